"""The adviser: one change of the spec with which all checks pass, or one for each check.

A check has words for the keys that move it. One value is changed, and the machine is built again
and checked: what is advised has been tried with the digits shown. Trials are counted, not timed, so
that equal specs get equal advice on every machine.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import cache
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.registry import KINDS
from geneva_cli.parts.chosen import ByLoad, by_load
from geneva_cli.parts.machine_sizes import built
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.spec.tables import Size
from geneva_cli.specfile.keys import tables_with
from geneva_cli.verdict.checks import QUICK, SIZELESS, TURNED, Check, every_check, single_check

# The reason why a failing check has no advice.
NONE = "no single change that was tried passes all checks"
STOPPED = "no single change passed all checks within the limit of trials"
FINE = 0.005  # fraction of a change to which its least value is searched
NEARLY = 0.01  # fraction of a change by which the value advised may exceed the least one
TRIALS = 80  # machines that are built for all searches of a design
# Fractions of the way to a remedy's end that are tried: the first step, the end, and between them.
PLACES = (1.0 / 12.0, 1.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 6.0)
# Requirements on the machine's size, process and walls, which no advice reduces.
REQUIRED = ("center_distance_mm", "crank_radius_mm", "face_width_mm", "process", "wall_min_mm")
# The words of each check, the likeliest first. A word is a key, by default of [size], and what
# becomes of its present value: key*2 is up to the double, key:5 towards 5, key+180 up to 180 more,
# key=a,b one of these (an empty one leaves out the key), key? towards the default or anywhere.
# Words in capitals stand for their own lines. The centre distance is changed for its own limits
# only, where the spec gives it. Sizes that the spec sets are tried behind the words. The speed is a
# requirement: it is changed where a limit forbids it, and for a part's strength only where no size
# of it helps.
_TABLE = """
LARGER: center_distance_mm*20
SLOWER: drive.n_rpm*0.001
FASTER: drive.n_rpm*30
WIDER: face_width_mm*10
TIGHTER: slot_clearance_mm:0
SMALLER: roller_radius_mm*0.2
LONGER: motion.alpha0_deg+-180 motion.alpha0_deg+180
MILDER: drive.A:0.99 drive.A:-0.99 drive.eccentricity:0.99 drive.eccentricity:0
  drive.before.A:0.99 drive.before.A:-0.99 drive.before.eccentricity:0.99
  drive.before.eccentricity:0 LONGER wheel.z:24
velocity_max acceleration_max acceleration_entry_max jerk_max: MILDER
entry_velocity_max: crank_radius_mm= wheel_radius_mm?
turns strike_velocity: crank_radius_mm=
pin_force_max_N: SLOWER LARGER MILDER
input_torque_max_Nm product_acceleration_max_m_s2 product_slip: SLOWER MILDER
contact_stress_max_MPa: SLOWER WIDER LARGER MILDER
stopping_torque_Nm: FASTER
cycle_max_s: drive.stop_s*0.1 FASTER
motion_max_s: FASTER MILDER
dwell_min_s: drive.stop_s*10 SLOWER MILDER
index_play_max_deg: TIGHTER
dwell_play_max_deg: lock_clearance_mm:0
dwell_position_max_deg: lock_clearance_mm:0 tolerance.lock_radius_mm:0
  tolerance.recess_radius_mm:0 tolerance.center_distance_mm:0 tolerance.slot_angle_deg:0
