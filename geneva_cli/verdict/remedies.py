"""What may help where a check fails: the keys to change, and how far.

Only a list of what to try, the likeliest first: whether it helps is for the adviser to find out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.spec.tables import Z_USUAL, Size

if TYPE_CHECKING:
    from geneva_cli.parts.sizes import Sizes

Value: TypeAlias = float | int | str | None  # None: the key is left out
STEPS = 24  # to the far end, where values beyond one that passes may fail again

# Sizes that, put back to their defaults, free a machine that jams.
FREE = (
    "wheel_radius_mm",
    "lock_radius_mm",
    "relief",
    "relief_clearance_mm",
    "slot_bottom_clearance_mm",
    "wheel_outer_radius_mm",
    "lock_clearance_mm",
    "slot_clearance_mm",
    "roller_radius_mm",
)
# How a size is called where all are known, and what of it the key gives.
_SIZES: dict[str, Callable[[Sizes], float]] = {
    "wheel_radius_mm": lambda s: s.rim,
    "lock_radius_mm": lambda s: s.lock,
    "relief_clearance_mm": lambda s: s.relief,
    "slot_bottom_clearance_mm": lambda s: s.slot_bottom,
    "wheel_outer_radius_mm": lambda s: s.outer,
    "roller_radius_mm": lambda s: s.roller,
    "wheel_bore_mm": lambda s: 2.0 * s.wheel_bore,
    "wheel_hub_mm": lambda s: 2.0 * s.wheel_hub,
    "crank_bore_mm": lambda s: 2.0 * s.crank_bore,
    "crank_hub_mm": lambda s: 2.0 * s.crank_hub,
    "pin_mm": lambda s: 2.0 * s.pin,
}


class Way(NamedTuple):
    """A key to change, and the values to try, from the one that it has now: the nearest first.

    Between two numbers of which one passes any other may do as well.
    """

    table: str
    key: str
    values: Callable[[Any], list[Value]]


def ways(check: str, mechanism: Mechanism) -> Iterator[Way]:
    """What may make a check pass, the likeliest first."""
    if check in _WAYS:
        if check in ("crank_shaft_mm", "crank_hub_mm", "wheel_shaft_mm"):
            yield from _hub(mechanism, check.partition("_")[0])
        given = mechanism.spec.motion is not None
        yield from (way for way in _WAYS[check] if given or way not in _LONGER)
    else:
        yield from _back(mechanism)
        yield from (_times("size", "roller_radius_mm", 0.7, 0.4), _to("wheel", "offset_mm", 0.0))


def value_now(mechanism: Mechanism, table: str, key: str) -> Value:
    """A key's value, of a size that is left out the one that it gets; None where it has none."""
    spec = mechanism.spec
    value: Value = spec.table(table).get(key)
    if value is not None or table != "size":
        return value or ("" if key in WORDS else value)
    if key == "roller_radius_mm":
        return mechanism.roller_radius_mm
    if key == "center_distance_mm":
        return mechanism.center_distance_mm
    return _size(mechanism, key)


WORDS = ("ratio", "held_by")  # keys that say something new where they are set at all


def _size(mechanism: Mechanism, key: str) -> float | None:
    if key not in _SIZES:
        return None
    from geneva_cli.parts.assembly import assembly
    from geneva_cli.parts.sizes import sizes

    try:
        return _SIZES[key](sizes(assembly(mechanism)))
    except GenevaError:
        return None


def _hub(mechanism: Mechanism, part: str) -> Iterator[Way]:
    """A hub is no thinner than its bore."""
    bore, hub = (_size(mechanism, f"{part}_{what}_mm") for what in ("bore", "hub"))
    if bore is not None and hub is not None and hub > bore:
        yield _set("size", f"{part}_hub_mm", bore)


def _back(mechanism: Mechanism) -> Iterator[Way]:
    """Given sizes, each towards its default and then left out."""
    given, defaults = mechanism.spec.size.as_dict(), Size().as_dict()
    for key in FREE:
        usual = defaults[key]
        if given[key] == usual:
            continue
        values: list[Value] = [usual]
        if usual is None:
            without = mechanism.spec.with_(f"size.{key}", None)
            default = _size(mechanism._replace(spec=without), key)
            values = [None] if default is None else [default, None]
        yield Way("size", key, lambda now, values=values: values)  # type: ignore[misc]


def _times(table: str, key: str, *shares: float) -> Way:
    return Way(table, key, lambda now: [share * now for share in shares])


def _to(table: str, key: str, *values: Value) -> Way:
    return Way(table, key, lambda now: list(values) if now else [])


def _set(table: str, key: str, word: Value) -> Way:
    return Way(table, key, lambda now: [word])


def _towards(table: str, key: str, end: float) -> Way:
    """In steps, for quantities that may pass and then fail again."""

    def values(now: Any) -> list[Value]:
        if not isinstance(now, float):
            return []
        return [now + (end - now) * i / STEPS for i in range(1, STEPS + 1)]

    return Way(table, key, values)


def _by(table: str, key: str, far: float) -> Way:
    return Way(table, key, lambda now: [now + far * i / STEPS for i in range(1, STEPS + 1)])


def _sine(now: float) -> list[Value]:
    return [math.copysign(0.125, now)] if now else []


