"""The registry of quantities: all whole names, and the functions that compute their values.

A new quantity is a name in one row here, and a value of the row's function.
"""

import math
import re
from itertools import product
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from geneva_cli.kept import load_named
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import KINDS, of_wheel
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, Shaft, WheelMaterial
from geneva_cli.verdict.checks import BEFORE_TURN, OF_TURN, PROOFS
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs, Values, only, single

INPUTS, CHECKS = "inputs.", "checks."  # beginnings of the names of a spec's keys, and of checks
# Keys that the numbers of a report depend on, besides the machine's own shape: some, or a table's.
_INPUTS = """wheel.held_by drive.n_rpm size.{process slot_clearance_mm lock_clearance_mm
  press_fit_mm shaft_fit_mm face_width_mm pin_held pin_gap_mm lock_edge_mm}"""
for _keys in (Load, Shaft, WheelMaterial, RollerMaterial, Limits):
    _INPUTS += f" {_keys.TABLE}.{{{' '.join(map(attrgetter('key'), fields(_keys)))}}}"
# For each peak: the power of the input speed that turns its invariant into a rate; the power of the
# output's unit in the rate, and the end of the rate's name behind that unit.
RATES = {
    "velocity": (1, 1, "_s"),
    "acceleration": (2, 1, "_s2"),
    "jerk": (3, 1, "_s3"),
    "power": (3, 2, "2_s3"),
}


# Tables whose quantities need the machine's parts, or their turn, which may take seconds.
MAKE_PARTS = ("parts", "parts_list", "tolerance", "checks")


class QuantityGroup(NamedTuple):
    """Quantities that are computed together, by their whole names.

    ``alone`` computes them for the machine of a Parts and ``batch`` for Designs, each as
    module:function, imported at its first use. Both return values by their ``own`` names, without
    the table, and no design has those that they leave out. Without ``alone`` a single design is a
    batch of one. Groups may have one function for batches. ``alone`` may also return lists and
    tables.
    """

    table: str  # beginning of the whole names, with its dot
    names: tuple[str, ...]
    own: tuple[str, ...]
    alone: str
    batch: str
    batched: tuple[str, ...]  # the names that ``batch`` computes
    kind: str  # name of the kind to whose machines they belong; empty for all
    makes_parts: bool

    def values(self, parts: Parts) -> Values:
        """The values of a single design; None for those that it lacks."""
        if not self.alone:
            columns = self.columns(single(parts.mechanism).requesting(self.names))
            return {name: only(column) for name, column in columns.items()}
        own: Values = load_named(self.alone)(parts) if self._is_of(parts.mechanism.spec) else {}
        computed: Values = {f"{self.table}{name}": value for name, value in own.items()}
        return {**dict.fromkeys(self.names), **computed}

    def columns(self, of: Designs) -> Columns:
        """The values of a batch; None where no design has one."""
        own = of.columns(load_named(self.batch)) if self._is_of(of.spec) else {}
        return dict(zip(self.names, map(own.get, self.own), strict=True))

    def _is_of(self, spec: Spec) -> bool:
        """Return True if the quantities belong to a machine of the spec's kinds."""
        if self.kind in ("", spec.drive.NAME):
            return True
        return self.kind in map(attrgetter("name"), of_wheel(spec.wheel.NAME))


def _group(row: str, kind: str = "") -> QuantityGroup:
    """The group of a row: its table, ``alone``, ``batch`` and its names; "-" stands for none.

    Each end in braces stands behind each prefix before them: ``a,b.{max min}`` are four names. Of
    those with an exclamation mark a batch computes none. Paths of a kind are whole.
    """
    table, alone, batch, *names = row.split(maxsplit=3)
    start, words = "" if table == "-" else f"{table}.", list[str]()
    for prefixes, ends, word in re.findall(r"(\S+)\.{([^}]*)}|(\S+)", "".join(names)):
        words += [word] if word else map(".".join, product(prefixes.split(","), ends.split()))
    own = " ".join(words).replace("!", "").split()
    batched = [*filter(own.__contains__, words)] if batch != "-" else []  # those without a mark
    rooms = ("", "") if kind else ("verdict.", "verdict.quantities.")
    return QuantityGroup(
        start,
        tuple(map(start.__add__, own)),
        tuple(own),
        "" if alone == "-" else rooms[0] + alone,
        "" if batch == "-" else rooms[1] + batch,
        tuple(map(start.__add__, batched)),
        kind,
        table in MAKE_PARTS or bool(kind and batch == "-"),
    )


