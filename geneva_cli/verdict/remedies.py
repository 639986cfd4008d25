"""The keys that move each check, with their directions: what the adviser tries (see ``advice``).

A check has words, the likeliest first. A word is a key, by default of ``[size]``, and what becomes
of its present value:

    key*2     larger values up to the double, or smaller ones below a factor of 1
    key>5     values towards 5; of a count, larger ones up to 5; towards another size by its key
    key<1     smaller counts, down to 1
    key+180   values up to 180 more
    key~      values towards the default, at last the default
    key=a,b   these values, the nearest first; an empty one is the default
    key?      smaller values, larger ones, the default
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple, TypeAlias

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import KINDS
from geneva_cli.spec.tables import Size
from geneva_cli.verdict.checks.all_checks import LIMITS, MOTION, PUSHED, TOLERANCES
from geneva_cli.verdict.checks.check import Check

NEARLY = 0.01  # fraction of a change by which the value advised may exceed the least one
Value: TypeAlias = float | int | str | None  # None: the key is left out

# Words in capitals stand for those of their own lines. The centre distance is changed for its own
# limits only, where the spec gives it. The speed is a requirement: it is changed where a limit
# forbids it, and for a part's strength only where no size of it helps.
_TABLE = """
LARGER: center_distance_mm*20
SLOWER: drive.n_rpm*0.001
WIDER: face_width_mm*10
TIGHTER: slot_clearance_mm>0
SMALLER: roller_radius_mm*0.2
SLOTS: wheel.z>24
LONGER: motion.alpha0_deg+-180 motion.alpha0_deg+180
ECCENTRIC: drive.eccentricity>0.99 drive.eccentricity>0
BEFORE: drive.before.A>0.99 drive.before.A>-0.99 drive.before.eccentricity>0.99
MILDER: drive.A>0.99 drive.A>-0.99 ECCENTRIC BEFORE drive.before.eccentricity>0 LONGER SLOTS
BLUNTER: lock_edge_mm*10 WIDER LARGER
CRANK: crank_bore_mm*0.2 crank_bore_mm=0
THICK: wheel_thickness_mm? face_width_mm? lock_thickness_mm? arm_thickness_mm?
velocity_max acceleration_max acceleration_entry_max jerk_max: MILDER
entry_velocity_max: crank_radius_mm= wheel_radius_mm~
turns strike_velocity: crank_radius_mm=
pin_force_max_N: SLOWER LARGER MILDER
input_torque_max_Nm product_acceleration_max_m_s2 product_slip: SLOWER MILDER
contact_stress_max_MPa: SLOWER WIDER LARGER MILDER
stopping_torque_Nm: drive.n_rpm*30
cycle_max_s: drive.stop_s*0.1 drive.n_rpm*30
motion_max_s: drive.n_rpm*30 MILDER
dwell_min_s: drive.stop_s*10 SLOWER MILDER
index_play_max_deg: TIGHTER
dwell_play_max_deg: lock_clearance_mm>0
dwell_position_max_deg: lock_clearance_mm>0 tolerance.lock_radius_mm>0
  tolerance.recess_radius_mm>0 tolerance.center_distance_mm>0 tolerance.slot_angle_deg>0
entry_shock_N: tolerance.crank_radius_mm>0 tolerance.center_distance_mm>0 SLOWER
reversal_shock_N: TIGHTER SLOWER
reversal_stress_MPa: TIGHTER SLOWER WIDER LARGER
pv_max_W_m2: SLOWER WIDER LARGER
roller_life_min_h: material.roller.dynamic_capacity_N*10 SLOWER LARGER
slot_wear_max_mm_per_million: WIDER SLOWER LARGER
pin_stress_MPa: pin_mm*1.9 roller_radius_mm*3 pin_held=fixed pin_mm= TIGHTER LARGER
  SLOWER
