"""The path of a cutter along an outline: its true offset, of lines and arcs as the outline is.

A laser's beam removes half its kerf on either side of its path. So the path runs that far outside
outlines and inside holes. Round an outer corner the path is an arc about it. In an inner corner
adjacent pieces end where they meet, and the beam leaves its own radius.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.measure import at, directions, segment_length
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
    return drawing._replace(
        title=f"{drawing.title}, kerf {kerf:g} mm", shapes=shapes, solid=None, shells=None
    )


def _path(shape: Contour | Circle, outside: bool, kerf: float) -> Contour | Circle:
    """Path about an outline or in a hole."""
    try:
        return offset(shape, outside, 0.5 * kerf)
    except Closed as error:
        raise GenevaError(f"--kerf {kerf:g}: {error}; {_widest(shape, outside, kerf)}") from None


def _widest(shape: Contour | Circle, outside: bool, kerf: float) -> str:
    """Advice for the user: the widest kerf that has a path, to three digits."""

    def leaves_a_path(width: float) -> bool:
        try:
            offset(shape, outside, 0.5 * width)
        except Closed:
            return False
        return True

    halvings = 12  # enough for the three digits
    widest = boundary(leaves_a_path, 0.0, kerf, halvings)
    if not widest:
        return f"even {kerf * 0.5**halvings:.2g} mm is too wide"
    return f"use a kerf up to {to_digits(widest, 3, math.floor):g} mm"


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
    contour = with_material_left(cleaned, outside)
    pieces = [_moved_piece(segment, contour.layer, distance) for segment in contour.segments]
    path = _joined(contour, pieces)
    _require_away(contour, path, distance)
    return path


def _moved_piece(segment: Segment, layer: Layer, distance: float) -> Line | Arc:
    """Move a piece to the right of its direction of travel."""
    if isinstance(segment, Line):
        (x0, y0), (x1, y1) = segment
        scale = distance / math.dist(segment.start, segment.end)
        x, y = scale * (y1 - y0), scale * (x0 - x1)
        return Line((x0 + x, y0 + y), (x1 + x, y1 + y))
    if not isinstance(segment, Arc):
        raise GenevaError("--kerf works on lines and arcs only: omit --curves spline")
    # A flat arc's centre is far away: its ends are moved along their own normals instead.
    ends = [
        _moved(point, direction, distance)
        for point, direction in zip((segment.start, segment.end), directions(segment), strict=True)
    ]
    if segment.bulge < 0.0 and segment.radius - distance <= SHORTEST_MM:
        text = f"a hollow of radius {segment.radius:.6g} mm on {layer} is narrower than the cut"
        raise Closed(text, at(segment, 0.5))
    return Arc(ends[0], ends[1], segment.bulge)


def _moved(point: Point, direction: float, distance: float) -> Point:
    return point[0] + distance * math.sin(direction), point[1] - distance * math.cos(direction)


def _joined(contour: Contour, pieces: list[Line | Arc]) -> Contour:
    """Join the moved pieces with arcs round outer corners, and cut them off in inner ones."""
    count = len(pieces)
    low, high = [0.0] * count, [1.0] * count
    around: list[Arc | None] = [None] * count
    for i, piece in enumerate(pieces):
        k = (i + 1) % count
        before, after = directions(piece)[1], directions(pieces[k])[0]
        turn = math.remainder(after - before, math.tau)
        if math.dist(piece.end, pieces[k].start) < SHORTEST_MM:
            continue
        if turn > 0.0:
            around[i] = Arc(piece.end, pieces[k].start, math.tan(0.25 * turn))
        else:
            high[i], low[k] = _meeting(contour, piece, pieces[k])
    segments: list[Segment] = []
    for piece, start, end, arc in zip(pieces, low, high, around, strict=True):
        if start >= end:
            raise Closed(f"a piece of {contour.layer} is shorter than the cut is wide", piece.start)
        segments += [_part(piece, start, end), *([arc] if arc else [])]
    return closed(contour.layer, segments)


def _meeting(contour: Contour, first: Line | Arc, second: Line | Arc) -> tuple[float, float]:
    """Crossing of two pieces whose ends overlap, as fractions of their lengths.

    Newton's method in both unknowns at once, from the corner, which is near.
    """
    s, t = 1.0, 0.0
    for _ in range(40):  # Newton steps; four or five are usual
        (x, y), (u, v) = at(first, s), at(second, t)
        (a, b), (c, d) = _speed(first, s), _speed(second, t)
        across = b * c - a * d
        if abs(across) < 1e-12 * math.hypot(a, b) * math.hypot(c, d):
            break
        ds, dt = ((u - x) * d - (v - y) * c) / -across, ((u - x) * b - (v - y) * a) / -across
        s, t = s + ds, t + dt
        if abs(ds) + abs(dt) < 1e-15:
            break
    apart = math.dist(at(first, s), at(second, t))
    if not (apart < SHORTEST_MM and 0.0 < s <= 1.0 and 0.0 <= t < 1.0):
        text = f"an inner corner of {contour.layer} is narrower than the cut"
        raise Closed(text, first.end)
    return s, t


def _speed(piece: Line | Arc, t: float) -> Point:
    """Derivative of the point by the fraction of the length."""
    first, last = directions(piece)
    direction, length = first + t * (last - first), segment_length(piece)
    return length * math.cos(direction), length * math.sin(direction)


def _part(piece: Line | Arc, start: float, end: float) -> Line | Arc:
    """Part of a piece between two fractions of its length."""
    if (start, end) == (0.0, 1.0):
        return piece
    ends = at(piece, start), at(piece, end)
    if isinstance(piece, Line):
        return Line(*ends)
    return Arc(*ends, math.tan(0.25 * piece.sweep * (end - start)))


def _require_away(contour: Contour, path: Contour, distance: float) -> None:
    """Raise if the path comes nearer to the part than the beam's radius.

    It does so wherever it crosses itself or turns inside out.
    """
    boundary = Polyarc([contour])
    around = math.fsum(map(segment_length, path.segments))
    # four samples in the offset's length, but at most 50,000 for the path
    longest = max(distance / 4, around / 50_000)
    points = Polyarc([path]).samples(SAME_CUT_MM, longest)
    away = boundary.signed(points)
    if float(away.min()) < distance - SAME_CUT_MM:
        at_x, at_y = points[int(np.argmin(away))]
        raise Closed(
            f"near x = {at_x:.4g}, y = {at_y:.4g} on {contour.layer} a gap is narrower than the "
            "cut",
            (float(at_x), float(at_y)),
        )
