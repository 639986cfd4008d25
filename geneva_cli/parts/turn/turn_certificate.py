"""Certificate of the full turn: a proved lower bound of the gap at every input angle.

A gap is at least that in the middle of an interval, less how far the parts move from there.
``geneva help accuracy`` derives the bounds. Distances at single positions are taken as exact, up to
their rounding.
"""

import math
from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from itertools import repeat
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc, from_segments
from geneva_cli.geometry.shapes import Arc, Contour, Segment, at
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, rising
from geneva_cli.parts.turn.stops import Clearances, Outline, Pose
from geneva_cli.parts.turn.turned_parts import Intervals, TurnedParts, Window, windows

MOST = 20_000  # intervals of one pair of parts: ten times what the designs take; under a second
# the gap of a pair of parts in the middles of intervals, and its bound on them, mm
Bound: TypeAlias = "Callable[[Intervals], tuple[Array, Array]]"
UNKNOWN = 1e30  # mm: a bound that is not known, so large that no interval closes with it


class Certificate(NamedTuple):
    """A proved lower bound of the gap, mm, and the number of intervals that it took.

    If an interval is ``open``, it holds elsewhere only. This has the ends of the interval, degrees,
    the gap in its middle and what is proved on it, mm. ``between`` names the parts there.
    """

    least_mm: float
    intervals: int
    open: tuple[float, float, float, float] | None = None
    between: str = ""


def certificate(parts: TurnedParts, gap_mm: float, to_mm: float) -> Certificate:
    """Return the certificate that no gap in a full turn is smaller than the smallest by ``to_mm``.

    ``gap_mm`` is the smallest gap of the sampled full turn; an overlap counts as 0.
    """
    # the greatest rounding of a distance; doubles carry 2e-16
    spare = 1e-11 * parts.assembly.L
    target = max(gap_mm, 0.0) - to_mm + spare
    pairs, least, count = parts.pairs(target), math.inf, 0
    todo: list[tuple[str, Bound, tuple[float, float]]] = []
    for window in windows(parts):
        if parts.locked:
            ends = window.start, window.end
            todo.append(("locking disc and wheel", partial(pairs.lock, window), ends))
        for start, end, driver in window.spans:
            for roller in range(len(parts.assembly.rollers)):
                drives, span = roller == driver, (start, end)
                name = "roller and slot" if drives else "roller and wheel"
                own = partial(pairs.roller, roller, window, span if drives else None)
                todo.append((name, own, span))
    for between, pair, ends in todo:
        bound = _halved(parts.gaps, pair, ends, target)
        least, count = min(least, bound.least_mm - spare), count + bound.intervals
        if bound.open:
            start, end, gap, proved = bound.open
            shown = parts.assembly.shown_deg
            return Certificate(least, count, (shown(start), shown(end), gap, proved), between)
    return Certificate(least, count)


def _halved(gaps: Clearances, pair: Bound, ends: tuple[float, float], target: float) -> Certificate:
    """Return a lower bound of a pair's gap, with intervals halved until ``target`` mm is proved."""
    cuts = np.linspace(*ends, 33)
    start, end = cuts[:-1], cuts[1:]
    least, count = math.inf, 0
    while len(start):
        count += len(start)
        middle, bound = pair(intervals(gaps, start, end))
        closed = bound >= target
        least = min(least, float(bound[closed].min(initial=math.inf)))
        start, end, middle, bound = np.array((start, end, middle, bound))[:, ~closed]
        collides = bool((middle < target).any())
        if collides or count + 2 * len(start) > MOST:
            i = int(np.argmin(middle if collides else bound))  # the most doubtful interval
            left = float(start[i]), float(end[i]), float(middle[i]), float(bound[i])
            return Certificate(least, count, left)
        half = 0.5 * (start + end)
        start, end = np.concatenate((start, half)), np.concatenate((half, end))
    return Certificate(least, count)


def intervals(gaps: Clearances, start: Array, end: Array) -> Intervals:
    """Return intervals of the input angle, with the turn of crank and wheel on them, and poses.

    Where the wheel turns back, its turn is a whole one: no point moves farther than that.
    """
    pose, count = gaps.pose(np.concatenate((start, 0.5 * (start + end), end))), len(start)
    wheel, crank = pose.wheel.reshape(3, count), pose.crank.reshape(3, count)
    steps = np.diff(wheel, axis=0)
    # the wheel's angle is rounded by less than 1e-12 radians
    turn = np.where((steps < -1e-12).any(axis=0), math.tau, steps.max(axis=0))
    crank_turn = np.abs(np.diff(np.unwrap(crank, axis=0), axis=0)).max(axis=0)
    poses = map(Pose, wheel, crank, pose.pins.reshape(3, count, *pose.pins.shape[1:]))
    return Intervals(start, end, crank_turn, turn, *poses)


