"""The registry of quantities: all whole names, and the functions that compute their values.

A new quantity is a name in one group here, and a value of the group's function.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.kept import load_named
from geneva_cli.motion.registry import KINDS, of_wheel
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, Shaft, WheelMaterial
from geneva_cli.verdict.checks import BEFORE_TURN, OF_TURN, PROOFS

if TYPE_CHECKING:
    from geneva_cli.motion.machine_spec import Spec
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.quantities.batch_designs import Columns, Designs, Values

INPUTS, CHECKS = "inputs.", "checks."  # beginnings of the names of a spec's keys, and of checks
ECHOED = {  # keys that the numbers of a report depend on, besides the machine's own shape
    "wheel": ("held_by",),
    "drive": ("n_rpm",),
    "size": (
        *("process", "slot_clearance_mm", "lock_clearance_mm", "press_fit_mm", "shaft_fit_mm"),
        *("face_width_mm", "pin_held", "pin_gap_mm", "lock_edge_mm"),
    ),
    **{
        table: tuple(key.key for key in fields(keys))
        for table, keys in (
            ("load", Load),
            ("shaft", Shaft),
            ("material.wheel", WheelMaterial),
            ("material.roller", RollerMaterial),
            ("limits", Limits),
        )
    },
}
# For each peak: the power of the input speed that turns its invariant into a rate; the power of the
# output's unit in the rate, and the end of the rate's name behind that unit.
RATES = {
    "velocity": (1, 1, "_s"),
    "acceleration": (2, 1, "_s2"),
    "jerk": (3, 1, "_s3"),
    "power": (3, 2, "2_s3"),
}


class QuantityGroup(NamedTuple):
    """Quantities that are computed together.

    ``alone`` computes them for the machine of a Parts and ``batch`` for Designs, each as
    module:function, imported at its first use. Both return values by the names in
    ``own``, and no design has those that they leave out. Without ``alone`` a single design is a
    batch of one. Groups may have one function for batches. ``alone`` may also return lists and
    tables.
    """

    table: str  # beginning of the whole names; empty if several tables are one group
    own: tuple[str, ...]
    alone: str = ""
    batch: str = ""
    one_by_one: tuple[str, ...] = ()  # names in ``own`` that ``batch`` does not compute
    makes_parts: bool = False  # it makes the machine's parts or turns them, which may take seconds
    kind: str = ""  # name of the kind to whose machines they belong; empty for all

    @property
    def names(self) -> tuple[str, ...]:
        """The whole names."""
        return tuple(map(self._whole, self.own))

    @property
    def batched(self) -> tuple[str, ...]:
        """The whole names of the quantities that a batch can compute."""
        names = [name for name in self.own if self.batch and name not in self.one_by_one]
        return tuple(map(self._whole, names))

    def values(self, parts: Parts) -> Values:
        """The values of a single design; None for those that it lacks."""
        every: Values = {self._whole(name): None for name in self.own}
        if not self._is_of(parts.mechanism.spec):
            return every
        computed: Values
        if self.alone:
            computed = load_named(self.alone)(parts)
        else:
            from geneva_cli.verdict.quantities.batch_designs import only, single

            columns = self.columns(single(parts.mechanism).requesting(self.names))
            computed = {name: only(columns[name]) for name in self.own}
        return every | {self._whole(name): value for name, value in computed.items()}

    def columns(self, of: Designs) -> Columns:
        """The values of a batch by the names without the table; None where no design has one."""
        none: Columns = dict.fromkeys(self.own)
        return {**none, **of.columns(load_named(self.batch))} if self._is_of(of.spec) else none

    def _is_of(self, spec: Spec) -> bool:
        """Return True if the quantities belong to a machine of the spec's kinds."""
        kinds = [kind.name for kind in of_wheel(spec.wheel.NAME)]
        return self.kind in ("", spec.drive.NAME, *kinds)

    def _whole(self, name: str) -> str:
        return f"{self.table}.{name}" if self.table else name


def own_names(table: str) -> tuple[str, ...]:
    """The names of a table's quantities, without the table.

    >>> own_names("strength.pin")[:2]
    ('diameter_mm', 'bending_MPa')
    """
    return tuple(name for group in GROUPS if group.table == table for name in group.own)


