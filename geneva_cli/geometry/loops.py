"""Pieces of a drawing that others made, as closed outlines with the material on their left.

Nesting tells plates from holes. Ends within ``JOINED_MM`` of each other are joined.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import with_material_left
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment, at, backwards, closed
from geneva_cli.numerics.arrays import blocks
from geneva_cli.table import in_decimals

JOINED_MM = 1e-3  # ends that are nearer to each other are one
SHORTEST_MM = 1e-6  # shorter pieces are left out
ROUNDING = 1e-9  # of a chord: an end that is nearer to another chord lies on it
BLOCK = 1 << 22  # pairs of chords that are compared together


def loops(pieces: Sequence[Line | Arc]) -> list[Contour]:
    """Return the closed outlines that pieces in any order make, in mm.

    They run counterclockwise, but clockwise around a hole, in an odd number of others.

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
    points = np.array([contour.segments[0].start for contour in contours])
    inside = np.array([Polyarc([contour]).signed(points) < 0.0 for contour in contours])
    np.fill_diagonal(inside, False)
    around = inside.sum(axis=0).tolist()
    return [with_material_left(one, n % 2 == 0) for one, n in zip(contours, around, strict=True)]


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
    points, out = np.array(ends) @ (1.0, 1j), []
    order, x = np.argsort(points.real), points.real
    low, high = np.searchsorted(x[order], x - JOINED_MM), np.searchsorted(x[order], x + JOINED_MM)
    for i in range(len(ends)):
        near = order[low[i] : high[i]]  # not farther in x
        near = near[np.abs(points[near] - points[i]) <= JOINED_MM].tolist()
        if len(near) == 1:
            away = np.abs(points - points[i])
            away[i] = np.inf
            other = int(np.argmin(away))
            raise GenevaError(
                f"the outline is open at {shown(ends[i])}: the nearest other end is "
                f"{away[other]:.4g} mm away, at {shown(ends[other])}; ends are joined up to "
                f"{JOINED_MM:g} mm"
            )
        if len(near) > 2:
            text = "an outline does not branch; leave out the lines that bound no part"
            raise GenevaError(f"{len(near)} ends meet at {shown(ends[i])}: {text}")
        out.append(sum(near) - i)
    return out


@np.errstate(divide="ignore", invalid="ignore")
def _refuse_crossings(contours: list[Contour]) -> None:
    """Raise GenevaError for the first place at which outlines cross, by chords within JOINED_MM."""
    rings = [Polyarc([contour]).samples(JOINED_MM, math.inf) @ (1.0, 1j) for contour in contours]
    start, end = np.concatenate(rings), np.concatenate([np.roll(ring, -1) for ring in rings])
    step, middle = end - start, 0.5 * (start + end)
    size = 0.5 * np.abs(step)
    for some in blocks(len(start), max(1, BLOCK // len(start))):
        apart = np.abs(middle[some, None] - middle)
        i, j = np.nonzero(apart <= size[some, None] + size)
        i += some.start
        away, across = start[j] - start[i], (step[i].conj() * step[j]).imag
        # fractions of both chords
        fractions = [(away.conj() * step[k]).imag / across for k in (j, i)]
        crosses = np.all([np.abs(x - 0.5) <= 0.5 + ROUNDING for x in fractions], axis=0)
        k = np.flatnonzero(crosses & (i < j) & (end[i] != start[j]) & (end[j] != start[i]))
        if len(k):
            place = start[i[k[0]]] + fractions[0][k[0]] * step[i[k[0]]]
            text = "an outline must not cross itself or another"
            raise GenevaError(f"outlines cross at {shown((place.real, place.imag))}: {text}")
