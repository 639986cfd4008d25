"""Peaks and loads against the spec's limits; peaks are derivatives by the input's radians."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.analysis.peaks import worst, worst_of
from geneva_cli.kinematics.engagement import Peak
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.spec.load_limits import QUANTITIES
from geneva_cli.verdict.checks.check import Check, compared


def limited_peak(name: str, mechanism: Mechanism) -> Check | None:
    """The peak that a key of ``[limits]`` bounds."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    values: dict[str, Callable[[Mechanism], float]] = {
        "velocity_max": lambda m: worst_of(m, "velocity").max,
        "acceleration_max": lambda m: worst_of(m, "acceleration").max,
        "acceleration_entry_max": lambda m: worst(m).ends.acceleration_entry,
        "jerk_max": lambda m: worst(m).jerk.max,
    }
    return compared(name, values[name](mechanism), "at most", limit)


def limited_load(name: str, mechanism: Mechanism) -> Check | None:
    """The load that a key of ``[limits]`` bounds, and its input angle."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    from geneva_cli.loads import loads  # who asks for the names alone needs none

    peak = loads.limited_peaks(mechanism).get(QUANTITIES[name], Peak(0.0, 0.0))
    return compared(name, peak.max, "at most", limit, peak.at_deg)
