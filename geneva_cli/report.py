"""One page on a design, for a person: words, timing, peaks, loads, sizes, cautions."""

from __future__ import annotations

import math
from typing import Any

from geneva_cli import loads
from geneva_cli.cautions import cautions
from geneva_cli.errors import GenevaError
from geneva_cli.kinds import is_flat
from geneva_cli.load_cautions import load_cautions
from geneva_cli.mechanism import Mechanism
from geneva_cli.peaks import Peaks, peaks, worst
from geneva_cli.station import LawDriven, Station
from geneva_cli.table import Table, record_table
from geneva_cli.timing import timings
from geneva_cli.units import omega


def report_table(mechanism: Mechanism) -> Table:
    """Everything about one design, as a tree of named values under a paragraph of words."""
    values: dict[str, Any] = {}
    differ = len(mechanism.stations) > 1
    for i, station in enumerate(mechanism.stations):
        where = f"station_{i + 1}." if differ else ""
        values |= _timing(mechanism, i, where)
        values |= _peaks(mechanism, peaks(station), station.mid_deg, where)
    values |= _loads(mechanism)
    values |= _drive(mechanism)
    values |= _sizes(mechanism)
    values |= _parts(mechanism)
    found = [*cautions(mechanism), *load_cautions(mechanism)]
    values |= {f"warnings.{i}": text for i, text in enumerate(found, 1)} or {"warnings": "none"}
    title = mechanism.spec.title
    return record_table(values, f"{title}\n\n{words(mechanism)}" if title else words(mechanism))


def words(mechanism: Mechanism) -> str:
    """The design in words."""
    spec = mechanism.spec
    wheel, drive = spec.wheel, spec.drive
    article = "An" if wheel.gearing[0] in "aeiou" else "A"
    curved = mechanism.stations[0].rail(mechanism.stations[0].entry_deg) is None
    slots = "curved" if curved else "straight offset" if wheel.offset_mm else "straight radial"
    front = f"{'an' if drive.kind[0] in 'aeiou' else 'a'} {drive.kind}"
    count = len(wheel.steps_deg or drive.roller_angles_deg or ()) or drive.rollers
    rollers = "one roller" if count == 1 else f"{count} rollers"
    text = (
        f"{article} {wheel.gearing} wheel of {wheel.z} {slots} slots, driven by {front} with "
        f"{rollers} at {drive.n_rpm:g} rpm."
    )
    if mechanism.law:
        text += f' The wheel follows the law "{mechanism.law.name}"'
        if spec.motion.alpha0_deg:
            text += f", with {spec.motion.alpha0_deg:g} deg of extra dwell"
        text += "; its slots are cut to suit." if curved else "; the groove is cut to suit."
    each = [timings(mechanism)[i] for i in range(len(mechanism.stations))]
    steps = sorted({mechanism.index_deg(i) for i in range(len(mechanism.stations))})
    turn = "turns by " + " or ".join(f"{step:.6g}" for step in steps) + " deg"
    if len(each) == 1:
        text += (
            f" It {turn} in {each[0].motion_s:.4g} s and then rests for {each[0].dwell_s:.4g} s."
        )
    else:
        lasting = sorted({f"{t.motion_s:.4g}" for t in each}, key=float)
        text += f" It {turn} {len(each)} times in a turn of the crank, in {' or '.join(lasting)} s."
    return text


def _timing(mechanism: Mechanism, i: int, where: str) -> dict[str, Any]:
    timing = timings(mechanism)[i]
    values: dict[str, Any] = {f"{where}timing.{k}": v for k, v in timing._asdict().items()}
    # Krasniqi's (15) and (16): t = phi/omega, shortest at the highest speed that the limits on
    # force, torque and stress allow (n itself where none bounds it; none where no speed keeps
    # them), and the work coefficient of one roller, k_r = phi/(2 pi - phi).
    motion = mechanism.stations[i].motion_deg
    fastest = loads.fastest_rpm(mechanism)
    if fastest is not None and math.isinf(fastest):
        fastest = mechanism.spec.drive.n_rpm
    values[f"{where}timing.shortest_motion_s"] = motion / (6.0 * fastest) if fastest else None
    values[f"{where}timing.k_r"] = motion / (360.0 - motion) if motion < 360.0 else None
    return values


def _peaks(mechanism: Mechanism, found: Peaks, mid_deg: float, where: str) -> dict[str, Any]:
    w = omega(mechanism.spec.drive.n_rpm)
    values: dict[str, Any] = {}
    rows = (
        ("velocity", found.velocity, w, "rad_s"),
        ("acceleration", found.acceleration, w**2, "rad_s2"),
        ("jerk", found.jerk, w**3, "rad_s3"),
        ("power", found.power, w**3, "rad2_s3"),
    )
    for name, peak, scale, unit in rows:
        values[f"{where}{name}.max"] = peak.max
        values[f"{where}{name}.at_deg"] = mid_deg + peak.at_deg
        values[f"{where}{name}.max_{unit}"] = peak.max * scale
        if name == "acceleration":
            entry = found.ends.acceleration_entry
            values[f"{where}{name}.entry"] = entry
            values[f"{where}{name}.entry_{unit}"] = entry * scale
        if name == "jerk":
            values[f"{where}{name}.entry"] = found.ends.jerk_entry
    return values


