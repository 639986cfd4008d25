"""Warnings about loads: unbounded ones, and limits that no speed keeps."""

from __future__ import annotations

import math

from geneva_cli.analysis.quantities import FORCE, STRESS
from geneva_cli.errors import Notice
from geneva_cli.loads import loads
from geneva_cli.loads.cycle import Cycle, cycle_of
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.spec.load_limits import limits_by_key, load_limits


def load_warnings(mechanism: Mechanism) -> list[Notice]:
    """The warnings that need the loads, of a machine with a load."""
    cycle = cycle_of(mechanism)
    out = [*_jammed(cycle), *_on_an_edge(cycle)]
    # the search for a speed is needed only if the present one breaks a limit
    if not _keeps_limits(cycle) and loads.fastest_rpm(mechanism) is None:
        out.append(_no_speed(mechanism))
    return out


def _keeps_limits(cycle: Cycle) -> bool:
    """Return True if the limits on loads are kept at the present speed."""
    bounds = load_limits(cycle.mechanism.spec.limits)
    if not bounds.keys() <= cycle.extremes.keys():
        return False
    extremes = [(cycle.extremes[name], limit) for name, limit in bounds.items()]
    return all(max(one.max, -one.min) <= limit for one, limit in extremes)


def _jammed(cycle: Cycle) -> list[Notice]:
    force = cycle.extremes[FORCE]
    friction = cycle.mechanism.spec.load.friction
    endless = [
        at
        for at, value in ((force.max_at_deg, force.max), (force.min_at_deg, force.min))
        if math.isinf(value)
    ]
    if not friction or not endless:
        return []
    return [
        Notice(
            "friction-holds-the-wheel",
            f"friction of {friction:g} holds the wheel at {min(endless):.4g} deg, however hard the "
            "roller presses: it takes as much torque as the wall gives. Use a smaller roller or "
            "less friction",
        )
    ]


def _on_an_edge(cycle: Cycle) -> list[Notice]:
    stress, force = cycle.extremes.get(STRESS), cycle.extremes[FORCE]
    if stress is None:
        return []
    if math.isfinite(stress.max) or math.isinf(force.max) or math.isinf(force.min):
        return []
    return [
        Notice(
            "sharp-wall",
            f"contact stress without bound at {stress.max_at_deg:.4g} deg: the roller bears on an "
            "edge there, where the undercut of the wall begins. A smaller roller bears on less of "
            'it; straight slots have none (kind = "cam" drives any law)',
        )
    ]


def _no_speed(mechanism: Mechanism) -> Notice:
    limits = limits_by_key(mechanism.spec.limits)
    broken = " and ".join(f"{key} = {limit:g}" for key, limit in limits.items())
    return Notice(
        "no-speed",
        f"no speed keeps {broken}, so there is no shortest motion: the resisting torque alone "
        "exceeds it, or nothing bounds the load. Use a larger machine or less torque_Nm",
    )
