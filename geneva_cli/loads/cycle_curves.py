"""The curves of a machine over a cycle, in pieces, with their marks.

Each smooth piece is sampled with both ends from inside, so that a jump has both its values.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from geneva_cli.figure import Mark, Piece
from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries, only
from geneva_cli.motion.engagement import Peak
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import spans
from geneva_cli.motion.peaks import worst
from geneva_cli.numerics.arrays import Array, rising
from geneva_cli.numerics.tolerances import ROUNDED, SAME_INPUT_DEG

ASPECT = 5.0  # width of a panel over its height
CHORD_ERROR = 1e-4  # of a panel's height: less than 0.1 px of a panel of 200 px
SAMPLES = 4097  # of a piece: between them a peak a hundredth as wide differs by that error
MOTION_QUANTITIES = ("velocity", "acceleration", "jerk", "power")  # besides the output itself
Ends: TypeAlias = tuple[float, float]
# the curve of a quantity over a window: its pieces, its marks, and its bounds if it has none
Drawn: TypeAlias = tuple[list[Piece], tuple[Mark, ...], Ends | None]


def drawn(cycle: Cycle, names: Sequence[str], window: Ends) -> dict[str, Drawn]:
    """The curves of some quantities of a machine, by name."""
    machine, out = cycle.mechanism, dict[str, Drawn]()
    column = machine.output.column
    loads = [n for n in names if n not in (column, *MOTION_QUANTITIES)]
    ends = {name: cycle.extremes[name] for name in loads}
    if "pin_force_N" in ends:  # drawn with the sign of the wall that bears
        (wall,) = load_summaries(machine, ["wall_force_N"], means=False).values()
        ends["pin_force_N"] = only(wall)
    stages = [*_stages(cycle, names, loads)]
    step = sum(2.0 * e.half_step for e in machine.engagements) * machine.output.per_radian
    for i, name in enumerate(names):
        own, marks = [(x, rows[i]) for x, rows in stages], tuple[Mark, ...]()
        bounds = _bounds(ends[name], own) if name in ends else None
        if bounds:
            own = [(x, np.clip(row, *bounds)) for x, row in own]
        pieces = _pieces(own, machine.period_deg, window, step if name == column else 0.0)
        if bounds:
            both = zip(bounds, (ends[name].min, ends[name].max), strict=True)
            cut = [bound for bound, end in both if math.isinf(end)]
            pieces = [part for piece in pieces for part in _within(piece, cut)]
        if name in ends:
            most, most_at, least, least_at, *_ = ends[name]
            tiny = ROUNDED * max(abs(most), abs(least))
            for word, value, at_deg, is_shown in (
                ("max", most, most_at, most > tiny),
                ("min", least, least_at, least < -tiny),  # only below 0
            ):
                if is_shown or math.isinf(value):
                    y = value if math.isfinite(value) else None
                    marks += (Mark(word, _placed(machine, at_deg, window), y),)
        elif name != column:
            marks = (_peak(machine, name, pieces, window),)
        out[name] = pieces, marks, bounds
    return out


def _stages(
    cycle: Cycle, names: Sequence[str], loads: Sequence[str]
) -> Iterator[tuple[Array, Array]]:
    """The smooth parts of a period from the first entry: input angles (n,), and curves (q, n)."""
    mechanism = cycle.mechanism
    column, per_radian = mechanism.output.column, mechanism.output.per_radian
    base = -mechanism.engagements[0].half_step  # the wheel's angle before the step
    for engagement, rest in zip(mechanism.engagements, _dwells(mechanism), strict=True):
        for stretch in (own for owner, own in cycle.stretches if owner is engagement):
            x, middle = places(stretch.start, stretch.end), 0.5 * (stretch.start + stretch.end)
            clear = x
            for low, high in spans(engagement.motion, 1):  # clear of breaks
                clear = np.clip(x, low[0], high[0]) if low < middle < high else clear
            wheel, v, a, j = engagement.motion.derivatives(clear)
            rows = (wheel + base + engagement.half_step) * per_radian, v, a, j, v * a
            known = dict(zip((column, *MOTION_QUANTITIES), rows, strict=True))
            if engagement.slot.curved:  # loads next to a cusp end before values are rounding
                end, farther = engagement.end_deg(middle), np.fmax if middle > 0.0 else np.fmin
                clear = farther(clear, NEAR_CUSP * end)
            if loads:
                known |= zip(loads, cycle.moving(engagement, clear, loads, stretch), strict=True)
            yield engagement.mid_deg + x, np.array([known[name] for name in names])
        base += 2.0 * engagement.half_step
        if rest[0] < rest[1]:
            still = [base * per_radian if name == column else 0.0 for name in names]
            yield np.array(rest), np.column_stack((still, still))


def _dwells(mechanism: Mechanism) -> list[Ends]:
    """The dwell after each engagement of a period, both ends."""
    begins = [one.mid_deg + one.exit_deg for one in mechanism.engagements]
    return [(begin, begin + mechanism.dwell_deg(i)) for i, begin in enumerate(begins)]


def _pieces(
    stages: Sequence[tuple[Array, Array]], period: float, window: Ends, rise: float
) -> list[Piece]:
    """The pieces of a curve over a window, from x and y of a period's stages, repeated."""
    start, end = window
    samples, last = list[tuple[Array, Array]](), -math.inf
    first = math.floor((start - stages[-1][0][-1]) / period)
    for number in range(first, 2 + int((end - start) // period)):
        for place, value in stages:
            x = place + number * period
            for known in (last, start, end):  # one place, whatever its last digit
                x = np.where(abs(x - known) <= SAME_INPUT_DEG, known, x)
            inside = rising(np.clip(x, start, end))
            if x[0] <= end and x[-1] >= start and (x[0] < x[-1] or x[0] in window):
                samples.append((inside, np.interp(inside, x, value) + number * rise))
                last = x[-1]
    height = np.ptp(np.concatenate([y for _, y in samples])) or 1.0
    out = list[Piece]()
    for x, y in samples:
        some = thinned(ASPECT / (end - start) * x, y / height, CHORD_ERROR)
        out.append((x[some].tolist(), (y[some] + 0.0).tolist()))
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


def _bounds(load: LoadSummary[float], stages: Sequence[tuple[Array, Array]]) -> Ends | None:
    """The visible range of a load: None if bounded, else from its sizes half-way between cuts.

    0 is in it, which a load is in the dwell.
    """
    if math.isfinite(load.max) and math.isfinite(load.min):
        return None
    sizes = [abs(float(y[len(y) // 2])) for _, y in stages]
    # an unbounded load is visible up to three times its typical size
    high = 3.0 * (max(filter(math.isfinite, sizes), default=0.0) or 1.0)
    low = -high if math.isinf(load.min) else min(load.min, 0.0)
    return low, high if math.isinf(load.max) else max(load.max, 0.0)


def _within(piece: Piece, cut: Sequence[float]) -> Iterator[Piece]:
    """A piece without its parts along the bounds at which it was cut."""
    x, y = piece
    begin = 0
    for i, (a, b) in enumerate(pairwise(y), 1):
        if a == b and a in cut:
            if i - begin > 1:
                yield x[begin:i], y[begin:i]
            begin = i
    if len(x) - begin > 1 or len(x) == 1:
        yield x[begin:], y[begin:]


def rests(machines: Sequence[Mechanism], window: Ends) -> list[Ends]:
    """The stretches in which all machines rest."""
    common = [window]
    for machine in machines:
        dwells, period = _dwells(machine), machine.period_deg
        turns = range(-1, 2 + int((window[1] - window[0]) // period))
        own = [(a + k * period, b + k * period) for k in turns for a, b in dwells]
        both = [(max(a, c), min(b, d)) for a, b in common for c, d in own]
        common = [(a, b) for a, b in both if b - a > SAME_INPUT_DEG]
    return common


def places(start: float, end: float) -> Array:
    """Places between two x, both included, denser towards both ends."""
    fraction = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, SAMPLES))
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
