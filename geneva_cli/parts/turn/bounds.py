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

from geneva_cli.geometry.distance import Polyarc, farthest, from_segments, short_pieces
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.pairs import Bounds, Intervals, Pose, Window, raised
from geneva_cli.parts.turn.travel import Travel, path_travel, slot_travel


class Segments(NamedTuple):
    """Segments in the wheel's frame, and how far from them a roller's centre may be, mm."""

    start: Array  # (n, 2)
    end: Array
    aside: Array  # (n,)


class FlatPairs:
    """Pairs of flat parts, and the distances of parts from their axes, mm.

    ``rim`` is the level that the wheel reaches: the circle about its axis, or that which an
    internal wheel leaves, or the edge of a rack. Gaps are bounded up to ``target``.
    """

    def __init__(self, gaps: Gaps, crank: Sequence[Contour], target: float, rim: float) -> None:
        self.gaps, self.crank, self.target, self.rim = gaps, crank, target, rim
        self.moves, self.L = gaps.assembly.plane_motion, gaps.assembly.L
        self.apart = max(target, 0.0)  # the distance up to which parts matter
        self._paths: dict[Engagement, Travel] = {}
        self._slots: dict[Engagement, Travel] = {}

    def lock(self, window: Window, on: Intervals) -> Bounds:
        """Return the gap of locking disc and wheel: bounds up to ``apart``.

        The wheel leaves a circle free about the middle of each recess. In the dwell and beside it,
        the part of the crank that is within the wheel's rim lies in that circle.
        """
        gap = self.gaps.locking(on.at_middle)
        far = self.rim if self.gaps.assembly.sign > 0.0 else self.L + self.disc + self.apart
        moved = self.moves.lever(far) * on.wheel + (self.disc + self.apart) * on.crank
        least = gap - moved

        def in_recess(which: Whole) -> Array:
            return self._in_recess(window, on.at(which))

        least = raised(least, least < self.target, in_recess)
        return Bounds(gap, np.minimum(least, self.apart))

    def free(self, roller: int, window: Window, on: Intervals) -> Bounds:
        """Return the gap of a roller outside the slot that it drives.

        It is the gap in the middle, less the roller's travel in the wheel's frame. While the wheel
        rests, the centre is also near the chord of its path.
        """
        centre, path = self._centre(roller, on.at_middle), self._path(roller)
        gap = np.maximum(self._gap(roller, on), self._beyond(centre) - self.gaps.sizes.roller)
        least = gap - self._travel(roller, on, centre)

        def near_chord(which: Whole) -> Array:
            some = on.at(which)
            start, end = (self._centre(roller, pose) for pose in (some.at_start, some.at_end))
            segments = Segments(start, end, path.aside(*self._own(roller, some)))
            return self._along(segments, centre[which], gap[which])

        return Bounds(gap, raised(least, window.rests & (least < self.target), near_chord))

    def driving(self, roller: int, span: tuple[float, float], on: Intervals) -> Bounds:
        """Return the gap of a roller in its slot between two input angles.

        Its centre is on the axis of a straight slot, or near a chord of the pitch curve.
        """
        engagement, _ = self.gaps.assembly.rollers[roller]
        centre, gap = self._centre(roller, on.at_middle), self._gap(roller, on)
        if engagement.slot.curved:
            moving, middle = self.gaps.assembly.motions[roller]
            if moving not in self._slots:
                self._slots[moving] = slot_travel(moving, self.L)
            aside = self._slots[moving].aside(on.start - middle, on.end - middle)
            start, end = (self._centre(roller, pose) for pose in (on.at_start, on.at_end))
            return Bounds(gap, self._along(Segments(start, end, aside), centre, gap))
        places = self.gaps.pose(np.array([span[0], 0.5 * (span[0] + span[1])]))
        first, other = self._centre(roller, places)
        axis = (first - other) / math.dist(first, other)
        half = self._travel(roller, on, centre)[:, None] * axis
        aside = np.abs((centre - first) @ (-axis[1], axis[0]))
        return Bounds(gap, self._along(Segments(centre - half, centre + half, aside), centre, gap))

    @cached_property
    def pieces(self) -> Polyarc:
        """The crank in arcs of a degree, each of which is tested for being in the wheel."""
        return short_pieces(self.crank, math.radians(1.0))

    @cached_property
    def disc(self) -> float:
        """The greatest distance of the crank from its axis, mm."""
        return float(farthest(self.pieces, 0.0, 0.0).max())

    def _beyond(self, points: Array) -> Array:
        """Return the distance of points (..., 2) from the level that the wheel reaches, mm."""
        return self.gaps.assembly.sign * (self.moves.level(points) - self.rim)

    def _path(self, roller: int) -> Travel:
        """Return the travel of a roller in the fixed frame, which several rollers share."""
        engagement, _ = self.gaps.assembly.rollers[roller]
        if engagement not in self._paths:
            turn_deg = self.gaps.assembly.turn_deg
            self._paths[engagement] = path_travel(engagement, self.L, turn_deg)
        return self._paths[engagement]

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

    def _gap(self, roller: int, on: Intervals) -> Array:
        """Return a roller's gap to the wheel in the middle of intervals."""
        return self.gaps.rollers(on.at_middle)[:, roller]

    def _along(self, segments: Segments, centre: Array, gap: Array) -> Array:
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

    def _in_recess(self, window: Window, on: Intervals) -> Array:
        """Return how far the crank stays within the circle of the nearer recess, mm."""
        moves, L, (wheel, crank, _) = self.moves, self.L, on.at_middle
        # the middles of the recesses at both ends of the window, in the wheel's frame
        turn = self.gaps.assembly.wheel(np.array((window.start, window.end)))
        recesses = moves.into(np.array(((L, 0.0), (L, 0.0))), turn)
        nearer = (on.middle - window.start >= window.end - on.middle).astype(int)
        middle = moves.into(recesses[nearer], -wheel)
        offset = turned_points(middle - (L, 0.0), -crank)
        row, piece = np.nonzero(self._within_rim(crank, on))
        far = np.zeros(len(wheel))
        np.maximum.at(far, row, farthest(self.pieces.subset(piece), *offset[row].T))
        moved = moves.lever(L) * on.wheel + np.hypot(*offset.T) * on.crank
        return self.gaps.wheel.signed(recesses)[nearer] - far - moved

    def _within_rim(self, crank: Array, on: Intervals) -> Mask:
        """Return a mask (n, k) of the pieces of the crank that may come within the wheel's rim."""
        pieces = self.pieces
        c, s = np.cos(crank)[:, None], np.sin(crank)[:, None]
        x, y = self.L + c * pieces.ox - s * pieces.oy, s * pieces.ox + c * pieces.oy
        moved = self.disc * on.crank[:, None] + self.apart
        return self._beyond(np.stack((x, y), axis=-1)) - pieces.size <= moved
