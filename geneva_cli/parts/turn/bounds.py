"""Proved lower bounds of the gaps between wheel, crank and rollers on intervals of the input angle.

Parts are rigid. A point at a distance r from an axis moves at most r times the angle by which its
part turns about it; a rack moves by its pinion's radius a radian. So a gap is at least the gap in
the middle of an interval, less how far the parts move from there. Pairs that touch by design have
more exact bounds: a roller in its own slot, and the locking disc in its recess, in the dwell and
beside it. ``geneva help certificates`` derives them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.hull import farthest, from_segments, short_pieces
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pair, Pose, Window, raised
from geneva_cli.parts.turn.travel import Travel, path_travel, slot_travel


class FlatPairs:
    """Pairs of flat parts, and the distances of parts from their axes, mm.

    ``rim`` is the level that the wheel reaches: the circle about its axis, or that which an
    internal wheel leaves, or the edge of a rack.
    """

    def __init__(self, gaps: Gaps, crank: Sequence[Contour], target: float, rim: float) -> None:
        self.gaps, self.crank, self.target, self.rim = gaps, crank, target, rim
        self.moves = gaps.assembly.plane_motion
        self._paths: dict[Engagement, Travel] = {}

    def path(self, engagement: Engagement) -> Travel:
        """Return the travel of an engagement's roller, which several rollers share."""
        if engagement not in self._paths:
            turn_deg = self.gaps.assembly.turn_deg
            self._paths[engagement] = path_travel(engagement, self.L, turn_deg)
        return self._paths[engagement]

    def lock(self, window: Window) -> Pair:
        """Return the crank's locking disc and the wheel, in a motion or dwell."""
        return Lock(self, window)

    def free(self, roller: int, window: Window) -> Pair:
        """Return a roller and the wheel, outside the slot that the roller drives."""
        return FreeRoller(self, roller, window)

    def driving(self, roller: int, span: tuple[float, float]) -> Pair:
        """Return a roller and the wheel, while it is in its slot between two input angles."""
        engagement, _ = self.gaps.assembly.rollers[roller]
        slot = CurvedSlot if engagement.slot.curved else StraightSlot
        return slot(self, roller, span)

    @cached_property
    def pieces(self) -> Polyarc:
        """The crank in arcs of a degree, each of which is tested for being in the wheel."""
        return short_pieces(self.crank, math.radians(1.0))

    @cached_property
    def disc(self) -> float:
        """The greatest distance of the crank from its axis, mm."""
        return float(farthest(self.pieces, 0.0, 0.0).max())

    @property
    def apart(self) -> float:
        """The distance up to which parts matter, mm."""
        return max(self.target, 0.0)

    @property
    def L(self) -> float:
        """The centre distance."""
        return self.gaps.assembly.L

    def beyond(self, points: Array) -> Array:
        """Return the distance of points (..., 2) from the level that the wheel reaches, mm."""
        return self.gaps.assembly.sign * (self.moves.level(points) - self.rim)


class Segments(NamedTuple):
    """Segments in the wheel's frame, and how far from them a roller's centre may be, mm."""

    start: Array  # (n, 2)
    end: Array
    aside: Array  # (n,)


class Roller:
    """A roller and the wheel; ``path`` bounds the roller's travel in the fixed frame."""

    def __init__(self, reach: FlatPairs, number: int) -> None:
        self.reach, self.number = reach, number
        self.gaps = reach.gaps
        engagement, self.behind = self.gaps.assembly.rollers[number]
        self.path = reach.path(engagement)

    def own(self, on: Intervals) -> tuple[Array, Array]:
        """Return the ends of intervals as angles of the roller's own engagement."""
        start = self.gaps.assembly.from_mid(on.start, self.behind)
        return start, start + (on.end - on.start)

    def centre(self, pose: Pose) -> Array:
        """Return the centre in the wheel's frame, (n, 2)."""
        return self.reach.moves.into(pose.pins[:, self.number], pose.wheel)

    def travel(self, on: Intervals, centre: Array) -> Array:
        """Return how far the centre is at most from its place in the middle, ``centre``."""
        moves = self.reach.moves
        return self.path.most(*self.own(on)) + moves.lever(moves.level(centre)) * on.wheel

    def gap(self, on: Intervals) -> Array:
        """Return the gap to the wheel in the middle of intervals."""
        return self.gaps.rollers(on.at_middle)[:, self.number]

    def along(self, segments: Segments, centre: Array, gap: Array) -> Array:
        """Return the gap of a roller whose centre moves along segments.

        In the middle of an interval it is at ``centre`` and has the gap ``gap``.
        """
        start, end, aside = segments
        radius = self.gaps.sizes.roller
        off = np.hypot(*(0.5 * (start + end) - centre).T)
        # A segment that is shorter than its middle's distance from the outline does not cross it.
        short = 0.5 * np.hypot(*(end - start).T) < radius + gap - off
        least = np.full(len(gap), -math.inf)
        if short.any():
            start, end, reach = start[short], end[short], radius + self.gaps.near
            free = from_segments(self.gaps.wheel, start, end, reach)
            least[short] = free - aside[short] - radius
        return least


