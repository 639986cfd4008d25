"""The list of checks, in the order shown; each is imported at its first use.

A new check is a function, and its name here. The function gets the name and the object to check,
and returns None if the check does not apply.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.motion.compatible import concerns
from geneva_cli.motion.records import KINDS, of_wheel
from geneva_cli.spec.load_named import load_named
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism

Checks: TypeAlias = dict[str, str]  # name -> module:function


def _of(module: str, **functions: str) -> Checks:
    """The checks of a module, from the names that each of its functions computes."""
    return {
        name: f"verdict.checks.{module}:{function}"
        for function, names in functions.items()
        for name in names.split()
    }


# Checks of the motion, if they apply.
MOTION: Checks = {
    **_of(
        "motion_checks",
        shortest_dwell="dwell_deg",
        gear_convexity="driver_gear_convexity driven_gear_convexity",
        least_velocity="velocity_min",
        groove_pressure="groove_pressure_deg",
        pressure_angle="pressure_angle_deg",
        driven_fraction="driven_fraction",
        undercut_depth="undercut_mm",
    ),
    **_of(
        "load_checks",
        entry_shock="entry_shock_N",
        reversal_shock="reversal_shock_N",
        reversal_stress="reversal_stress_MPa",
        stopping_torque="stopping_torque_Nm",
    ),
    **{name: path for kind in KINDS for name, path in kind.motion_checks.items()},
}
# Checks of limits that the spec sets.
LIMITS: Checks = {
    **_of(
        "motion_checks",
        limited_peak="velocity_max acceleration_max acceleration_entry_max jerk_max",
        entry_velocity="entry_velocity_max",
        limited_time="dwell_min_s motion_max_s cycle_max_s",
    ),
    **_of(
        "load_checks",
        limited_load="pin_force_max_N input_torque_max_Nm contact_stress_max_MPa",
        strength_limit=(
            "pv_max_W_m2 roller_life_min_h pin_stress_MPa "
            "horn_stress_MPa lock_horn_stress_MPa lock_stress_max_MPa lock_deflection_max_deg "
            "wheel_shaft_stress_MPa crank_shaft_stress_MPa arm_stress_MPa "
            "wheel_key_pressure_MPa crank_key_pressure_MPa"
        ),
        product="product_acceleration_max_m_s2 product_slip",
    ),
}
# Checks of flat parts at rest.
STATIC: Checks = {
    **_of(
        "walls",
        between_slots="wall_between_slots_mm",
        horn="horn_mm",
        rollers_apart="rollers_apart_mm",
        wheel_bore="wheel_bore_wall_mm",
        outside="outer_wall_mm",
        dial="dial_wall_mm",
        crank_bore="crank_bore_wall_mm",
    ),
    **_of(
        "clearances",
        crank_shaft="crank_shaft_mm",
        crank_hub="crank_hub_mm",
        wheel_shaft="wheel_shaft_mm",
        passing_parts="beside_shafts_mm",
        passing_gears="gear_gap_mm",
        arm_wall="arm_wall_mm",
        arm_to_hub="arm_to_hub_mm",
        links_wall="link_wall_mm",
        links_gap="link_gap_mm",
    ),
    **_of(
        "load_checks",
        first_stress="first_pin_stress_MPa first_horn_stress_MPa first_crank_shaft_stress_MPa "
        "first_arm_stress_MPa",
    ),
    **_of(
        "walls",
        branches="branches_apart_mm branches_crossed_mm",
        wheels_apart="wheels_apart_mm",
        cranks_apart="cranks_apart_mm",
    ),
}
# Checks of flat parts at rest, shown behind those that a kind adds.
PROCESS = _of(
    "clearances", thickest_plate="cut_plate_mm", slot_width="cut_slot_mm", plates_built="parts"
)
# All checks of parts at rest, of whatever kind.
STANDING: Checks = {
    **STATIC,
    **{name: path for kind in KINDS for name, path in kind.parts_checks.items()},
    **PROCESS,
}
# Checks of plates or shells in a whole turn. JAMS are those that fail where a roller does not find
# its slot, or meets the rim next to it, and jams.
JAMS = _of(
    "play_checks",
    play="hand_over_play_deg hand_over_play_mm",
    hand_over_pressure="hand_over_pressure_deg",
    hand_over_offset="hand_over_offset_mm",
)
# Of machines as built, by what touches.
PUSHED = ("turns", "strike_velocity")
# Plays that the spec limits; a machine whose parts cannot be turned has no value of them.
PLAYS = _of(
    "play_checks",
    limited_play="index_play_max_deg dwell_play_max_deg",
    dwell_position="dwell_position_max_deg",
)
# Of all the machines within the tolerances.
TOLERANCES = _of(
    "play_checks",
    toleranced="tolerance_slot_mm tolerance_lock_mm",
)
TURNING: Checks = {
    **_of(
        "play_checks",
        dwell_hold="dwell_hold",
        smallest_gap="gap_mm",
        idle_roller="idle_roller_mm",
        play="dwell_play_deg dwell_play_mm",
    ),
    **JAMS,
    **_of("play_checks", play="motion_play_deg motion_play_mm"),
    **PLAYS,
    **TOLERANCES,
}
# Of flat parts at every angle of the turn, made for a design's own answer.
PROOFS = _of("play_checks", least_gap="gap_proved_mm")
# The names of all checks but those of the whole turn; ``parts``: they can be built.
BEFORE_TURN = tuple(dict.fromkeys((*MOTION, *LIMITS, "parts", *STANDING)))
# The names of those of the whole turn; ``full_turn``: the parts can be turned.
OF_TURN = ("full_turn", *TURNING)


def standing(mechanism: Mechanism) -> Checks:
    """The checks of the parts of a machine at rest."""
    kinds = of_wheel(mechanism.spec.wheel.NAME)
    own: Mapping[str, str] = {}
    some: Checks = {}
    for kind in kinds:
        if kind.parts:
            own = kind.parts_checks
        elif concerns(kind, mechanism.spec):
            some |= kind.parts_checks
    return {**own, **some} if own else {**STATIC, **some, **PROCESS}


def check_named(among: Checks, name: str, *of: object) -> Check | None:
    """The check with this name, without its reason; None if it is none, or does not apply."""
    return load_named(among[name])(name, *of) if name in among else None


def without_reasons(among: Checks, *of: object) -> Iterator[Check]:
    """The checks of a list that apply to ``of``; those that fail have no reason in words yet."""
    for name in among:
        if check := check_named(among, name, *of):
            yield check


def applicable(among: Checks, *of: object) -> Iterator[Check]:
    """The checks of a list that apply to ``of``; of those that fail for one reason, the first."""
    reasons = set()
    for name, path in among.items():
        check = load_named(path)(name, *of)
        if check is None:
            continue
        check = check.with_reason
        if check.passes is not False:
            yield check
        elif check.why not in reasons:
            yield check
            reasons |= {check.why} - {""}
