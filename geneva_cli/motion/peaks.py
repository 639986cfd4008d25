"""Peak velocity, acceleration, jerk and power of a motion, as invariants.

Plain wheels have closed forms, which need no NumPy. All other peaks are searched as a batch of one
by ``peak_search``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

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
    peaks = {name: motion.closed_peak(name) for name in names}
    open_ = [name for name, known in peaks.items() if known is None]
    if open_:
        from geneva_cli.motion.peak_search import motion_peaks

        peaks |= {
            name: Peak(size.item(), at_deg.item())
            for name, (size, at_deg) in motion_peaks(motion, open_).items()
        }
    return [peak for peak in peaks.values() if peak is not None]


def peak(motion: WheelMotion, quantity: str) -> Peak[float]:
    """Greatest size of one quantity over a motion, ends included, and its input angle."""
    return peaks_of(motion, [quantity])[0]


def ends(engagement: Engagement) -> EndSizes:
    """Sizes at both ends, from inside the motion."""
    first, last = (engagement.motion.end_rates(engagement.end_deg(end)) for end in (-1.0, 1.0))
    return EndSizes(first[0], last[0], first[1], last[1])


def peaks(engagement: Engagement) -> Peaks:
    """All peaks of one engagement."""
    return Peaks._make((*peaks_of(engagement.motion, QUANTITIES), ends(engagement)))


def worst(mechanism: Mechanism) -> Peaks:
    """Greatest peaks over all engagements; angles are the machine's input angles."""
    each = [placed_peaks(mechanism, s) for s in mechanism.engagements]
    greatest = [Peak(*greatest_at(same)) for same in zip(*[e[:-1] for e in each], strict=True)]
    return Peaks._make(
        (*greatest, EndSizes._make(map(max, zip(*[e.ends for e in each], strict=True))))
    )


def worst_of(mechanism: Mechanism, quantity: str) -> Peak[float]:
    """Greatest peak of one quantity over all engagements, at the machine's input angle."""
    each = [_placed(mechanism, s, peak(s.motion, quantity)) for s in mechanism.engagements]
    return Peak(*greatest_at(each))


def placed_peaks(mechanism: Mechanism, engagement: Engagement) -> Peaks:
    """Peaks of an engagement at the machine's input angles."""
    own = peaks(engagement)
    return Peaks._make((*(_placed(mechanism, engagement, p) for p in own[:-1]), own.ends))


def _placed(mechanism: Mechanism, engagement: Engagement, p: Peak[float]) -> Peak[float]:
    return Peak(p.max, mechanism.shown_deg(engagement.mid_deg + p.at_deg))


def peaks_table(mechanism: Mechanism) -> Table:
    """The greatest peaks, and a table of each engagement's peaks if there are several."""
    rows = [
        _record(placed_peaks(mechanism, engagement))
        | {"motion_deg": engagement.motion_deg, "dwell_deg": mechanism.dwell_deg(i)}
        for i, engagement in enumerate(mechanism.engagements)
    ]
    differ = len(rows) > 1
    values: dict[str, object] = {"spec": mechanism.spec.path, "title": mechanism.spec.title}
    values |= _record(worst(mechanism)) if differ else rows[0]
    values |= {key: rows[0][key] for key in ("motion_deg", "dwell_deg")}
    each = rows_table(tuple(rows[0]), [tuple(row.values()) for row in rows])
    return record_table(values | {"stations": each if differ else None})


def _record(peaks: Peaks) -> dict[str, float]:
    sizes = peaks.ends._asdict()
    out: dict[str, float] = {}
    for name, peak in zip(QUANTITIES, peaks[:-1], strict=True):
        out |= {f"{name}.max": peak.max, f"{name}.at_deg": peak.at_deg}
        out |= {
            f"{name}.{end}": sizes[f"{name}_{end}"]
            for end in ("entry", "exit")
            if f"{name}_{end}" in sizes
        }
    return out
