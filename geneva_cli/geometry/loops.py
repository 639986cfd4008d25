"""Pieces of a drawing that others made, as closed outlines with the material on their left.

Nesting tells plates from holes. Ends within ``JOINED_MM`` of each other are joined.
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import with_material_left
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment, at, backwards, closed
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.table import in_decimals

JOINED_MM = 1e-3  # ends that are nearer to each other are one
SHORTEST_MM = 1e-6  # shorter pieces are left out


class Loop(NamedTuple):
    """A closed outline with the material on its left; ``depth`` outlines lie around it, an odd
    number around a hole."""

    contour: Contour
    depth: int


def loops(pieces: Sequence[Line | Arc]) -> list[Loop]:
    """Return the closed outlines that pieces in any order make, in mm.

    Raises GenevaError, naming the place, for one that is open, branches or crosses.
    """
    kept = list(_distinct(pieces))
    if not kept:
        raise GenevaError("nothing is drawn: no lines, arcs, circles, polylines or splines")
    # closed chains of pieces, end to end
    partner = _partners([point for piece in kept for point in (piece.start, piece.end)])
    used, contours = [False] * len(kept), []
    for first in range(len(kept)):
        chain: list[Segment] = []
        end = 2 * first  # the end from which a piece is run through
        while not used[end // 2]:
            piece = kept[end // 2]
            used[end // 2] = True
            way = Contour("", (piece,), closed=False)
            chain += (backwards(way) if end % 2 else way).segments
            end = partner[end ^ 1]
        if chain:
            contours.append(with_material_left(closed("", chain), True))
    _refuse_crossings(contours)
    depth = np.zeros(len(contours), dtype=int)
    points = np.array([contour.segments[0].start for contour in contours])
    for i, outline in enumerate(Polyarc([contour]) for contour in contours):
        within = outline.signed(points) < 0.0
        within[i] = False
        depth += within
    return [
        Loop(contour if around % 2 == 0 else with_material_left(contour, False), around)
        for contour, around in zip(contours, depth.tolist(), strict=True)
    ]


def greatest_gap(pieces: Sequence[Line | Arc]) -> float:
    """Return the greatest distance of ends that ``loops`` joins, mm: of a drawing's rounding."""
    ends = [point for piece in _distinct(pieces) for point in (piece.start, piece.end)]
    return max(math.dist(ends[i], ends[j]) for i, j in enumerate(_partners(ends)))


def shown(point: Point) -> str:
    """A place in a drawing, for messages."""
    return f"({', '.join(in_decimals(value, 4) for value in point)})"


def _distinct(pieces: Sequence[Line | Arc]) -> Iterator[Line | Arc]:
    """Yield the pieces that have a length, each once."""
    seen: set[tuple[int, ...]] = set()
    for piece in pieces:
        middle = at(piece, 0.5)
        if max(math.dist(piece.start, middle), math.dist(middle, piece.end)) < SHORTEST_MM:
            continue
        ends = sorted((piece.start, piece.end))
        key = tuple(round(v / SHORTEST_MM) for point in (*ends, middle) for v in point)
        if key not in seen:
            seen.add(key)
            yield piece


def _partners(ends: list[Point]) -> list[int]:
    """Return for each end the other at the same place; raises GenevaError for none or several."""
    cells: dict[tuple[int, int], list[int]] = defaultdict(list)
    for i, (x, y) in enumerate(ends):
        cells[math.floor(x / JOINED_MM), math.floor(y / JOINED_MM)].append(i)
    out = []
    for i, point in enumerate(ends):
        cx, cy = (math.floor(v / JOINED_MM) for v in point)
        around = product((cx - 1, cx, cx + 1), (cy - 1, cy, cy + 1))
        others = (j for cell in around for j in cells.get(cell, ()) if j != i)
        near = [j for j in others if math.dist(point, ends[j]) <= JOINED_MM]
        if not near:
            gap, nearest = min((math.dist(point, p), p) for j, p in enumerate(ends) if j != i)
            raise GenevaError(
                f"the outline is open at {shown(point)}: the nearest other end is {gap:.4g} mm "
                f"away, at {shown(nearest)}; ends are joined up to {JOINED_MM:g} mm"
            )
        if len(near) > 1:
            text = "an outline does not branch; leave out the lines that bound no part"
            raise GenevaError(f"{len(near) + 1} ends meet at {shown(point)}: {text}")
        out.append(near[0])
    return out


