"""Pieces parallel to others, their corners, and the path of a cutter along an outline.

The path is the true offset, of lines and arcs as the outline is, with arcs about outer corners. A
milling cutter reaches all of an outline if the offset by its radius keeps that distance.
"""

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import shapes
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import plates, with_material_left
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Layer, Line, Point, Segment
from geneva_cli.geometry.sheet import SHORTEST_MM, Drawing, prepared
from geneva_cli.numerics.tolerances import SAME_CUT_MM
from geneva_cli.spec.rules import TOOL_MM, require_mm

TOO_WIDE = "it is wider than a rounding, or cuts off a face of a part; use a smaller value"


class Closed(GenevaError):
    """An offset that has no path: at a place, ``what`` is narrower than the cut."""

    def __init__(self, layer: Layer, at: Point, what: str = "a gap") -> None:
        x, y = at
        super().__init__(f"near x = {x:.4g}, y = {y:.4g} on {layer} {what} is narrower")
        self.at, self.what = at, what


def paths(drawing: Drawing, kerf: float) -> Drawing:
    """Drawing with the solid shapes replaced by paths for a cut of a width in mm, and no solid.

    Raises GenevaError for a width outside of TOOL_MM, for cubics, and where no path fits.
    """
    require_mm("--kerf", kerf, TOOL_MM)
    cut = plates(drawing.solid) if drawing.solid else []
    outside = {hole: False for plate in cut for hole in plate.holes}
    outside |= {plate.outline: True for plate in cut}
    try:
        moved = tuple(
            offset(shape, outside[shape], 0.5 * kerf) if shape in outside else shape
            for shape in drawing.shapes
        )
    except Closed as error:
        raise GenevaError(f"--kerf {kerf:g}: {error}; use a narrower one") from None
    title = f"{drawing.title}, kerf {kerf:g} mm"
    return drawing._replace(title=title, shapes=moved, solid=None, shells=None)


def offset(shape: Contour | Circle, outside: bool, distance: float) -> Contour | Circle:
    """Move an outline outwards, or a hole inwards, by a distance above 0; may raise Closed."""
    if isinstance(shape, Circle):
        radius = shape.radius + (distance if outside else -distance)
        if radius <= SHORTEST_MM:
            raise Closed(shape.layer, shape.centre, f"a hole of {2.0 * shape.radius:.6g} mm")
        return shape._replace(radius=radius)
    contour, own = _cleaned(shape, outside)
    hollows = [piece for piece in own if isinstance(piece, Arc) and piece.bulge < 0.0]
    tightest = min(hollows, key=lambda arc: arc.radius, default=None)
    if tightest and tightest.radius - distance <= SHORTEST_MM:
        text = f"an inner radius of {tightest.radius:.5g} mm"
        raise Closed(shape.layer, shapes.at(tightest, 0.5), text)
    path = shapes.closed(shape.layer, _joined(shape.layer, own, distance))
    around = math.fsum(map(shapes.segment_length, path.segments))
    # four samples in the offset's length, but at most 50,000 for the path
    points = Polyarc([path]).samples(SAME_CUT_MM, max(distance / 4, around / 50_000))
    away = Polyarc([contour]).signed(points)
    if float(away.min()) < distance - SAME_CUT_MM:
        x, y = points[int(np.argmin(away))].tolist()
        raise Closed(shape.layer, (x, y))
    return path


def _cleaned(outline: Contour, outside: bool) -> tuple[Contour, list[Line | Arc]]:
    """Return an outline, or a hole, without pieces that no file shows, its material on the left.

    With it go its pieces. Raises GenevaError for a cubic.
    """
    (cleaned,) = prepared(Drawing("", (outline,))).shapes
    contour = with_material_left(cleaned, outside)
    own = [piece for piece in contour.segments if isinstance(piece, Line | Arc)]
    if len(own) < len(contour.segments):
        raise GenevaError("--kerf and --cutter work on lines and arcs only: use --curves arcs")
    return contour, own


def _turns(own: list[Line | Arc]) -> Iterator[tuple[int, int, float]]:
    """Yield each piece and the next one, by index, and the left turn between them, radians."""
    for i, piece in enumerate(own):
        k = (i + 1) % len(own)
        ahead, back = shapes.directions(own[k])[0], shapes.directions(piece)[1]
        yield i, k, math.remainder(ahead - back, math.tau)


def _joined(layer: Layer, own: list[Line | Arc], distance: float) -> list[Segment]:
    """Join the moved pieces with arcs round outer corners, and cut them off in inner ones."""
    moved = [parallel(piece, -distance) for piece in own]
    starts, ends = [piece.start for piece in moved], [piece.end for piece in moved]
    around: dict[int, Arc] = {}
    segments: list[Segment] = []
    place = ends[0]
    try:
        for i, k, turn in _turns(moved):
            place = ends[i]
            if math.dist(place, starts[k]) < SHORTEST_MM:
                continue
            if turn > 0.0:
                around[i] = Arc(place, starts[k], math.tan(0.25 * turn))
            else:
                ends[i] = starts[k] = corner(own[i], own[k], -distance, 1e-3)
        for i, piece in enumerate(moved):
            place = piece.start
            if (starts[i], ends[i]) != piece[:2]:
                piece = between(piece, starts[i], ends[i])
            segments += [piece, around[i]] if i in around else [piece]
    except GenevaError:  # too sharp, or shorter than the cut is wide
        raise Closed(layer, place) from None
    return segments