_SLOTS = Way("wheel", "z", lambda z: list(range(z + 1, Z_USUAL + 1)))
_FEWER = Way("drive", "rollers", lambda m: list(range(m - 1, 0, -1)))
_LONGER = (_by("motion", "alpha0_deg", -180.0), _by("motion", "alpha0_deg", 180.0))
_DRIVE = (
    _towards("drive", "A", 0.99),
    _towards("drive", "A", -0.99),
    _towards("drive", "eccentricity", 0.99),
    _towards("drive", "eccentricity", 0.0),
)
_MILDER = (*_DRIVE, *_LONGER, _SLOTS)
_SLOWER = _times("drive", "n_rpm", 1e-3)
_LARGER = _times("size", "center_distance_mm", 20.0)
_SMALLER = _times("size", "roller_radius_mm", 0.2)
_CRANK = (
    _times("size", "crank_bore_mm", 0.2),
    _to("size", "crank_bore_mm", 0.0),
)
_WIDER = (_times("size", "roller_radius_mm", 3.0), *_LONGER)
_CONVEX = (
    _towards("drive", "eccentricity", 0.0),
    _towards("drive", "A", 0.0),
    _SLOTS,
)
_WAYS: dict[str, tuple[Way, ...]] = {
    "velocity_max": _MILDER,
    "acceleration_max": _MILDER,
    "acceleration_entry_max": _MILDER,
    "jerk_max": _MILDER,
    "pin_force_max_N": (_SLOWER, _LARGER, *_MILDER),
    "input_torque_max_Nm": (_SLOWER, *_MILDER),
    "contact_stress_max_MPa": (
        _SLOWER,
        _times("size", "face_width_mm", 10.0),
        _LARGER,
        *_MILDER,
    ),
    "pv_max_W_m2": (_SLOWER, _times("size", "face_width_mm", 10.0), _LARGER),
    "roller_life_min_h": (
        _times("material.roller", "dynamic_capacity_N", 10.0),
        _SLOWER,
        _LARGER,
    ),
    "pin_stress_MPa": (
        _times("size", "pin_mm", 1.9, 1.5, 1.2),
        _set("size", "pin_held", "fixed"),
        _times("size", "face_width_mm", 0.1),
        _SLOWER,
        _LARGER,
    ),
    "horn_stress_MPa": (
        _times("size", "face_width_mm", 10.0),
        _times("size", "lock_radius_mm", 0.5),
        _SLOWER,
        _LARGER,
    ),
    "lock_horn_stress_MPa": (
        _times("size", "face_width_mm", 10.0),
        _times("size", "lock_radius_mm", 0.5),
        _LARGER,
    ),
    "lock_stress_max_MPa": (
        _times("size", "lock_edge_mm", 10.0),
        _times("size", "face_width_mm", 10.0),
        _LARGER,
    ),
    "wheel_shaft_stress_MPa": (
        _times("shaft", "wheel_diameter_mm", 5.0),
        _times("shaft", "wheel_overhang_mm", 0.1),
        _SLOWER,
    ),
    "crank_shaft_stress_MPa": (
        _times("shaft", "crank_diameter_mm", 5.0),
        _times("shaft", "crank_overhang_mm", 0.1),
        _SLOWER,
    ),
    "pressure_angle_deg": (_set("motion", "ratio", "matched"), *_LONGER, _SLOTS),
    "undercut_mm": (_SMALLER, *_LONGER),
    "velocity_min": (Way("motion", "lambda", _sine),),
    "dwell_deg": (_FEWER, *_LONGER),
    "driver_gear_convexity": _CONVEX,
    "driven_gear_convexity": _CONVEX,
    "dwell_hold": (
        Way("size", "lock_radius_mm", lambda now: [None] if now == 0.0 else []),
        _set("wheel", "held_by", "detent"),
    ),
    "wall_between_slots_mm": (_SMALLER, _times("size", "slot_clearance_mm", 0.0)),
    "horn_mm": (
        _times("size", "lock_radius_mm", 0.5),
        Way("size", "lock_radius_mm", lambda now: [None]),
        _SMALLER,
        _times("size", "lock_clearance_mm", 0.0),
        _times("size", "slot_clearance_mm", 0.0),
    ),
    "crank_shaft_mm": _CRANK,
    "crank_hub_mm": _CRANK,
    "crank_bore_wall_mm": _CRANK,
    "wheel_shaft_mm": (
        _times("size", "wheel_bore_mm", 0.2),
        _to("size", "wheel_bore_mm", 0.0),
    ),
    "wheel_bore_wall_mm": (
        _times("size", "wheel_bore_mm", 0.2),
        _to("size", "wheel_bore_mm", 0.0),
    ),
    "arm_wall_mm": (
        *(Way("size", key, lambda now: [None]) for key in ("arm_hub_mm", "arm_eye_mm")),
        _times("size", "arm_bore_mm", 0.3),
        _times("size", "lock_bolt_mm", 0.2),
        Way("size", "lock_bolt_circle_mm", lambda now: [None]),
        Way("size", "crank_keyway", lambda now: [None]),
    ),
    "arm_to_hub_mm": (_times("size", "arm_eye_mm", 0.2),),
    "link_wall_mm": tuple(
        Way("size", key, lambda now: [None])
        for key in ("link_bore_mm", "link_pin_mm", "link_width_mm", "pin_mm")
    ),
    "link_gap_mm": (
        *(Way("size", key, lambda now: [None]) for key in ("link_width_mm", "link_pin_mm")),
        _times("size", "wheel_hub_mm", 0.5),
        _set("size", "wheel_hub_mm", 0.0),
    ),
    "dial_wall_mm": (
        Way("size", "dial_bolt_circle_mm", lambda now: [None]),
        _times("size", "dial_bolt_mm", 0.2),
        Way("size", "dial_bolt_mm", lambda now: [None]),
        _times("size", "wheel_bore_mm", 0.3),
        Way("size", "wheel_keyway", lambda now: [None]),
    ),
    "outer_wall_mm": (Way("size", "wheel_outer_radius_mm", lambda now: [None]),),
    "branches_apart_mm": _WIDER,
    "branches_crossed_mm": _WIDER,
}
