"""The curves of a machine over a cycle, in pieces, with their marks.

Each smooth piece is sampled with both ends from inside, so that a jump has both its values.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.figure import Mark, Piece
from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle import Cycle, Stretch
from geneva_cli.loads.cycle_quantities import FORCE, WALL_FORCE
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries, only
from geneva_cli.motion import peaks
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg
from geneva_cli.motion.peak_search import spans
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.sampling import ASPECT, CHORD_ERROR, places, refined, thinned
from geneva_cli.numerics.tolerances import ROUNDED, SAME_INPUT_DEG

MOTION_QUANTITIES = ("velocity", "acceleration", "jerk", "power")  # besides the output itself
Ends: TypeAlias = tuple[float, float]
# the curve of a quantity over a window: its pieces, its marks, and its bounds if it has none
Drawn: TypeAlias = tuple[list[Piece], tuple[Mark, ...], Ends | None]


class Stage(NamedTuple):
    """A range of input angles, degrees, in which all curves are smooth."""

    start: float
    end: float
    of: Callable[[Array], Array]  # the curves at input angles (n,), one row each
    flat: bool = False  # True if they are constant, as in a dwell


def drawn(cycle: Cycle, names: Sequence[str], window: Ends) -> dict[str, Drawn]:
    """The curves of some quantities of a machine, by name."""
    machine, out = cycle.mechanism, dict[str, Drawn]()
    column = machine.output.column
    moves = [n for n in names if n in (column, *MOTION_QUANTITIES)]
    loads = [n for n in names if n not in moves]
    if moves:
        stages = list(_motion_stages(machine, moves))
        step = sum(2.0 * e.half_step for e in machine.engagements) * machine.output.per_radian
        rise = [step if n == column else 0.0 for n in moves]
        curves = _pieces(stages, machine.period_deg, window, rise)
        for i, (name, pieces) in enumerate(zip(moves, curves, strict=True)):
            peak = () if name == column else (_peak(machine, name, i, stages, window),)
            out[name] = pieces, peak, None
    if loads:
        ends = {name: cycle.extremes[name] for name in loads}
        if FORCE in ends:  # drawn with the sign of the wall that bears
            ends[FORCE] = only(load_summaries(machine, [WALL_FORCE], means=False)[WALL_FORCE])
        bounds = _bounds(cycle, ends)
        stages = list(_load_stages(cycle, loads, bounds))
        curves = _pieces(stages, machine.period_deg, window, [0.0] * len(loads))
        for name, pieces in zip(loads, curves, strict=True):
            own = bounds.get(name)
            if own:
                pieces = [part for piece in pieces for part in _within(piece, own)]
            one, marks = ends[name], tuple[Mark, ...]()
            size = max(abs(one.max), abs(one.min))
            for word, value, at_deg, shown in (
                ("max", one.max, one.max_at_deg, one.max > ROUNDED * size),
                ("min", one.min, one.min_at_deg, one.min < -ROUNDED * size),  # only below 0
            ):
                if shown or math.isinf(value):
                    y = value if math.isfinite(value) else None
                    marks += (Mark(word, _placed(machine, at_deg, window), y),)
            out[name] = pieces, marks, own
    return out


def _motion_stages(mechanism: Mechanism, names: Sequence[str]) -> Iterator[Stage]:
    """Stages of the output and of ``MOTION_QUANTITIES`` over a period from the first entry."""
    column, per_radian = mechanism.output.column, mechanism.output.per_radian
    base = -mechanism.engagements[0].half_step  # the wheel's angle before the step
    for i, engagement in enumerate(mechanism.engagements):
        mid, motion, up = engagement.mid_deg, engagement.motion, base + engagement.half_step
        # the ends of the smooth parts are clear of the breaks between them
        both = zip(pairwise(motion.breaks_deg), spans(motion, 1), strict=True)
        for (a, b), (start, end) in both:
            inside = start.item(), end.item()
            yield Stage(mid + a, mid + b, partial(_moved, mechanism, i, names, inside, up))
        base += 2.0 * engagement.half_step
        rest = [base * per_radian if n == column else 0.0 for n in names]
        yield from _dwell(mechanism, i, rest)


def _moved(
    mechanism: Mechanism, i: int, names: Sequence[str], inside: Ends, up: float, x: Array
) -> Array:
    engagement, output = mechanism.engagements[i], mechanism.output
    wheel, v, a, j = engagement.motion.derivatives(np.clip(x - engagement.mid_deg, *inside))
    rows = (wheel + up) * output.per_radian, v, a, j, v * a
    known = dict(zip((output.column, *MOTION_QUANTITIES), rows, strict=True))
    return np.array([known[name] for name in names])


def _load_stages(cycle: Cycle, names: Sequence[str], bounds: Mapping[str, Ends]) -> Iterator[Stage]:
    """Stages of loads over a period; those with ``bounds`` are limited to them."""
    for i, engagement in enumerate(cycle.mechanism.engagements):
        mid = engagement.mid_deg
        for owner, stretch in cycle.stretches:
            if owner is not engagement:
                continue
            # clear of breaks; next to a cusp they end before values are rounding
            start, end = stretch[:2]
            for low, high in spans(engagement.motion, 1):
                if low.item() < 0.5 * (stretch.start + stretch.end) < high.item():
                    start, end = max(start, low.item()), min(end, high.item())
            if engagement.slot.curved:
                before, after = NEAR_CUSP * engagement.entry_deg, NEAR_CUSP * engagement.exit_deg
                start = after if abs(start) < after else start
                end = before if abs(end) < -before else end

            of = partial(_loaded, cycle, engagement, stretch, names, bounds, (start, end))
            yield Stage(mid + stretch.start, mid + stretch.end, of)
        yield from _dwell(cycle.mechanism, i, [0.0] * len(names))


def _loaded(
    cycle: Cycle,
    engagement: Engagement,
    stretch: Stretch,
    names: Sequence[str],
    bounds: Mapping[str, Ends],
    inside: Ends,
    x: Array,
) -> Array:
    rows = cycle.moving(engagement, np.clip(x - engagement.mid_deg, *inside), names, stretch)
    each = zip(names, rows, strict=True)
    return np.array([np.clip(row, *bounds.get(n, (None, None))) for n, row in each])


def _dwell(mechanism: Mechanism, i: int, values: Sequence[float]) -> Iterator[Stage]:
    here, dwell = mechanism.engagements[i], mechanism.dwell_deg(i)
    end, column = here.mid_deg + here.exit_deg, np.array(values)[:, None]
    if dwell:
        yield Stage(end, end + dwell, lambda x: column + 0.0 * x, flat=True)


def _pieces(
    stages: Sequence[Stage], period: float, window: Ends, rise: Sequence[float]
) -> list[list[Piece]]:
    """The pieces of each curve over a window, with the period's stages repeated."""
    start, end = window
    placed: list[tuple[Callable[[Array], Array], bool, float, float]] = []
    tiny, last = ROUNDED * period, -math.inf
    first = math.floor((start - stages[-1].end) / period)
    for number in range(first, 2 + int((end - start) // period)):
        shift = number * period
        up = shift / period * np.array(rise)[:, None]
        for stage in stages:
            a, b = max(stage.start + shift, start), min(stage.end + shift, end)
            a = last if abs(a - last) <= tiny else a  # one place, whatever its last digit
            if abs(b - a) <= tiny and (a == start or b == end):
                a = b = start if a == start else end
            elif b - a <= tiny:
                continue
            else:
                last = b

            def here(x: Array, stage: Stage = stage, shift: float = shift, up: Array = up) -> Array:
                return stage.of(x - shift) + up

            placed.append((here, stage.flat, a, b))
    rough = [of(places(a, b) if b > a else np.array([a])) for of, _, a, b in placed]
    heights = np.ptp(np.concatenate(rough, axis=1), axis=1)
    heights[heights == 0.0] = 1.0
    width = end - start
    out: list[list[Piece]] = [[] for _ in rise]
    for of, is_flat, a, b in placed:
        x = np.array([a, b] if b > a else [a])
        if not is_flat and b > a:
            x = refined(of, a, b, width, heights)
        for curve, y, height in zip(out, of(x), heights, strict=True):
            some = thinned(ASPECT / width * x, y / height, CHORD_ERROR / 4.0)
            curve.append((x[some].tolist(), (y[some] + 0.0).tolist()))
    return out


def _peak(machine: Mechanism, name: str, row: int, stages: Sequence[Stage], window: Ends) -> Mark:
    """The greatest size of a quantity of the motion, with its sign."""
    peak, first = peaks.worst_of(machine, name), first_entry_deg(machine)
    x = _placed(machine, peak.at_deg, (first, first))
    values = [
        float(stage.of(np.array([x]))[row, 0])
        for stage in stages
        if stage.start - SAME_INPUT_DEG <= x <= stage.end + SAME_INPUT_DEG
    ]
    nearest_to = min(values, key=lambda value: abs(abs(value) - peak.max))
    return Mark("peak", _placed(machine, peak.at_deg, window), math.copysign(peak.max, nearest_to))


def _placed(machine: Mechanism, at_deg: float, window: Ends) -> float:
    """An input angle as displayed, moved by whole turns to its first place in the window."""
    whole = machine.whole_deg
    return at_deg + whole * math.ceil((window[0] - SAME_INPUT_DEG - at_deg) / whole)


def _bounds(cycle: Cycle, ends: Mapping[str, LoadSummary[float]]) -> dict[str, Ends]:
    """The visible range of each unbounded load, from its sizes half-way between cuts."""
    out = {}
    for name, (top, _, low, *_) in ends.items():
        if math.isfinite(top) and math.isfinite(low):
            continue
        sizes = []
        for engagement, stretch in cycle.stretches:
            middle = np.array([0.5 * (stretch.start + stretch.end)])
            sizes.append(abs(cycle.moving(engagement, middle, [name], stretch).item()))
        # an unbounded load is visible up to three times its typical size
        high = 3.0 * max((size for size in sizes if math.isfinite(size)), default=1.0)
        out[name] = -high if math.isinf(low) else low, high if math.isinf(top) else top
    return out


def _within(piece: Piece, bounds: Ends) -> Iterator[Piece]:
    """A piece that was limited to bounds, without its parts along them."""
    x, y = piece
    begin = 0
    for i, (a, b) in enumerate(pairwise(y), 1):
        if a == b and a in bounds:
            if i - begin > 1:
                yield x[begin:i], y[begin:i]
            begin = i
    if len(x) - begin > 1 or len(x) == 1:
        yield x[begin:], y[begin:]


def rests(machines: Sequence[Mechanism], window: Ends) -> list[Ends]:
    """The stretches in which all machines rest."""
    common = [window]
    for machine in machines:
        dwells = [(s.start, s.end) for s in _motion_stages(machine, []) if s.flat]
        period = machine.period_deg
        turns = range(-1, 2 + int((window[1] - window[0]) // period))
        own = [(a + k * period, b + k * period) for k in turns for a, b in dwells]
        both = [(max(a, c), min(b, d)) for a, b in common for c, d in own]
        common = [(a, b) for a, b in both if b - a > SAME_INPUT_DEG]
    return common
