"""Exact distances of many points from outlines of lines and arcs.

Polygons are not accurate enough: the locking disc lies in its recess without any play.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.measure import directions
from geneva_cli.geometry.shapes import Arc, Contour, Line, Segment, about
from geneva_cli.numerics.arrays import Array, Mask, Number, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE

PLACES = (0, 2, 4, 8, 12, 16)  # columns of a boundary that are x, and y behind it
BLOCK = 1 << 14  # distances in a block: they stay in the processor's cache


class PieceDistances(NamedTuple):
    """Distances and sides of points relative to pieces."""

    distance: Array
    side: Array  # signed distance from the whole line or circle
    facing: Mask  # True if the nearest point is inside the piece
    along: Array  # position along its chord, from the middle


class Polyarc:
    """The boundary of a part, of closed contours with the material on their left."""

    def __init__(self, contours: Iterable[Contour]) -> None:
        rows = []
        for contour in contours:
            pieces = [s for s in contour.segments if isinstance(s, Line | Arc)]
            assert len(pieces) == len(contour.segments), "cubics have no exact distance here"
            ends = [directions(piece) for piece in pieces]
            steps = (math.remainder(on[0] - ends[i - 1][1], math.tau) for i, on in enumerate(ends))
            turns = [turn if abs(turn) > SAME_ANGLE else 0.0 for turn in steps]
            for piece, before, after in zip(pieces, turns, [*turns[1:], *turns[:1]], strict=True):
                circle = 0.0, 0.0, 0.0, 0.0, 0.0, 1.0
                if isinstance(piece, Arc):
                    half, sense = 0.5 * abs(piece.sweep), math.copysign(1.0, piece.bulge)
                    sine = math.sin(half)
                    # as ``piece.radius``, without another arc tangent and sine
                    radius = 0.5 * math.dist(piece.start, piece.end) / abs(sine)
                    circle = (*piece.centre, radius, sense, sine, math.cos(half))
                rows.append((*piece.start, *piece.end, *circle, before, after))
        x0, y0, x1, y1, cx, cy, radius, sense, sin_half, cos_half, *turned = np.array(rows).T
        dx, dy = x1 - x0, y1 - y0
        dx = np.where((dx == 0.0) & (dy == 0.0), 1e-150, dx)  # a point has a direction too
        square = np.maximum(dx * dx + dy * dy, 1e-300)
        length = np.sqrt(square)
        right = np.where(sense < 0.0, -1.0, 1.0) / length
        size = np.where(cos_half < 0.0, 2.0 * radius, 0.5 * length)
        arcs = (cx, cy, radius, sense, dy * right, -dx * right, sin_half, cos_half)
        chords = (dx, dy, square, length, 0.5 * (x0 + x1), 0.5 * (y0 + y1), size)
        self._name(np.array((x0, y0, x1, y1, *arcs, *chords, *turned)))

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

    def around(self, count: int) -> Polyarc:
        """The pieces and their copies, turned about the origin by 1/``count`` turn each."""
        out, turned = object.__new__(Polyarc), []
        for k in range(count):
            c, s = math.cos(math.tau * k / count), math.sin(math.tau * k / count)
            copy = self._columns.copy()
            for i in PLACES:
                x, y = self._columns[i], self._columns[i + 1]
                copy[i], copy[i + 1] = c * x - s * y, s * x + c * y
            turned.append(copy)
        out._name(np.concatenate(turned, axis=1))
        return out

    def signed(self, points: Array) -> Array:
        """Distance of each of (n, 2) points from the boundary, negative inside the material."""
        size = max(1, BLOCK // len(self))
        blocks = [self._signed(points[i : i + size]) for i in range(0, len(points), size)]
        return np.concatenate(blocks) if blocks else np.empty(0)

    def _signed(self, points: Array) -> Array:
        # The nearest piece is among those whose circles come nearer than the ends of any piece.
        dx, dy = points[:, :1] - self.ox, points[:, 1:] - self.oy
        away = np.sqrt(dx * dx + dy * dy)
        most = (away + 0.5 * self.length).min(axis=1, keepdims=True)
        # 1e-9 of a distance is more than its rounding
        row, piece = np.nonzero(away - self.size <= most * (1.0 + 1e-9))
        some = self.subset(piece)
        seen = some.distances(*points[row].T)
        # the first of the nearest pieces of each point
        least = np.minimum.reduceat(seen.distance, np.flatnonzero(_changes(row)))
        equal = np.flatnonzero(seen.distance == least[row])
        first = equal[_changes(row[equal])]
        distance, side, facing, along = seen
        # Outside at a convex corner, inside at a hollow one; at a smooth joint the side decides.
        turn = np.where(along[first] < 0.0, some.turn_start[first], some.turn_end[first])
        inside = np.where(~facing[first] & (turn != 0.0), turn < 0.0, side[first] > 0.0)
        return np.where(inside, -1.0, 1.0) * distance[first]

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


def farthest(outline: Polyarc, x: Number, y: Number) -> Array:
    """Return the distance from points to the farthest point of each piece; both broadcast."""
    vx, vy = outline.cx - x, outline.cy - y
    away = np.hypot(vx, vy)
    opposite = outline.arc & (vx * outline.mx + vy * outline.my >= away * outline.cos_half)
    start, end = np.hypot(outline.x0 - x, outline.y0 - y), np.hypot(outline.x1 - x, outline.y1 - y)
    return np.where(opposite, away + outline.radius, np.maximum(start, end))


def from_segments(outline: Polyarc, start: Array, end: Array, reach: float) -> Array:
    """Return the distance, at most ``reach``, of segments that cross no piece, (n,).

    It is at an end of the segment, at a corner of the outline, or where the line from an arc's
    centre meets the segment at a right angle.
    """
    # only pieces that may lie within reach of a segment are compared with it
    (x, y), half = 0.5 * (start + end).T, 0.5 * np.hypot(*(end - start).T)
    middle = np.hypot(outline.ox - x[:, None], outline.oy - y[:, None])
    row, piece = np.nonzero(middle <= reach + half[:, None] + outline.size)
    near = outline.subset(piece)
    (x, y), (dx, dy), (ex, ey) = start[row].T, (end - start)[row].T, end[row].T
    square = np.maximum(dx * dx + dy * dy, 1e-300)

    def nearest(px: Array, py: Array) -> tuple[Array, Array]:
        """The points of the segments that are nearest to points."""
        along = np.clip(((px - x) * dx + (py - y) * dy) / square, 0.0, 1.0)
        return x + along * dx, y + along * dy

    def away(px: Array, py: Array) -> Array:
        fx, fy = nearest(px, py)
        return np.hypot(fx - px, fy - py)

    places = (x, y), (ex, ey), nearest(near.cx, near.cy)
    from_places = [near.distances(*place).distance for place in places]
    corners = away(near.x0, near.y0), away(near.x1, near.y1)
    out = np.full(len(start), reach)
    np.minimum.at(out, row, np.minimum.reduce((*from_places, *corners)))
    return out


def short_pieces(contours: Iterable[Contour], step: float) -> Polyarc:
    """Return an outline in short pieces: arcs of at most ``step`` radians, and parts of lines."""
    pieces: list[Segment] = []
    for segment in (segment for contour in contours for segment in contour.segments):
        if isinstance(segment, Arc):
            (cx, cy), sweep = segment.centre, segment.sweep
            start = math.atan2(segment.start[1] - cy, segment.start[0] - cx)
            count = max(1, math.ceil(abs(sweep) / step))
            turns = (start + sweep * i / count for i in range(count))
            pieces += [about((cx, cy), segment.radius, turn, sweep / count) for turn in turns]
            continue
        (x0, y0), (x1, y1) = segment.start, segment.end
        count = math.ceil(0.5 * math.pi / step)
        shares = [i / count for i in range(count + 1)]
        corners = [(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share) for share in shares]
        pieces += map(Line, corners[:-1], corners[1:])
    return Polyarc([Contour("", tuple(pieces))])
