"""Exact distances of many points from outlines of lines and arcs.

Polygons are not accurate enough: the locking disc lies in its recess without any play.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from geneva_cli.geometry.shapes import Arc, Contour, Line
from geneva_cli.numerics.arrays import Array, Mask, Whole, blocks, rising
from geneva_cli.numerics.tolerances import SAME_ANGLE

BLOCK = 1 << 14  # distances in a block: they stay in the processor's cache


class Polyarc:
    """The boundary of a part, of closed contours with the material on their left."""

    def __init__(self, contours: Iterable[Contour]) -> None:
        rows, after = list[tuple[float, ...]](), list[int]()
        for contour in contours:
            after += [*range(len(rows) + 1, len(rows) + len(contour.segments)), len(rows)]
            for piece in contour.segments:
                assert isinstance(piece, Line | Arc), "cubics have no exact distance here"
                bulge = piece.bulge if isinstance(piece, Arc) else 0.0
                rows.append((*piece.start, *piece.end, bulge))
        self.after = np.array(after)  # the piece that follows each
        x0, y0, x1, y1, bulges = np.array(rows).T
        dx, dy, sense, half = x1 - x0, y1 - y0, np.sign(bulges), 2.0 * np.arctan(bulges)
        # the turns of the outline at the ends of the pieces, and at their starts
        chord = np.arctan2(dy, dx)
        turn = (chord - half)[after] - (chord + half)
        turn = turn - math.tau * np.round(turn / math.tau)
        turn_end, turn_start = np.where(np.abs(turn) > SAME_ANGLE, turn, 0.0), np.empty(len(turn))
        turn_start[after] = turn_end
        dx = np.where((dx == 0.0) & (dy == 0.0), 1e-150, dx)  # a point has a direction too
        square = np.maximum(dx * dx + dy * dy, 1e-300)
        length, ox, oy = np.sqrt(square), 0.5 * (x0 + x1), 0.5 * (y0 + y1)
        # the centre of a line is far away, on its right
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = np.where(sense == 0.0, 0.0, 0.5 * length / np.sin(np.abs(half)))
            away = 0.25 * (1.0 - bulges * bulges) / bulges
        away = np.where(sense == 0.0, -1e12 * length.max() / length, away)
        right = np.where(sense < 0.0, -1.0, 1.0) / length
        size = np.where(np.abs(bulges) > 1.0, 2.0 * radius, 0.5 * length)
        arcs = (ox - away * dy, oy + away * dx, radius, sense, dy * right, -dx * right)
        halves = np.abs(np.sin(half)), np.cos(half)
        chords = (dx, dy, square, length, ox, oy, size)
        self._name(np.array((x0, y0, x1, y1, *arcs, *halves, *chords, turn_start, turn_end)))

    def _name(self, columns: Array) -> None:
        """Set the numbers of the pieces, one row of ``columns`` each."""
        self._columns = columns
        self.x0, self.y0, self.x1, self.y1, *rest = columns
        # Centre; for arcs radius, left (1) or right (-1); 0 for lines. Then the direction from the
        # centre to the middle, for lines to the right, and sine and cosine of half the sweep.
        self.cx, self.cy, self.radius, self.sense, self.mx, self.my, *rest = rest
        self.sin_half, self.cos_half, *rest = rest
        self.arc = self.sense != 0.0
        self.dx, self.dy, self.square, self.length, *rest = rest  # of the chord
        # A circle about the middle of each piece's chord that holds the piece. Then the turn of the
        # outline at each piece's start and end, radians: above 0 to the left, 0 for none.
        self.ox, self.oy, self.size, self.turn_start, self.turn_end = rest
        self.starts, self.centres, self.middles = columns[:2].T, columns[4:6].T, columns[-5:-3].T
        # if an outline lies in another one, so do some of these points
        self.probes = self.starts

    def __len__(self) -> int:
        return len(self.x0)

    def subset(self, keep: Whole) -> Polyarc:
        """The boundary's pieces at some indices, for points that are near no other pieces."""
        out = object.__new__(Polyarc)
        out._name(self._columns[:, keep])
        return out

    def signed(self, points: Array) -> Array:
        """Distance of each of (n, 2) points from the boundary, negative inside the material."""
        out = np.empty(len(points))
        for block in blocks(len(points), max(1, BLOCK // len(self.x0))):
            px, py = points[block].T
            # The nearest piece is among those whose circles come nearer than the ends of any piece.
            dx, dy = px[:, None] - self.ox, py[:, None] - self.oy
            away = np.sqrt(dx * dx + dy * dy)
            most = (away + 0.5 * self.length).min(axis=1, keepdims=True)
            # 1e-9 of a distance is more than its rounding
            row, piece = np.nonzero(away - self.size <= most * (1.0 + 1e-9))
            some = self.subset(piece)
            distance, side, facing, along = some.distances(px[row], py[row])
            # the first of the nearest pieces of each point
            least = np.minimum.reduceat(distance, np.flatnonzero(np.diff(row, prepend=-1)))
            equal = np.flatnonzero(distance == least[row])
            first = equal[np.flatnonzero(np.diff(row[equal], prepend=-1))]
            # Outside at a convex corner, inside at a hollow one; at a smooth joint by the side.
            turn = np.where(along[first] < 0.0, some.turn_start[first], some.turn_end[first])
            inside = np.where(~facing[first] & (turn != 0.0), turn < 0.0, side[first] > 0.0)
            out[block] = np.where(inside, -1.0, 1.0) * distance[first]
        return out

    def distances(self, x: Array, y: Array) -> tuple[Array, Array, Mask, Array]:
        """Distances and sides of points relative to pieces; x and y broadcast with the pieces.

        Returned are the distance from the piece, that from its whole line or circle, positive on
        its left, True where the nearest point is inside the piece, and the place along its chord,
        from the middle.

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
        return distance, np.where(self.sense < 0.0, -side, side), facing, along

    def farthest(self, points: Array) -> Array:
        """Return the distance from points (n, 2) to the farthest point of each piece, (n, k)."""
        x, y = points.T[..., None]
        vx, vy = self.cx - x, self.cy - y
        away = np.hypot(vx, vy)
        opposite = self.arc & (vx * self.mx + vy * self.my >= away * self.cos_half)
        start, end = np.hypot(self.x0 - x, self.y0 - y), np.hypot(self.x1 - x, self.y1 - y)
        return np.where(opposite, away + self.radius, np.maximum(start, end))

    def touching(self, which: Whole, centres: Array) -> tuple[Whole, Array]:
        """Return the points of some pieces (m,) where others may touch, after their indices.

        They are their starts, and points in the directions of centres (m, j, 2), or opposite.
        """
        some = self.subset(which[:, None])
        # Coordinates are from each arc's centre, along its chord and outwards, over its radius.
        # They are computed from the chord's middle: a centre may be too far away.
        x, y = centres[..., 0] - some.ox, centres[..., 1] - some.oy
        along, out = some.mx * y - some.my * x, some.mx * x + some.my * y
        bend = 2.0 * some.sin_half / some.length
        turn = np.arctan2(bend * along, bend * out + some.cos_half)
        turns = np.array((turn, turn - np.copysign(np.pi, turn)))
        half = np.arctan2(some.sin_half, some.cos_half)
        # lines have a foot, and no opposite point
        place = np.where(some.arc, turns, (along, np.full_like(along, np.inf)))
        place = place / np.where(some.arc, half, 0.5 * some.length)
        on = np.nonzero(np.abs(place) <= 1.0)
        way = np.where(some.sense < 0.0, -0.5, 0.5)[on[1], 0]
        facing = self.at(which[on[1]], 0.5 + way * place[on])
        rows = np.concatenate((np.arange(len(which)), on[1]))
        return rows, np.concatenate((self.probes[which], facing))

    def at(self, which: Whole, fraction: Array) -> Array:
        """Points of some pieces at fractions of their lengths, (n, 2)."""
        some, along = self.subset(which), 2.0 * fraction - 1.0  # from its middle, of half of it
        half = np.arctan2(some.sin_half, some.cos_half)
        sine = np.where(some.arc, some.sin_half, 1.0)
        # measured from the chord: the centre may be kilometres away
        rise = some.length * np.sin(half * fraction) * np.sin(half * (1.0 - fraction)) / sine
        along = 0.5 * np.where(some.arc, np.sin(along * half) / sine, along)
        x = some.ox + along * some.dx + rise * some.mx
        y = some.oy + along * some.dy + rise * some.my
        return np.column_stack((x, y))

    def samples(self, sagitta: float, longest: float) -> Array:
        """Points of the boundary, (n, 2): all corners, and points at the requested spacing."""
        arc, radius = self.arc, np.where(self.arc, self.radius, 1.0)
        sweep = 2.0 * np.arctan2(self.sin_half, self.cos_half)
        step = 4.0 * np.arcsin(np.sqrt(0.5 * np.minimum(sagitta / radius, 1.0)))
        bent = np.maximum(sweep / step, sweep * radius / longest)
        count = np.maximum(np.ceil(np.where(arc, bent, self.length / longest)), 1.0).astype(int)
        first = np.cumsum(count) - count
        which = np.repeat(np.arange(len(count)), count)
        fraction = (np.arange(len(which)) - first[which]) / count[which]
        points = self.at(which, fraction)
        points[first] = self.starts  # exactly
        return points

    def one_sector(self, pitch: float, near: float) -> Whole | None:
        """The pieces of a sector that repeats after ``pitch`` radians within ``near`` mm, or None.

        Of equal pieces, the first ones are taken.
        """
        count = round(math.tau / pitch)
        if not len(self.x0) or len(self.x0) % count:
            return None
        sides = np.column_stack((self.x0 + 1j * self.y0, self.x1 + 1j * self.y1))
        bend = self.sense * self.sin_half
        turned = sides * np.exp(1j * pitch)
        after = np.empty(len(turned), dtype=int)
        for some in blocks(len(turned), max(1, (1 << 22) // len(turned))):
            # each piece starts at another place, and squares take a tenth of the time of distances
            x, y = turned[some, :1].real - self.x0, turned[some, :1].imag - self.y0
            after[some] = np.argmin(x * x + y * y, axis=1)
        moved = np.abs(turned - sides[after]).max()
        if moved > near or np.abs(bend - bend[after]).max() > 1e-9:
            return None
        least = here = np.arange(len(turned))
        for _ in range(count - 1):
            here = after[here]
            least = np.minimum(least, here)
        return rising(least)


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
    # the points of the segments that are nearest to the pieces' ends and centres
    px, py = np.array((near.x0, near.x1, near.cx)), np.array((near.y0, near.y1, near.cy))
    along = np.clip(((px - x) * dx + (py - y) * dy) / square, 0.0, 1.0)
    fx, fy = x + along * dx, y + along * dy
    from_ends, *_ = near.distances(np.array((x, ex, fx[2])), np.array((y, ey, fy[2])))
    corners = np.hypot(fx[:2] - px[:2], fy[:2] - py[:2])
    out = np.full(len(start), reach)
    np.minimum.at(out, row, np.minimum(from_ends.min(axis=0), corners.min(axis=0)))
    return out