class FlatPairs:
    """Pairs of flat parts, with gaps up to ``target`` mm; the wheel reaches the level ``rim``."""

    def __init__(
        self, gaps: Clearances, crank: Sequence[Contour], target: float, rim: float
    ) -> None:
        self.gaps, self.target, self.rim = gaps, target, rim
        self.apart, moves = max(target, 0.0), gaps.plane_motion  # up to which parts matter
        # the crank in arcs of a degree and pieces of lines, each of which is tested for being in
        # the wheel, and its greatest distance from its axis, mm
        pieces: list[Segment] = []
        for contour in crank:
            for piece in contour.segments:
                sweep = piece.sweep if isinstance(piece, Arc) else 0.0
                count = math.ceil(abs(math.degrees(sweep))) or 90
                ends = [*map(partial(at, piece), np.linspace(0.0, 1.0, count + 1).tolist())]
                bulge = math.tan(0.25 * sweep / count)
                pieces += map(Arc, ends, ends[1:], repeat(bulge))
        self.pieces: Outline = None
        far = self.apart
        if crank:
            self.pieces = Polyarc([Contour("", tuple(pieces))])
            far += float(self.pieces.farthest(np.zeros((1, 2))).max())
        # how far points of wheel and crank move a radian, if they may be near each other
        self.levers = moves.lever(rim if gaps.assembly.sign > 0.0 else moves.L + far), far

    def lock(self, window: Window, on: Intervals) -> tuple[Array, Array]:
        """Return the gap of locking disc and wheel: bounds up to ``apart``.

        In the dwell and beside it, the part of the crank that is within the wheel's rim lies in the
        circle that the wheel leaves free about the middle of each recess.
        """
        gaps, pieces, pose = self.gaps, self.pieces, on.at_middle
        moves, gap = gaps.plane_motion, gaps.locking(pose)
        moved = self.levers[1] * on.crank
        least = gap - (self.levers[0] * on.wheel + moved)
        some = np.flatnonzero(least < self.target)
        if pieces is None or not len(some):
            return gap, np.minimum(least, self.apart)
        wheel, crank = pose.wheel[some], pose.crank[some]
        # the middles of the recesses at both ends of the window, in the wheel's frame
        recesses = moves.into(
            moves.crank_axis, gaps.assembly.wheel(np.array((window.start, window.end)))
        )
        at = 0.5 * (on.start[some] + on.end[some])
        nearer = (at - window.start >= window.end - at).astype(int)
        offset = moves.in_crank(moves.into(recesses[nearer], -wheel), crank)
        # the pieces of the crank that may come within the wheel's rim
        level = moves.level(moves.from_crank(pieces.middles, crank))
        beyond = gaps.assembly.sign * (level - self.rim) - pieces.size
        inside = beyond <= moved[some, None] + self.apart
        reach = np.where(inside, pieces.farthest(offset), 0.0).max(axis=1)
        away = moves.lever(moves.level(moves.crank_axis)) * on.wheel[some]
        away = away + moves.scale * np.hypot(offset[:, 0], offset[:, 1]) * on.crank[some]
        free = gaps.to_wheel(recesses)[nearer] - reach - away
        least[some] = np.maximum(least[some], free)
        return gap, np.minimum(least, self.apart)

    def roller(
        self, number: int, window: Window, span: tuple[float, float] | None, on: Intervals
    ) -> tuple[Array, Array]:
        """Return the gap of a roller in its slot between two angles, or outside the one it drives.

        In its slot it moves along the axis, or near chords of the curve. Outside, the gap is that
        in the middle, less the roller's travel in the wheel's frame. While the wheel rests, the
        centre is also near the chord of its path.
        """
        gaps, moves, pose = self.gaps, self.gaps.plane_motion, on.at_middle
        assembly, (engagement, mid) = gaps.assembly, gaps.assembly.rollers[number]
        centre, gap = moves.into(pose.pins[:, number], pose.wheel), gaps.rollers(pose)[:, number]
        begin = assembly.from_mid(on.start, mid)
        path = path_travel(engagement, assembly.L, assembly.turn_deg)
        most, aside = path.on(begin, begin + (on.end - on.start))
        travel = most + moves.lever(moves.level(centre)) * on.wheel
        some, least = np.arange(len(gap)), np.full(len(gap), -math.inf)
        if span is None:
            beyond = assembly.sign * (moves.level(centre) - self.rim)
            gap = np.maximum(gap, beyond - gaps.sizes.roller)
            least = gap - travel
            some = np.flatnonzero(window.rests & (least < self.target))
            if not len(some):
                return gap, least
        if span and not engagement.slot.curved:
            places = gaps.pose(np.array([span[0], 0.5 * (span[0] + span[1])]))
            first, other = moves.into(places.pins[:, number], places.wheel)
            axis = (first - other) / math.dist(first, other)
            start, end = centre - travel[:, None] * axis, centre + travel[:, None] * axis
            aside = np.abs((centre - first) @ (-axis[1], axis[0]))
        else:
            start = moves.into(on.at_start.pins[some, number], on.at_start.wheel[some])
            end = moves.into(on.at_end.pins[some, number], on.at_end.wheel[some])
            if span:  # a curved slot's, as the roller travels in the wheel's frame
                moving, mid = assembly.motions[number]
                _, aside = slot_travel(moving, assembly.L).on(on.start - mid, on.end - mid)
        # A segment that is shorter than its middle's distance from the outline does not cross it.
        radius, off = gaps.sizes.roller, np.hypot(*(0.5 * (start + end) - centre[some]).T)
        short = 0.5 * np.hypot(*(end - start).T) < radius + gap[some] - off
        if short.any():
            free = from_segments(gaps.wheel, start[short], end[short], radius + gaps.near)
            some = some[short]
            least[some] = np.maximum(least[some], free - aside[some] - radius)
        return gap, least


