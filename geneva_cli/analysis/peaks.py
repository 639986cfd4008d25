"""Peak velocity, acceleration, jerk and power of a motion, as invariants.

A peak is a root of the next derivative, found to the last bit, or an end of the motion, or a
place where the law's derivative jumps; never the largest of a grid. The classic wheels' peaks of
velocity and acceleration have closed forms.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from geneva_cli.analysis.timing import timings
from geneva_cli.machine.engagement import Engagement, Motion
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.roots import SCAN, TIE, Curve, extrema, greatest_at
from geneva_cli.table import Table, record_table, rows_table


class Peak(NamedTuple):
    """The greatest size of a quantity, and the signed input angle of its first occurrence."""

    max: float
    at_deg: float


class Ends(NamedTuple):
    """Sizes just after entry and just before exit."""

    acceleration_entry: float
    acceleration_exit: float
    jerk_entry: float
    jerk_exit: float


class Peaks(NamedTuple):
    """All peaks of one engagement."""

    velocity: Peak
    acceleration: Peak
    jerk: Peak
    power: Peak
    ends: Ends


QUANTITIES: dict[str, Callable[[tuple[float, ...]], tuple[float, float, float]]] = {
    # derivatives 0..5 of the wheel's angle -> the quantity and its first two derivatives
    "velocity": lambda p: (p[1], p[2], p[3]),
    "acceleration": lambda p: (p[2], p[3], p[4]),
    "jerk": lambda p: (p[3], p[4], p[5]),
    "power": lambda p: (p[1] * p[2], p[2] ** 2 + p[1] * p[3], 3 * p[2] * p[3] + p[1] * p[4]),
}
_ORDER = {"velocity": 3, "acceleration": 4, "jerk": 5, "power": 4}
_SAME = 1e-15  # of the motion: a rounding
_BESIDE = (1e-12, 1e-6)  # of the motion: nearer may be rounding; some root of TIE, a top's flat
_LEVEL = 16.0 * 2.0**-52  # of the steepest slope: of less a rounding may be all


def peak(motion: Motion, quantity: str) -> Peak:
    """The greatest size of one quantity over a motion, ends included."""
    pick, order = QUANTITIES[quantity], _ORDER[quantity]

    def curve(x: float) -> tuple[float, float, float]:
        value, slope, bend = pick(motion(x, order).scalars())
        return value, slope * DEGREE, bend * DEGREE * DEGREE

    breaks = motion.breaks_deg
    if motion.symmetric:
        breaks = tuple(x for x in breaks if x <= 0.0)
    places: list[tuple[Peak, bool]] = []  # in order; whether stationary
    for a, b in zip(breaks, breaks[1:], strict=False):
        # A break belongs to the piece before it; the piece after begins one double later.
        start = a if a == breaks[0] else math.nextafter(a, math.inf)
        places.append((Peak(abs(curve(start)[0]), a), False))
        places += [(Peak(_summit(x, *curve(x)), x), True) for x in extrema(curve, start, b)]
        places.append((Peak(abs(curve(b)[0]), b), False))
    size = max(p.max for p, _ in places)
    equal = [(p.at_deg, top) for p, top in places if p.max * (1.0 + TIE) >= size]
    at_deg = equal[0][0]
    # As high as its neighbour, a break so near a summit is on its flat top.
    low, high = (share * (breaks[-1] - breaks[0]) for share in _BESIDE)
    near = [x for x, top in equal if top and abs(x - at_deg) < high]
    if near and (abs(near[0] - at_deg) > low or _leans(curve, at_deg, near[0], breaks)):
        at_deg = near[0]
    beside = min(breaks, key=lambda x: abs(x - at_deg))  # as 0 beside 1e-47
    return Peak(size, beside if abs(beside - at_deg) < _SAME * (breaks[-1] - breaks[0]) else at_deg)


def _leans(curve: Curve, x: float, to: float, breaks: tuple[float, ...]) -> bool:
    """Whether a curve's slope at x, on the side of another place, is more than rounding."""
    width = breaks[-1] - breaks[0]
    slopes = [curve(breaks[0] + width * k / SCAN)[1] for k in range(SCAN)]
    here = curve(math.nextafter(x, to))[1]
    return abs(here) > _LEVEL * max(abs(slope) for slope in slopes)


