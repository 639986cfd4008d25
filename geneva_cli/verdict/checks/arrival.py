"""Whether the wheel comes to its dwell where a roller stops it from one wall alone."""

from __future__ import annotations

import math

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


def stopping_torque(name: str, mechanism: Mechanism) -> Check | None:
    """The torque that resists, against what the wheel's inertia overcomes; None with two walls."""
    if not mechanism.engagements[0].paired:
        return None
    from geneva_cli.analysis.arrival import arrival

    found = arrival(mechanism)
    if found is None:
        return None
    check = compared(name, found.torque_Nm, "at most", found.most_Nm)
    if check.passes:
        return check
    n = mechanism.spec.drive.n_rpm
    if not found.most_Nm > 0.0:
        helps = "an inertia_kgm2 that carries the wheel on"
    else:  # the most goes with the square of the speed
        needed = n * math.sqrt(found.torque_Nm / found.most_Nm)
        helps = f"n_rpm = {math.ceil(1000.0 * needed) / 1000.0:.10g}"
    return check._replace(nearest=helps)