entry_shock_N: tolerance.crank_radius_mm:0 tolerance.center_distance_mm:0 SLOWER
reversal_shock_N: TIGHTER SLOWER
reversal_stress_MPa: TIGHTER SLOWER WIDER LARGER
pv_max_W_m2: SLOWER WIDER LARGER
roller_life_min_h: material.roller.dynamic_capacity_N*10 SLOWER LARGER
pin_stress_MPa: pin_mm*1.9 roller_radius_mm*3 pin_held=fixed pin_mm= TIGHTER LARGER SLOWER
horn_stress_MPa lock_horn_stress_MPa: WIDER lock_radius_mm*0.5 LARGER SLOWER
lock_stress_max_MPa: lock_edge_mm*10 WIDER LARGER
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
pressure_angle_deg: motion.ratio=matched LONGER wheel.z:24
driven_fraction: FASTER LONGER
undercut_mm: SMALLER LONGER
velocity_min: motion.lambda=0.125,-0.125
dwell_deg: drive.rollers:1 LONGER
driver_gear_convexity driven_gear_convexity: drive.eccentricity:0 drive.A:0 wheel.z:24
dwell_hold: lock_radius_mm= wheel.held_by=detent
tolerance_slot_mm: slot_clearance_mm+1
tolerance_lock_mm: lock_clearance_mm+1
beside_shafts_mm arm_wall_mm arm_to_hub_mm link_wall_mm dial_wall_mm outer_wall_mm:
cut_plate_mm cut_slot_mm: wheel_thickness_mm? face_width_mm? lock_thickness_mm? arm_thickness_mm?
wall_between_slots_mm: SMALLER TIGHTER
horn_mm: lock_radius_mm? SMALLER lock_clearance_mm:0 TIGHTER
wheels_apart_mm: SMALLER LARGER drive.wheels:1
rollers_apart_mm: SMALLER drive.sector_deg+30
crank_shaft_mm crank_hub_mm crank_bore_wall_mm: crank_hub_mm? crank_bore_mm*0.2 crank_bore_mm=0
wheel_shaft_mm wheel_bore_wall_mm: wheel_hub_mm? wheel_bore_mm*0.2 wheel_bore_mm=0
gear_gap_mm: drive.gear_distance_mm*0.3 drive.eccentricity*0.3 drive.A*0.3
  drive.before.gear_distance_mm*0.3 drive.before.eccentricity*0.3 drive.before.A*0.3
  wheel_hub_mm=0 arm_bore_mm*0.3
link_gap_mm: link_width_mm? link_pin_mm? crank_shaft_low_mm= drive.before.input_crank_mm*0.2
  wheel_hub_mm*0.5 wheel_hub_mm=0
