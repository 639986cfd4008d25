"""One page on a design, for a person: words, timing, peaks, loads, sizes, cautions."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from geneva_cli.analysis.loads import loads
from geneva_cli.analysis.loads.carried import inertia_kgm2
from geneva_cli.analysis.peaks import Peaks, placed, worst
from geneva_cli.analysis.timing import timings
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.parts.proof import Proof
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, WheelMaterial
from geneva_cli.table import Table, record_table, rows_table
from geneva_cli.verdict.advice import judged
from geneva_cli.verdict.cautions import cautions
from geneva_cli.verdict.checks import Check, all_pass
from geneva_cli.verdict.load_cautions import load_cautions
from geneva_cli.verdict.turn_cautions import turn_cautions


class Report(NamedTuple):
    """A page on a design; ``passes`` as ``check`` has it, and what its checks and cautions say."""

    table: Table
    passes: bool
    cautions: tuple[str, ...]


def report(
    mechanism: Mechanism, proof: Proof | None = None, rows: list[Check] | None = None
) -> Report:
    """Everything about one design, as a tree of named values under a paragraph of words.

    The names are the same for every machine; a value is None where it does not apply. ``proof``
    and the checks' ``rows`` are the machine's own, where they have been made already.
    """
    proof = proof or Proof(mechanism)
    rows = judged(mechanism, proof) if rows is None else rows
    told = (*cautions(mechanism), *load_cautions(mechanism), *turn_cautions(proof))
    passes = all_pass(rows)
    title = mechanism.spec.title
    values: dict[str, Any] = {
        "spec": mechanism.spec.path,
        "title": title,
        "passes": passes,
        "checks_failed": tuple(_said(c) for c in rows if c.passes is False),
        "not_proved": tuple(f"{c.name}: {c.nearest}" for c in rows if c.passes is None),
    }
    values |= _inputs(mechanism)
    values |= _stations(mechanism)
    values |= _loads(mechanism)
    values |= _drive(mechanism)
    values |= _sizes(mechanism)
    values |= _parts(proof)
    values["warnings"] = told
    return Report(record_table(values, title, words(mechanism)), passes, told)


def _said(check: Check) -> str:
    """A failing check in a line."""
    where = "" if check.at_deg is None else f" at {check.at_deg:.6g} deg"
    value, limit = (float("nan") if x is None else x for x in (check.value, check.limit))
    text = f"{check.name} = {value:.6g}{where}, must be {check.must_be} {limit:.6g}"
    return f"{text}; nearest change: {check.nearest}"


ECHOED = {  # what the numbers below rest on, besides the machine's own shape
    "drive": ("n_rpm",),
    "size": ("slot_clearance_mm", "lock_clearance_mm", "face_width_mm"),
    "load": tuple(key.key for key in fields(Load)),
    "material.wheel": tuple(key.key for key in fields(WheelMaterial)),
    "material.roller": tuple(key.key for key in fields(RollerMaterial)),
    "limits": tuple(key.key for key in fields(Limits)),
}


def _inputs(mechanism: Mechanism) -> dict[str, Any]:
    """What was asked: speed, clearances, load and limits."""
    spec = mechanism.spec
    values: dict[str, Any] = {"inputs.wheel.held_by": spec.wheel.held_by}
    for table, names in ECHOED.items():
        given = spec.table(table)
        values |= {f"inputs.{table}.{key}": given[key] for key in names}
    return values


def _stations(mechanism: Mechanism) -> dict[str, Any]:
    """Timing and peaks; where engagements differ, what they share and their worst, then each."""
    each = [
        _timing(mechanism, i) | _peaks(mechanism, placed(mechanism, s))
        for i, s in enumerate(mechanism.engagements)
    ]
    if len(each) == 1:
        return each[0] | {"stations": None}
    shared: dict[str, Any] = {}
    for name in each[0]:
        low, high = min(found := [e[name] or 0.0 for e in each]), max(found)
        same = all(e[name] is not None for e in each) and high - low <= 1e-12 * abs(high)
        shared[name] = each[0][name] if same else None
    rows = rows_table(tuple(each[0]), [tuple(e.values()) for e in each])
    return shared | _peaks(mechanism, worst(mechanism)) | {"stations": rows}


def words(mechanism: Mechanism) -> str:
    """The design in words."""
    spec = mechanism.spec
    wheel, drive = spec.wheel, spec.drive
    article = "An" if wheel.NAME[0] in "aeiou" else "A"
    slot = mechanism.engagements[0].slot
    slots = "curved" if slot.curved else "straight offset" if slot.offset else "straight radial"
    count = len(wheel.steps or drive.roller_angles_deg or ()) or drive.rollers
    rollers = "one roller" if count == 1 else f"{count} rollers"
    text = (
        f"{article} {wheel.NAME} wheel of {wheel.z} {slots} slots, driven by {drive.WORDS} with "
        f"{rollers} at {drive.n_rpm:g} rpm."
    )
    if spec.motion:
        text += f' The wheel follows the law "{spec.motion.law.NAME}"'
        if spec.motion.alpha0_deg:
            text += f", with {spec.motion.alpha0_deg:g} deg of extra dwell"
        text += "; its slots are cut to suit." if slot.curved else "; the groove is cut to suit."
    each = [timings(mechanism)[i] for i in range(len(mechanism.engagements))]
    steps = sorted({mechanism.index_deg(i) for i in range(len(mechanism.engagements))})
    turn = "turns by " + " or ".join(f"{step:.6g}" for step in steps) + " deg"
    if len(each) == 1:
        text += (
            f" It {turn} in {each[0].motion_s:.4g} s and then rests for {each[0].dwell_s:.4g} s."
        )
    else:
        lasting = sorted({f"{t.motion_s:.4g}" for t in each}, key=float)
        text += f" It {turn} {len(each)} times in a turn of the crank, in {' or '.join(lasting)} s."
    return text


def _timing(mechanism: Mechanism, i: int) -> dict[str, Any]:
    timing = timings(mechanism)[i]
    values: dict[str, Any] = {f"timing.{k}": v for k, v in timing._asdict().items()}
    # Krasniqi's (15) and (16): t = phi/omega, shortest at the highest speed that the limits on
    # force, torque and stress allow (n itself where none bounds it; none where no speed keeps
    # them), and the work coefficient of one roller, k_r = phi/(2 pi - phi).
    motion = mechanism.engagements[i].motion_deg
    fastest = loads.fastest_rpm(mechanism)
    if fastest is not None and math.isinf(fastest):
        fastest = mechanism.spec.drive.n_rpm
    values["timing.shortest_motion_s"] = motion / (6.0 * fastest) if fastest else None
    values["timing.k_r"] = motion / (360.0 - motion) if motion < 360.0 else None
    return values


def _peaks(mechanism: Mechanism, found: Peaks) -> dict[str, Any]:
    w = omega(mechanism.spec.drive.n_rpm)
    values: dict[str, Any] = {}
    rows = (
        ("velocity", found.velocity, w, "rad_s"),
        ("acceleration", found.acceleration, w**2, "rad_s2"),
        ("jerk", found.jerk, w**3, "rad_s3"),
        ("power", found.power, w**3, "rad2_s3"),
    )
    for name, peak, scale, unit in rows:
        values[f"{name}.max"] = peak.max
        values[f"{name}.at_deg"] = peak.at_deg
        values[f"{name}.max_{unit}"] = peak.max * scale
        if name == "acceleration":
            entry = found.ends.acceleration_entry
            values[f"{name}.entry"] = entry
            values[f"{name}.entry_{unit}"] = entry * scale
        if name == "jerk":
            values[f"{name}.entry"] = found.ends.jerk_entry
    return values


def _loads(mechanism: Mechanism) -> dict[str, Any]:
    """The greatest loads; None without a load, and where nothing bounds them, as a caution says."""
    loaded = mechanism.spec.is_loaded
    values: dict[str, Any] = {}
    for name in ("torque_Nm", "pin_force_N", "input_torque_Nm", "contact_stress_MPa"):
        wide = name != "contact_stress_MPa" or mechanism.spec.size.face_width_mm is not None
        found = loads.greatest(mechanism, name) if loaded and wide else None
        bounded = found is not None and math.isfinite(found.max)
        values[f"loads.{name}.max"] = found.max if found and bounded else None
        values[f"loads.{name}.at_deg"] = found.at_deg if found else None
    power = worst(mechanism).power.max if inertia_kgm2(mechanism.spec) else None
    kinetic = None if power is None else loads.kinetic_power_W(mechanism, power)
    return values | {"loads.kinetic_power_W": kinetic}


def _drive(mechanism: Mechanism) -> dict[str, Any]:
    """Of curved slots: whether they drive the wheel positively under the spec's load."""
    from geneva_cli.analysis.positive_drive import positive_drive

    drive = positive_drive(mechanism) if mechanism.law is not None else None
    return {
        "slot.positively_driven": not drive.loose_deg if drive else None,
        "slot.not_driven_share": drive.share if drive else None,
        "slot.branch_gap_mm": drive.gap_mm if drive else None,
        "slot.branch_gap_at_deg": drive.gap_at_deg if drive else None,
    }


