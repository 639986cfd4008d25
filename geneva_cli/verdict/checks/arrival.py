"""Check that the wheel reaches its dwell if one wall alone stops it."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


def stopping_torque(name: str, mechanism: Mechanism) -> Check | None:
    """The resisting torque, limited by the wheel's inertia; None for slots with two walls."""
    if not mechanism.engagements[0].paired:
        return None
    from geneva_cli.analysis.arrival import arrival

    stop = arrival(mechanism)
    if stop is None:
        return None
    check = compared(name, stop.torque_Nm, "at most", stop.most_Nm)
    if check.passes or stop.most_Nm > 0.0:
        return check
    return check._replace(why="no inertia carries the wheel on: set inertia_kgm2 in [load]")
