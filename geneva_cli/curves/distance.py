"""Exact distances of many points from outlines of lines and arcs.

Polygons are not accurate enough here. A wheel that is 0.2 mm too large collides by less than a
micrometre. The locking disc lies in its recess without any play.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.measure import directions
from geneva_cli.curves.shapes import Arc, Contour, Line
from geneva_cli.numerics.tolerances import SAME_ANGLE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

    Which: TypeAlias = NDArray[np.intp] | tuple[NDArray[np.intp], NDArray[np.intp]]

BLOCK = 1 << 14  # distances in a block: they stay in the processor's cache


class _PieceDistances(NamedTuple):
    """Distances and sides of points relative to pieces.

    ``side`` is the signed distance from the whole line or circle. ``facing`` is True if the nearest
    point is inside the piece. ``start`` and ``end`` are squared distances from its ends.
    """

    distance: Array
    side: Array
    facing: NDArray[np.bool_]
    start: Array
    end: Array

    def at(self, which: Which) -> _PieceDistances:
        distance, side, facing, start, end = self
        return _PieceDistances(
            distance[which], side[which], facing[which], start[which], end[which]
        )


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
        x0, y0, x1, y1, *rest = np.array(rows).T
        radius, sense, cos_half = rest[2], rest[3], rest[6]
        dx, dy = x1 - x0, y1 - y0
        square = np.maximum(dx * dx + dy * dy, 1e-300)
        length = np.sqrt(square)
        wide = (sense != 0.0) & (cos_half < 0.0)
        size = np.where(wide, 2.0 * radius, 0.5 * length)
        after, first = [], 0
        for contour in contours:
            count = len(contour.segments)
            after += [first + (i + 1) % count for i in range(count)]
            first += count
        turn = np.array(turns)
        ends = (x0, y0, x1, y1, *rest, dx, dy, square, length)
        self._name(np.array((*ends, 0.5 * (x0 + x1), 0.5 * (y0 + y1), size, turn, turn[after])))

    def _name(self, columns: Array) -> None:
        """Set the numbers of the pieces, one row of ``columns`` each."""
        self._columns = columns
        self.x0, self.y0, self.x1, self.y1, *rest = columns
        # For arcs: centre, radius, left (1) or right (-1), the direction of the middle and the
        # cosine of half the sweep. All are 0 for lines.
        self.cx, self.cy, self.radius, self.sense, self.mx, self.my, self.cos_half, *rest = rest
        self.arc = self.sense != 0.0
        self.dx, self.dy, self.square, self.length, *rest = rest  # of the chord
        # A circle about the middle of each piece's chord that holds the piece. Then the turn of the
        # outline at each piece's start and end: left (1), right (-1) or none (0).
        self.ox, self.oy, self.size, self.turn_start, self.turn_end = rest

    def __len__(self) -> int:
        return len(self.x0)

    def subset(self, keep: NDArray[np.intp]) -> Polyarc:
        """The boundary's pieces at some indices, for points that are near no other pieces."""
        out = object.__new__(Polyarc)
        out._name(self._columns[:, keep])
        return out

    def near(self, points: Array, reach: float) -> Polyarc:
        """The pieces that may lie within ``reach`` of one of the points; all pieces if none do.

        For points farther away the result has no valid side of the outline.
        """
        # sixty points represent all of them here, where pieces are selected
        grid = points[:: max(1, len(points) // 60)]
        dx, dy = grid[:, :1] - self.ox, grid[:, 1:] - self.oy
        away = np.sqrt((dx * dx + dy * dy).min(axis=0)) - self.size
        # Points between those of the grid are no farther from it than its own spacing.
        step = np.hypot(*np.diff(points, axis=0).T)
        spare = float(step.max(initial=0.0)) * (len(points) // len(grid) + 1)
        keep = np.flatnonzero(away <= reach + spare)
        return self.subset(keep) if len(keep) else self

    def signed(self, points: Array) -> Array:
        """Distance of each of (n, 2) points from the boundary, negative inside the material."""
        size = max(1, BLOCK // len(self))
        blocks = [self._signed(points[i : i + size]) for i in range(0, len(points), size)]
        return np.concatenate(blocks) if blocks else np.empty(0)

    def _signed(self, points: Array) -> Array:
        x, y = points.T
        if len(self) < 64:  # with more pieces, selecting those nearby first is faster
            views = self._upright._distances(x, y)
            piece = np.argmin(views.distance, axis=0)
            return self._signs(views.at((piece, np.arange(len(points)))), piece)
        row, pieces = self._nearby(points)
        some = self.subset(pieces)
        views = some._distances(x[row], y[row])
        # the first of the nearest pieces of each point
        least = np.minimum.reduceat(views.distance, np.flatnonzero(_changes(row)))
        equal = np.flatnonzero(views.distance == least[row])
        first = equal[_changes(row[equal])]
        return some._signs(views.at(first), first)

    @cached_property
    def _upright(self) -> Polyarc:
        """The pieces in a column, so that array rows run along the points.

        There are more points than pieces; rows along the pieces take at least twice as long.
        """
        out = object.__new__(Polyarc)
        out._name(self._columns[:, :, None])
        return out

    def _distances(self, x: Array, y: Array) -> _PieceDistances:
        """Distances and sides of points relative to pieces; x and y broadcast with the pieces."""
        ax, ay = x - self.x0, y - self.y0
        # Lines: the fraction along them. Arcs: True if the point is in the sector seen from the
        # centre.
        fraction = (ax * self.dx + ay * self.dy) / self.square
        vx, vy = x - self.cx, y - self.cy
        far = np.sqrt(vx * vx + vy * vy)  # takes a tenth of hypot's time; nothing here overflows
        facing = np.where(
            self.arc,
            vx * self.mx + vy * self.my >= far * self.cos_half,
            (fraction >= 0.0) & (fraction <= 1.0),
        )
        side = np.where(
            self.arc,
            self.sense * (self.radius - far),
            (self.dx * ay - self.dy * ax) / self.length,
        )
        bx, by = x - self.x1, y - self.y1
        start, end = ax * ax + ay * ay, bx * bx + by * by
        distance = np.where(facing, np.abs(side), np.sqrt(np.minimum(start, end)))
        return _PieceDistances(distance, side, facing, start, end)

    def _signs(self, view: _PieceDistances, piece: NDArray[np.intp]) -> Array:
        """Signed distances of points from their nearest pieces."""
        # Outside at a convex corner, inside at a hollow one; at a smooth joint the side decides.
        turn = np.where(view.start < view.end, self.turn_start[piece], self.turn_end[piece])
        corner = ~view.facing & (turn != 0.0)
        inside = np.where(corner, turn < 0.0, view.side > 0.0)
        out: Array = np.where(inside, -1.0, 1.0) * view.distance
        return out

    def _nearby(self, points: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
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
        sweep = 2.0 * np.arccos(np.clip(self.cos_half, -1.0, 1.0))
        step = 4.0 * np.arcsin(np.sqrt(0.5 * np.minimum(sagitta / radius, 1.0)))
        bent = np.maximum(sweep / step, sweep * radius / longest)
        count = np.maximum(np.ceil(np.where(arc, bent, self.length / longest)), 1.0).astype(int)
        first = np.cumsum(count) - count
        which = np.repeat(np.arange(len(self)), count)
        fraction = (np.arange(len(which)) - first[which]) / count[which]
        start = np.arctan2(self.y0 - self.cy, self.x0 - self.cx)
        turn = start[which] + (self.sense * sweep)[which] * fraction
        x = self.cx[which] + radius[which] * np.cos(turn)
        y = self.cy[which] + radius[which] * np.sin(turn)
        flat = ~arc[which] | (fraction == 0.0)
        along, i = fraction[flat], which[flat]
        x[flat], y[flat] = self.x0[i] + along * self.dx[i], self.y0[i] + along * self.dy[i]
        return np.column_stack((x, y))


def _changes(numbers: NDArray[np.intp]) -> NDArray[np.bool_]:
    """True where a number differs from the one before; the first is True."""
    out = np.ones(len(numbers), dtype=bool)
    out[1:] = numbers[1:] != numbers[:-1]
    return out


def _row(piece: Line | Arc) -> tuple[float, ...]:
    if isinstance(piece, Line):
        return (*piece.start, *piece.end, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    (cx, cy), radius, sweep = piece.centre, piece.radius, piece.sweep
    start = math.atan2(piece.start[1] - cy, piece.start[0] - cx)
    middle = start + 0.5 * sweep
    return (
        *piece.start,
        *piece.end,
        cx,
        cy,
        radius,
        math.copysign(1.0, sweep),
        math.cos(middle),
        math.sin(middle),
        math.cos(0.5 * sweep),
    )


def _corner(before: float, after: float) -> float:
    turn = math.remainder(after - before, math.tau)
    return math.copysign(1.0, turn) if abs(turn) > SAME_ANGLE else 0.0
