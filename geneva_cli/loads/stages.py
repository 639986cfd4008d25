"""The smooth pieces of a cycle's curves: motions, divided where a curve breaks, and dwells.

They are of one design: each curve of a picture has its own number of points.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.figure import Piece
from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle import Cycle, Stretch
from geneva_cli.motion.engagement import Engagement, WheelMotion
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import spans
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.sampling import ASPECT, CHORD_ERROR, places, refined, thinned
from geneva_cli.numerics.tolerances import ROUNDED

# derivatives 0..3 of the wheel's angle -> the quantity, besides the output itself
MOTION_QUANTITIES: dict[str, Callable[[Sequence[Array]], Array]] = {
    "velocity": lambda p: p[1],
    "acceleration": lambda p: p[2],
    "jerk": lambda p: p[3],
    "power": lambda p: p[1] * p[2],
}


class Stage(NamedTuple):
    """A range of input angles, degrees, in which all curves are smooth."""

    start: float
    end: float
    of: Callable[[Array], Array]  # the curves at input angles (n,), one row each
    flat: bool = False  # True if they are constant, as in a dwell


def motion_stages(mechanism: Mechanism, names: Sequence[str]) -> Iterator[Stage]:
    """Stages of the output and of ``MOTION_QUANTITIES`` over a period from the first entry."""
    output = mechanism.output
    functions = {**MOTION_QUANTITIES, output.column: lambda p: p[0] * output.per_radian}
    quantities = [functions[name] for name in names]
    base = -mechanism.engagements[0].half_step  # the wheel's angle before the step
    for i, engagement in enumerate(mechanism.engagements):
        mid, motion = engagement.mid_deg, engagement.motion
        up = base + engagement.half_step
        for (a, b), inside in zip(pairwise(motion.breaks_deg), _smooth(engagement), strict=True):
            yield Stage(mid + a, mid + b, partial(_moved, motion, quantities, mid, inside, up))
        base += 2.0 * engagement.half_step
        rest = [base * output.per_radian if n == output.column else 0.0 for n in names]
        yield from _dwell(mechanism, i, rest)


def load_stages(
    cycle: Cycle, names: Sequence[str], bounds: Mapping[str, tuple[float, float]]
) -> Iterator[Stage]:
    """Stages of loads over a period; those with ``bounds`` are limited to them."""
    for i, engagement in enumerate(cycle.mechanism.engagements):
        mid = engagement.mid_deg
        for owner, stretch in cycle.stretches:
            if owner is engagement:
                of = partial(_loaded, cycle, engagement, stretch, names, bounds)
                yield Stage(mid + stretch.start, mid + stretch.end, of)
        yield from _dwell(cycle.mechanism, i, [0.0] * len(names))


def _smooth(engagement: Engagement) -> list[tuple[float, float]]:
    """Ends of the smooth parts of a motion, clear of the breaks between them."""
    return [(start.item(), end.item()) for start, end in spans(engagement.motion, 1)]


def _moved(
    motion: WheelMotion,
    quantities: Sequence[Callable[[Sequence[Array]], Array]],
    mid: float,
    inside: tuple[float, float],
    up: float,
    x: Array,
) -> Array:
    wheel, *rates = motion.derivatives(np.clip(x - mid, *inside))
    return np.array([quantity([wheel + up, *rates]) for quantity in quantities])


def _loaded(
    cycle: Cycle,
    engagement: Engagement,
    stretch: Stretch,
    names: Sequence[str],
    bounds: Mapping[str, tuple[float, float]],
    x: Array,
) -> Array:
    """Loads clear of breaks; next to a cusp they end before values are rounding."""
    start, end = stretch[:2]
    for a, b in _smooth(engagement):
        if a < 0.5 * (start + end) < b:
            start, end = max(start, a), min(end, b)
    if engagement.slot.curved:
        before, after = NEAR_CUSP * engagement.entry_deg, NEAR_CUSP * engagement.exit_deg
        start = after if abs(start) < after else start
        end = before if abs(end) < -before else end
    here = cycle.along(engagement, stretch, np.clip(x - engagement.mid_deg, start, end))
    rows = np.broadcast_arrays(*(cycle.plain(here, name) for name in names), x)[:-1]
    return np.array(
        [np.clip(row, *bounds.get(n, (None, None))) for n, row in zip(names, rows, strict=True)]
    )


def _dwell(mechanism: Mechanism, i: int, values: Sequence[float]) -> Iterator[Stage]:
    """The dwell after an engagement, if there is one."""
    here, dwell = mechanism.engagements[i], mechanism.dwell_deg(i)
    end, column = here.mid_deg + here.exit_deg, np.array(values)[:, None]
    if dwell:
        yield Stage(end, end + dwell, lambda x: column + 0.0 * x, flat=True)


def pieces(
    stages: Sequence[Stage], period: float, window: tuple[float, float], rise: Sequence[float]
) -> list[list[Piece]]:
    """The pieces of each curve over a window, with the period's stages repeated.

    ``rise`` is the rise of each curve in a period. A stage that only touches the window is a
    single point, at which the curve jumps.
    """
    placed = list(_repeated(stages, period, window))
    ups = [shift / period * np.array(rise)[:, None] for _, shift, _, _ in placed]
    first = [
        stage.of((places(a, b) if b > a else np.array([a])) - shift) + up
        for (stage, shift, a, b), up in zip(placed, ups, strict=True)
    ]
    heights = np.ptp(np.concatenate(first, axis=1), axis=1)
    heights[heights == 0.0] = 1.0
    width = window[1] - window[0]
    out: list[list[Piece]] = [[] for _ in rise]
    for (stage, shift, a, b), up in zip(placed, ups, strict=True):

        def of(x: Array, stage: Stage = stage, shift: float = shift) -> Array:
            return stage.of(x - shift)

        x = np.array([a, b] if b > a else [a])
        if not stage.flat and b > a:
            x = refined(of, a, b, width, heights)
        for curve, y, height in zip(out, of(x) + up, heights, strict=True):
            some = thinned(ASPECT / width * x, y / height, CHORD_ERROR / 4.0)
            curve.append((x[some].tolist(), (y[some] + 0.0).tolist()))
    return out


def _repeated(
    stages: Sequence[Stage], period: float, window: tuple[float, float]
) -> Iterator[tuple[Stage, float, float, float]]:
    """The stages in a window, with their shifts, starts and ends there."""
    start, end = window
    tiny, last = ROUNDED * period, -math.inf
    first = math.floor((start - stages[-1].end) / period)
    for number in range(first, 2 + int((end - start) // period)):
        shift = number * period
        for stage in stages:
            a, b = max(stage.start + shift, start), min(stage.end + shift, end)
            a = last if abs(a - last) <= tiny else a  # one place, whatever its last digit
            if b - a > tiny:
                yield stage, shift, a, b
                last = b
            elif abs(b - a) <= tiny and (a == start or b == end):
                at = start if a == start else end
                yield stage, shift, at, at