branches_apart_mm branches_crossed_mm: roller_radius_mm*3 LONGER
OTHERS: lock_clearance_mm:0 TIGHTER roller_radius_mm*0.4 wheel.offset_mm:0
"""
Value: TypeAlias = float | int | str | None  # None: the key is left out


class Remedy(NamedTuple):
    """Values of one key: a list of them, or all from the present one ``now`` to ``end``."""

    key: str  # with its table
    values: tuple[Value, ...] = ()
    now: float = 0.0
    end: float = 0.0
    even: bool = True  # or in one ratio

    def at(self, fraction: float) -> float | int:
        """The value at a fraction of the way from the present one, with the digits shown."""
        if not self.even:
            return float(f"{self.now * (self.end / self.now) ** fraction:.12g}")
        value = self.now + (self.end - self.now) * fraction
        return round(value) if isinstance(self.now, int) else float(f"{value:.12g}")

    def rounded(self, fraction: float) -> list[float | int]:
        """The value at a fraction with two digits, as limits often have, or a bit farther away."""
        value = self.at(fraction)
        if isinstance(value, int):
            return [value]
        near, short = NEARLY * abs(value - self.now), float(f"{value:.2g}")
        away, farther = value, math.ceil if self.end > self.now else math.floor
        for digits in range(11, 2, -1):
            step = 10.0 ** (math.floor(math.log10(abs(value) or 1.0)) + 1 - digits)
            rough = float(f"{farther(value / step) * step:.{digits + 1}g}")
            away = rough if abs(rough - value) <= near else away
        return [short, away] if abs(short - value) <= near else [away]


Advice: TypeAlias = tuple[Remedy, Value]


@cache
def _words() -> dict[str, str]:
    """The words of each check, with those in capitals spelled out."""
    out: dict[str, str] = {}
    rows = [row.partition(":")[::2] for row in _TABLE.strip().replace("\n  ", " ").splitlines()]
    for names, words in (*rows, *(row for kind in KINDS for row in kind.remedies.items())):
        spelled = " ".join(out.get(word, word) for word in words.split())
        out |= dict.fromkeys(names.split(), spelled)
    return out


def remedies(check: Check, mechanism: Mechanism) -> Iterator[Remedy]:
    """Changes of the spec that may make a failing check pass, the likeliest first."""
    spec, size = mechanism.spec, mechanism.spec.size.as_dict()
    usual = {} if check.name in SIZELESS else Size().as_dict()
    own = [key for key in usual if size[key] != usual[key] and key not in REQUIRED]
    # first a size that the reason names, such as "wheel_bore_mm = 30: it must be below 20"
    words = [f"{key}?" for key in own if key in check.why]
    words += _words().get(check.name, _words()["OTHERS"]).split()
    words += [f"{key}?" for key in own if key not in check.why]
    given = [key for key in REQUIRED[:2] if size[key]]
    for word in words:
        if given and word == _words()["LARGER"]:
            if len(given) > 1 or spec.limits.as_dict().get(check.name) is None:
                continue
            word = word.replace(REQUIRED[0], given[0])
        yield from _of_word(word, mechanism)


def _of_word(word: str, mechanism: Mechanism) -> Iterator[Remedy]:
    match = re.fullmatch(r"(?:([\w.]+)\.)?(\w+)([*:+=?])(.*)", word)
    assert match, word
    table, key, how, end = match[1] or "size", match[2], match[3], match[4]
    whole, keys = f"{table}.{key}", mechanism.spec.table(table)
    if key not in keys:
        return
    if how == "=":
        texts = end.split(",")
        yield Remedy(whole, tuple(float(t) if t[-1:].isdigit() else t or None for t in texts))
        return
    now = _now(mechanism, table, key)
    if isinstance(now, float | int) and not isinstance(now, bool):
        ends = [(float(end or 0.0) + (now if how == "+" else 0.0), True)]
        if how == "*":
            ends = [(now * float(end), False)]
        elif how == "?" and not isinstance(now, int):
            ends = [(0.1 * now, False), (10.0 * now, False)]
            with suppress(GenevaError):
                bare = mechanism.spec.with_(whole, None)
                usual = _now(mechanism._replace(spec=bare), table, key)
                ends = [(usual, True), *ends] if isinstance(usual, float) else ends
        yield from (Remedy(whole, (), now, last, even) for last, even in ends if last != now)
    if how == "?" and keys[key] is not None:
        yield Remedy(whole, (None,))


def _now(mechanism: Mechanism, table: str, key: str) -> Value:
    """A key's present value; the machine's for a size that the spec leaves out."""
    value: Value = mechanism.spec.table(table)[key]
    return built(mechanism).as_dict()[key] if value is None and table == "size" else value


def advised(mechanism: Mechanism, rows: list[Check]) -> list[Check]:
    """The checks, those that fail with one change of the spec with which all checks pass."""
    failing = [c for c in rows if c.passes is False]
    if not failing:
        return rows
    adviser, count = Adviser(mechanism, failing), len(failing)
    one, why = adviser.advice(failing, TRIALS if count == 1 else TRIALS // 2)
    each, own = [one] if one else [], [""] * count
    if not one and count > 1:
        # one trial is for all changes together
        some = [
            adviser.advice([c], (adviser.left - 1) // (count - i))[0] for i, c in enumerate(failing)
        ]
        by_key = {one[0].key: one for one in some if one}
        adviser.aim(failing, 0)
        if all(some) and adviser.margin([*by_key.values()], True) >= 0.0:
            each = sorted(by_key.values(), key=lambda advice: advice[1] is None)
        own = [f"{line(*one)} passes this one" if one else "" for one in some]
    anew, change = "", " and ".join(line(*one) for one in each)
    if each and mechanism.spec.is_loaded:
        changed = build(adviser.changed(each), mechanism)
        anew = ByLoad(by_load(changed), by_load(mechanism)).changes
    out, advice = [], iter(own)
    for c in rows:
        if c.passes is False and each:
            # where the same key passes, the other sizes may have changed with it
            value, but, _ = c.why.partition(", but ")
            same = but and value.startswith(f"{change.partition(' ')[0]} is ")
            c = c._replace(nearest=change, why=value if same else c.why, anew=anew)
        elif c.passes is False:
            c = c._replace(why="; ".join(filter(None, (c.why, why, next(advice)))))
        out.append(c)
    return out


def line(remedy: Remedy, value: Value) -> str:
    """A change as a line of the spec; a key that an earlier table has too stands with its table."""
    table, _, key = remedy.key.rpartition(".")
    if table != next(iter(tables_with(key))):
        key = remedy.key
    if value is None:
        return f"leaving out {key}"
    return f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.12g}"


class Adviser:
    """Search for changes with which the ``failing`` checks pass."""

    def __init__(self, mechanism: Mechanism, failing: list[Check]) -> None:
        self.mechanism, self.failing, self.left = mechanism, failing, TRIALS
        self._last: tuple[Mechanism, Parts] | None = None

    def changed(self, changes: Sequence[Advice]) -> Spec:
        """The spec with some changes."""
        spec = self.mechanism.spec
        for remedy, value in changes:
            spec = spec.with_(remedy.key, value)
        return spec

    def aim(self, wanted: list[Check], stop: int) -> None:
        """Search for these checks, the quick ones first, until so many trials are left."""
        by_cost = sorted(wanted, key=lambda c: (c.name in TURNED, c.name not in QUICK))
        self.units = {c.name: -c.spare if c.spare > -math.inf else 1.0 for c in by_cost}
        self.turns, self.stop = by_cost[-1].name in TURNED, stop

    def advice(self, wanted: list[Check], trials: int) -> tuple[Advice | None, str]:
        """The change with which some failing checks pass and no other fails; else the reason."""
        self.aim(wanted, self.left - trials)
        tried = set()
        for remedy in (one for check in wanted for one in remedies(check, self.mechanism)):
            way = remedy[:2] if remedy.values else (remedy.key, remedy.end > remedy.now)
            found = None if way in tried else self._least(remedy)
            if self.left < self.stop:
                return None, STOPPED
            if found:
                return found, ""
            tried.add(way)
        return None, NONE

    def _least(self, remedy: Remedy) -> Advice | None:
        """The least sufficient value of one key, with its remedy; None if there is none."""
        for value in remedy.values:
            if self.margin([(remedy, value)], True) >= 0.0:
                return remedy, value
        at, short = 0.0, -1.0
        # parts that are turned anyway cost as much as all checks, which are last otherwise
        for every in () if remedy.values else (True,) if self.turns else (False, True):
            at = self._edge(remedy, every, at, short)
            if at < 0.0:
                return None
            for value in remedy.rounded(at):
                if self.margin([(remedy, value)], True) >= 0.0:
                    return remedy, value
            short = -math.inf
        return None if remedy.values else (remedy, remedy.at(at))

    def _edge(self, remedy: Remedy, every: bool, start: float, short: float) -> float:
        """The fraction nearest to a failing ``start`` with a margin of at least 0; -1 without.

        The margin may be largest between ``start`` and 1. ``short`` is that at the start.
        """
        known, good = {start: short}, start
        for part in PLACES:
            good = start + (1.0 - start) * part
            known[good] = self.margin([(remedy, remedy.at(good))], every)
            if known[good] >= 0.0:
                break
            # no peak is expected before an end that is no better, nor between places that are not
            if part != PLACES[0] and -math.inf < max(known.values()) <= short:
                return -1.0
        else:
            return -1.0
        bad = max(x for x in known if x < good)
        while good - bad > FINE * good:
            middle = 0.5 * (good + bad)
            holds = self.margin([(remedy, remedy.at(middle))], every) >= 0.0
            good, bad = (middle, bad) if holds else (good, middle)
        return good

    def margin(self, changes: Sequence[Advice], every: bool) -> float:
        """The least margin of the wanted checks, relative to its present violation.

        With ``every`` it is -1 if another check begins to fail; -inf for a spec that makes no
        machine, or whose turn takes too long, and without trials left.
        """
        least = math.inf
        try:
            spec = self.changed(changes)
            if self._last is None or self._last[0].spec != spec:
                self.left = max(self.left, self.stop) - 1
                if self.left < self.stop:
                    return -math.inf
                machine = build(spec, self.mechanism)
                self._last = machine, parts_of(machine)
            machine, parts = self._last
            for name, unit in self.units.items():
                check = single_check(machine, name, parts)
                least = min(least, check.spare / unit if check else math.inf)
                if least < 0.0:
                    return least
            failed = {c.name for c in self.failing} - self.units.keys()
            for check in every_check(machine, parts, quick=True) if every else ():
                if check.passes is False and check.name not in failed:
                    return -1.0
        except GenevaError:
            return -math.inf
        return least
