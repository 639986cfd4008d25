"""The keys of ``[limits]`` that bound loads. It needs no numbers: commands ask for names alone."""

from __future__ import annotations

from geneva_cli.spec.tables import Limits

QUANTITIES = {
    "pin_force_max_N": "pin_force_N",
    "input_torque_max_Nm": "input_torque_Nm",
    "contact_stress_max_MPa": "contact_stress_MPa",
}


def limits_by_key(limits: Limits) -> dict[str, float]:
    """The limits that a spec sets on loads, by their keys."""
    values = limits.as_dict()
    return {key: values[key] for key in QUANTITIES if values[key]}


def load_limits(limits: Limits) -> dict[str, float]:
    """The limits that a spec sets on loads, by the quantities that they bound."""
    return {QUANTITIES[key]: limit for key, limit in limits_by_key(limits).items()}