# Quantities of a report, in the order shown, but those of kinds.
_REPORT = """
inputs report_sections:inputs - INPUTS
timing - motion_quantities:timing motion_deg dwell_deg index_deg k tau motion_s dwell_s
  cycle_s index_mm k_r
input_stop - motion_quantities:input_stop stands_s brake_deg start_deg inertia_kgm2
  brake_torque_Nm start_torque_Nm energy_J power_W
timing - motion_quantities:index_gained index_gained_deg
- - motion_quantities:peaks velocity.{max at_deg max_rad_s max_m_s entry exit}
  acceleration.{max at_deg max_rad_s2 max_m_s2 entry exit entry_rad_s2 entry_m_s2}
  jerk.{max at_deg max_rad_s3 max_m_s3 entry exit} power.{max at_deg max_rad2_s3 max_m2_s3}
- report_sections:stations -
loads - load_quantities:greatest
  torque_Nm,rack_force_N,pin_force_N,input_torque_Nm,contact_stress_MPa.{max at_deg} kinetic_power_W
loads - load_quantities:summaries input_torque_Nm.{min mean rms}
  power_W,crank_bearing_N.{max min mean rms}
loads report_sections:reversals -
shock.entry - load_quantities:entry at_deg jump force_N moment_Nms
shock.reversal - load_quantities:reversal
  at_deg jump force_N moment_Nms contact_stress_MPa drag_Nm
slot report_sections:slot - positively_driven
slot - load_quantities:slot not_driven_share branch_gap_mm branch_gap_at_deg
vibration report_sections:vibration load_quantities:vibration none! period_ratio
  damping_ratio natural_Hz residual_share residual_deg dynamic_factor windup_deg
product - motion_quantities:product travel_mm friction_needed
  speed_m_s,acceleration_m_s2,jerk_m_s3.{max at_deg}
- report_sections:wheels -
- report_sections:cranks -
sizes report_sections:sizes - axes_deg sphere_radius_mm crank_arm_mm slot_mouth_polar_deg
  slot_bottom_polar_deg center_distance_mm crank_radius_mm ratio roller_radius_mm slot_width_mm
  clearances_from slot_mouth_radius_mm slot_bottom_radius_mm wheel_radius_mm rim_radius_mm
  pressure_angle_max_deg rollers_max
parts report_sections:parts - none rim_radius_mm slot_end_radius_mm lock_radius_mm recess_radius_mm
  relief horn_mm wheel_bore_mm crank_bore_mm
parts report_sections:turned - smallest_gap_mm smallest_gap_at_deg dwell_play_deg dwell_play_mm
parts_list report_sections:parts_list_tables -
tolerance report_sections:tolerances load_quantities:tolerances
  dwell_position.{worst_deg! rss_deg! p997_deg!} motion_play.{worst_deg rss_deg p997_deg!}
  entry_jump.{mean! worst} clearances.{slot_needed_mm! lock_needed_mm! turns!}
strength.pin - part_strength:pin
  diameter_mm bending_MPa shear_MPa stress_MPa allowed_MPa margin least_diameter_mm
strength.horn - part_strength:horn
  stress_MPa at_deg inwards_mm thickness_mm allowed_MPa margin
strength.lock - part_strength:lock torque_Nm force_N contact_stress_MPa pressure_MPa
  allowed_MPa margin horn_stress_MPa play_deg approach_deg bending_deg deflection_deg
strength - part_strength:shafts wheel_shaft,crank_shaft.{diameter_mm moment_Nm at_deg stress_MPa
  allowed_MPa margin least_diameter_mm}
strength.arm - part_strength:arm thickness_mm stress_MPa allowed_MPa margin
strength.arm - part_strength:arm_thickness least_thickness_mm
strength - part_strength:keys
  wheel_key,crank_key.{length_mm pressure_MPa shear_MPa allowed_MPa margin least_length_mm}
life - part_strength:wear
  slot_travel_m roller_turns_per_motion equivalent_force_N friction_work_J
life - part_strength:pressure_speed pv_max_W_m2
life - part_strength:bending pin_stress_MPa horn_stress_MPa
life - part_strength:wear roller_life_turns roller_life_motions roller_life_h
strength report_sections:needs -
"""
# The kind of machine; then further quantities, for studies. Whether a design passes is found alone,
# too: until the first check that fails.
_STUDY = f"""
- report_sections:machine - wheel.z wheel.gearing drive.kind drive.rollers drive.before.kind
  motion.law
loads - load_quantities:summaries input_torque_Nm.min_at_deg
  power_W,crank_bearing_N.{{min_at_deg max_at_deg}}
  pin_force_N,contact_stress_MPa,rack_force_N.{{min min_at_deg mean rms}}
  omega_rad_s,alpha_rad_s2,wheel_torque_Nm,sliding_m_s.{{max max_at_deg min min_at_deg mean rms}}
  wheel_bearing_N,pv_W_m2,rack_speed_m_s.{{max max_at_deg min min_at_deg mean rms}}
  rack_acceleration_m_s2,guide_force_N.{{max max_at_deg min min_at_deg mean rms}}
  wheel_near_bearing_N,wheel_far_bearing_N.{{max max_at_deg min min_at_deg mean rms}}
  crank_near_bearing_N,crank_far_bearing_N.{{max max_at_deg min min_at_deg mean rms}}
sizing - load_quantities:sizing inertia_kgm2 acceleration_rad_s2 inertia_torque_Nm
  friction_torque_Nm total_torque_Nm design_torque_Nm input_torque_Nm power_W Am Vm Qm
  energy_fluctuation_J flywheel_kgm2 motor_rpm motor_torque_max_Nm motor_torque_rms_Nm
  inertia_ratio flywheel_to_add_kgm2
checks checks:values_before_turn - {" ".join(BEFORE_TURN)}
checks checks:check_values - {" ".join(OF_TURN)} passes failed
checks checks:passed - passes
checks checks:proved - {" ".join(PROOFS)}
"""

