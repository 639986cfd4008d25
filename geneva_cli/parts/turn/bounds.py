"""Proved lower bounds of the gaps between wheel, crank and rollers on intervals of the input angle.

A gap is at least that in the middle of an interval, less how far the parts move from there.
``geneva help accuracy`` derives the bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias, cast

import numpy as np

from geneva_cli.geometry.distance import Polyarc, farthest, from_segments, short_pieces
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Undecided, Whole
from geneva_cli.numerics.intervals import Interval, size_of
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pose, Window, raised

Curve: TypeAlias = Callable[[Number, int], tuple[Jet, Jet]]

UNKNOWN = 1e30  # mm: a bound that is not known, so large that no interval closes with it


class FlatPairs:
    """Pairs of flat parts, with gaps up to ``target`` mm; the wheel reaches the level ``rim``."""

    def __init__(self, gaps: Gaps, crank: Sequence[Contour], target: float, rim: float) -> None:
        self.gaps, self.crank, self.target, self.rim = gaps, crank, target, rim
        self.moves, self.L = gaps.assembly.plane_motion, gaps.assembly.L
        self.apart = max(target, 0.0)  # the distance up to which parts matter
        self._travels: dict[tuple[str, Engagement], Travel] = {}

    def lock(self, window: Window, on: Intervals) -> Bounds:
        """Return the gap of locking disc and wheel: bounds up to ``apart``.

        In the dwell and beside it, the part of the crank that is within the wheel's rim lies in the
        circle that the wheel leaves free about the middle of each recess.
        """
        gap = self.gaps.locking(on.at_middle)
        far = self.rim if self.gaps.assembly.sign > 0.0 else self.L + self.disc + self.apart
        moved = self.moves.lever(far) * on.wheel + (self.disc + self.apart) * on.crank
        least = gap - moved
        doubtful = least < self.target
        least = raised(least, doubtful, lambda which: self._in_recess(window, on.at(which)))
        return Bounds(gap, np.minimum(least, self.apart))

    def free(self, roller: int, window: Window, on: Intervals) -> Bounds:
        """Return the gap of a roller outside the slot that it drives.

        It is the gap in the middle, less the roller's travel in the wheel's frame. While the wheel
        rests, the centre is also near the chord of its path.
        """
        centre, path = self._centre(roller, on.at_middle), self._path(roller)
        beyond = self.gaps.assembly.sign * (self.moves.level(centre) - self.rim)
        gap = self.gaps.rollers(on.at_middle)[:, roller]
        gap = np.maximum(gap, beyond - self.gaps.sizes.roller)
        least = gap - self._travel(roller, on, centre)

        def near_chord(which: Whole) -> Array:
            some = on.at(which)
            start, end = (self._centre(roller, pose) for pose in (some.at_start, some.at_end))
            aside = path.aside(*self._own(roller, some))
            return self._along((start, end, aside), centre[which], gap[which])

        return Bounds(gap, raised(least, window.rests & (least < self.target), near_chord))

    def driving(self, roller: int, span: tuple[float, float], on: Intervals) -> Bounds:
        """Return the gap of a roller in its slot, on its axis or near chords of its curve."""
        engagement, _ = self.gaps.assembly.rollers[roller]
        centre = self._centre(roller, on.at_middle)
        gap = self.gaps.rollers(on.at_middle)[:, roller]
        if engagement.slot.curved:
            moving, middle = self.gaps.assembly.motions[roller]
            if ("slot", moving) not in self._travels:
                # the roller's travel in its slot, in the wheel's frame
                edges = _edges(moving, moving.entry_deg, moving.exit_deg)
                rates = _rates(moving.slot, np.array(edges[:-1]), np.array(edges[1:]))
                self._travels["slot", moving] = Travel(edges, rates, self.L)
            start, end = (self._centre(roller, pose) for pose in (on.at_start, on.at_end))
            aside = self._travels["slot", moving].aside(on.start - middle, on.end - middle)
            return Bounds(gap, self._along((start, end, aside), centre, gap))
        places = self.gaps.pose(np.array([span[0], 0.5 * (span[0] + span[1])]))
        first, other = self._centre(roller, places)
        axis = (first - other) / math.dist(first, other)
        half = self._travel(roller, on, centre)[:, None] * axis
        aside = np.abs((centre - first) @ (-axis[1], axis[0]))
        return Bounds(gap, self._along((centre - half, centre + half, aside), centre, gap))

    @cached_property
    def pieces(self) -> Polyarc:
        """The crank in arcs of a degree, each of which is tested for being in the wheel."""
        return short_pieces(self.crank, math.radians(1.0))

    @cached_property
    def disc(self) -> float:
        """The greatest distance of the crank from its axis, mm."""
        return float(farthest(self.pieces, 0.0, 0.0).max())

    def _path(self, roller: int) -> Travel:
        """Return the travel of a roller through a whole turn in the fixed frame."""
        engagement, _ = self.gaps.assembly.rollers[roller]
        if ("path", engagement) not in self._travels:  # which several rollers share
            turn_deg = self.gaps.assembly.turn_deg
            edges = _edges(engagement, -0.5 * turn_deg, 0.5 * turn_deg)
            start, end = np.array(edges[:-1]), np.array(edges[1:])
            moving, dwell = np.full(len(start), True), None
            if engagement.groove is not None:
                from geneva_cli.motion.groove_path import dwell_rates

                dwell = dwell_rates(engagement.groove)
                if dwell:
                    moving = (engagement.entry_deg <= start) & (end <= engagement.exit_deg)
            rates = np.empty((2, len(start)))
            rates[:, moving] = _rates(engagement.path, start[moving], end[moving])
            if dwell:
                rates[:, ~moving] = np.array(dwell)[:, None]
            self._travels["path", engagement] = Travel(edges, rates, self.L, turn_deg)
        return self._travels["path", engagement]

    def _own(self, roller: int, on: Intervals) -> tuple[Array, Array]:
        """Return the ends of intervals as angles of the roller's own engagement."""
        start = self.gaps.assembly.from_mid(on.start, self.gaps.assembly.rollers[roller][1])
        return start, start + (on.end - on.start)

    def _centre(self, roller: int, pose: Pose) -> Array:
        """Return a roller's centre in the wheel's frame, (n, 2)."""
        return self.moves.into(pose.pins[:, roller], pose.wheel)

    def _travel(self, roller: int, on: Intervals, centre: Array) -> Array:
        """Return how far the centre is at most from its place in the middle, ``centre``."""
        moved = self.moves.lever(self.moves.level(centre)) * on.wheel
        return self._path(roller).most(*self._own(roller, on)) + moved

    def _along(self, segments: tuple[Array, Array, Array], centre: Array, gap: Array) -> Array:
        """Return the gap of a roller, ``gap`` at ``centre``, that moves along segments.

        ``segments`` has their ends in the wheel's frame, and how far off the centre may be, mm.
        """
        start, end, aside = segments
        radius = self.gaps.sizes.roller
        off = np.hypot(*(0.5 * (start + end) - centre).T)
        # A segment that is shorter than its middle's distance from the outline does not cross it.
        short = 0.5 * np.hypot(*(end - start).T) < radius + gap - off
        least = np.full(len(gap), -math.inf)
        if short.any():
            reach = radius + self.gaps.near
            free = from_segments(self.gaps.wheel, start[short], end[short], reach)
            least[short] = free - aside[short] - radius
        return least

    def _in_recess(self, window: Window, on: Intervals) -> Array:
        """Return how far the crank stays within the circle of the nearer recess, mm."""
        moves, L, pieces, (wheel, crank, _) = self.moves, self.L, self.pieces, on.at_middle
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = self.gaps.assembly.wheel(np.array((window.start, window.end)))
        recesses = moves.into(np.array(((L, 0.0), (L, 0.0))), turn)
        nearer = (on.middle - window.start >= window.end - on.middle).astype(int)
        middle = moves.into(recesses[nearer], -wheel)
        offset = turned_points(middle - (L, 0.0), -crank)
        # the pieces of the crank that may come within the wheel's rim
        c, s = np.cos(crank)[:, None], np.sin(crank)[:, None]
        x, y = L + c * pieces.ox - s * pieces.oy, s * pieces.ox + c * pieces.oy
        beyond = self.gaps.assembly.sign * (moves.level(np.stack((x, y), axis=-1)) - self.rim)
        moved = self.disc * on.crank[:, None] + self.apart
        row, piece = np.nonzero(beyond - pieces.size <= moved)
        far = np.zeros(len(wheel))
        np.maximum.at(far, row, farthest(pieces.subset(piece), *offset[row].T))
        away = moves.lever(L) * on.wheel + np.hypot(*offset.T) * on.crank
        return self.gaps.wheel.signed(recesses)[nearer] - far - away


