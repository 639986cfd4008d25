"""The checks, each loaded when it is asked for, in the order shown.

A new check is one file, or a function in a file of like ones, and one line here. It is called with
its name and what it is a check of, and gives None where there is nothing to check.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.spec.named import named
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.parts.outlines import Outlines
    from geneva_cli.parts.turn.full_turn import FullTurn

Checks: TypeAlias = dict[str, str]  # name -> module:function in this folder

# Of a machine: what every one of its kind must pass.
MOTION: Checks = {
    "dwell_deg": "dwell:shortest",
    "driver_gear_convexity": "convexity:of_gear",
    "driven_gear_convexity": "convexity:of_gear",
    "velocity_min": "forwards:least_velocity",
    "groove_pressure_deg": "groove:greatest",
    "pressure_angle_deg": "pressure:of_curved_slots",
    "undercut_mm": "undercut:deepest",
    "entry_shock_N": "shocks:of_entry",
    "reversal_shock_N": "shocks:of_reversal",
}
# Of a machine: what its spec asks for.
LIMITS: Checks = {
    "velocity_max": "invariants:greatest",
    "acceleration_max": "invariants:greatest",
    "acceleration_entry_max": "invariants:greatest",
    "jerk_max": "invariants:greatest",
    "pin_force_max_N": "load_limits:greatest",
    "input_torque_max_Nm": "load_limits:greatest",
    "pressure_angle_deg": "pressure:as_asked",
    "contact_stress_max_MPa": "load_limits:greatest",
    "pv_max_W_m2": "strength:borne",
    "roller_life_min_h": "strength:borne",
    "pin_stress_MPa": "strength:borne",
    "horn_stress_MPa": "strength:borne",
    "lock_horn_stress_MPa": "strength:borne",
    "lock_stress_max_MPa": "strength:borne",
    "wheel_shaft_stress_MPa": "strength:borne",
    "crank_shaft_stress_MPa": "strength:borne",
}
# Of flat parts as they stand.
STANDING: Checks = {
    "wall_between_slots_mm": "walls:between_slots",
    "horn_mm": "walls:horn",
    "wheel_bore_wall_mm": "walls:wheel_bore",
    "outer_wall_mm": "walls:outside",
    "dial_wall_mm": "dial:wall",
    "crank_bore_wall_mm": "walls:crank_bore",
    "crank_shaft_mm": "shafts:crank_shaft",
    "crank_hub_mm": "shafts:crank_hub",
    "wheel_shaft_mm": "shafts:wheel_shaft",
    "arm_wall_mm": "arm:arm_wall",
    "arm_to_hub_mm": "arm:arm_to_hub",
    "link_wall_mm": "links:wall",
    "link_gap_mm": "links:gap",
    "branches_apart_mm": "branches:apart",
    "branches_crossed_mm": "branches:crossed",
}
# Of flat parts and a whole turn of them.
TURNING: Checks = {
    "dwell_hold": "play:dwell_hold",
    "gap_mm": "touching:smallest_gap",
    "idle_roller_mm": "touching:idle_roller",
    "dwell_play_deg": "play:dwell",
    "hand_over_play_deg": "play:hand_over",
    "hand_over_pressure_deg": "play:hand_over_pressure",
    "motion_play_deg": "play:motion",
}


def of_machine(among: Checks, mechanism: Mechanism) -> Iterator[Check]:
    """Those of MOTION or LIMITS, one by one as they are made."""
    yield from _made(among, mechanism)


def standing(found: Outlines) -> Iterator[Check]:
    """The checks of the parts as they stand: walls, shafts, branches of a slot."""
    yield from _made(STANDING, found)


def turning(found: Outlines, turn: FullTurn) -> Iterator[Check]:
    """What a whole turn shows: no parts overlap, the wheel is held, pushed into line and led."""
    yield from _made(TURNING, found, turn)


def ask(among: Checks, name: str, *of: object) -> Check | None:
    """The check of this name; None where there is none, or nothing to check."""
    found: Check | None = None
    if name in among:
        found = named(f"verdict.checks.{among[name]}")(name, *of)
    return found


def _made(among: Checks, *of: object) -> Iterator[Check]:
    yield from (check for name in among if (check := ask(among, name, *of)))
