"""The pressure angle in a cam's groove, over the whole turn."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared

# A steeper groove wedges its roller; the limit is that of a roller that enters a slot.
GROOVE_MAX_DEG = 60.0


def groove_pressure(name: str, mechanism: Mechanism) -> Check | None:
    """The greatest pressure angle in the groove."""
    groove = mechanism.engagements[0].groove
    if groove is None:
        return None
    from geneva_cli.layout.groove import greatest_pressure

    value, at_deg = greatest_pressure(groove)
    own_limit = mechanism.spec.limits.pressure_angle_max_deg
    limit = GROOVE_MAX_DEG if own_limit is None else own_limit
    input_deg = mechanism.spec.input_deg(at_deg)  # the groove is cut by the crank's angle
    return compared(name, value, "at most", limit, mechanism.shown_deg(input_deg))
