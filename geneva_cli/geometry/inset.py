"""Contours parallel to a contour of lines and arcs, inside its material."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import directions, fraction_at
from geneva_cli.geometry.shapes import Arc, Line, Point, Shape, as_contour


def lines_and_arcs(shape: Shape, cubics: str) -> list[Line | Arc]:
    """Return the pieces of a closed shape; raises GenevaError with a text for a cubic."""
    pieces = as_contour(shape).segments
    plain = [piece for piece in pieces if isinstance(piece, Line | Arc)]
    if len(plain) < len(pieces):
        raise GenevaError(cubics)
    return plain


def away(piece: Line | Arc, at: Point) -> tuple[float, Point]:
    """Return how far a point is to the left of a piece's line or circle, and that direction.

    All is measured from the middle of the chord: a flat arc's centre may be kilometres away.
    """
    (x0, y0), (x1, y1) = piece.start, piece.end
    long = math.dist(piece.start, piece.end)
    u, v, half = (x1 - x0) / long, (y1 - y0) / long, 0.0
    if isinstance(piece, Arc):
        half = 0.5 * piece.sweep
    x, y = at[0] - 0.5 * (x0 + x1), at[1] - 0.5 * (y0 + y1)
    along, left = x * u + y * v, y * u - x * v
    bend, c = 2.0 * math.sin(half) / long, math.cos(half)
    ahead, out = bend * along, c - bend * left  # from the centre, over the radius
    far = math.hypot(ahead, out)
    side = (bend * (0.25 * long * long - along * along - left * left) + 2.0 * c * left) / (
        1.0 + far
    )
    return side, (-(ahead * u + out * v) / far, (out * u - ahead * v) / far)


def corner(before: Line | Arc, after: Line | Arc, depth: float, sharpest: float = 0.1) -> Point:
    """Return the point at a distance to the left of two pieces, near their common end.

    Raises GenevaError for a corner so sharp that it is far away: ``sharpest`` is the least sum of 1
    and the cosine of its turn, by default an angle of 26 degrees.
    """
    x, y = after.start
    (ax, ay), (bx, by) = _left(directions(before)[1]), _left(directions(after)[0])
    both = 1.0 + ax * bx + ay * by
    if both < sharpest:
        raise _too_wide()
    if abs(ax * by - ay * bx) < 1e-6:  # radians: tangent pieces meet in the common normal
        return x + depth * (ax + bx) / both, y + depth * (ay + by) / both
    for _ in range(40):  # Newton's digits double each time: five steps are usual
        (d, (ux, uy)), (e, (vx, vy)) = away(before, (x, y)), away(after, (x, y))
        det = ux * vy - uy * vx
        if not det:  # so deep that both pieces are in one direction, to rounding
            raise _too_wide()
        d, e = depth - d, depth - e
        dx, dy = (d * vy - e * uy) / det, (e * ux - d * vx) / det
        x, y = x + dx, y + dy
        if abs(dx) + abs(dy) < 1e-15 * (1.0 + abs(x) + abs(y)):
            break
    return x, y


def parallel(piece: Line | Arc, depth: float) -> Line | Arc:
    """Return a piece moved to the left; raises GenevaError for an arc that turns inside out."""
    if isinstance(piece, Arc) and piece.bulge > 0.0 and piece.radius <= depth:
        raise _too_wide()
    # ends are moved along their own normals: a flat arc's centre is far away
    ends = []
    for (x, y), direction in zip((piece.start, piece.end), directions(piece), strict=True):
        u, v = _left(direction)
        ends.append((x + depth * u, y + depth * v))
    return piece._replace(start=ends[0], end=ends[1])


def between(piece: Line | Arc, start: Point, end: Point) -> Line | Arc:
    """Return a piece from one of its points to another, which may lie beyond its ends.

    Raises GenevaError where it would run backwards.
    """
    part = fraction_at(piece, end) - fraction_at(piece, start)
    if part <= 0.0:
        raise _too_wide()
    bend = {"bulge": math.tan(0.25 * piece.sweep * part)} if isinstance(piece, Arc) else {}
    return piece._replace(start=start, end=end, **bend)


def _left(direction: float) -> Point:
    return -math.sin(direction), math.cos(direction)


def _too_wide() -> GenevaError:
    return GenevaError(
        "it is wider than a rounding, or cuts off a face of a part; use a smaller value"
    )