def _words(names: str) -> tuple[str, ...]:
    """The words of a text, and each end in braces behind each prefix before them.

    >>> _words("k jerk,power.{max at_deg}")
    ('k', 'jerk.max', 'jerk.at_deg', 'power.max', 'power.at_deg')
    """
    out: list[str] = []
    for prefixes, ends, word in re.findall(r"(\S+)\.{([^}]*)}|(\S+)", names):
        own = [f"{prefix}.{end}" for prefix in prefixes.split(",") for end in ends.split()]
        out += own or [word]
    return tuple(out)


def _groups(rows: str) -> Iterator[QuantityGroup]:
    """The groups of a text: functions, table, names; "!" behind names that no batch computes."""
    for row in rows.strip().replace("\n  ", " ").splitlines():
        functions, table, *names = row.split(maxsplit=2)
        words = _words("".join(names))
        paths = {one.startswith("quantities"): f"verdict.{one}" for one in functions.split(",")}
        yield QuantityGroup(
            table.rstrip("-"),
            tuple(word.rstrip("!") for word in words),
            paths.get(False, ""),
            paths.get(True, ""),
            tuple(word.rstrip("!") for word in words if word.endswith("!")),
            table in ("parts", "parts_list", "tolerance", "checks"),
        )


# Quantities of a report, in the order shown, but those of kinds.
_REPORT = """
report_sections:inputs inputs INPUTS
quantities.motion_quantities:timing timing motion_deg dwell_deg index_deg k tau motion_s dwell_s
  cycle_s index_mm k_r
quantities.motion_quantities:input_stop input_stop stands_s brake_deg start_deg inertia_kgm2
  brake_torque_Nm start_torque_Nm energy_J power_W
quantities.motion_quantities:index_gained timing index_gained_deg
quantities.motion_quantities:peaks - velocity.{max at_deg max_rad_s max_m_s entry exit}
  acceleration.{max at_deg max_rad_s2 max_m_s2 entry exit entry_rad_s2 entry_m_s2}
  jerk.{max at_deg max_rad_s3 max_m_s3 entry exit} power.{max at_deg max_rad2_s3 max_m2_s3}
report_sections:stations -
quantities.load_quantities:greatest loads
  torque_Nm,rack_force_N,pin_force_N,input_torque_Nm,contact_stress_MPa.{max at_deg} kinetic_power_W
quantities.load_quantities:summaries loads input_torque_Nm.{min mean rms}
  power_W,crank_bearing_N.{max min mean rms}
report_sections:reversals loads
quantities.load_quantities:entry shock.entry at_deg jump force_N moment_Nms
quantities.load_quantities:reversal shock.reversal
  at_deg jump force_N moment_Nms contact_stress_MPa drag_Nm
report_sections:slot slot positively_driven
quantities.load_quantities:slot slot not_driven_share branch_gap_mm branch_gap_at_deg
report_sections:vibration,quantities.load_quantities:vibration vibration none! period_ratio
  damping_ratio natural_Hz residual_share residual_deg dynamic_factor windup_deg
quantities.motion_quantities:product product travel_mm friction_needed
  speed_m_s,acceleration_m_s2,jerk_m_s3.{max at_deg}
report_sections:wheels -
report_sections:cranks -
report_sections:sizes sizes axes_deg sphere_radius_mm crank_arm_mm slot_mouth_polar_deg
  slot_bottom_polar_deg center_distance_mm crank_radius_mm ratio roller_radius_mm slot_width_mm
  clearances_from slot_mouth_radius_mm slot_bottom_radius_mm wheel_radius_mm rim_radius_mm
  pressure_angle_max_deg rollers_max
report_sections:parts parts none rim_radius_mm slot_end_radius_mm lock_radius_mm recess_radius_mm
  relief horn_mm wheel_bore_mm crank_bore_mm
report_sections:turned parts smallest_gap_mm smallest_gap_at_deg dwell_play_deg dwell_play_mm
report_sections:parts_list_tables parts_list
report_sections:tolerances,quantities.load_quantities:tolerances tolerance
  dwell_position.{worst_deg! rss_deg! p997_deg!} motion_play.{worst_deg rss_deg p997_deg!}
  entry_jump.{mean! worst} clearances.{slot_needed_mm! lock_needed_mm! turns!}
quantities.part_strength:pin strength.pin
  diameter_mm bending_MPa shear_MPa stress_MPa allowed_MPa margin least_diameter_mm
quantities.part_strength:horn strength.horn
  stress_MPa at_deg inwards_mm thickness_mm allowed_MPa margin
quantities.part_strength:lock strength.lock torque_Nm force_N contact_stress_MPa pressure_MPa
  allowed_MPa margin horn_stress_MPa play_deg approach_deg bending_deg deflection_deg
quantities.part_strength:wheel_shaft strength.wheel_shaft
  diameter_mm moment_Nm at_deg stress_MPa allowed_MPa margin least_diameter_mm
quantities.part_strength:crank_shaft strength.crank_shaft
  diameter_mm moment_Nm at_deg stress_MPa allowed_MPa margin least_diameter_mm
quantities.part_strength:arm strength.arm thickness_mm stress_MPa allowed_MPa margin
quantities.part_strength:arm_thickness strength.arm least_thickness_mm
quantities.part_strength:wheel_key strength.wheel_key
  length_mm pressure_MPa shear_MPa allowed_MPa margin least_length_mm
quantities.part_strength:crank_key strength.crank_key
  length_mm pressure_MPa shear_MPa allowed_MPa margin least_length_mm
quantities.part_strength:wear life
  slot_travel_m roller_turns_per_motion equivalent_force_N friction_work_J
quantities.part_strength:pressure_speed life pv_max_W_m2
quantities.part_strength:bending life pin_stress_MPa horn_stress_MPa
quantities.part_strength:wear life roller_life_turns roller_life_motions roller_life_h
report_sections:needs strength
"""
_INPUTS = " ".join(f"{table}.{{{' '.join(keys)}}}" for table, keys in ECHOED.items())
# The kind of machine; then further quantities, for studies. Whether a design passes is found alone,
# too: until the first check that fails.
_STUDY = f"""
report_sections:machine - wheel.z wheel.gearing drive.kind drive.rollers drive.before.kind
  motion.law
quantities.load_quantities:summaries loads input_torque_Nm.min_at_deg
  power_W,crank_bearing_N.{{min_at_deg max_at_deg}}
  pin_force_N,contact_stress_MPa,rack_force_N.{{min min_at_deg mean rms}}
  omega_rad_s,alpha_rad_s2,wheel_torque_Nm,sliding_m_s.{{max max_at_deg min min_at_deg mean rms}}
  wheel_bearing_N,pv_W_m2,rack_speed_m_s.{{max max_at_deg min min_at_deg mean rms}}
  rack_acceleration_m_s2,guide_force_N.{{max max_at_deg min min_at_deg mean rms}}
  wheel_near_bearing_N,wheel_far_bearing_N.{{max max_at_deg min min_at_deg mean rms}}
  crank_near_bearing_N,crank_far_bearing_N.{{max max_at_deg min min_at_deg mean rms}}
quantities.load_quantities:sizing sizing inertia_kgm2 acceleration_rad_s2 inertia_torque_Nm
  friction_torque_Nm total_torque_Nm design_torque_Nm input_torque_Nm power_W Am Vm Qm
  energy_fluctuation_J flywheel_kgm2 motor_rpm motor_torque_max_Nm motor_torque_rms_Nm
  inertia_ratio flywheel_to_add_kgm2
checks:values_before_turn checks {" ".join(BEFORE_TURN)}
checks:check_values checks {" ".join(OF_TURN)} passes failed
checks:passed checks passes
checks:proved checks {" ".join(PROOFS)}
"""


def _with_kinds() -> Iterator[QuantityGroup]:
    """The groups of a report, each kind's own behind the tables that it names."""
    core = [*_groups(_REPORT.replace("INPUTS", _INPUTS))]
    last = {group.table: group for group in core}
    for group in core:
        yield group
        for kind in KINDS if last[group.table] is group else ():
            if row := kind.quantities.get(group.table):
                way, path, table, names = row.split(maxsplit=3)
                alone, batch = (path, "") if way == "alone" else ("", path)
                yield QuantityGroup(table, _words(names), alone, batch, (), bool(alone), kind.name)


REPORT = (*_with_kinds(),)
MACHINE, *STUDY = _groups(_STUDY)
# All quantities; those that make parts come last.
GROUPS = tuple(sorted((MACHINE, *REPORT, *STUDY), key=lambda group: group.makes_parts))