def _sizes(mechanism: Mechanism) -> dict[str, Any]:
    """Sizes in millimetres; the wheel's radius is the one at which no roller fouls its rim."""
    spec = mechanism.spec
    L, r = mechanism.center_distance_mm, mechanism.roller_radius_mm
    R = mechanism.ratio * L
    engagement = mechanism.engagements[0]
    mouth, bottom = _distance(engagement, engagement.entry_deg) * L, _distance(engagement, 0.0) * L
    if not spec.wheel.FLAT:
        return _sphere_sizes(mechanism, L, r)
    inside = spec.wheel.SIGN < 0.0
    rim = math.hypot(mouth, r)
    curved = engagement.slot.curved
    return {
        **dict.fromkeys(_SPHERE),
        "sizes.center_distance_mm": L,
        "sizes.crank_radius_mm": R,
        "sizes.ratio": mechanism.ratio,
        "sizes.roller_radius_mm": r,
        "sizes.slot_width_mm": 2.0 * (r + spec.size.slot_clearance_mm),
        "sizes.slot_mouth_radius_mm": mouth,
        "sizes.slot_bottom_radius_mm": bottom,
        "sizes.wheel_radius_mm": None if inside else rim,
        "sizes.rim_radius_mm": rim if inside else None,
        "sizes.pressure_angle_max_deg": (
            loads.greatest(mechanism, "pressure_deg").max if curved else None
        ),
        "sizes.rollers_max": mechanism.rollers_max,
    }


