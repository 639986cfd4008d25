"""The pressure angle between roller and slot."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.verdict.checks.check import Check


def curved_slot_pressure(name: str, mechanism: Mechanism) -> Check | None:
    """The pressure angle of curved slots, below 90 degrees if the spec sets no limit."""
    has_limit = mechanism.spec.limits.pressure_angle_max_deg is not None
    if has_limit or not mechanism.engagements[0].slot.curved:
        return None
    return _greatest(name, mechanism, 90.0)


def limited_pressure(name: str, mechanism: Mechanism) -> Check | None:
    """The pressure angle of any slots, with the spec's limit."""
    limit = mechanism.spec.limits.pressure_angle_max_deg
    return None if limit is None else _greatest(name, mechanism, limit)


def _greatest(name: str, mechanism: Mechanism, limit: float) -> Check:
    from geneva_cli.loads import loads

    peak = loads.greatest_pressure(mechanism)
    # At 90 degrees nothing turns the wheel, whatever the limit.
    passes = keeps(peak.max, "at most", limit) and peak.max < 90.0
    return Check(name, peak.max, "at most", limit, passes, at_deg=peak.at_deg)
