"""The list of checks, in the order shown; each is imported at its first use.

A new check is a file, or a function in a file of related ones, and one line here. The function gets
its name and the object to check, and returns None if the check does not apply.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.spec.load_named import load_named
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.collisions.full_turn import FullTurn
    from geneva_cli.collisions.machine_parts import MachineParts
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.parts.parts_of_machine import PartsOfMachine

Checks: TypeAlias = dict[str, str]  # name -> module:function in this folder

# Checks of the motion, if they apply.
MOTION: Checks = {
    "dwell_deg": "motion:shortest_dwell",
    "driver_gear_convexity": "motion:gear_convexity",
    "driven_gear_convexity": "motion:gear_convexity",
    "velocity_min": "motion:least_velocity",
    "groove_pressure_deg": "motion:groove_pressure",
    "pressure_angle_deg": "motion:curved_slot_pressure",
    "undercut_mm": "motion:undercut_depth",
    "entry_shock_N": "shocks:entry_shock",
    "reversal_shock_N": "shocks:reversal_shock",
    "stopping_torque_Nm": "shocks:stopping_torque",
    "rack_horn_mm": "rack:rack_horn",
    "guide_locks": "rack:guide_locks",
    "counter_free_deg": "counter:free",
    "counter_play_deg": "counter:greatest_play",
    "counter_lock_deg": "counter:lock",
}
# Checks of limits that the spec sets.
LIMITS: Checks = {
    "velocity_max": "limits:limited_peak",
    "acceleration_max": "limits:limited_peak",
    "acceleration_entry_max": "limits:limited_peak",
    "jerk_max": "limits:limited_peak",
    "pin_force_max_N": "limits:limited_load",
    "input_torque_max_Nm": "limits:limited_load",
    "pressure_angle_deg": "motion:limited_pressure",
    "contact_stress_max_MPa": "limits:limited_load",
    "pv_max_W_m2": "strength:strength_limit",
    "roller_life_min_h": "strength:strength_limit",
    "slot_wear_max_mm_per_million": "strength:strength_limit",
    "pin_stress_MPa": "strength:strength_limit",
    "horn_stress_MPa": "strength:strength_limit",
    "lock_horn_stress_MPa": "strength:strength_limit",
    "lock_stress_max_MPa": "strength:strength_limit",
    "lock_deflection_max_deg": "strength:strength_limit",
    "wheel_shaft_stress_MPa": "strength:strength_limit",
    "crank_shaft_stress_MPa": "strength:strength_limit",
    "arm_stress_MPa": "strength:strength_limit",
    "wheel_key_pressure_MPa": "strength:strength_limit",
    "crank_key_pressure_MPa": "strength:strength_limit",
    "product_acceleration_max_m_s2": "limits:product_acceleration",
    "product_slip": "limits:product_slip",
}
# Checks of flat parts at rest.
STATIC: Checks = {
    "wall_between_slots_mm": "walls:between_slots",
    "horn_mm": "walls:horn",
    "rollers_apart_mm": "walls:rollers_apart",
    "wheel_bore_wall_mm": "walls:wheel_bore",
    "outer_wall_mm": "walls:outside",
    "wheel_clamp_Nm": "shafts:held_torque",
    "crank_clamp_Nm": "shafts:held_torque",
    "dial_wall_mm": "walls:dial",
    "crank_bore_wall_mm": "walls:crank_bore",
    "crank_shaft_mm": "shafts:crank_shaft",
    "crank_hub_mm": "shafts:crank_hub",
    "wheel_shaft_mm": "shafts:wheel_shaft",
    "beside_shafts_mm": "shafts:passing_parts",
    "gear_gap_mm": "shafts:passing_gears",
    "arm_wall_mm": "arm:arm_wall",
    "arm_to_hub_mm": "arm:arm_to_hub",
    "link_wall_mm": "arm:links_wall",
    "link_gap_mm": "arm:links_gap",
    "first_pin_stress_MPa": "strength:first_stress",
    "first_horn_stress_MPa": "strength:first_stress",
    "first_crank_shaft_stress_MPa": "strength:first_stress",
    "first_arm_stress_MPa": "strength:first_stress",
    "branches_apart_mm": "walls:branches_apart",
    "branches_crossed_mm": "walls:branches_crossed",
    "wheels_apart_mm": "cranks:wheels_apart",
    "cranks_apart_mm": "cranks:cranks_apart",
    "stop_turns": "stop:turns",
    "stop_overlap_mm": "stop:overlap",
    "stop_stress_max_MPa": "stop:stress",
    "cut_plate_mm": "process:thickest_plate",
    "cut_slot_mm": "process:slot_width",
    "parts": "process:plates_built",
}
# Checks of the shells of a sphere at rest.
SPHERE: Checks = {
    "wall_between_slots_mm": "sphere:between_slots",
    "horn_mm": "sphere:horn",
    "wheel_bore_wall_mm": "sphere:wheel_bore",
    "crank_shaft_mm": "sphere:crank_shaft",
    "wheel_clamp_Nm": "shafts:held_torque",
    "crank_clamp_Nm": "shafts:held_torque",
    "dial_wall_mm": "sphere:dial",
    "crank_bore_wall_mm": "sphere:crank_bore",
    "beside_shafts_mm": "sphere:passing_parts",
    "arm_wall_mm": "sphere:arm_wall",
    "cut_plate_mm": "process:thickest_shell",
    "cut_slot_mm": "process:width_in_shell",
    "parts": "process:solids_built",
}
# Checks of a rack's machine at rest.
RACK: Checks = {
    "beside_shafts_mm": "shafts:passing_rack",
    "gear_gap_mm": "shafts:passing_rack_gears",
    "cut_plate_mm": "process:thickest_of_rack",
    "cut_slot_mm": "process:width_in_rack",
    "parts": "process:plates_built",
}
# The checks of parts at rest, by ``Gearing.PARTS``; those of a counter's teeth are in MOTION.
STANDING = {
    "flat": STATIC,
    "ball": SPHERE,
    "rack": RACK,
    "counter": {"cut_plate_mm": "process:thickest_of_counter", "parts": "process:plates_built"},
}
# Checks of plates or shells in a whole turn.
TURNING: Checks = {
    "dwell_hold": "play:dwell_hold",
    "gap_mm": "play:smallest_gap",
    "idle_roller_mm": "play:idle_roller",
    "dwell_play_deg": "play:dwell",
    "dwell_play_mm": "play:dwell",
    "hand_over_play_deg": "play:hand_over",
    "hand_over_play_mm": "play:hand_over",
    "hand_over_pressure_deg": "play:hand_over_pressure",
    "motion_play_deg": "play:motion",
    "motion_play_mm": "play:motion",
}
# Those that fail where a roller does not find its slot, or meets the rim next to it, and jams.
JAMS = ("hand_over_play_deg", "hand_over_play_mm", "hand_over_pressure_deg")
# Of flat parts at every angle of the turn, made for a design's own answer.
PROOFS: Checks = {"gap_proved_mm": "proved:least_gap"}


def checks_before_turn() -> tuple[str, ...]:
    """The names of all checks but those of the whole turn; ``parts``: they can be built."""
    lists = (MOTION, LIMITS, ("parts",), *STANDING.values())
    return tuple(dict.fromkeys(name for names in lists for name in names))


def checks_of_turn() -> tuple[str, ...]:
    """The names of the checks of the whole turn; ``full_turn``: the parts can be turned."""
    return ("full_turn", *TURNING)


def standing(mechanism: Mechanism) -> Checks:
    """The checks of the parts of a machine at rest."""
    return STANDING.get(mechanism.spec.wheel.PARTS, {})


def standing_checks(parts: PartsOfMachine) -> Iterator[Check]:
    """The checks of parts at rest: walls, shafts, branches of a slot."""
    yield from applicable(standing(parts.mechanism), parts)


def turn_checks(parts: MachineParts, turn: FullTurn) -> Iterator[Check]:
    """The checks of a whole turn: no parts overlap, and lock and slots leave little play."""
    yield from applicable(TURNING, parts, turn)


def check_named(among: Checks, name: str, *of: object) -> Check | None:
    """The check with this name; None if it is not in the list, or does not apply."""
    check: Check | None = None
    if name in among:
        check = load_named(f"verdict.checks.{among[name]}")(name, *of)
    return check


def applicable(among: Checks, *of: object) -> Iterator[Check]:
    """The checks of a list that apply to ``of``; of those that fail for one reason, the first."""
    reasons = set()
    for name in among:
        check = check_named(among, name, *of)
        if check is None or (check.passes is False and check.why in reasons):
            continue
        yield check
        if check.passes is False and check.why:
            reasons.add(check.why)