horn_stress_MPa lock_horn_stress_MPa: WIDER lock_radius_mm*0.5 LARGER SLOWER
lock_stress_max_MPa: BLUNTER
lock_deflection_max_deg: lock_clearance_mm*0.1 WIDER LARGER
wheel_shaft_stress_MPa: shaft.wheel_diameter_mm*5 shaft.wheel_overhang_mm*0.1 wheel_bore_mm*5
  wheel_bore_mm= LARGER SLOWER
crank_shaft_stress_MPa: shaft.crank_diameter_mm*5 shaft.crank_overhang_mm*0.1 arm_bore_mm*5
  arm_bore_mm= crank_bore_mm= LARGER SLOWER
arm_stress_MPa: arm_thickness_mm*10 arm_eye_mm*3 arm_hub_mm*3 arm_thickness_mm= LARGER SLOWER
first_pin_stress_MPa: roller_radius_mm*3 pin_mm*1.9 LARGER
first_horn_stress_MPa first_arm_stress_MPa: link_thickness_mm*10 LARGER
first_crank_shaft_stress_MPa: link_bore_mm*5 LARGER
wheel_key_pressure_MPa: wheel_thickness_mm*10 wheel_bore_mm*5 LARGER
crank_key_pressure_MPa: arm_thickness_mm*10 arm_bore_mm*5 LARGER
pressure_angle_deg: motion.ratio=matched LONGER SLOTS
driven_fraction: drive.n_rpm*30 LONGER
undercut_mm: SMALLER LONGER
velocity_min: motion.lambda=0.125,-0.125
dwell_deg: drive.rollers<1 LONGER
driver_gear_convexity driven_gear_convexity: drive.eccentricity>0 drive.A>0 SLOTS
dwell_hold: lock_radius_mm= wheel.held_by=detent
tolerance_slot_mm: slot_clearance_mm+1
tolerance_lock_mm: lock_clearance_mm+1
tolerance_turns:
wall_between_slots_mm: SMALLER TIGHTER
horn_mm: lock_radius_mm? SMALLER lock_clearance_mm>0 TIGHTER
wheels_apart_mm: SMALLER LARGER drive.wheels<1
rollers_apart_mm: SMALLER drive.sector_deg+30
crank_shaft_mm crank_hub_mm: crank_hub_mm>crank_bore_mm CRANK
crank_bore_wall_mm: CRANK
wheel_shaft_mm: wheel_hub_mm>wheel_bore_mm wheel_bore_mm*0.2 wheel_bore_mm=0
beside_shafts_mm: wheel_hub_mm*0.5 crank_hub_mm*0.5 wheel_bore_mm*0.5 arm_eye_mm*0.5
  crank_bore_mm=0 wheel_hub_mm? wheel_hub_length_mm? wheel_shaft_low_mm? wheel_shaft_high_mm?
  crank_hub_mm? crank_hub_length_mm? crank_shaft_low_mm? crank_shaft_high_mm?
gear_gap_mm: drive.gear_distance_mm*0.3 drive.eccentricity*0.3 drive.A*0.3
  drive.before.gear_distance_mm*0.3 drive.before.eccentricity*0.3 drive.before.A*0.3
  wheel_hub_mm=0 arm_bore_mm*0.3
wheel_bore_wall_mm: wheel_hub_mm*0.2 wheel_bore_mm*0.2 wheel_bore_mm=0 wheel_hub_mm=
arm_wall_mm: arm_hub_mm? arm_eye_mm? arm_bore_mm*0.3 lock_bolt_mm*0.2 lock_bolt_circle_mm?
  lock_bolts<0 crank_keyway= crank_bore=round
arm_to_hub_mm: arm_eye_mm*0.2
link_wall_mm: link_bore_mm? link_pin_mm? link_width_mm? pin_mm?
link_gap_mm: link_width_mm? link_pin_mm? crank_shaft_low_mm= drive.before.input_crank_mm*0.2
  wheel_hub_mm*0.5 wheel_hub_mm=0
dial_wall_mm: dial_bolt_circle_mm? dial_bolt_mm? dial_bolts<0 wheel_bore_mm*0.3 wheel_keyway=
  wheel_bore=round
