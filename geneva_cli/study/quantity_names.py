"""The names of a design's quantities: which there are, and what a name that is typed stands for.

Every command that takes a quantity resolves its name here, without making a machine.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.verdict.checks.registry import every_check
from geneva_cli.verdict.report import parts, tolerances
from geneva_cli.verdict.report.inputs import INPUTS, input_names

CHECKS = "checks."
SHOWN_MAX = 5  # candidates in a message

# Names of columns and keys that neither the whole name nor its end spells.
SYNONYMS = {
    "acceleration_max_deg": "acceleration.at_deg",
    "drive": "drive.kind",
    "n_rpm": "inputs.drive.n_rpm",
}
# Quantities that are words, which have no order.
WORDS = frozenset(
    {
        *("wheel.gearing", "drive.kind", "motion.law", "sizes.clearances_from", "checks.failed"),
        *("inputs.wheel.held_by", "inputs.size.process", "inputs.size.pin_held"),
        *("inputs.load.friction_at", "vibration.none", "parts.none", "parts.relief"),
    }
)


def _product(of: str, names: str) -> tuple[str, ...]:
    """Each of some names behind each prefix, as texts of words.

    >>> _product("jerk power", "max at_deg")
    ('jerk.max', 'jerk.at_deg', 'power.max', 'power.at_deg')
    """
    return tuple(f"{prefix}.{name}" for prefix in of.split() for name in names.split())


# The quantities of each section of a report and of the study, without tables and lists.
SECTIONS: Mapping[str, tuple[str, ...]] = {
    "study.fields:machine": (
        *("wheel.z", "wheel.gearing", "drive.kind", "drive.rollers", "motion.law"),
    ),
    "verdict.report.inputs:inputs": input_names(),
    "verdict.report.stations:stations": (
        *_product("timing", "motion_deg dwell_deg index_deg k tau motion_s dwell_s cycle_s"),
        *_product("timing", "shortest_motion_s k_r"),
        *_product("velocity", "max at_deg max_rad_s"),
        *_product("acceleration", "max at_deg max_rad_s2 entry exit entry_rad_s2"),
        *_product("jerk", "max at_deg max_rad_s3 entry exit"),
        *_product("power", "max at_deg max_rad2_s3"),
    ),
    "verdict.report.loads:greatest_loads": (
        *_product("loads.torque_Nm loads.pin_force_N", "max at_deg"),
        *_product("loads.input_torque_Nm loads.contact_stress_MPa", "max at_deg"),
        "loads.kinetic_power_W",
    ),
    "verdict.report.cycle:cycle": _product(
        "cycle.input_torque_Nm cycle.power_W cycle.crank_bearing_N", "max min mean rms"
    ),
    "verdict.report.shocks:shocks": (
        *_product("shock.entry shock.reversal", "at_deg jump force_N moment_Nms"),
        "shock.reversal.drag_Nm",
    ),
    "verdict.report.slot:slot": _product(
        "slot", "positively_driven not_driven_share branch_gap_mm branch_gap_at_deg"
    ),
    "verdict.report.vibration:vibration": (
        *_product("vibration", "none period_ratio damping_ratio natural_Hz residual_share"),
        *_product("vibration", "residual_deg residual_share_worst steady_share dynamic_factor"),
        "vibration.windup_deg",
    ),
    "verdict.report.sizes:sizes": (
        *_product("sizes", "axes_deg sphere_radius_mm crank_arm_mm slot_mouth_polar_deg"),
        *_product("sizes", "slot_bottom_polar_deg center_distance_mm crank_radius_mm ratio"),
        *_product("sizes", "roller_radius_mm slot_width_mm clearances_from slot_mouth_radius_mm"),
        *_product("sizes", "slot_bottom_radius_mm wheel_radius_mm rim_radius_mm"),
        *_product("sizes", "pressure_angle_max_deg rollers_max"),
    ),
    "verdict.report.strength:strength_values": (
        *_product("strength.pin", "diameter_mm bending_MPa shear_MPa stress_MPa allowed_MPa"),
        *_product("strength.pin", "margin least_diameter_mm"),
        *_product("strength.horn", "stress_MPa at_deg inwards_mm thickness_mm allowed_MPa margin"),
        *_product("strength.lock", "torque_Nm force_N contact_stress_MPa pressure_MPa"),
        *_product("strength.lock", "allowed_MPa margin horn_stress_MPa play_deg approach_deg"),
        *_product("strength.lock", "bending_deg deflection_deg"),
        *_product(
            "strength.wheel_shaft strength.crank_shaft",
            "diameter_mm moment_Nm at_deg stress_MPa allowed_MPa margin least_diameter_mm "
            "twist_deg",
        ),
        *_product("life", "slot_travel_m roller_turns_per_motion equivalent_force_N"),
        *_product("life", "friction_work_J pv_max_W_m2 pin_stress_MPa horn_stress_MPa"),
        *_product("life", "roller_life_turns roller_life_motions roller_life_h"),
        "life.slot_wear_mm_per_million",
    ),
    "study.fields:cycle": _product(
        "loads.omega_rad_s loads.alpha_rad_s2 loads.wheel_torque_Nm loads.pin_force_N "
        "loads.contact_stress_MPa loads.sliding_m_s loads.input_torque_Nm loads.power_W "
        "loads.wheel_bearing_N loads.crank_bearing_N loads.pv_W_m2 loads.guide_force_N "
        "loads.wheel_near_bearing_N loads.wheel_far_bearing_N loads.crank_near_bearing_N "
        "loads.crank_far_bearing_N",
        "min min_at_deg mean rms",
    ),
    "study.fields:bought": (
        *_product("sizing", "inertia_kgm2 acceleration_rad_s2 inertia_torque_Nm"),
        *_product("sizing", "friction_torque_Nm total_torque_Nm design_torque_Nm"),
        *_product("sizing", "input_torque_Nm power_W Am Vm Qm energy_fluctuation_J"),
        *_product("sizing", "flywheel_kgm2 motor_rpm motor_torque_max_Nm motor_torque_rms_Nm"),
        *_product("sizing", "inertia_ratio flywheel_to_add_kgm2 coasting_speed_share"),
        "sizing.input_torque_ratio",
    ),
    "verdict.report.parts:parts": tuple(parts.NAMES),
    "verdict.report.tolerances:tolerances": tuple(
        f"tolerance.{name}" for name in tolerances.NAMES if name != "warnings"
    ),
    "study.fields:judged": (
        *(f"{CHECKS}{name}" for name in every_check()),
        *("checks.passes", "checks.failed"),
    ),
}


@cache
def section_of() -> Mapping[str, str]:
    """The section of each quantity, by its whole name."""
    return {name: by for by, names in SECTIONS.items() for name in names}


def whole_name(asked: str, option: str = "--pick") -> str:
    """The whole name of a quantity; ``option`` is what asks for it.

    A whole name may be written with underscores, as a column of ``table`` and ``synth``, or
    shortened to its end. A key of the spec is named whole, and a check gives way to a quantity of
    its name. Raises GenevaError for a name that is none, with the nearest one, and for one that
    may be several, with these.

    >>> whole_name("acceleration_max"), whole_name("dwell_s")
    ('acceleration.max', 'timing.dwell_s')
    """
    if asked in section_of():
        return asked
    for found in _readings(asked):
        if len(found) > 1:
            more = len(found) - SHOWN_MAX
            those = [*found[:SHOWN_MAX], *([f"{more} others"] if more > 0 else [])]
            raise GenevaError(f"{option} {cut(asked)}: it may be {' or '.join(those)}; say which")
        if found:
            return found[0]
    raise GenevaError(
        f"{option} {cut(asked)}: no quantity of a design{_nearest(asked)}; `geneva compare` "
        "shows all that are quick, and check names stand behind checks."
    )


def _readings(asked: str) -> Iterator[list[str]]:
    """What a name that is no whole name may mean, the nearest reading first."""
    yield [SYNONYMS[asked]] if asked in SYNONYMS else []
    others = [name for name in section_of() if not name.startswith(INPUTS)]
    quantities = [name for name in others if not name.startswith(CHECKS)]
    yield [name for name in quantities if _spelled(name) == asked]
    for names in (quantities, others):
        yield [name for name in names if name.endswith(f".{asked}")]
        yield [name for name in names if asked in {_spelled(end) for end in _ends(name)}]


def _spelled(name: str) -> str:
    """A name with underscores, as the columns of ``table`` and ``synth`` have it."""
    return name.replace(".", "_")


def _ends(name: str) -> list[str]:
    """The name without its first parts, the longest first.

    >>> _ends("loads.pin_force_N.max")
    ['pin_force_N.max', 'max']
    """
    parts = name.split(".")
    return [".".join(parts[i:]) for i in range(1, len(parts))]


def _nearest(asked: str) -> str:
    """`` (did you mean "..."?)``: by a whole name, or by the end of one, as dwell for dwell_s.

    A whole name behind a word too many, as velocity.max in peaks.velocity.max, comes first, and a
    key of the spec by its own name.
    """
    known = section_of()
    behind = [name for name in known if asked.endswith(f".{name}")]
    keys = [name for name in known if name.startswith(INPUTS) and name.endswith(f".{asked}")]
    if behind or keys:
        best = max(behind or keys, key=len)
        return nearest(best, [best])
    ends = [end for name in known if not name.startswith(INPUTS) for end in _ends(name)]
    return nearest(asked, dict.fromkeys([*known, *ends]))
