"""The rows of the registry of quantities: tables, functions and names, in the order shown.

A row has the table of its names, the function for the parts of a single design, that for a batch,
and the names without the table; "-" stands for none. Each end in braces stands behind each prefix
before them: ``a,b.{max min}`` are four names. Of those with an exclamation mark a batch computes
none. A row goes on in lines that begin with two spaces.
"""

from operator import attrgetter

from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, Shaft, WheelMaterial
from geneva_cli.verdict.checks import BEFORE_TURN, OF_TURN, PROOFS

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
# Quantities of a report, in the order shown, but those of kinds.
REPORT_ROWS = """
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
  diameter_mm bending_MPa shear_MPa stress_MPa allowed_MPa margin
strength.pin - part_strength:pin_diameter least_diameter_mm
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
""".replace("INPUTS", _INPUTS)
# The kind of machine; then further quantities, for studies. Whether a design passes is found alone,
# too: until the first check that fails.
STUDY_ROWS = f"""
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
