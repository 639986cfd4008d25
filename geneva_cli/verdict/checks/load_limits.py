"""The greatest loads against the spec's limits."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared

QUANTITIES = {
    "pin_force_max_N": "pin_force_N",
    "input_torque_max_Nm": "input_torque_Nm",
    "contact_stress_max_MPa": "contact_stress_MPa",
}


def limited_load(name: str, mechanism: Mechanism) -> Check | None:
    """The load that a key of ``[limits]`` bounds, and its input angle."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    from geneva_cli.loads import loads  # who asks for the names alone needs none

    peak = loads.greatest(mechanism, QUANTITIES[name])
    return compared(name, peak.max, "at most", limit, peak.at_deg)