class FreeRoller(Roller):
    """A roller outside the slot that it drives: the wheel's outline may be anywhere about it."""

    def __init__(self, reach: FlatPairs, number: int, window: Window) -> None:
        super().__init__(reach, number)
        self.rests = window.rests

    def __call__(self, on: Intervals) -> Bounds:
        """Return the gap in the middle, less the roller's travel in the wheel's frame.

        While the wheel rests, the centre is also near the chord of its path.
        """
        centre = self.centre(on.at_middle)
        far = self.reach.beyond(centre) - self.gaps.sizes.roller
        gap = np.maximum(self.gap(on), far)
        least = gap - self.travel(on, centre)

        def near_chord(which: Whole) -> Array:
            some = on.at(which)
            aside = self.path.aside(*self.own(some))
            segments = Segments(self.centre(some.at_start), self.centre(some.at_end), aside)
            return self.along(segments, centre[which], gap[which])

        return Bounds(gap, raised(least, self.rests & (least < self.reach.target), near_chord))


class StraightSlot(Roller):
    """A roller in its own straight slot: its centre is on the slot's axis."""

    def __init__(self, reach: FlatPairs, number: int, span: tuple[float, float]) -> None:
        super().__init__(reach, number)
        ends = np.array([span[0], 0.5 * (span[0] + span[1])])
        self.first, other = self.centre(self.gaps.pose(ends))
        self.axis = (self.first - other) / math.dist(self.first, other)

    def __call__(self, on: Intervals) -> Bounds:
        """Return the gap along the part of the axis that the centre may reach."""
        centre, gap = self.centre(on.at_middle), self.gap(on)
        half = self.travel(on, centre)[:, None] * self.axis
        aside = np.abs((centre - self.first) @ (-self.axis[1], self.axis[0]))
        segments = Segments(centre - half, centre + half, aside)
        return Bounds(gap, self.along(segments, centre, gap))


class CurvedSlot(Roller):
    """A roller in its own curved slot: its centre is near a chord of the pitch curve."""

    def __init__(self, reach: FlatPairs, number: int, span: tuple[float, float]) -> None:
        super().__init__(reach, number)
        engagement, self.middle = self.gaps.assembly.motions[number]
        self.slot = slot_travel(engagement, reach.L)

    def __call__(self, on: Intervals) -> Bounds:
        """Return the gap along the chord, less the greatest distance of the curve from it."""
        start, end = self.centre(on.at_start), self.centre(on.at_end)
        aside = self.slot.aside(on.start - self.middle, on.end - self.middle)
        gap = self.gap(on)
        chord = self.along(Segments(start, end, aside), self.centre(on.at_middle), gap)
        return Bounds(gap, chord)


class Lock:
    """The crank's locking disc and the wheel: bounds up to ``FlatPairs.apart``.

    The wheel leaves a circle free about the middle of each recess. In the dwell and beside it, the
    part of the crank that is within the wheel's rim lies in that circle.
    """

    def __init__(self, reach: FlatPairs, window: Window) -> None:
        self.reach, self.window = reach, window
        self.pieces, self.disc = reach.pieces, reach.disc
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = reach.gaps.assembly.wheel(np.array((window.start, window.end)))
        self.recesses = reach.moves.into(np.array(((reach.L, 0.0), (reach.L, 0.0))), turn)
        self.free = reach.gaps.wheel.signed(self.recesses)

    def __call__(self, on: Intervals) -> Bounds:
        """Return the better of two bounds: from the gap, and from the recess's circle."""
        gaps, reach = self.reach.gaps, self.reach
        gap = gaps.locking(on.at_middle)
        far = reach.rim if gaps.assembly.sign > 0.0 else reach.L + self.disc + reach.apart
        wheel = reach.moves.lever(far) * on.wheel
        least = gap - wheel - (self.disc + reach.apart) * on.crank

        def in_recess(which: Whole) -> Array:
            return self._in_recess(on.at(which))

        least = raised(least, least < reach.target, in_recess)
        return Bounds(gap, np.minimum(least, reach.apart))

    def _in_recess(self, on: Intervals) -> Array:
        """Return how far the crank stays within the circle of the nearer recess, mm."""
        moves, L = self.reach.moves, self.reach.L
        wheel, crank, _ = on.at_middle
        nearer = (on.middle - self.window.start >= self.window.end - on.middle).astype(int)
        middle = moves.into(self.recesses[nearer], -wheel)
        offset = turned_points(middle - (L, 0.0), -crank)
        row, piece = np.nonzero(self._within_rim(crank, on))
        far = np.zeros(len(wheel))
        np.maximum.at(far, row, farthest(self.pieces.subset(piece), *offset[row].T))
        moved = moves.lever(L) * on.wheel + np.hypot(*offset.T) * on.crank
        return self.free[nearer] - far - moved

    def _within_rim(self, crank: Array, on: Intervals) -> Mask:
        """Return a mask (n, k) of the pieces of the crank that may come within the wheel's rim."""
        pieces = self.pieces
        c, s = np.cos(crank)[:, None], np.sin(crank)[:, None]
        x, y = self.reach.L + c * pieces.ox - s * pieces.oy, s * pieces.ox + c * pieces.oy
        moved = self.disc * on.crank[:, None] + self.reach.apart
        return self.reach.beyond(np.stack((x, y), axis=-1)) - pieces.size <= moved