class Travel:
    """Bounds of the speed and the second derivative of a curve between two input angles.

    ``rates`` (2, n) has them on the n cells between ``edges``, degrees from mid-motion, in units of
    ``length`` mm; infinite if unknown. A curve that runs all round repeats after ``turn_deg``.
    """

    def __init__(
        self, edges: Sequence[float], rates: Array, length: float, turn_deg: float = 0.0
    ) -> None:
        speed, bend = np.minimum(length * rates, UNKNOWN)
        self.edges = np.array(edges)
        if turn_deg:  # an interval may begin in one turn and end in the next
            speed, bend = np.tile(speed, 2), np.tile(bend, 2)
            self.edges = np.concatenate((self.edges, self.edges[1:] + turn_deg))
        self.bend, self.unknown = bend, np.where(speed < UNKNOWN, 0.0, UNKNOWN)
        known = np.where(speed < UNKNOWN, speed, 0.0)
        self.moved = np.concatenate(([0.0], np.cumsum(known * np.radians(np.diff(self.edges)))))

    def most(self, start: Array, end: Array) -> Array:
        """Return how far the curve is at most, on either half of intervals, from their middles."""
        moved = [np.interp(at, self.edges, self.moved) for at in (start, 0.5 * (start + end), end)]
        out: Array = np.diff(moved, axis=0).max(axis=0)
        return np.maximum(out, self._greatest(self.unknown, start, end))

    def aside(self, start: Array, end: Array) -> Array:
        """Return how far the curve is at most from its chord on intervals."""
        return self._greatest(self.bend, start, end) * np.radians(end - start) ** 2 / 8.0

    def _greatest(self, values: Array, start: Array, end: Array) -> Array:
        """Return the greatest value of the cells that intervals touch."""
        touch = (self.edges[:-1] <= end[:, None]) & (self.edges[1:] >= start[:, None])
        return np.where(touch, values, 0.0).max(axis=1)