def _refuse_crossings(contours: list[Contour]) -> None:
    """Raise GenevaError for the first place at which outlines cross."""
    outline = Polyarc(contours)
    count = len(outline)
    start, end = outline.x0 + 1j * outline.y0, outline.x1 + 1j * outline.y1
    for first in range(0, count, 512):
        some = np.arange(first, min(first + 512, count))
        apart = np.hypot(outline.ox[some, None] - outline.ox, outline.oy[some, None] - outline.oy)
        i, j = np.nonzero(apart <= outline.size[some, None] + outline.size)
        i = some[i]
        i, j = i[j > i], j[j > i]
        place = _crossing(outline, i, j, (end[i] == start[j]) | (end[j] == start[i]))
        if place is not None:
            text = "an outline must not cross itself or another"
            raise GenevaError(f"outlines cross at {shown(place)}: {text}")


def _crossing(outline: Polyarc, i: Whole, j: Whole, adjacent: Mask) -> Point | None:
    """Return a place at which pieces i and j cross away from a common end; None without one."""
    pairs = [outline.subset(i), outline.subset(j)]
    for place in _meetings(*pairs):
        known = np.isfinite(place)
        p, inside, normals, ends = np.where(known, place, 0.0), known, [], []
        for some in pairs:
            away, _, on, _ = some.distances(p.real, p.imag)
            inside = inside & on & (away < SHORTEST_MM)
            # at a joint that is rounded, two tangent pieces cross, but at hardly any angle
            radius = np.where(some.arc, some.radius, 1.0)
            from_centre = (p - some.cx - 1j * some.cy) / radius
            normals.append(np.where(some.arc, from_centre, some.mx + 1j * some.my))
            both = (some.x0 + 1j * some.y0, some.x1 + 1j * some.y1)
            ends.append(np.minimum(*(np.abs(end - p) for end in both)))
        depth = np.abs((normals[0].conj() * normals[1]).imag) * np.maximum(*ends)
        k = np.flatnonzero(inside & ~(adjacent & (depth < 4.0 * JOINED_MM)))
        if len(k):
            return float(p[k[0]].real), float(p[k[0]].imag)
    return None


@np.errstate(all="ignore")
def _meetings(one: Polyarc, two: Polyarc) -> list[Array]:
    """Return the points, complex, at which whole lines and circles cross; NaN where they do not."""
    # the line through both points: a piece itself, or the common chord of two circles
    a, b = one.cx + 1j * one.cy, two.cx + 1j * two.cy
    square = np.abs(b - a) ** 2
    chord = a + 0.5 * (square + one.radius**2 - two.radius**2) / square * (b - a)
    both, lines = one.arc & two.arc, ~one.arc & ~two.arc
    first, second = one.x0 + 1j * one.y0, two.x0 + 1j * two.y0
    start = np.where(both, chord, np.where(one.arc, second, first))
    along, other = one.dx + 1j * one.dy, two.dx + 1j * two.dy
    ahead = np.where(both, 1j * (b - a), np.where(one.arc, other, along))
    ahead /= np.abs(ahead)
    seen = (np.where(one.arc, a, b) - start) * ahead.conj()
    half = np.sqrt(np.where(one.arc, one.radius, two.radius) ** 2 - seen.imag**2)
    straight = ((second - start).conj() * other).imag / (ahead.conj() * other).imag
    at = [np.where(lines, straight, seen.real + sign * half) for sign in (1.0, -1.0)]
    return [start + t * ahead for t in at]
