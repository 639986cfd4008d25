"""The greatest loads against the spec's limits."""

from __future__ import annotations

from geneva_cli.kinematics.engagement import Peak
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.spec.load_limits import QUANTITIES
from geneva_cli.verdict.checks.check import Check, compared


def limited_load(name: str, mechanism: Mechanism) -> Check | None:
    """The load that a key of ``[limits]`` bounds, and its input angle."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    from geneva_cli.loads import loads  # who asks for the names alone needs none

    peak = loads.limited_peaks(mechanism).get(QUANTITIES[name], Peak(0.0, 0.0))
    return compared(name, peak.max, "at most", limit, peak.at_deg)