def away(piece: Line | Arc, at: Point) -> tuple[float, Point]:
    """Return how far a point is to the left of a piece's line or circle, and that direction."""
    start, end = complex(*piece.start), complex(*piece.end)
    long, half = abs(end - start), 0.5 * piece.sweep if isinstance(piece, Arc) else 0.0
    u = (end - start) / long
    seen = (complex(*at) - 0.5 * (start + end)) * u.conjugate()
    bend, c = 2.0 * math.sin(half) / long, math.cos(half)
    ahead, out = bend * seen.real, c - bend * seen.imag  # from the centre, over the radius
    far = math.hypot(ahead, out)
    inside = bend * (0.25 * long * long - seen.real**2 - seen.imag**2)
    left = complex(-ahead, out) * u / far
    return (inside + 2.0 * c * seen.imag) / (1.0 + far), (left.real, left.imag)


def corner(before: Line | Arc, after: Line | Arc, depth: float, sharpest: float = 0.1) -> Point:
    """Return the point at a distance to the left of two pieces, near their common end.

    Raises GenevaError for a corner so sharp that it is far away: ``sharpest`` is the least sum of 1
    and the cosine of its turn, by default an angle of 26 degrees.
    """
    x, y = after.start
    one, two = shapes.directions(before)[1], shapes.directions(after)[0]
    ax, ay, bx, by = -math.sin(one), math.cos(one), -math.sin(two), math.cos(two)
    both = 1.0 + ax * bx + ay * by
    if both < sharpest:
        raise GenevaError(TOO_WIDE)
    if abs(ax * by - ay * bx) < 1e-6:  # radians: tangent pieces meet in the common normal
        return x + depth * (ax + bx) / both, y + depth * (ay + by) / both
    for _ in range(40):  # Newton's digits double each time: five steps are usual
        (d, (ux, uy)), (e, (vx, vy)) = away(before, (x, y)), away(after, (x, y))
        det = ux * vy - uy * vx
        if not det:  # so deep that both pieces are in one direction, to rounding
            raise GenevaError(TOO_WIDE)
        d, e = depth - d, depth - e
        dx, dy = (d * vy - e * uy) / det, (e * ux - d * vx) / det
        x, y = x + dx, y + dy
        if abs(dx) + abs(dy) < 1e-15 * (1.0 + abs(x) + abs(y)):
            break
    return x, y


def parallel(piece: Line | Arc, depth: float) -> Line | Arc:
    """Return a piece moved to the left; raises GenevaError for an arc that turns inside out."""
    if isinstance(piece, Arc) and piece.bulge > 0.0 and piece.radius <= depth:
        raise GenevaError(TOO_WIDE)
    # ends are moved along their own normals: a flat arc's centre is far away
    ends = []
    for (x, y), direction in zip((piece.start, piece.end), shapes.directions(piece), strict=True):
        ends.append((x - depth * math.sin(direction), y + depth * math.cos(direction)))
    return piece._replace(start=ends[0], end=ends[1])


def between(piece: Line | Arc, start: Point, end: Point) -> Line | Arc:
    """Return a piece between two points of its line or circle; GenevaError if it runs back."""
    part = shapes.fraction_at(piece, end) - shapes.fraction_at(piece, start)
    if part <= 0.0:
        raise GenevaError(TOO_WIDE)
    bend = {"bulge": math.tan(0.25 * piece.sweep * part)} if isinstance(piece, Arc) else {}
    return piece._replace(start=start, end=end, **bend)


def judged(drawing: Drawing, cutter_mm: float) -> tuple[str, list[str]]:
    """Return places that a cutter does not enter, "" if none, and notes on what else it leaves.

    Raises GenevaError for a diameter outside of TOOL_MM, and for outlines with cubics.
    """
    require_mm("--cutter", cutter_mm, TOOL_MM)
    stops, notes, radius = list[str](), list[str](), 0.5 * cutter_mm
    for plate in dict.fromkeys(plates(drawing.solid)) if drawing.solid else ():
        for original in (plate.outline, *plate.holes):
            outside, layer = original is plate.outline, f"{plate.name}, layer {original.layer}"
            if isinstance(original, Circle):
                if not outside and original.radius < radius - SAME_CUT_MM:
                    x, y = original.centre
                    size = f"hole of {2.0 * original.radius:.6g} mm at x = {x:.6g}, y = {y:.6g}"
                    notes.append(f"{size} in {plate.name}: narrower than the cutter; drill it")
                continue
            try:
                offset(original, outside, radius - SAME_CUT_MM)
            except Closed as error:
                # a micrometre's last digit moves with rounding; six decimals in mm are steady
                x, y = (round(v, 6) + 0.0 for v in error.at)
                text = f"it does not enter {layer}, at x = {x:.5g}, y = {y:.5g}"
                stops.append(f"{text}: {error.what} is narrower; use a smaller one")
                continue
            _, own = _cleaned(original, outside)
            for i, _, turn in _turns(own):
                # less than 1e-4 mm of material is no corner
                if -math.pi < turn < 0.0 and radius * (1.0 / math.cos(0.5 * turn) - 1.0) > 1e-4:
                    x, y = own[i].end
                    text = f"the corner of {layer}, at x = {x:.5g}, y = {y:.5g}"
                    notes.append(f"it leaves a radius of {radius:.6g} mm in {text}")
    refused = f"--cutter {cutter_mm:g}: {'; '.join(stops)}" if stops else ""
    return refused, [f"--cutter {cutter_mm:g}: {text}" for text in notes]