def _parts(proof: Proof) -> dict[str, Any]:
    """Sizes that the parts are cut to, and what a whole turn of them shows."""
    values: dict[str, Any] = dict.fromkeys(_PARTS)
    if not proof.mechanism.spec.is_flat:
        return values
    try:
        found, turn = proof.found, proof.turn
    except GenevaError as error:
        return values | {"parts.none": str(error)}
    size, gap = found.sizes, turn.smallest
    locked = bool(found.crank)
    return values | {
        "parts.rim_radius_mm": size.rim,
        "parts.slot_end_radius_mm": size.slot_end,
        "parts.lock_radius_mm": size.lock,
        "parts.recess_radius_mm": size.recess if locked else None,
        "parts.relief": found.relief if locked else None,
        "parts.horn_mm": size.horn if locked else None,
        "parts.wheel_bore_mm": 2.0 * size.wheel_bore,
        "parts.crank_bore_mm": 2.0 * size.crank_bore,
        "parts.smallest_gap_mm": gap.mm if abs(gap.mm) > found.contact else 0.0,
        "parts.smallest_gap_at_deg": gap.at_deg,
        "parts.dwell_play_deg": turn.dwell.deg if locked else None,
    }


_PARTS = [
    f"parts.{name}"
    for name in (
        "none",
        "rim_radius_mm",
        "slot_end_radius_mm",
        "lock_radius_mm",
        "recess_radius_mm",
        "relief",
        "horn_mm",
        "wheel_bore_mm",
        "crank_bore_mm",
        "smallest_gap_mm",
        "smallest_gap_at_deg",
        "dwell_play_deg",
    )
]
_SPHERE = [
    f"sizes.{name}"
    for name in (
        "axes_deg",
        "sphere_radius_mm",
        "crank_arm_mm",
        "slot_mouth_polar_deg",
        "slot_bottom_polar_deg",
    )
]
_FLAT = [
    f"sizes.{name}"
    for name in (
        "center_distance_mm",
        "crank_radius_mm",
        "ratio",
        "slot_width_mm",
        "slot_mouth_radius_mm",
        "slot_bottom_radius_mm",
        "wheel_radius_mm",
        "rim_radius_mm",
        "pressure_angle_max_deg",
    )
]


def _distance(engagement: Engagement, input_deg: float) -> float:
    x, y = engagement.path(input_deg, 0)
    return math.hypot(x.c[0], y.c[0])


def _sphere_sizes(mechanism: Mechanism, L: float, r: float) -> dict[str, Any]:
    """Sizes of a spherical wheel: the slot is a meridian between two polar angles."""
    engagement = mechanism.engagements[0]
    mouth, bottom = (engagement.slot(x, 0)[0].c[0] for x in (engagement.entry_deg, 0.0))
    return {
        **dict.fromkeys(_FLAT),
        **{f"sizes.{key}": value for key, value in mechanism.spec.wheel.own_sizes.items()},
        "sizes.sphere_radius_mm": L,
        "sizes.crank_arm_mm": mechanism.ratio * L,
        "sizes.roller_radius_mm": r,
        "sizes.slot_mouth_polar_deg": math.degrees(mouth),
        "sizes.slot_bottom_polar_deg": math.degrees(bottom),
        "sizes.rollers_max": mechanism.rollers_max,
    }
