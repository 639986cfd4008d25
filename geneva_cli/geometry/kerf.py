"""The path of a cutter along an outline: its true offset, of lines and arcs as the outline is.

Round an outer corner the path is an arc about it. In an inner corner adjacent pieces end where they
meet, and the beam leaves its own radius.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.inset import between, corner, lines_and_arcs, parallel
from geneva_cli.geometry.measure import at, directions, fraction_at, segment_length
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.pieces import SHORTEST_MM, prepared
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Layer, Line, Point, Segment, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import SAME_CUT_MM
from geneva_cli.spec.rules import TOOL_MM, require_mm


class Closed(GenevaError):
    """An offset that has no path; ``at`` is the place."""

    def __init__(self, text: str, at: Point) -> None:
        super().__init__(text)
        self.at = at


def paths(drawing: Drawing, kerf: float) -> Drawing:
    """Drawing with the solid shapes replaced by paths for a cut of a width in mm, and no solid.

    Raises GenevaError for a width outside of TOOL_MM, and for cubics. If no path leaves the part as
    it is, the error names a narrower kerf that does.

    >>> from geneva_cli.geometry.plates import Plate
    >>> bore = Circle("BORE", (0.0, 0.0), 5.0)
    >>> washer = Plate("washer", "CRANK", Circle("CRANK", (0.0, 0.0), 9.0), (bore,), 0.0, 1.0)
    >>> cut = paths(Drawing("washer", (washer.outline, bore), solid=washer), 0.2)
    >>> [circle.radius for circle in cut.shapes]
    [9.1, 4.9]
    """
    require_mm("--kerf", kerf, TOOL_MM)
    cut = plates(drawing.solid) if drawing.solid else []
    outside = {hole: False for plate in cut for hole in plate.holes}
    outside |= {plate.outline: True for plate in cut}
    shapes = tuple(
        _path(shape, outside[shape], kerf) if shape in outside else shape
        for shape in drawing.shapes
    )
    title = f"{drawing.title}, kerf {kerf:g} mm"
    return drawing._replace(title=title, shapes=shapes, solid=None, shells=None)


def _path(shape: Contour | Circle, outside: bool, kerf: float) -> Contour | Circle:
    """Path about an outline or in a hole."""

    def leaves_a_path(width: float) -> bool:
        try:
            offset(shape, outside, 0.5 * width)
        except Closed:
            return False
        return True

    try:
        return offset(shape, outside, 0.5 * kerf)
    except Closed as error:
        halvings = 12  # enough for the three digits that are shown
        widest = boundary(leaves_a_path, 0.0, kerf, halvings)
        advice = f"use a kerf up to {to_digits(widest, 3, math.floor):g} mm"
        if not widest:
            advice = f"even {kerf * 0.5**halvings:.2g} mm is too wide"
        raise GenevaError(f"--kerf {kerf:g}: {error}; {advice}") from None


def offset(shape: Contour | Circle, outside: bool, distance: float) -> Contour | Circle:
    """Move an outline outwards, or a hole inwards, by a distance above 0.

    Raises GenevaError if the beam does not fit in, and for cubics.
    """
    if isinstance(shape, Circle):
        radius = shape.radius + (distance if outside else -distance)
        if radius <= SHORTEST_MM:
            text = f"the hole of {2.0 * shape.radius:.6g} mm on {shape.layer} is too narrow"
            raise Closed(text, shape.centre)
        return shape._replace(radius=radius)
    (cleaned,) = prepared(Drawing("", (shape,))).shapes
    assert isinstance(cleaned, Contour)
    contour, layer = with_material_left(cleaned, outside), shape.layer
    own = lines_and_arcs(contour, "--kerf works on lines and arcs only: omit --curves spline")
    for piece in own:
        if isinstance(piece, Arc) and piece.bulge < 0.0 and piece.radius - distance <= SHORTEST_MM:
            text = f"a hollow of radius {piece.radius:.6g} mm on {layer} is narrower than the cut"
            raise Closed(text, at(piece, 0.5))
    path = closed(layer, _joined(layer, own, distance))
    _require_away(contour, path, distance)
    return path


def _joined(layer: Layer, own: list[Line | Arc], distance: float) -> list[Segment]:
    """Join the moved pieces with arcs round outer corners, and cut them off in inner ones."""
    moved = [parallel(piece, -distance) for piece in own]
    starts, ends = [piece.start for piece in moved], [piece.end for piece in moved]
    around: dict[int, Arc] = {}
    for i, (piece, other) in enumerate(zip(moved, [*moved[1:], moved[0]], strict=True)):
        k = (i + 1) % len(moved)
        turn = math.remainder(directions(other)[0] - directions(piece)[1], math.tau)
        if math.dist(piece.end, other.start) < SHORTEST_MM:
            continue
        if turn > 0.0:
            around[i] = Arc(piece.end, other.start, math.tan(0.25 * turn))
            continue
        try:
            ends[i] = starts[k] = point = corner(own[i], own[k], -distance, 1e-3)
            s, t = fraction_at(piece, point), fraction_at(other, point)
            apart = math.dist(at(piece, s), at(other, t))
            meet = apart < SHORTEST_MM and 0.0 < s <= 1.0 and 0.0 <= t < 1.0
        except GenevaError:  # too sharp
            meet = False
        if not meet:
            raise Closed(f"an inner corner of {layer} is narrower than the cut", piece.end)
    segments: list[Segment] = []
    for i, (piece, start, end) in enumerate(zip(moved, starts, ends, strict=True)):
        if (start, end) != (piece.start, piece.end):
            if fraction_at(piece, start) >= fraction_at(piece, end):
                text = f"a piece of {layer} is shorter than the cut is wide"
                raise Closed(text, piece.start)
            piece = between(piece, start, end)
        segments += [piece, around[i]] if i in around else [piece]
    return segments


def _require_away(contour: Contour, path: Contour, distance: float) -> None:
    """Raise if the path comes nearer to the part than the beam's radius."""
    around = math.fsum(map(segment_length, path.segments))
    # four samples in the offset's length, but at most 50,000 for the path
    longest = max(distance / 4, around / 50_000)
    points = Polyarc([path]).samples(SAME_CUT_MM, longest)
    away = Polyarc([contour]).signed(points)
    if float(away.min()) < distance - SAME_CUT_MM:
        x, y = points[int(np.argmin(away))].tolist()
        text = f"near x = {x:.4g}, y = {y:.4g} on {contour.layer} a gap is narrower than the cut"
        raise Closed(text, (x, y))
