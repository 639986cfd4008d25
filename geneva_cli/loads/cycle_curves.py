"""The curves of a machine over a cycle, in pieces, with their marks.

Each smooth piece is sampled with both ends from inside, so that a jump has both its values.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.figure import Mark, Piece
from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle import Cycle, Stretch
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries, only
from geneva_cli.motion.engagement import Engagement, Peak
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import spans
from geneva_cli.motion.peaks import worst
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import ROUNDED, SAME_INPUT_DEG

ASPECT = 5.0  # width of a panel over its height
CHORD_ERROR = 1e-4  # of a panel's height: less than 0.1 px of a panel of 200 px
SAMPLES = 4097  # of a piece: between them a peak a hundredth as wide differs by that error
MOTION_QUANTITIES = ("velocity", "acceleration", "jerk", "power")  # besides the output itself
Ends: TypeAlias = tuple[float, float]
Curves: TypeAlias = Callable[[Array], Array]  # x (n,) -> a row a curve (q, n)
# the curve of a quantity over a window: its pieces, its marks, and its bounds if it has none
Drawn: TypeAlias = tuple[list[Piece], tuple[Mark, ...], Ends | None]


class Stage(NamedTuple):
    """A range of input angles, degrees, in which all curves are smooth."""

    start: float
    end: float
    of: Curves  # the curves at input angles (n,), one row each
    flat: bool = False  # True if they are constant, as in a dwell


def drawn(cycle: Cycle, names: Sequence[str], window: Ends) -> dict[str, Drawn]:
    """The curves of some quantities of a machine, by name."""
    machine, out = cycle.mechanism, dict[str, Drawn]()
    column = machine.output.column
    loads = [n for n in names if n not in (column, *MOTION_QUANTITIES)]
    ends = {name: cycle.extremes[name] for name in loads}
    if "pin_force_N" in ends:  # drawn with the sign of the wall that bears
        (wall,) = load_summaries(machine, ["wall_force_N"], means=False).values()
        ends["pin_force_N"] = only(wall)
    bounds = _bounds(cycle, ends)
    stages = list(_stages(cycle, names, loads, bounds))
    step = sum(2.0 * e.half_step for e in machine.engagements) * machine.output.per_radian
    rise = [step if n == column else 0.0 for n in names]
    curves = _pieces(stages, machine.period_deg, window, rise)
    for name, pieces in zip(names, curves, strict=True):
        marks, own = tuple[Mark, ...](), bounds.get(name)
        if own:
            pieces = [part for piece in pieces for part in _within(piece, own)]
        if name in ends:
            one = ends[name]
            size = max(abs(one.max), abs(one.min))
            for word, value, at_deg, shown in (
                ("max", one.max, one.max_at_deg, one.max > ROUNDED * size),
                ("min", one.min, one.min_at_deg, one.min < -ROUNDED * size),  # only below 0
            ):
                if shown or math.isinf(value):
                    y = value if math.isfinite(value) else None
                    marks += (Mark(word, _placed(machine, at_deg, window), y),)
        elif name != column:
            marks = (_peak(machine, name, pieces, window),)
        out[name] = pieces, marks, own
    return out


def _stages(
    cycle: Cycle, names: Sequence[str], loads: Sequence[str], bounds: Mapping[str, Ends]
) -> Iterator[Stage]:
    """Stages of a period from the first entry; loads with ``bounds`` are limited to them."""
    mechanism = cycle.mechanism
    column, per_radian = mechanism.output.column, mechanism.output.per_radian

    def curves(
        engagement: Engagement, stretch: Stretch, inside: Ends, clear: Ends, up: float, x: Array
    ) -> Array:
        x = x - engagement.mid_deg
        wheel, v, a, j = engagement.motion.derivatives(np.clip(x, *inside))
        rows = (wheel + up) * per_radian, v, a, j, v * a
        known = dict(zip((column, *MOTION_QUANTITIES), rows, strict=True))
        if loads:
            own = cycle.moving(engagement, np.clip(x, *clear), loads, stretch)
            for name, row in zip(loads, own, strict=True):
                known[name] = np.clip(row, *bounds.get(name, (None, None)))
        return np.array([known[name] for name in names])

    base = -mechanism.engagements[0].half_step  # the wheel's angle before the step
    for i, engagement in enumerate(mechanism.engagements):
        mid, up = engagement.mid_deg, base + engagement.half_step
        for owner, stretch in cycle.stretches:
            if owner is not engagement:
                continue
            # clear of breaks; loads next to a cusp end before values are rounding
            start, end = stretch[:2]
            for low, high in spans(engagement.motion, 1):
                if low.item() < 0.5 * (stretch.start + stretch.end) < high.item():
                    start, end = max(start, low.item()), min(end, high.item())
            inside = start, end
            if engagement.slot.curved:
                before, after = NEAR_CUSP * engagement.entry_deg, NEAR_CUSP * engagement.exit_deg
                start = after if abs(start) < after else start
                end = before if abs(end) < -before else end
            of = partial(curves, engagement, stretch, inside, (start, end), up)
            yield Stage(mid + stretch.start, mid + stretch.end, of)
        base += 2.0 * engagement.half_step
        rest = [base * per_radian if n == column else 0.0 for n in names]
        yield from _dwell(mechanism, i, rest)


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
    samples: list[tuple[Array, Array]] = []  # of each piece
    tiny, last, up = ROUNDED * period, -math.inf, np.array(rise)[:, None]
    first = math.floor((start - stages[-1].end) / period)
    for number in range(first, 2 + int((end - start) // period)):
        for stage in stages:
            a = max(stage.start + number * period, start)
            b = min(stage.end + number * period, end)
            a = last if abs(a - last) <= tiny else a  # one place, whatever its last digit
            if abs(b - a) <= tiny and (a == start or b == end):
                a = b = start if a == start else end
            elif b - a <= tiny:
                continue
            else:
                last = b
            x = places(a, b, 2 if stage.flat else SAMPLES) if b > a else np.array([a])
            samples.append((x, stage.of(x - number * period) + number * up))
    heights = np.ptp(np.concatenate([y for _, y in samples], axis=1), axis=1)
    heights[heights == 0.0] = 1.0
    out: list[list[Piece]] = [[] for _ in rise]
    for x, rows in samples:
        for curve, y, height in zip(out, rows, heights, strict=True):
            some = thinned(ASPECT / (end - start) * x, y / height, CHORD_ERROR)
            curve.append((x[some].tolist(), (y[some] + 0.0).tolist()))
    return out


def _peak(machine: Mechanism, name: str, pieces: Sequence[Piece], window: Ends) -> Mark:
    """The greatest size of a quantity of the motion, with its sign."""
    peak: Peak[float] = getattr(worst(machine), name)
    at = _placed(machine, peak.at_deg, window)
    near = [(abs(x - at), y) for piece in pieces for x, y in zip(*piece, strict=True)]
    _, sign = min((one for one in near if abs(one[1]) >= 0.99 * peak.max), default=(0.0, 1.0))
    return Mark("peak", at, math.copysign(peak.max, sign))


def _placed(machine: Mechanism, at_deg: float, window: Ends) -> float:
    """An input angle as displayed, moved by whole turns to its first place in the window."""
    whole = 360.0 * machine.spec.turns
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
        dwells = [
            stage[:2] for i in range(len(machine.engagements)) for stage in _dwell(machine, i, ())
        ]
        period = machine.period_deg
        turns = range(-1, 2 + int((window[1] - window[0]) // period))
        own = [(a + k * period, b + k * period) for k in turns for a, b in dwells]
        both = [(max(a, c), min(b, d)) for a, b in common for c, d in own]
        common = [(a, b) for a, b in both if b - a > SAME_INPUT_DEG]
    return common


def places(start: float, end: float, count: int) -> Array:
    """Places between two x, both included, denser towards both ends."""
    fraction = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, count))
    x: Array = start + (end - start) * fraction
    x[-1] = end
    return x


def thinned(x: Array, y: Array, miss: float) -> list[int]:
    """The numbers of the points (n,) whose polyline is within ``miss`` of all of them.

    ``miss`` has the unit of x and y. After Ramer (1972), and Douglas and Peucker (1973).
    """
    kept, stack = {0, len(x) - 1}, [(0, len(x) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        dx, dy = x[b] - x[a], y[b] - y[a]
        length = float(np.hypot(dx, dy)) or 1.0
        off = abs((x[a + 1 : b] - x[a]) * dy - (y[a + 1 : b] - y[a]) * dx) / length
        far = int(np.argmax(off))
        if off[far] > miss:
            middle = a + 1 + far
            kept.add(middle)
            stack += [(a, middle), (middle, b)]
    return sorted(kept)
