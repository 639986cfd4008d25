"""The list of checks, in the order shown; each is imported at its first use.

A new check is a file, or a function in a file of related ones, and one line here. The function gets
its name and the object to check, and returns None if the check does not apply.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.motion.records import KINDS, of_wheel
from geneva_cli.spec.load_named import load_named
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.parts.parts import Parts
    from geneva_cli.parts.turn.full_turn import FullTurn

Checks: TypeAlias = dict[str, str]  # name -> module:function

# Checks of the motion, if they apply.
MOTION: Checks = {
    "dwell_deg": "verdict.checks.motion_checks:shortest_dwell",
    "driver_gear_convexity": "verdict.checks.motion_checks:gear_convexity",
    "driven_gear_convexity": "verdict.checks.motion_checks:gear_convexity",
    "velocity_min": "verdict.checks.motion_checks:least_velocity",
    "groove_pressure_deg": "verdict.checks.motion_checks:groove_pressure",
    "pressure_angle_deg": "verdict.checks.motion_checks:curved_slot_pressure",
    "driven_fraction": "verdict.checks.motion_checks:driven_fraction",
    "undercut_mm": "verdict.checks.motion_checks:undercut_depth",
    "entry_shock_N": "verdict.checks.shocks:entry_shock",
    "reversal_shock_N": "verdict.checks.shocks:reversal_shock",
    "reversal_stress_MPa": "verdict.checks.shocks:reversal_stress",
    "stopping_torque_Nm": "verdict.checks.shocks:stopping_torque",
    **{name: path for kind in KINDS for name, path in kind.motion_checks.items()},
}
# Checks of limits that the spec sets.
LIMITS: Checks = {
    "velocity_max": "verdict.checks.limits:limited_peak",
    "acceleration_max": "verdict.checks.limits:limited_peak",
    "acceleration_entry_max": "verdict.checks.limits:limited_peak",
    "jerk_max": "verdict.checks.limits:limited_peak",
    "pin_force_max_N": "verdict.checks.limits:limited_load",
    "input_torque_max_Nm": "verdict.checks.limits:limited_load",
    "pressure_angle_deg": "verdict.checks.motion_checks:limited_pressure",
    "contact_stress_max_MPa": "verdict.checks.limits:limited_load",
    **dict.fromkeys(
        (
            "pv_max_W_m2",
            "roller_life_min_h",
            "slot_wear_max_mm_per_million",
            "pin_stress_MPa",
            "horn_stress_MPa",
            "lock_horn_stress_MPa",
            "lock_stress_max_MPa",
            "lock_deflection_max_deg",
            "wheel_shaft_stress_MPa",
            "crank_shaft_stress_MPa",
            "arm_stress_MPa",
            "wheel_key_pressure_MPa",
            "crank_key_pressure_MPa",
        ),
        "verdict.checks.strength_checks:strength_limit",
    ),
    "product_acceleration_max_m_s2": "verdict.checks.limits:product_acceleration",
    "product_slip": "verdict.checks.limits:product_slip",
}
# Checks of flat parts at rest.
STATIC: Checks = {
    "wall_between_slots_mm": "verdict.checks.walls:between_slots",
    "horn_mm": "verdict.checks.walls:horn",
    "rollers_apart_mm": "verdict.checks.walls:rollers_apart",
    "wheel_bore_wall_mm": "verdict.checks.walls:wheel_bore",
    "outer_wall_mm": "verdict.checks.walls:outside",
    "wheel_clamp_Nm": "verdict.checks.shaft_checks:held_torque",
    "crank_clamp_Nm": "verdict.checks.shaft_checks:held_torque",
    "dial_wall_mm": "verdict.checks.walls:dial",
    "crank_bore_wall_mm": "verdict.checks.walls:crank_bore",
    "crank_shaft_mm": "verdict.checks.shaft_checks:crank_shaft",
    "crank_hub_mm": "verdict.checks.shaft_checks:crank_hub",
    "wheel_shaft_mm": "verdict.checks.shaft_checks:wheel_shaft",
    "beside_shafts_mm": "verdict.checks.shaft_checks:passing_parts",
    "gear_gap_mm": "verdict.checks.shaft_checks:passing_gears",
    "arm_wall_mm": "verdict.checks.arm_checks:arm_wall",
    "arm_to_hub_mm": "verdict.checks.arm_checks:arm_to_hub",
    "link_wall_mm": "verdict.checks.arm_checks:links_wall",
    "link_gap_mm": "verdict.checks.arm_checks:links_gap",
    "first_pin_stress_MPa": "verdict.checks.strength_checks:first_stress",
    "first_horn_stress_MPa": "verdict.checks.strength_checks:first_stress",
    "first_crank_shaft_stress_MPa": "verdict.checks.strength_checks:first_stress",
    "first_arm_stress_MPa": "verdict.checks.strength_checks:first_stress",
    "branches_apart_mm": "verdict.checks.walls:branches_apart",
    "branches_crossed_mm": "verdict.checks.walls:branches_crossed",
    "wheels_apart_mm": "verdict.checks.crank_checks:wheels_apart",
    "cranks_apart_mm": "verdict.checks.crank_checks:cranks_apart",
}
# Checks of flat parts at rest, shown behind those that a kind adds.
PROCESS: Checks = {
    "cut_plate_mm": "verdict.checks.process:thickest_plate",
    "cut_slot_mm": "verdict.checks.process:slot_width",
    "parts": "verdict.checks.process:plates_built",
}
# All checks of parts at rest, of whatever kind.
STANDING: Checks = {
    **STATIC,
    **{name: path for kind in KINDS for name, path in kind.parts_checks.items()},
    **PROCESS,
}
# Checks of all the machines within the tolerances, for which parts are turned.
TOLERANCES: Checks = {
    "tolerance_slot_mm": "verdict.checks.tolerance_checks:slot_clearance",
    "tolerance_lock_mm": "verdict.checks.tolerance_checks:lock_clearance",
    "tolerance_turns": "verdict.checks.tolerance_checks:extremes_turn",
}
# Checks of plates or shells in a whole turn.
TURNING: Checks = {
    "dwell_hold": "verdict.checks.play_checks:dwell_hold",
    "gap_mm": "verdict.checks.play_checks:smallest_gap",
    "idle_roller_mm": "verdict.checks.play_checks:idle_roller",
    "dwell_play_deg": "verdict.checks.play_checks:dwell",
    "dwell_play_mm": "verdict.checks.play_checks:dwell",
    "hand_over_play_deg": "verdict.checks.play_checks:hand_over",
    "hand_over_play_mm": "verdict.checks.play_checks:hand_over",
    "hand_over_pressure_deg": "verdict.checks.play_checks:hand_over_pressure",
    "hand_over_offset_mm": "verdict.checks.play_checks:hand_over_offset",
    "motion_play_deg": "verdict.checks.play_checks:motion",
    "motion_play_mm": "verdict.checks.play_checks:motion",
    **TOLERANCES,
}
# Those that fail where a roller does not find its slot, or meets the rim next to it, and jams.
JAMS = (
    "hand_over_play_deg",
    "hand_over_play_mm",
    "hand_over_pressure_deg",
    "hand_over_offset_mm",
)
# Of flat parts at every angle of the turn, made for a design's own answer.
PROOFS: Checks = {"gap_proved_mm": "verdict.checks.proved:least_gap"}


# The names of all checks but those of the whole turn; ``parts``: they can be built.
BEFORE_TURN = tuple(dict.fromkeys((*MOTION, *LIMITS, "parts", *STANDING)))
# The names of those of the whole turn; ``full_turn``: the parts can be turned.
OF_TURN = ("full_turn", *TURNING)


def standing(mechanism: Mechanism) -> Checks:
    """The checks of the parts of a machine at rest."""
    kinds = of_wheel(mechanism.spec.wheel.NAME)
    own = next((kind.parts_checks for kind in reversed(kinds) if kind.parts), {})
    some = {
        name: path for kind in kinds if not kind.parts for name, path in kind.parts_checks.items()
    }
    return {**own, **some} if own else {**STATIC, **some, **PROCESS}


def standing_checks(parts: Parts) -> Iterator[Check]:
    """The checks of parts at rest: walls, shafts, branches of a slot."""
    yield from applicable(standing(parts.mechanism), parts)


def turn_checks(parts: Parts, turn: FullTurn) -> Iterator[Check]:
    """The checks of a whole turn: no parts overlap, and lock and slots leave little play."""
    yield from applicable(TURNING, parts, turn)


def check_named(among: Checks, name: str, *of: object) -> Check | None:
    """The check with this name; None if it is not in the list, or does not apply."""
    return next(untold({name: among[name]}, *of), None) if name in among else None


def untold(among: Checks, *of: object) -> Iterator[Check]:
    """The checks of a list that apply to ``of``; those that fail have no reason in words yet."""
    for name, path in among.items():
        check: Check | None = load_named(path)(name, *of)
        if check is not None:
            yield check


def applicable(among: Checks, *of: object) -> Iterator[Check]:
    """The checks of a list that apply to ``of``; of those that fail for one reason, the first."""
    reasons = set()
    for check in untold(among, *of):
        told = check.told
        if told.passes is not False or told.why not in reasons:
            yield told
        if told.passes is False and told.why:
            reasons.add(told.why)
