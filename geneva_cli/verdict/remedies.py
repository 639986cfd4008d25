"""Remedies for failing checks: the keys to change, and how far.

They are candidates only, the likeliest first; the adviser tries them (see ``advice``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import KINDS
from geneva_cli.parts.shafts.screws import SCREWS
from geneva_cli.spec.load_named import load_named
from geneva_cli.spec.tables import Z_USUAL, Size
from geneva_cli.verdict.changes import (
    SIZE_STEPS,
    Change,
    Value,
    fewer,
    increased,
    left_out,
    replaced,
    scaled,
    set_to,
    size_now,
    sized,
    towards,
)
from geneva_cli.verdict.checks.all_checks import LIMITS, MOTION, TOLERANCES
from geneva_cli.verdict.checks.check import Check


def remedies(check: Check, mechanism: Mechanism) -> Iterator[Change]:
    """Changes of the spec that may make a failing check pass, the likeliest first.

    A centre distance that the spec gives is changed for its limits only, and not for its parts.
    """
    spec = mechanism.spec
    kept = spec.size.center_distance_mm is not None
    if kept and spec.limits.as_dict().get(check.name) is None:
        yield from (change for change in _candidates(check, mechanism) if change is not _LARGER)
    else:
        yield from _candidates(check, mechanism)


def _candidates(check: Check, mechanism: Mechanism) -> Iterator[Change]:
    name = check.name
    is_known = name in MOTION or name in LIMITS or name in TOLERANCES
    own = {} if is_known else _own_sizes(mechanism)
    # a size that the reason names, such as "wheel_bore_mm = 30: it must be below 20"
    yield from (change for key, changes in own.items() if key in check.why for change in changes)
    known = REMEDIES if name in REMEDIES else of_kinds(name)
    if name in known:
        if name in ("crank_shaft_mm", "crank_hub_mm", "wheel_shaft_mm"):
            yield from _hub(mechanism, name.partition("_")[0])
        has_law = mechanism.spec.motion is not None
        yield from (change for change in known[name] if has_law or change not in _MOTION)
    else:
        if mechanism.engagements[0].overtaking > 0.0:
            yield set_to("drive", "gear_ratio", "shockless")
        yield from _defaults(mechanism)
        yield from (
            scaled("size", "lock_clearance_mm", 0.0),
            scaled("size", "slot_clearance_mm", 0.0),
            scaled("size", "roller_radius_mm", 0.4),
            towards("wheel", "offset_mm", 0.0, SIZE_STEPS),
        )
    for changes in own.values():
        yield from changes


def of_kinds(name: str) -> Mapping[str, tuple[Change, ...]]:
    """The remedies of the kind that has a check; none without one."""
    paths = [kind.remedies for kind in KINDS if kind.remedies and name in kind.parts_checks]
    own: Mapping[str, tuple[Change, ...]] = load_named(paths[0]) if paths else {}
    return own


def _hub(mechanism: Mechanism, part: str) -> Iterator[Change]:
    """A hub as thin as its bore, if it is thicker."""
    bore, hub = (size_now(mechanism, f"{part}_{what}_mm") for what in ("bore", "hub"))
    if bore is not None and hub is not None and hub > bore:
        yield towards("size", f"{part}_hub_mm", bore, SIZE_STEPS)


def _own_sizes(mechanism: Mechanism) -> dict[str, tuple[Change, ...]]:
    """Smaller values, larger values and the default of each size that the spec sets, by its key."""
    usual = Size().as_dict()
    # Requirements on the machine's size, process and walls, which no advice reduces.
    required = ("center_distance_mm", "face_width_mm", "process", "wall_min_mm")
    own: dict[str, tuple[Change, ...]] = {}
    for key, value in mechanism.spec.size.as_dict().items():
        if value == usual[key] or key in required:
            continue
        if isinstance(value, int):
            own[key] = (fewer("size", key, 0),)
        elif isinstance(value, float):
            own[key] = sized("size", key)
        else:
            own[key] = (left_out("size", key),)
    return own


def _defaults(mechanism: Mechanism) -> Iterator[Change]:
    """Steps from each size that the spec sets to its default, then the default."""
    present, usual_sizes = mechanism.spec.size.as_dict(), Size().as_dict()
    # Sizes whose defaults free a machine that jams.
    keys = (
        "wheel_radius_mm",
        "lock_radius_mm",
        "relief",
        "relief_clearance_mm",
        "slot_bottom_clearance_mm",
        "wheel_outer_radius_mm",
        "roller_radius_mm",
    )
    for key in keys:
        usual = usual_sizes[key]
        if present[key] == usual:
            continue
        without = mechanism.spec.with_(f"size.{key}", None)
        default = size_now(mechanism._replace(spec=without), key) if usual is None else usual
        if isinstance(default, float):
            yield towards("size", key, default, SIZE_STEPS)
        yield set_to("size", key, usual)


def _wider_screws(now: float | None) -> list[Value]:
    """Return the threads above a screw's, of the next sizes."""
    return [screw.thread for screw in SCREWS if now and screw.thread > now]