_JOINED = ("\n  ", " ")  # a row may have several lines
_TEXT = _REPORT.replace("INPUTS", _INPUTS).replace(*_JOINED)
REPORT = [*map(_group, _TEXT.strip().splitlines())]
MACHINE, *STUDY = map(_group, _STUDY.replace(*_JOINED).strip().splitlines())
for _kind in reversed(KINDS):
    for _table, _row in _kind.quantities.items():  # behind the table that it names
        _tables = [*map(attrgetter("table"), REPORT)]
        REPORT.insert(len(_tables) - _tables[::-1].index(f"{_table}."), _group(_row, _kind.name))
# All quantities; those that make parts come last.
GROUPS = sorted((MACHINE, *REPORT, *STUDY), key=attrgetter("makes_parts"))
GROUP_OF = dict[str, QuantityGroup]()  # the group of each quantity, by its whole name
for _one in GROUPS:
    GROUP_OF |= dict.fromkeys(_one.names, _one)


def value_of(mechanism: Mechanism, name: str) -> float:
    """A quantity of a single design by its whole name: NaN if it has none, infinite if unbounded.

    Of loads and peaks those are known that the spec limits.

    >>> value_of(Design(External(6)).mechanism, "timing.motion_deg")
    120.0
    """
    value = GROUP_OF[name].columns(single(mechanism))[name]
    return math.nan if value is None else np.ravel(value).item()