def _edges(engagement: Engagement, start: float, end: float) -> list[float]:
    """Return the ends of cells; no formula changes within a cell of the motion."""
    # on cells longer than a degree of the input the bounds are much wider
    seams = [x for x in engagement.motion.seams_deg if start < x < end]
    return sorted({*np.linspace(start, end, math.ceil(end - start) + 1).tolist(), *seams})


def _rates(curve: Curve, start: Array, end: Array) -> Array:
    """Return the greatest sizes of a curve's derivatives on n cells (2, n); infinite if unknown.

    Where another formula takes over within a cell, it is halved down to that place.
    """
    rates, tries = np.zeros((2, len(start))), np.zeros(len(start), dtype=int)
    left = [(np.arange(len(start)), start, end)]  # parts of cells: each one's cell, and its ends
    while left:
        part = left.pop()
        # an interval may reach over the end of a formula's piece by some 1e-12 degrees: each such
        # place takes 80 halves
        few = tries[part[0]] < 400
        cell, low, high = part[0][few], part[1][few], part[2][few]
        if not len(cell):
            continue
        try:
            with np.errstate(all="ignore"):
                x, y = curve(cast("Number", Interval(low, high)), 2)
        except Undecided as error:
            answers = np.broadcast_to(error.answers, len(cell))
            for one in sorted(set(answers[~np.isnan(answers)].tolist())):
                some = answers == one
                left.append((cell[some], low[some], high[some]))
            some = np.isnan(answers)
            cell, low, high = cell[some], low[some], high[some]
            half = 0.5 * (low + high)
            left.append((np.tile(cell, 2), np.append(low, half), np.append(half, high)))
        else:
            for k, total in enumerate(rates, start=1):
                np.maximum.at(total, cell, k * np.hypot(size_of(x.c[k]), size_of(y.c[k])))
        np.add.at(tries, cell, 1)
    rates[:, tries >= 400] = math.inf
    return rates