def _summit(x: float, value: float, slope: float, bend: float) -> float:
    """Size of a stationary value whose place was rounded to the double x.

    Where a crank runs away, a peak may be only some thousand doubles wide: the parabola through
    value, slope and bend at x stands higher between two of them by slope² / (2 bend).
    """
    if abs(slope) < 2.0 * math.ulp(x) * abs(bend):
        value -= 0.5 * slope * slope / bend
    return abs(value)


def ends(engagement: Engagement) -> Ends:
    """Sizes at both ends, from inside the motion."""
    first = engagement.motion(engagement.entry_deg).scalars()
    last = engagement.motion(engagement.exit_deg).scalars()
    return Ends(abs(first[2]), abs(last[2]), abs(first[3]), abs(last[3]))


def _peak(motion: Motion, quantity: str) -> Peak:
    """The peak in closed form, where there is one."""
    known = motion.closed_peak(quantity)
    return Peak(*known) if known else peak(motion, quantity)


def acceleration_peak(engagement: Engagement) -> Peak:
    """The peak acceleration."""
    return _peak(engagement.motion, "acceleration")


def velocity_peak(engagement: Engagement) -> Peak:
    """The peak velocity."""
    return _peak(engagement.motion, "velocity")


def peaks(engagement: Engagement) -> Peaks:
    """Every peak of one engagement."""
    return Peaks(
        velocity_peak(engagement),
        acceleration_peak(engagement),
        peak(engagement.motion, "jerk"),
        peak(engagement.motion, "power"),
        ends(engagement),
    )


def worst(mechanism: Mechanism) -> Peaks:
    """The greatest peaks over all engagements; angles are the machine's input angles."""
    each = [placed(mechanism, s) for s in mechanism.engagements]
    return Peaks(
        Peak(*greatest_at([e.velocity for e in each])),
        Peak(*greatest_at([e.acceleration for e in each])),
        Peak(*greatest_at([e.jerk for e in each])),
        Peak(*greatest_at([e.power for e in each])),
        Ends(*[max(values) for values in zip(*[e.ends for e in each], strict=True)]),
    )


def worst_of(mechanism: Mechanism, quantity: str) -> Peak:
    """The greatest peak of one quantity over all engagements, at the machine's input angle."""
    each = [_placed(mechanism, s, _peak(s.motion, quantity)) for s in mechanism.engagements]
    return Peak(*greatest_at(each))


def placed(mechanism: Mechanism, engagement: Engagement) -> Peaks:
    """An engagement's peaks, their angles the machine's input angles."""
    found = peaks(engagement)
    return Peaks(
        _placed(mechanism, engagement, found.velocity),
        _placed(mechanism, engagement, found.acceleration),
        _placed(mechanism, engagement, found.jerk),
        _placed(mechanism, engagement, found.power),
        found.ends,
    )


def _placed(mechanism: Mechanism, engagement: Engagement, p: Peak) -> Peak:
    return Peak(p.max, mechanism.shown_deg(engagement.mid_deg + p.at_deg))


def peaks_table(mechanism: Mechanism) -> Table:
    """The greatest peaks, then those of each engagement where they differ (None if not)."""
    times = timings(mechanism)
    rows = [
        _record(placed(mechanism, engagement))
        | {"motion_deg": time.motion_deg, "dwell_deg": time.dwell_deg}
        for engagement, time in zip(mechanism.engagements, times, strict=True)
    ]
    differ = len(rows) > 1
    values: dict[str, object] = {"spec": mechanism.spec.path, "title": mechanism.spec.title}
    values |= _record(worst(mechanism)) if differ else rows[0]
    values |= {"motion_deg": times[0].motion_deg, "dwell_deg": times[0].dwell_deg}
    each = rows_table(tuple(rows[0]), [tuple(row.values()) for row in rows])
    return record_table(values | {"stations": each if differ else None})


def _record(found: Peaks) -> dict[str, float]:
    return {
        "velocity.max": found.velocity.max,
        "velocity.at_deg": found.velocity.at_deg,
        "acceleration.max": found.acceleration.max,
        "acceleration.at_deg": found.acceleration.at_deg,
        "acceleration.entry": found.ends.acceleration_entry,
        "acceleration.exit": found.ends.acceleration_exit,
        "jerk.max": found.jerk.max,
        "jerk.at_deg": found.jerk.at_deg,
        "jerk.entry": found.ends.jerk_entry,
        "jerk.exit": found.ends.jerk_exit,
        "power.max": found.power.max,
        "power.at_deg": found.power.at_deg,
    }
