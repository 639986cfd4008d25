"""Peak velocity, acceleration, jerk and power, as invariants; closed forms need no NumPy."""

import math
from collections.abc import Sequence
from typing import NamedTuple, cast

from geneva_cli.motion.engagement import Engagement, Peak, WheelMotion
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.roots import greatest_at
from geneva_cli.table import Table, record_table, rows_table


class EndSizes(NamedTuple):
    """Sizes of acceleration and jerk just after entry and just before exit."""

    acceleration_entry: float
    acceleration_exit: float
    jerk_entry: float
    jerk_exit: float


class Peaks(NamedTuple):
    """All peaks of one engagement."""

    velocity: Peak[float]
    acceleration: Peak[float]
    jerk: Peak[float]
    power: Peak[float]
    ends: EndSizes


QUANTITIES = Peaks._fields[:-1]


def peaks_of(motion: WheelMotion, names: Sequence[str]) -> list[Peak[float]]:
    """Greatest sizes of quantities over the motion of one design, ends included.

    Each has the signed input angle of its first occurrence, degrees from mid-motion.
    """
    found = dict(zip(names, map(motion.closed_peak, names), strict=True))
    if None in found.values():
        from geneva_cli.motion.peak_search import motion_peaks

        open_ = [name for name, known in found.items() if known is None]
        for name, (size, at_deg) in motion_peaks(motion, open_).items():
            found[name] = Peak(size.item(), at_deg.item())
    return cast("list[Peak[float]]", [*found.values()])


def peak(motion: WheelMotion, quantity: str) -> Peak[float]:
    """Greatest size of one quantity over a motion, ends included, and its input angle."""
    return peaks_of(motion, [quantity])[0]


def peaks(engagement: Engagement, mechanism: Mechanism | None = None) -> Peaks:
    """All peaks of one engagement; at the machine's input angles, if a mechanism is given."""
    motion = engagement.motion
    out = peaks_of(motion, QUANTITIES)
    if mechanism is not None:
        for i, (size, at_deg) in enumerate(out):
            out[i] = Peak(size, mechanism.shown_deg(engagement.mid_deg + at_deg))
    first, last = motion.end_rates(motion.entry_deg), motion.end_rates(motion.exit_deg)
    return Peaks._make((*out, EndSizes(first[0], last[0], first[1], last[1])))


def worst(mechanism: Mechanism) -> Peaks:
    """Greatest peaks over all engagements; angles are the machine's input angles."""
    return _greatest([peaks(one, mechanism) for one in mechanism.engagements])


def _greatest(each: Sequence[Peaks]) -> Peaks:
    greatest = [Peak(*greatest_at(same)) for same in zip(*[e[:-1] for e in each], strict=True)]
    ends = EndSizes(*map(max, zip(*[e.ends for e in each], strict=True)))
    return Peaks._make((*greatest, ends))


def peaks_table(mechanism: Mechanism) -> Table:
    """The greatest peaks, and a table of each engagement's peaks if there are several."""
    kinds, each, rows = mechanism.engagements, [], []
    for i, one in enumerate(kinds):
        each.append(peaks(one, mechanism))
        rows.append(_record(each[i], (one,), mechanism.dwell_deg(i)))
    values: dict[str, object] = {"spec": mechanism.spec.path, "title": mechanism.spec.title}
    if not rows[1:]:
        return record_table(values | rows[0] | {"stations": None})
    values |= _record(_greatest(each), kinds, mechanism.dwell_deg(0))
    stations = rows_table(tuple(rows[0]), [tuple(row.values()) for row in rows])
    return record_table(values | {"stations": stations})


def _record(
    peaks: Peaks, engagements: Sequence[Engagement], dwell_deg: float
) -> dict[str, float | None]:
    """One row of the table: the peaks, and the values at entry and exit where they are shown.

    The wheel's velocity jumps at both ends of a crank as built. Its greatest jumps are shown, or
    None where a roller's centre never crosses the axis of the slot at rest inside the rim.
    """
    out: dict[str, float | None] = {}
    ends, built = peaks.ends, engagements[0].built  # all leave the rim alike
    at_ends: dict[str, Sequence[float | None]] = {
        "velocity": (0.0, 0.0) if built is None else greatest_jumps(engagements),
        "acceleration": ends[:2],
        "jerk": ends[2:],
    }
    for name, one in zip(QUANTITIES, peaks[:-1], strict=True):
        out[f"{name}.max"], out[f"{name}.at_deg"] = one.max, one.at_deg
        if name in at_ends:
            out[f"{name}.entry"], out[f"{name}.exit"] = at_ends[name]
    out |= {"motion_deg": engagements[0].motion_deg, "dwell_deg": dwell_deg}
    gained = math.nan if built is None else math.degrees(float(built.gained))
    return out | {"index_gained_deg": None if math.isnan(gained) else gained}


def greatest_jumps(engagements: Sequence[Engagement]) -> list[float | None]:
    """Greatest jumps of the wheel's velocity at entry and at exit of any engagement, signed.

    None where a roller's centre never crosses the axis of the slot at rest inside the rim.
    """
    out: list[float | None] = []
    for each in zip(*(one.jumps for one in engagements), strict=True):
        jumps = [float(jump) for jump in each]
        out.append(None if any(map(math.isnan, jumps)) else max(jumps, key=abs))
    return out