outer_wall_mm: wheel_outer_radius_mm?
cut_plate_mm: THICK
cut_slot_mm: roller_radius_mm? THICK
branches_apart_mm branches_crossed_mm: roller_radius_mm*3 LONGER
OTHERS: drive.gear_ratio=shockless wheel_radius_mm~ lock_radius_mm~ relief~
  relief_clearance_mm~ slot_bottom_clearance_mm~ wheel_outer_radius_mm~ lock_clearance_mm>0
  TIGHTER roller_radius_mm~ roller_radius_mm*0.4 wheel.offset_mm>0
"""


@cache
def _table() -> dict[str, str]:
    """The words of each check, with those in capitals spelled out."""
    out: dict[str, str] = {}
    rows = [row.partition(":") for row in _TABLE.strip().replace("\n  ", " ").splitlines()]
    of_kinds = [(name, ":", words) for kind in KINDS for name, words in kind.remedies.items()]
    for names, _, words in (*rows, *of_kinds):
        spelled = " ".join(out.get(word, word) for word in words.split())
        out |= dict.fromkeys(names.split(), spelled)
    return out


# Requirements on the machine's size, process and walls, which no advice reduces.
REQUIRED = ("center_distance_mm", "crank_radius_mm", "face_width_mm", "process", "wall_min_mm")
_WORD = re.compile(r"(?:([\w.]+)\.)?(\w+)([*><+~=?])(.*)")


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

    def rounded(self, fraction: float) -> list[float | int]:
        """The value at a fraction with few digits: a limit beside it, or one farther away."""
        value = self.at(fraction)
        if isinstance(value, int):
            return [value]
        limit, away = limit_beside(value, self.now), rounded(value, self.end, self.now)
        return [away] if limit is None else [limit, away]


def limit_beside(good: float, bad: float) -> float | None:
    """A value of two digits next to ``good``, on the side of ``bad``: a limit is often one.

    >>> limit_beside(31.97, 40.0)
    32.0
    """
    shown = float(f"{good:.2g}")
    beyond = (shown - good) * (bad - good) > 0.0
    return shown if beyond and abs(shown - good) <= NEARLY * abs(good - bad) else None


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
    own = {} if name in (*MOTION, *LIMITS, *TOLERANCES, *PUSHED) else _own_sizes(spec.size)
    # first a size that the reason names, such as "wheel_bore_mm = 30: it must be below 20"
    words = [words for key, words in own.items() if key in check.why]
    words += [_table().get(name, _table()["OTHERS"]), *own.values()]
    limited = spec.limits.as_dict().get(name) is not None
    L, R = spec.size.center_distance_mm, spec.size.crank_radius_mm
    for word in " ".join(words).split():
        if word == _table()["LARGER"] and (L or R):
            if not limited or (L and R):
                continue
            word = word if L else word.replace("center_distance_mm", "crank_radius_mm")
        yield from _remedies(word, mechanism)


def _own_sizes(size: Size) -> dict[str, str]:
    """The words of each size that the spec sets: smaller, larger, or its default."""
    usual = Size().as_dict()
    return {
        key: f"{key}=" if isinstance(value, bool | str) else f"{key}?"
        for key, value in size.as_dict().items()
        if value != usual[key] and key not in REQUIRED
    }


def _remedies(word: str, mechanism: Mechanism) -> Iterator[Remedy]:
    match = _WORD.fullmatch(word)
    assert match, word
    table, key, how, end = match[1] or "size", match[2], match[3], match[4]
    spec = mechanism.spec
    if key not in spec.table(table):
        return
    if how == "?":
        count = isinstance(spec.table(table)[key], int)
        for every in ("<0",) if count else ("*0.1", "*10", "="):
            yield from _remedies(f"{key}{every}", mechanism)
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
    from geneva_cli.parts.machine_sizes import built

    of_machine: Value = built(mechanism).as_dict()[key]
    return of_machine
