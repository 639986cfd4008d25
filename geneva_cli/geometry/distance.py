"""Exact distances of many points from outlines of lines and arcs.

Polygons are not accurate enough here. A wheel that is 0.2 mm too large collides by less than a
micrometre. The locking disc lies in its recess without any play.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.measure import directions
from geneva_cli.geometry.shapes import Arc, Contour, Line
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE

if TYPE_CHECKING:
    Which: TypeAlias = Whole | tuple[Whole, Whole]

BLOCK = 1 << 14  # distances in a block: they stay in the processor's cache


class PieceDistances(NamedTuple):
    """Distances and sides of points relative to pieces.

    ``side`` is the signed distance from the whole line or circle. ``facing`` is True if the nearest
    point is inside the piece. ``along`` is the position along its chord, from the middle.
    """

    distance: Array
    side: Array
    facing: Mask
    along: Array

    def at(self, which: Which) -> PieceDistances:
        """Those at some indices."""
        distance, side, facing, along = self
        return PieceDistances(distance[which], side[which], facing[which], along[which])


class Polyarc:
    """The boundary of a part, of closed contours with the material on their left."""

    def __init__(self, contours: Iterable[Contour]) -> None:
        rows, turns = [], []
        for contour in contours:
            pieces = [s for s in contour.segments if isinstance(s, Line | Arc)]
            assert len(pieces) == len(contour.segments), "cubics have no exact distance here"
            rows += [_row(piece) for piece in pieces]
            headings = [directions(piece) for piece in pieces]
            turns += [_corner(headings[i - 1][1], headings[i][0]) for i in range(len(headings))]
        x0, y0, x1, y1, cx, cy, radius, sense, sin_half, cos_half = np.array(rows).T
        dx, dy = x1 - x0, y1 - y0
        dx = np.where((dx == 0.0) & (dy == 0.0), 1e-150, dx)  # a point has a direction too
        square = np.maximum(dx * dx + dy * dy, 1e-300)
        length = np.sqrt(square)
        right = np.where(sense < 0.0, -1.0, 1.0) / length
        size = np.where(cos_half < 0.0, 2.0 * radius, 0.5 * length)
        after, first = [], 0
        for contour in contours:
            count = len(contour.segments)
            after += [first + (i + 1) % count for i in range(count)]
            first += count
        turn = np.array(turns)
        arcs = (cx, cy, radius, sense, dy * right, -dx * right, sin_half, cos_half)
        chords = (dx, dy, square, length, 0.5 * (x0 + x1), 0.5 * (y0 + y1), size)
        self._name(np.array((x0, y0, x1, y1, *arcs, *chords, turn, turn[after])))

    def _name(self, columns: Array) -> None:
        """Set the numbers of the pieces, one row of ``columns`` each."""
        self._columns = columns
        self.x0, self.y0, self.x1, self.y1, *rest = columns
        # For arcs: centre, radius, left (1) or right (-1); 0 for lines. Then the direction from the
        # centre to the middle, for lines to the right, and sine and cosine of half the sweep.
        self.cx, self.cy, self.radius, self.sense, self.mx, self.my, *rest = rest
        self.sin_half, self.cos_half, *rest = rest
        self.arc = self.sense != 0.0
        self.dx, self.dy, self.square, self.length, *rest = rest  # of the chord
        # A circle about the middle of each piece's chord that holds the piece. Then the turn of the
        # outline at each piece's start and end, radians: above 0 to the left, 0 for none.
        self.ox, self.oy, self.size, self.turn_start, self.turn_end = rest

    def __len__(self) -> int:
        return len(self.x0)

    def subset(self, keep: Whole) -> Polyarc:
        """The boundary's pieces at some indices, for points that are near no other pieces."""
        out = object.__new__(Polyarc)
        out._name(self._columns[:, keep])
        return out

    def signed(self, points: Array) -> Array:
        """Distance of each of (n, 2) points from the boundary, negative inside the material."""
        size = max(1, BLOCK // len(self))
        blocks = [self._signed(points[i : i + size]) for i in range(0, len(points), size)]
        return np.concatenate(blocks) if blocks else np.empty(0)

    def _signed(self, points: Array) -> Array:
        x, y = points.T
        row, pieces = self._nearby(points)
        some = self.subset(pieces)
        views = some.distances(x[row], y[row])
        # the first of the nearest pieces of each point
        least = np.minimum.reduceat(views.distance, np.flatnonzero(_changes(row)))
        equal = np.flatnonzero(views.distance == least[row])
        first = equal[_changes(row[equal])]
        return some._signs(views.at(first), first)

    def distances(self, x: Array, y: Array) -> PieceDistances:
        """Distances and sides of points relative to pieces; x and y broadcast with the pieces.

        A fitted arc may have a radius of kilometres. So nothing is measured from its centre, but
        all from the middle of its chord. A line is an arc without curvature.
        """
        px, py = x - self.ox, y - self.oy
        along = (px * self.dx + py * self.dy) / self.length
        outward = px * self.mx + py * self.my
        beyond, square = np.abs(along) - 0.5 * self.length, outward * outward
        facing = self.sin_half * outward >= self.cos_half * beyond
        # radius - far = (radius^2 - far^2) / (radius + far), with the distance ``far`` from the
        # centre, over the radius
        bend = 2.0 * self.sin_half / self.length
        far = np.sqrt((bend * along) ** 2 + (bend * outward + self.cos_half) ** 2)
        inside = bend * (0.25 * self.square - along * along - square)
        side = (inside - 2.0 * self.cos_half * outward) / (1.0 + far)
        distance = np.where(facing, np.abs(side), np.sqrt(square + beyond * beyond))
        return PieceDistances(distance, np.where(self.sense < 0.0, -side, side), facing, along)

    def _signs(self, view: PieceDistances, piece: Whole) -> Array:
        """Signed distances of points from their nearest pieces."""
        # Outside at a convex corner, inside at a hollow one; at a smooth joint the side decides.
        turn = np.where(view.along < 0.0, self.turn_start[piece], self.turn_end[piece])
        corner = ~view.facing & (turn != 0.0)
        inside = np.where(corner, turn < 0.0, view.side > 0.0)
        return np.where(inside, -1.0, 1.0) * view.distance

    def _nearby(self, points: Array) -> tuple[Whole, Whole]:
        """Each point with the pieces among which its nearest one is, both in order.

        A piece's ends are half its chord from the middle of its circle. No point of it is farther
        from there than its size.
        """
        dx, dy = points[:, :1] - self.ox, points[:, 1:] - self.oy
        away = np.sqrt(dx * dx + dy * dy)
        most = (away + 0.5 * self.length).min(axis=1, keepdims=True)
        # 1e-9 of a distance is more than its rounding
        row, piece = np.nonzero(away - self.size <= most * (1.0 + 1e-9))
        return row, piece

    def samples(self, sagitta: float, longest: float) -> Array:
        """Points of the boundary, (n, 2): all corners, and points at the requested spacing."""
        arc, radius = self.arc, np.where(self.arc, self.radius, 1.0)
        sweep = 2.0 * np.arctan2(self.sin_half, self.cos_half)
        step = 4.0 * np.arcsin(np.sqrt(0.5 * np.minimum(sagitta / radius, 1.0)))
        bent = np.maximum(sweep / step, sweep * radius / longest)
        count = np.maximum(np.ceil(np.where(arc, bent, self.length / longest)), 1.0).astype(int)
        first = np.cumsum(count) - count
        which = np.repeat(np.arange(len(self)), count)
        fraction = (np.arange(len(which)) - first[which]) / count[which]
        half, size = 0.5 * sweep[which], 2.0 * radius[which]
        turn = (2.0 * fraction - 1.0) * half
        # measured from the chord: the centre may be kilometres away
        along = 0.5 * size * np.sin(turn) * np.where(self.sense[which] < 0.0, -1.0, 1.0)
        out = size * np.sin(half * fraction) * np.sin(half * (1.0 - fraction))
        x = self.ox[which] - along * self.my[which] + out * self.mx[which]
        y = self.oy[which] + along * self.mx[which] + out * self.my[which]
        flat = ~arc[which] | (fraction == 0.0)
        along, i = fraction[flat], which[flat]
        x[flat], y[flat] = self.x0[i] + along * self.dx[i], self.y0[i] + along * self.dy[i]
        return np.column_stack((x, y))


def _changes(numbers: Whole) -> Mask:
    """True where a number differs from the one before; the first is True."""
    out = np.ones(len(numbers), dtype=bool)
    out[1:] = numbers[1:] != numbers[:-1]
    return out


def _row(piece: Line | Arc) -> tuple[float, ...]:
    if isinstance(piece, Line):
        return (*piece.start, *piece.end, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    half = 0.5 * abs(piece.sweep)
    sine, sense = math.sin(half), math.copysign(1.0, piece.bulge)
    # as ``piece.radius``, without another arc tangent and sine
    radius = 0.5 * math.dist(piece.start, piece.end) / abs(sine)
    return (*piece.start, *piece.end, *piece.centre, radius, sense, sine, math.cos(half))


def _corner(before: float, after: float) -> float:
    turn = math.remainder(after - before, math.tau)
    return turn if abs(turn) > SAME_ANGLE else 0.0