def _loads(mechanism: Mechanism) -> dict[str, Any]:
    load = mechanism.spec.load
    if not (load.inertia_kgm2 or load.torque_Nm):
        return {}
    values: dict[str, Any] = {}
    shown = ["torque_Nm", "pin_force_N", "input_torque_Nm"]
    if mechanism.spec.size.face_width_mm is not None:
        shown.append("contact_stress_MPa")
    for name in shown:
        found = loads.greatest(mechanism, name)
        bounded = math.isfinite(found.max)
        values[f"loads.{name}_max"] = found.max if bounded else "without bound"
        values[f"loads.{name}_at_deg"] = found.at_deg
    if load.inertia_kgm2:
        power = worst(mechanism).power.max
        values["loads.kinetic_power_W"] = loads.kinetic_power_W(mechanism, power)
    return values


def _drive(mechanism: Mechanism) -> dict[str, Any]:
    """Of curved slots: whether they drive the wheel positively under the spec's load."""
    if mechanism.law is None:
        return {}
    from geneva_cli.positive import positive_drive

    drive = positive_drive(mechanism)
    if drive is None:
        return {}
    return {
        "slot.positively_driven": not drive.loose_deg,
        "slot.not_driven_share": drive.share,
        "slot.branch_gap_mm": drive.gap_mm,
        "slot.branch_gap_at_deg": drive.gap_at_deg,
    }


def _sizes(mechanism: Mechanism) -> dict[str, Any]:
    """Sizes in millimetres; the wheel's radius is the one at which no roller fouls its rim."""
    spec = mechanism.spec
    L, r = spec.size.center_distance_mm, spec.roller_radius_mm
    R = mechanism.ratio * L
    station = mechanism.stations[0]
    mouth, bottom = _distance(station, station.entry_deg) * L, _distance(station, 0.0) * L
    if spec.wheel.gearing == "spherical":
        return _sphere_sizes(mechanism, L, r)
    inside = spec.wheel.gearing == "internal"
    values: dict[str, Any] = {
        "sizes.center_distance_mm": L,
        "sizes.crank_radius_mm": R,
        "sizes.ratio": mechanism.ratio,
        "sizes.roller_radius_mm": r,
        "sizes.slot_width_mm": 2.0 * (r + spec.size.slot_clearance_mm),
        "sizes.slot_mouth_radius_mm": mouth,
        "sizes.slot_bottom_radius_mm": bottom,
        "sizes.rim_radius_mm" if inside else "sizes.wheel_radius_mm": math.hypot(mouth, r),
    }
    if isinstance(station, LawDriven):
        values["sizes.pressure_angle_max_deg"] = loads.greatest(mechanism, "pressure_deg").max
    values["sizes.rollers_max"] = mechanism.rollers_max
    return values


def _parts(mechanism: Mechanism) -> dict[str, Any]:
    """Sizes that the parts are cut to, and what a whole turn of them shows."""
    if not is_flat(mechanism.spec):
        return {}
    from geneva_cli.full_turn import full_turn
    from geneva_cli.outline import outlines

    try:
        found = outlines(mechanism)
    except GenevaError as error:
        return {"parts": f"none: {error}"}
    size, turn = found.sizes, full_turn(found)
    values: dict[str, Any] = {
        "parts.rim_radius_mm": size.rim,
        "parts.slot_end_radius_mm": size.slot_end,
        "parts.lock_radius_mm": size.lock or "none",
    }
    if found.crank:
        values |= {
            "parts.recess_radius_mm": size.recess,
            "parts.relief": found.relief,
            "parts.horn_mm": size.horn,
        }
    for name, radius in (("wheel_bore", size.wheel_bore), ("crank_bore", size.crank_bore)):
        values[f"parts.{name}_mm"] = 2.0 * radius or "none"
    gap = turn.smallest
    values["parts.smallest_gap_mm"] = gap.mm if abs(gap.mm) > found.close else 0.0
    values["parts.smallest_gap_at_deg"] = gap.at_deg
    if found.crank:
        values["parts.dwell_play_deg"] = turn.dwell_play_deg
    return values


def _distance(station: Station, input_deg: float) -> float:
    x, y = station.pin(input_deg, 0)
    return math.hypot(x.c[0], y.c[0])


def _sphere_sizes(mechanism: Mechanism, L: float, r: float) -> dict[str, Any]:
    """Sizes of a spherical wheel: the slot is a meridian between two polar angles."""
    station = mechanism.stations[0]
    mouth, bottom = (station.pitch(x, 0)[0].c[0] for x in (station.entry_deg, 0.0))
    return {
        "sizes.axes_deg": mechanism.spec.wheel.axes_deg,
        "sizes.sphere_radius_mm": L,
        "sizes.crank_arm_mm": mechanism.ratio * L,
        "sizes.roller_radius_mm": r,
        "sizes.slot_mouth_polar_deg": math.degrees(mouth),
        "sizes.slot_bottom_polar_deg": math.degrees(bottom),
        "sizes.rollers_max": mechanism.rollers_max,
    }