def _sine(now: float) -> list[Value]:
    return [math.copysign(0.125, now)] if now else []


_SLOTS = Change("wheel", "z", lambda z: list(range(z + 1, Z_USUAL + 1)))
_MOTION = (increased("motion", "alpha0_deg", -180.0), increased("motion", "alpha0_deg", 180.0))
_MILDER = (
    *(
        towards(table, key, end)
        for table in ("drive", "drive.before")
        for key, end in (("A", 0.99), ("A", -0.99), ("eccentricity", 0.99), ("eccentricity", 0.0))
    ),
    *_MOTION,
    _SLOTS,
)
# The speed is a requirement: it is changed where a limit forbids it, not for a part's size.
_SLOWER = scaled("drive", "n_rpm", 1e-3)
_LARGER = scaled("size", "center_distance_mm", 20.0)
_LESS_LOAD = (_SLOWER, _LARGER)
_TIGHTER = scaled("size", "slot_clearance_mm", 0.0)
_WIDER_FACE = scaled("size", "face_width_mm", 10.0)
BLUNTER = (scaled("size", "lock_edge_mm", 10.0), _WIDER_FACE, _LARGER)
OTHER_LOCK = sized("size", "lock_radius_mm")
SMALLER = scaled("size", "roller_radius_mm", 0.2)
_CRANK = (scaled("size", "crank_bore_mm", 0.2), replaced("size", "crank_bore_mm", 0.0))
_WIDER = (scaled("size", "roller_radius_mm", 3.0), *_MOTION)
_CONVEX = (towards("drive", "eccentricity", 0.0), towards("drive", "A", 0.0), _SLOTS)
REMEDIES: dict[str, tuple[Change, ...]] = {
    "velocity_max": _MILDER,
    "acceleration_max": _MILDER,
    "acceleration_entry_max": _MILDER,
    "jerk_max": _MILDER,
    "pin_force_max_N": (_SLOWER, _LARGER, *_MILDER),
    "input_torque_max_Nm": (_SLOWER, *_MILDER),
    "contact_stress_max_MPa": (_SLOWER, _WIDER_FACE, _LARGER, *_MILDER),
    "product_acceleration_max_m_s2": (_SLOWER, *_MILDER),
    "product_slip": (_SLOWER, *_MILDER),
    "stopping_torque_Nm": (scaled("drive", "n_rpm", 30.0),),
    "entry_shock_N": (
        scaled("tolerance", "crank_radius_mm", 0.0),
        scaled("tolerance", "center_distance_mm", 0.0),
        _SLOWER,
    ),
    "reversal_shock_N": (_TIGHTER, _SLOWER),
    "reversal_stress_MPa": (_TIGHTER, _SLOWER, _WIDER_FACE, _LARGER),
    "pv_max_W_m2": (_SLOWER, _WIDER_FACE, _LARGER),
    "roller_life_min_h": (scaled("material.roller", "dynamic_capacity_N", 10.0), *_LESS_LOAD),
    "slot_wear_max_mm_per_million": (_WIDER_FACE, *_LESS_LOAD),
    "pin_stress_MPa": (
        scaled("size", "pin_mm", 1.9),
        scaled("size", "roller_radius_mm", 3.0),
        set_to("size", "pin_held", "fixed"),
        left_out("size", "pin_mm"),
        _TIGHTER,
        _LARGER,
    ),
    "horn_stress_MPa": (_WIDER_FACE, scaled("size", "lock_radius_mm", 0.5), _LARGER),
    "lock_horn_stress_MPa": (_WIDER_FACE, scaled("size", "lock_radius_mm", 0.5), _LARGER),
    "lock_stress_max_MPa": BLUNTER,
    "lock_deflection_max_deg": (scaled("size", "lock_clearance_mm", 0.1), _WIDER_FACE, _LARGER),
    "wheel_shaft_stress_MPa": (
        scaled("shaft", "wheel_diameter_mm", 5.0),
        scaled("shaft", "wheel_overhang_mm", 0.1),
        scaled("size", "wheel_bore_mm", 5.0),
        left_out("size", "wheel_bore_mm"),
        _LARGER,
    ),
    "crank_shaft_stress_MPa": (
        scaled("shaft", "crank_diameter_mm", 5.0),
        scaled("shaft", "crank_overhang_mm", 0.1),
        scaled("size", "arm_bore_mm", 5.0),
        left_out("size", "arm_bore_mm"),
        left_out("size", "crank_bore_mm"),
        _LARGER,
    ),
    "arm_stress_MPa": (
        scaled("size", "arm_thickness_mm", 10.0),
        scaled("size", "arm_eye_mm", 3.0),
        scaled("size", "arm_hub_mm", 3.0),
        left_out("size", "arm_thickness_mm"),
        _LARGER,
    ),
    # a first wheel is as thick as its crank, which is a link
    "first_pin_stress_MPa": (
        scaled("size", "roller_radius_mm", 3.0),
        scaled("size", "pin_mm", 1.9),
        _LARGER,
    ),
    "first_horn_stress_MPa": (scaled("size", "link_thickness_mm", 10.0), _LARGER),
    "first_crank_shaft_stress_MPa": (scaled("size", "link_bore_mm", 5.0), _LARGER),
    "first_arm_stress_MPa": (scaled("size", "link_thickness_mm", 10.0), _LARGER),
    "wheel_clamp_Nm": (
        scaled("size", "wheel_hub_mm", 5.0),
        Change("size", "wheel_clamp_mm", _wider_screws),
        _LARGER,
    ),
    "crank_clamp_Nm": (
        scaled("size", "crank_hub_mm", 5.0),
        Change("size", "crank_clamp_mm", _wider_screws),
        _LARGER,
    ),
    "wheel_key_pressure_MPa": (
        scaled("size", "wheel_thickness_mm", 10.0),
        scaled("size", "wheel_bore_mm", 5.0),
        _LARGER,
    ),
    "crank_key_pressure_MPa": (
        scaled("size", "arm_thickness_mm", 10.0),
        scaled("size", "arm_bore_mm", 5.0),
        _LARGER,
    ),
    "pressure_angle_deg": (set_to("motion", "ratio", "matched"), *_MOTION, _SLOTS),
    "driven_fraction": (scaled("drive", "n_rpm", 30.0), *_MOTION),
    "undercut_mm": (SMALLER, *_MOTION),
    "velocity_min": (Change("motion", "lambda", _sine),),
    "dwell_deg": (fewer("drive", "rollers", 1), *_MOTION),
    "driver_gear_convexity": _CONVEX,
    "driven_gear_convexity": _CONVEX,
    "dwell_hold": (
        Change("size", "lock_radius_mm", lambda now: [None] if now == 0.0 else []),
        set_to("wheel", "held_by", "detent"),
    ),
    "tolerance_slot_mm": (increased("size", "slot_clearance_mm", 1.0),),
    "tolerance_lock_mm": (increased("size", "lock_clearance_mm", 1.0),),
    "tolerance_turns": (),
    "wall_between_slots_mm": (SMALLER, scaled("size", "slot_clearance_mm", 0.0)),
    "horn_mm": (
        *OTHER_LOCK,
        SMALLER,
        scaled("size", "lock_clearance_mm", 0.0),
        scaled("size", "slot_clearance_mm", 0.0),
    ),
    "wheels_apart_mm": (SMALLER, _LARGER, fewer("drive", "wheels", 1)),
    "rollers_apart_mm": (SMALLER, increased("drive", "sector_deg", 30.0)),
    "crank_shaft_mm": _CRANK,
    "crank_hub_mm": _CRANK,
    "crank_bore_wall_mm": _CRANK,
    "wheel_shaft_mm": (
        scaled("size", "wheel_bore_mm", 0.2),
        replaced("size", "wheel_bore_mm", 0.0),
    ),
    "beside_shafts_mm": (
        scaled("size", "wheel_hub_mm", 0.5),
        scaled("size", "crank_hub_mm", 0.5),
        scaled("size", "wheel_bore_mm", 0.5),
        scaled("size", "arm_eye_mm", 0.5),
        replaced("size", "crank_bore_mm", 0.0),
        *(
            change
            for part in ("wheel", "crank")
            for what in ("hub", "hub_length", "shaft_low", "shaft_high")
            for change in sized("size", f"{part}_{what}_mm")
        ),
    ),
    "gear_gap_mm": (
        *(
            scaled(table, key, 0.3)
            for table in ("drive", "drive.before")
            for key in ("gear_distance_mm", "eccentricity", "A")
        ),
        set_to("size", "wheel_hub_mm", 0.0),
        scaled("size", "arm_bore_mm", 0.3),
    ),
    "wheel_bore_wall_mm": (
        scaled("size", "wheel_hub_mm", 0.2),
        scaled("size", "wheel_bore_mm", 0.2),
        replaced("size", "wheel_bore_mm", 0.0),
        left_out("size", "wheel_hub_mm"),
    ),
    "arm_wall_mm": (
        *(c for key in ("arm_hub_mm", "arm_eye_mm") for c in sized("size", key)),
        scaled("size", "arm_bore_mm", 0.3),
        scaled("size", "lock_bolt_mm", 0.2),
        *sized("size", "lock_bolt_circle_mm"),
        fewer("size", "lock_bolts", 0),
        left_out("size", "crank_keyway"),
        set_to("size", "crank_bore", "round"),
    ),
    "arm_to_hub_mm": (scaled("size", "arm_eye_mm", 0.2),),
    "link_wall_mm": tuple(
        change
        for key in ("link_bore_mm", "link_pin_mm", "link_width_mm", "pin_mm")
        for change in sized("size", key)
    ),
    "link_gap_mm": (
        *(c for key in ("link_width_mm", "link_pin_mm") for c in sized("size", key)),
        left_out("size", "crank_shaft_low_mm"),
        scaled("drive.before", "input_crank_mm", 0.2),
        scaled("size", "wheel_hub_mm", 0.5),
        set_to("size", "wheel_hub_mm", 0.0),
    ),
    "dial_wall_mm": (
        *sized("size", "dial_bolt_circle_mm"),
        *sized("size", "dial_bolt_mm"),
        fewer("size", "dial_bolts", 0),
        scaled("size", "wheel_bore_mm", 0.3),
        left_out("size", "wheel_keyway"),
        set_to("size", "wheel_bore", "round"),
    ),
    "outer_wall_mm": sized("size", "wheel_outer_radius_mm"),
    "cut_plate_mm": tuple(
        change
        for key in ("wheel_thickness_mm", "face_width_mm", "lock_thickness_mm", "arm_thickness_mm")
        for change in sized("size", key)
    ),
    "cut_slot_mm": (
        *sized("size", "roller_radius_mm"),
        *sized("size", "wheel_thickness_mm"),
        *sized("size", "face_width_mm"),
    ),
    "branches_apart_mm": _WIDER,
    "branches_crossed_mm": _WIDER,
}