class Travel:
    """Bounds of the speed and the second derivative of a curve between two input angles.

    ``rates`` (2, n) has them on the n cells between ``edges``, degrees from mid-motion, in units of
    ``length`` mm; infinite if unknown. A curve that runs all round repeats after ``turn_deg``.
    """

    def __init__(self, edges: Array, rates: Array, length: float, turn_deg: float = 0.0) -> None:
        self.edges, self.rates = edges, np.minimum(length * rates, UNKNOWN)
        if turn_deg:  # an interval may begin in one turn and end in the next
            self.edges = np.concatenate((edges, edges[1:] + turn_deg))
            self.rates = np.tile(self.rates, 2)

    def on(self, start: Array, end: Array) -> tuple[Array, Array]:
        """Return how far the curve is at most on intervals from its place in their middles.

        With it goes how far it is at most from its chord.
        """
        (speed, bend), low, high = self.rates, self.edges[:-1], self.edges[1:]
        at = np.array((start, 0.5 * (start + end), end))[..., None]
        # the part of each half of an interval that is in each cell
        within = np.minimum(at[1:], high) - np.maximum(at[:-1], low)
        most = (np.maximum(within, 0.0) * speed).sum(axis=-1).max(axis=0)
        touch = (low <= at[2]) & (high >= at[0])
        bend = np.where(touch, bend, 0.0).max(axis=1)
        return np.radians(most), bend * np.radians(end - start) ** 2 / 8.0


@lru_cache(maxsize=16)  # which several rollers share
def slot_travel(moving: Engagement, L: float) -> Travel:
    """Return the travel of a roller in its curved slot, in the wheel's frame."""
    from geneva_cli.numerics.intervals import curve_rates

    edges = cells(moving, moving.entry_deg, moving.exit_deg)
    return Travel(edges, curve_rates(moving.slot, edges[:-1], edges[1:]), L)


@lru_cache(maxsize=16)
def path_travel(engagement: Engagement, L: float, turn_deg: float) -> Travel:
    """Return the travel of a roller through a whole turn in the fixed frame."""
    body, groove = engagement.body, engagement.groove
    if engagement.on_arm and groove is None and isinstance(body, float):
        # a circle about the crank's axis, at a constant speed
        x, y = engagement.path(0.0, 0)
        speed = abs(body) * math.hypot(x.c[0] - engagement.hub, y.c[0])
        rates = np.array(((speed,), (speed * abs(body),)))
        return Travel(np.array((-0.5, 0.5)) * turn_deg, rates, L, turn_deg)
    from geneva_cli.numerics.intervals import curve_rates

    edges, path = cells(engagement, -0.5 * turn_deg, 0.5 * turn_deg), engagement.path
    if groove is not None:
        from geneva_cli.motion.groove_path import path_over_turn

        path = partial(path_over_turn, groove, path)
    return Travel(edges, curve_rates(path, edges[:-1], edges[1:]), L, turn_deg)


def cells(engagement: Engagement, start: float, end: float) -> Array:
    """Return the ends of cells; no formula changes within a cell of the motion."""
    # on cells longer than a degree of the input the bounds are much wider
    seams = [x for x in engagement.motion.seams_deg if start < x < end]
    return rising(np.append(np.linspace(start, end, math.ceil(end - start) + 1), seams))
