"""The keys that move each check, with their directions: what the adviser tries (see ``advice``).

A check has words, the likeliest first. A word is a key, by default of ``[size]``, and what becomes
of its present value:

    key*2     larger values up to the double, or smaller ones below a factor of 1
    key>5     values towards 5; of a count, larger ones up to 5; towards another size by its key
    key<1     smaller counts, down to 1
    key+180   values up to 180 more
    key~      values towards the default, at last the default
    key=a,b   these values, the nearest first; an empty one is the default
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import KINDS
from geneva_cli.spec.load_named import load_named
from geneva_cli.spec.tables import Z_USUAL, Size
from geneva_cli.verdict.checks.all_checks import LIMITS, MOTION, TOLERANCES
from geneva_cli.verdict.checks.check import Check

NEARLY = 0.01  # fraction of a change by which the value advised may exceed the least one
Value: TypeAlias = float | int | str | None  # None: the key is left out

# The centre distance is changed for its own limits only, where the spec gives it. The speed is a
# requirement: it is changed where a limit forbids it, not for a part's size.
LARGER, SLOWER = "center_distance_mm*20", "drive.n_rpm*0.001"
LESS_LOAD = f"{SLOWER} {LARGER}"
MOTION_ANGLE = "motion.alpha0_deg+-180 motion.alpha0_deg+180"
MORE_SLOTS = f"wheel.z>{Z_USUAL}"
MILDER = " ".join(
    (
        "drive.A>0.99 drive.A>-0.99 drive.eccentricity>0.99 drive.eccentricity>0",
        "drive.before.A>0.99 drive.before.A>-0.99",
        "drive.before.eccentricity>0.99 drive.before.eccentricity>0",
        MOTION_ANGLE,
        MORE_SLOTS,
    )
)
WIDER, TIGHTER = "face_width_mm*10", "slot_clearance_mm>0"
BLUNTER = f"lock_edge_mm*10 {WIDER} {LARGER}"
OTHER_LOCK = "lock_radius_mm*0.3 lock_radius_mm*3 lock_radius_mm="
CRANK = "crank_bore_mm*0.2 crank_bore_mm=0"
THICK = " ".join(
    f"{key}*0.3 {key}*3 {key}="
    for key in ("wheel_thickness_mm", "face_width_mm", "lock_thickness_mm", "arm_thickness_mm")
)
SCREWS = "2,2.5,3,4,5,6,8,10,12,16,20"  # threads, mm
# Sizes whose defaults free a machine that jams, and what else may free it.
FREER = (
    "drive.gear_ratio=shockless wheel_radius_mm~ lock_radius_mm~ relief~ relief_clearance_mm~ "
    "slot_bottom_clearance_mm~ wheel_outer_radius_mm~ lock_clearance_mm>0 "
    f"{TIGHTER} roller_radius_mm~ roller_radius_mm*0.4 wheel.offset_mm>0"
)
REMEDIES: dict[str, str] = {
    "velocity_max": MILDER,
    "acceleration_max": MILDER,
    "acceleration_entry_max": MILDER,
    "jerk_max": MILDER,
    "pin_force_max_N": f"{LESS_LOAD} {MILDER}",
    "input_torque_max_Nm": f"{SLOWER} {MILDER}",
    "contact_stress_max_MPa": f"{SLOWER} {WIDER} {LARGER} {MILDER}",
    "product_acceleration_max_m_s2": f"{SLOWER} {MILDER}",
    "product_slip": f"{SLOWER} {MILDER}",
    "stopping_torque_Nm": "drive.n_rpm*30",
    "entry_shock_N": f"tolerance.crank_radius_mm>0 tolerance.center_distance_mm>0 {SLOWER}",
    "reversal_shock_N": f"{TIGHTER} {SLOWER}",
    "reversal_stress_MPa": f"{TIGHTER} {SLOWER} {WIDER} {LARGER}",
    "pv_max_W_m2": f"{SLOWER} {WIDER} {LARGER}",
    "roller_life_min_h": f"material.roller.dynamic_capacity_N*10 {LESS_LOAD}",
    "slot_wear_max_mm_per_million": f"{WIDER} {LESS_LOAD}",
    "pin_stress_MPa": f"pin_mm*1.9 roller_radius_mm*3 pin_held=fixed pin_mm= {TIGHTER} {LARGER}",
    "horn_stress_MPa": f"{WIDER} lock_radius_mm*0.5 {LARGER}",
    "lock_horn_stress_MPa": f"{WIDER} lock_radius_mm*0.5 {LARGER}",
    "lock_stress_max_MPa": BLUNTER,
    "lock_deflection_max_deg": f"lock_clearance_mm*0.1 {WIDER} {LARGER}",
    "wheel_shaft_stress_MPa": "shaft.wheel_diameter_mm*5 shaft.wheel_overhang_mm*0.1 "
    f"wheel_bore_mm*5 wheel_bore_mm= {LARGER}",
    "crank_shaft_stress_MPa": "shaft.crank_diameter_mm*5 shaft.crank_overhang_mm*0.1 "
    f"arm_bore_mm*5 arm_bore_mm= crank_bore_mm= {LARGER}",
    "arm_stress_MPa": "arm_thickness_mm*10 arm_eye_mm*3 arm_hub_mm*3 arm_thickness_mm= " + LARGER,
    # a first wheel is as thick as its crank, which is a link
    "first_pin_stress_MPa": f"roller_radius_mm*3 pin_mm*1.9 {LARGER}",
    "first_horn_stress_MPa": f"link_thickness_mm*10 {LARGER}",
    "first_crank_shaft_stress_MPa": f"link_bore_mm*5 {LARGER}",
    "first_arm_stress_MPa": f"link_thickness_mm*10 {LARGER}",
    "wheel_clamp_Nm": f"wheel_hub_mm*5 wheel_clamp_mm={SCREWS} {LARGER}",
    "crank_clamp_Nm": f"crank_hub_mm*5 crank_clamp_mm={SCREWS} {LARGER}",
    "wheel_key_pressure_MPa": f"wheel_thickness_mm*10 wheel_bore_mm*5 {LARGER}",
    "crank_key_pressure_MPa": f"arm_thickness_mm*10 arm_bore_mm*5 {LARGER}",
    "pressure_angle_deg": f"motion.ratio=matched {MOTION_ANGLE} {MORE_SLOTS}",
    "driven_fraction": f"drive.n_rpm*30 {MOTION_ANGLE}",
    "undercut_mm": f"roller_radius_mm*0.2 {MOTION_ANGLE}",
    "velocity_min": "motion.lambda=0.125,-0.125",
    "dwell_deg": f"drive.rollers<1 {MOTION_ANGLE}",
    "driver_gear_convexity": f"drive.eccentricity>0 drive.A>0 {MORE_SLOTS}",
    "driven_gear_convexity": f"drive.eccentricity>0 drive.A>0 {MORE_SLOTS}",
    "dwell_hold": "lock_radius_mm= wheel.held_by=detent",
    "tolerance_slot_mm": "slot_clearance_mm+1",
    "tolerance_lock_mm": "lock_clearance_mm+1",
    "tolerance_turns": "",
    "wall_between_slots_mm": f"roller_radius_mm*0.2 {TIGHTER}",
    "horn_mm": f"{OTHER_LOCK} roller_radius_mm*0.2 lock_clearance_mm>0 {TIGHTER}",
    "wheels_apart_mm": f"roller_radius_mm*0.2 {LARGER} drive.wheels<1",
    "rollers_apart_mm": "roller_radius_mm*0.2 drive.sector_deg+30",
    "crank_shaft_mm": f"crank_hub_mm>crank_bore_mm {CRANK}",
    "crank_hub_mm": f"crank_hub_mm>crank_bore_mm {CRANK}",
    "crank_bore_wall_mm": CRANK,
    "wheel_shaft_mm": "wheel_hub_mm>wheel_bore_mm wheel_bore_mm*0.2 wheel_bore_mm=0",
    "beside_shafts_mm": " ".join(
        (
            "wheel_hub_mm*0.5 crank_hub_mm*0.5 wheel_bore_mm*0.5 arm_eye_mm*0.5 crank_bore_mm=0",
            *(
                f"{part}_{key}_mm*0.3 {part}_{key}_mm*3 {part}_{key}_mm="
                for part in ("wheel", "crank")
                for key in ("hub", "hub_length", "shaft_low", "shaft_high")
            ),
        )
    ),
    "gear_gap_mm": "drive.gear_distance_mm*0.3 drive.eccentricity*0.3 drive.A*0.3 "
    "drive.before.gear_distance_mm*0.3 drive.before.eccentricity*0.3 drive.before.A*0.3 "
    "wheel_hub_mm=0 arm_bore_mm*0.3",
    "wheel_bore_wall_mm": "wheel_hub_mm*0.2 wheel_bore_mm*0.2 wheel_bore_mm=0 wheel_hub_mm=",
    "arm_wall_mm": "arm_hub_mm*0.3 arm_hub_mm*3 arm_hub_mm= arm_eye_mm*0.3 arm_eye_mm*3 "
    "arm_eye_mm= arm_bore_mm*0.3 lock_bolt_mm*0.2 lock_bolt_circle_mm*0.3 lock_bolt_circle_mm*3 "
    "lock_bolt_circle_mm= lock_bolts<0 crank_keyway= crank_bore=round",
    "arm_to_hub_mm": "arm_eye_mm*0.2",
    "link_wall_mm": "link_bore_mm*0.3 link_bore_mm*3 link_bore_mm= link_pin_mm*0.3 link_pin_mm*3 "
    "link_pin_mm= link_width_mm*0.3 link_width_mm*3 link_width_mm= pin_mm*0.3 pin_mm*3 pin_mm=",
    "link_gap_mm": "link_width_mm*0.3 link_width_mm*3 link_width_mm= link_pin_mm*0.3 link_pin_mm*3 "
    "link_pin_mm= crank_shaft_low_mm= drive.before.input_crank_mm*0.2 wheel_hub_mm*0.5 "
    "wheel_hub_mm=0",
    "dial_wall_mm": "dial_bolt_circle_mm*0.3 dial_bolt_circle_mm*3 dial_bolt_circle_mm= "
    "dial_bolt_mm*0.3 dial_bolt_mm*3 dial_bolt_mm= dial_bolts<0 wheel_bore_mm*0.3 wheel_keyway= "
    "wheel_bore=round",
    "outer_wall_mm": "wheel_outer_radius_mm*0.3 wheel_outer_radius_mm*3 wheel_outer_radius_mm=",
    "cut_plate_mm": THICK,
    "cut_slot_mm": f"roller_radius_mm*0.3 roller_radius_mm*3 roller_radius_mm= {THICK}",
    "branches_apart_mm": f"roller_radius_mm*3 {MOTION_ANGLE}",
    "branches_crossed_mm": f"roller_radius_mm*3 {MOTION_ANGLE}",
}
# Requirements on the machine's size, process and walls, which no advice reduces.
REQUIRED = ("center_distance_mm", "face_width_mm", "process", "wall_min_mm")
_WORD = re.compile(r"(?:([\w.]+)\.)?(\w+)([*><+~=])(.*)")


class Remedy(NamedTuple):
    """Values of one key: a list of them, or all from the present one ``now`` to ``end``."""

    table: str
    key: str
    values: tuple[Value, ...]
    now: float = 0.0
    end: float = 0.0
    even: bool = True  # or in one ratio

    @property
    def way(self) -> tuple[object, ...]:
        """The key and the direction of its change, or its values."""
        return self.table, self.key, self.values or self.end > self.now

    def at(self, fraction: float) -> float | int:
        """The value at a fraction of the way from the present one, with the digits shown."""
        if not self.even:
            return float(f"{self.now * (self.end / self.now) ** fraction:.12g}")
        value = self.now + (self.end - self.now) * fraction
        return round(value) if isinstance(self.now, int) else float(f"{value:.12g}")

    def rounded(self, fraction: float) -> float | int:
        """The value at a fraction, with few digits, and not nearer to the present one."""
        value = self.at(fraction)
        return value if isinstance(value, int) else rounded(value, self.end, self.now)


def rounded(good: float, far: float, bad: float) -> float:
    """``good``, rounded away from ``bad`` to as few digits as keep it near.

    >>> rounded(12.3456, 20.0, 10.0)
    12.35
    """
    for digits in range(3, 12):
        step = 10.0 ** (math.floor(math.log10(abs(good) or 1.0)) + 1 - digits)
        count = math.ceil(good / step) if far > bad else math.floor(good / step)
        shown = float(f"{count * step:.{digits + 1}g}")
        if abs(shown - good) <= NEARLY * abs(good - bad):
            return shown
    return good


def remedies(check: Check, mechanism: Mechanism) -> Iterator[Remedy]:
    """Changes of the spec that may make a failing check pass, the likeliest first."""
    spec, name = mechanism.spec, check.name
    own = {} if {name} & {*MOTION, *LIMITS, *TOLERANCES} else dict(_own_sizes(spec.size))
    known = REMEDIES.get(name)
    if known is None:
        path = next((k.remedies for k in KINDS if k.remedies and name in k.parts_checks), "")
        known = load_named(path)[name] if path else FREER
    # first a size that the reason names, such as "wheel_bore_mm = 30: it must be below 20"
    words = [words for key, words in own.items() if key in check.why] + [known, *own.values()]
    limited = spec.limits.as_dict().get(name) is not None
    for word in " ".join(words).split():
        if word == LARGER and spec.size.center_distance_mm is not None and not limited:
            continue
        yield from _remedies(word, mechanism)


def _own_sizes(size: Size) -> Iterator[tuple[str, str]]:
    """The sizes that the spec sets, each with its words."""
    usual = Size().as_dict()
    for key, value in size.as_dict().items():
        if value == usual[key] or key in REQUIRED:
            continue
        if isinstance(value, bool | str):
            yield key, f"{key}="
        else:
            yield key, f"{key}<0" if isinstance(value, int) else f"{key}*0.1 {key}*10 {key}="


def _remedies(word: str, mechanism: Mechanism) -> Iterator[Remedy]:
    match = _WORD.fullmatch(word)
    assert match, word
    table, key, how, end = match[1] or "size", match[2], match[3], match[4]
    spec = mechanism.spec
    if key not in spec.table(table):
        return
    if how == "=":
        values = tuple(map(_value, end.split(",")))
        if len(values) > 1:  # numbers
            near = value_now(mechanism, table, key)
            own = near if isinstance(near, float) else 0.0
            values = tuple(sorted(values, key=lambda value: abs(float(value or 0.0) - own)))
        yield Remedy(table, key, values)
        return
    if how == "~" and spec.table(table)[key] == Size().as_dict()[key]:
        return
    now = value_now(mechanism, table, key)
    if isinstance(now, float | int) and not isinstance(now, bool):
        last = _end(now, how, end, mechanism, key)
        count = isinstance(now, int)
        up, down = count and how == ">", how == "<"
        if last not in (None, now) and not (up and last < now) and not (down and last > now):
            yield Remedy(table, key, (), now, last, how != "*")
    if how == "~":
        yield Remedy(table, key, (None,))


def _end(now: float, how: str, end: str, mechanism: Mechanism, key: str) -> float | None:
    if how == "~":
        default = mechanism._replace(spec=mechanism.spec.with_(f"size.{key}", None))
        usual = value_now(default, "size", key)
        return usual if isinstance(usual, float) else None
    number = _value(end)
    if isinstance(number, str):
        number = value_now(mechanism, "size", number)
    if not isinstance(number, float | int):
        return None
    return now * number if how == "*" else now + number if how == "+" else number


def _value(text: str) -> Value:
    try:
        return float(text)
    except ValueError:
        return text or None


def value_now(mechanism: Mechanism, table: str, key: str) -> Value:
    """A key's present value; the machine's for a size that the spec leaves out; else None."""
    spec = mechanism.spec
    value: Value = spec.table(table)[key]
    if value is not None or table != "size":
        return value
    from geneva_cli.parts.machine_sizes import built, sized

    flat = sized(mechanism) if key == "arm_bore_mm" else None
    of_machine: Value = 2.0 * flat[1].arm_bore if flat else built(mechanism).as_dict()[key]
    return of_machine
