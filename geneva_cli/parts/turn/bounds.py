"""Proved lower bounds of the gaps between wheel, crank and rollers on intervals of the input angle.

A gap is at least that in the middle of an interval, less how far the parts move from there.
``geneva help accuracy`` derives the bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeAlias, cast

import numpy as np

from geneva_cli.geometry.distance import farthest, from_segments, short_pieces
from geneva_cli.geometry.shapes import Contour
from geneva_cli.motion.engagement import ConstantRate, Engagement
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Undecided, Whole, rising
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.turned_parts import Intervals, Window

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Jet, Number

Curve: TypeAlias = "Callable[[Number, int], tuple[Jet, Jet]]"

UNKNOWN = 1e30  # mm: a bound that is not known, so large that no interval closes with it


class FlatPairs:
    """Pairs of flat parts, with gaps up to ``target`` mm; the wheel reaches the level ``rim``."""

    def __init__(self, gaps: Gaps, crank: Sequence[Contour], target: float, rim: float) -> None:
        self.gaps, self.target, self.rim = gaps, target, rim
        self.apart = max(target, 0.0)  # the distance up to which parts matter
        self._travels: dict[tuple[str, Engagement], Travel] = {}
        # the crank in arcs of a degree, each of which is tested for being in the wheel, and the
        # greatest distance of the crank from its axis, mm
        self.pieces = short_pieces(crank, math.radians(1.0)) if crank else None
        self.disc = float(farthest(self.pieces, 0.0, 0.0).max()) if self.pieces else 0.0

    def lock(self, window: Window, on: Intervals) -> tuple[Array, Array]:
        """Return the gap of locking disc and wheel: bounds up to ``apart``.

        In the dwell and beside it, the part of the crank that is within the wheel's rim lies in the
        circle that the wheel leaves free about the middle of each recess.
        """
        gaps, pieces, pose = self.gaps, self.pieces, on.at_middle
        moves, sign, L = gaps.plane_motion, gaps.assembly.sign, gaps.assembly.L
        gap = gaps.locking(pose)
        far = self.rim if sign > 0.0 else L + self.disc + self.apart
        least = gap - (moves.lever(far) * on.wheel + (self.disc + self.apart) * on.crank)
        some = np.flatnonzero(least < self.target)
        if pieces is None or not len(some):
            return gap, np.minimum(least, self.apart)
        wheel, crank = pose.wheel[some], pose.crank[some]
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = gaps.assembly.wheel(np.array((window.start, window.end)))
        recesses = moves.into(np.array(((L, 0.0), (L, 0.0))), turn)
        at = 0.5 * (on.start[some] + on.end[some])
        nearer = (at - window.start >= window.end - at).astype(int)
        offset = turned_points(moves.into(recesses[nearer], -wheel) - (L, 0.0), -crank)
        # the pieces of the crank that may come within the wheel's rim
        c, s = np.cos(crank)[:, None], np.sin(crank)[:, None]
        x, y = L + c * pieces.ox - s * pieces.oy, s * pieces.ox + c * pieces.oy
        beyond = sign * (moves.level(np.stack((x, y), axis=-1)) - self.rim)
        moved = self.disc * on.crank[some, None] + self.apart
        row, piece = np.nonzero(beyond - pieces.size <= moved)
        reach = np.zeros(len(some))  # of the crank from the middle of the nearer recess
        np.maximum.at(reach, row, farthest(pieces.subset(piece), *offset[row].T))
        away = moves.lever(L) * on.wheel[some] + np.hypot(*offset.T) * on.crank[some]
        free = gaps.wheel.signed(recesses)[nearer]
        least[some] = np.maximum(least[some], free - reach - away)
        return gap, np.minimum(least, self.apart)

    def free(self, roller: int, window: Window, on: Intervals) -> tuple[Array, Array]:
        """Return the gap of a roller outside the slot that it drives.

        It is the gap in the middle, less the roller's travel in the wheel's frame. While the wheel
        rests, the centre is also near the chord of its path.
        """
        centre, gap, travel, aside = self._moving(roller, on)
        level, gaps = self.gaps.plane_motion.level(centre), self.gaps
        beyond = gaps.assembly.sign * (level - self.rim)
        gap = np.maximum(gap, beyond - gaps.sizes.roller)
        least = gap - travel
        some = np.flatnonzero(least < self.target)
        if window.rests and len(some):
            chord = self._ends(roller, on, some)
            closer = self._along(*chord, aside[some], centre[some], gap[some])
            least[some] = np.maximum(least[some], closer)
        return gap, least

    def driving(self, roller: int, span: tuple[float, float], on: Intervals) -> tuple[Array, Array]:
        """Return the gap of a roller in its slot, on its axis or near chords of its curve."""
        gaps = self.gaps
        centre, gap, travel, _ = self._moving(roller, on)
        if gaps.assembly.rollers[roller].engagement.slot.curved:
            moving, middle = gaps.assembly.motions[roller]
            if ("slot", moving) not in self._travels:
                # the roller's travel in its slot, in the wheel's frame
                edges = cells(moving, moving.entry_deg, moving.exit_deg)
                rates = curve_rates(moving.slot, edges[:-1], edges[1:])
                self._travels["slot", moving] = Travel(edges, rates, gaps.assembly.L)
            _, aside = self._travels["slot", moving].on(on.start - middle, on.end - middle)
            chord = self._ends(roller, on, np.arange(len(gap)))
            return gap, self._along(*chord, aside, centre, gap)
        places = gaps.pose(np.array([span[0], 0.5 * (span[0] + span[1])]))
        first, other = gaps.plane_motion.into(places.pins[:, roller], places.wheel)
        axis = (first - other) / math.dist(first, other)
        half = travel[:, None] * axis
        aside = np.abs((centre - first) @ (-axis[1], axis[0]))
        return gap, self._along(centre - half, centre + half, aside, centre, gap)

    def _moving(self, roller: int, on: Intervals) -> tuple[Array, Array, Array, Array]:
        """Return a roller's centre in the wheel's frame and its gap, both in the middle.

        With them go how far it is at most from there, and from its path's chord in a fixed frame.
        """
        gaps, moves, pose = self.gaps, self.gaps.plane_motion, on.at_middle
        centre = moves.into(pose.pins[:, roller], pose.wheel)
        start = gaps.assembly.from_mid(on.start, gaps.assembly.rollers[roller][1])
        most, aside = self._path(roller).on(start, start + (on.end - on.start))
        travel = most + moves.lever(moves.level(centre)) * on.wheel
        return centre, gaps.rollers(pose)[:, roller], travel, aside

    def _path(self, roller: int) -> Travel:
        """Return the travel of a roller through a whole turn in the fixed frame."""
        engagement, _ = self.gaps.assembly.rollers[roller]
        if ("path", engagement) in self._travels:  # which several rollers share
            return self._travels["path", engagement]
        turn_deg, L = self.gaps.assembly.turn_deg, self.gaps.assembly.L
        body, groove = engagement.body, engagement.groove
        if engagement.on_arm and groove is None and isinstance(body, ConstantRate):
            # a circle about the crank's axis, at a constant speed
            x, y = engagement.path(0.0, 0)
            speed = abs(body.rate) * math.hypot(x.c[0] - engagement.hub, y.c[0])
            edges, rates = np.array((-0.5, 0.5)) * turn_deg, [[speed], [speed * abs(body.rate)]]
        else:
            edges = cells(engagement, -0.5 * turn_deg, 0.5 * turn_deg)
            start, end = edges[:-1], edges[1:]
            moving, dwell = np.full(len(start), True), None
            if groove is not None:
                from geneva_cli.motion.groove_path import dwell_rates

                dwell = dwell_rates(groove)
                if dwell:
                    moving = (engagement.entry_deg <= start) & (end <= engagement.exit_deg)
            rates = np.empty((2, len(start)))
            rates[:, moving] = curve_rates(engagement.path, start[moving], end[moving])
            if dwell:
                rates[:, ~moving] = np.array(dwell)[:, None]
        travel = self._travels["path", engagement] = Travel(edges, np.array(rates), L, turn_deg)
        return travel

    def _ends(self, roller: int, on: Intervals, some: Whole) -> tuple[Array, Array]:
        """Return a roller's centre in the wheel's frame at both ends of some intervals."""
        into, start, end = self.gaps.plane_motion.into, on.at_start, on.at_end
        return (
            into(start.pins[some, roller], start.wheel[some]),
            into(end.pins[some, roller], end.wheel[some]),
        )

    def _along(self, start: Array, end: Array, aside: Array, centre: Array, gap: Array) -> Array:
        """Return the gap of a roller, ``gap`` at ``centre``, that moves along segments.

        They have ends in the wheel's frame; the centre may be ``aside`` of them, mm.
        """
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


class Travel:
    """Bounds of the speed and the second derivative of a curve between two input angles.

    ``rates`` (2, n) has them on the n cells between ``edges``, degrees from mid-motion, in units of
    ``length`` mm; infinite if unknown. A curve that runs all round repeats after ``turn_deg``.
    """

    def __init__(self, edges: Array, rates: Array, length: float, turn_deg: float = 0.0) -> None:
        speed, bend = np.minimum(length * rates, UNKNOWN)
        self.edges = edges
        if turn_deg:  # an interval may begin in one turn and end in the next
            speed, bend = np.tile(speed, 2), np.tile(bend, 2)
            self.edges = np.concatenate((edges, edges[1:] + turn_deg))
        self.bend, self.unknown = bend, np.where(speed < UNKNOWN, 0.0, UNKNOWN)
        known = np.where(speed < UNKNOWN, speed, 0.0)
        self.moved = np.concatenate(([0.0], np.cumsum(known * np.radians(np.diff(self.edges)))))

    def on(self, start: Array, end: Array) -> tuple[Array, Array]:
        """Return how far the curve is at most on intervals from its place in their middles.

        With it goes how far it is at most from its chord.
        """
        at = np.array((start, 0.5 * (start + end), end))
        most = np.diff(np.interp(at, self.edges, self.moved), axis=0).max(axis=0)
        touch = (self.edges[:-1] <= end[:, None]) & (self.edges[1:] >= start[:, None])
        unknown = np.where(touch, self.unknown, 0.0).max(axis=1)
        bend = np.where(touch, self.bend, 0.0).max(axis=1)
        return np.maximum(most, unknown), bend * np.radians(end - start) ** 2 / 8.0


def cells(engagement: Engagement, start: float, end: float) -> Array:
    """Return the ends of cells; no formula changes within a cell of the motion."""
    # on cells longer than a degree of the input the bounds are much wider
    seams = [x for x in engagement.motion.seams_deg if start < x < end]
    return rising(np.append(np.linspace(start, end, math.ceil(end - start) + 1), seams))


def curve_rates(curve: Curve, start: Array, end: Array) -> Array:
    """Return the greatest sizes of a curve's derivatives on n cells (2, n); infinite if unknown.

    Where another formula takes over within a cell, it is halved down to that place.
    """
    from geneva_cli.numerics.intervals import Interval, size_of

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
