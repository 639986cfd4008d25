"""The checks of a design: each has a value, a limit, and says whether the value keeps it.

A check is a name in a row here, in the order shown, with the function that yields it and the keys
that move it. The function gets the names that are asked for, and the machine's parts. It yields no
check that does not apply. Its module is imported when the first of its checks is asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.kept import load_named
from geneva_cli.motion.compatible import concerns
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import KINDS, of_wheel
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import Parts, parts_of

Checks: TypeAlias = dict[str, str]  # name -> module:function
Values: TypeAlias = dict[str, "float | str | None"]  # of checks by their names

FIRST = "first_"  # of the first of two wheels in series, and of its crank
# Plays that the spec limits; a machine whose parts cannot be turned has no value of them.
PLAYS = ("index_play_max_deg", "dwell_play_max_deg", "dwell_position_max_deg")
# The checks of the motion, if they apply; of limits that the spec sets; of flat parts at rest, and
# those shown behind what a kind adds; of plates or shells in a whole turn; of machines as built, by
# what touches; and of flat parts at every angle of the turn, made for a design's own answer. Below
# each table and function: names, and the keys that move them, as words of ``verdict.advice``.
_ROWS = """
MOTION verdict.checks.motion_checks:motion
  dwell_deg: drive.rollers:1 LONGER
  driver_gear_convexity driven_gear_convexity: drive.eccentricity:0 drive.A:0 wheel.z:24
  velocity_min: motion.lambda=0.125 motion.lambda=-0.125
  groove_pressure_deg
  pressure_angle_deg: motion.ratio=matched LONGER wheel.z:24
  driven_fraction: FASTER LONGER
  undercut_mm: SMALLER LONGER
MOTION verdict.checks.load_checks:shocks
  entry_shock_N: tolerance.crank_radius_mm:0 tolerance.center_distance_mm:0 SLOWER
  reversal_shock_N: TIGHTER SLOWER
  reversal_stress_MPa: TIGHTER SLOWER WIDER LARGER
  stopping_torque_Nm: FASTER
LIMITS verdict.checks.motion_checks:limits
  velocity_max acceleration_max acceleration_entry_max jerk_max: MILDER
  entry_velocity_max: crank_radius_mm= wheel_radius_mm?
  dwell_min_s: drive.stop_s*10 SLOWER MILDER
  motion_max_s: FASTER MILDER
  cycle_max_s: drive.stop_s*0.1 FASTER
  pin_force_max_N: SLOWER LARGER MILDER
  input_torque_max_Nm: SLOWER MILDER
  contact_stress_max_MPa: SLOWER WIDER LARGER MILDER
LIMITS verdict.checks.load_checks:strength_limits
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
  wheel_key_pressure_MPa: wheel_thickness_mm*10 wheel_bore_mm*5 LARGER
  crank_key_pressure_MPa: arm_thickness_mm*10 arm_bore_mm*5 LARGER
LIMITS verdict.checks.motion_checks:limits
  product_acceleration_max_m_s2 product_slip: SLOWER MILDER
STATIC verdict.checks.part_checks:walls
  wall_between_slots_mm: SMALLER TIGHTER
  horn_mm: lock_radius_mm? SMALLER lock_clearance_mm:0 TIGHTER
  rollers_apart_mm: SMALLER drive.sector_deg:180
  wheel_bore_wall_mm: wheel_hub_mm? wheel_bore_mm*0.2 wheel_bore_mm=0
  outer_wall_mm dial_wall_mm:
  crank_bore_wall_mm: crank_hub_mm? crank_bore_mm*0.2 crank_bore_mm=0
STATIC verdict.checks.part_checks:clearances
  crank_shaft_mm crank_hub_mm: crank_hub_mm? crank_bore_mm*0.2 crank_bore_mm=0
  wheel_shaft_mm: wheel_hub_mm? wheel_bore_mm*0.2 wheel_bore_mm=0
  beside_shafts_mm:
  gear_gap_mm: drives.gear_distance_mm*0.3 drives.eccentricity*0.3 drives.A*0.3 wheel_hub_mm=0
    arm_bore_mm*0.3
  arm_wall_mm arm_to_hub_mm link_wall_mm:
  link_gap_mm: link_width_mm? link_pin_mm? crank_shaft_low_mm= drive.before.input_crank_mm*0.2
    wheel_hub_mm*0.5 wheel_hub_mm=0
STATIC verdict.checks.load_checks:first_stresses
  first_pin_stress_MPa: roller_radius_mm*3 pin_mm*1.9 LARGER
  first_horn_stress_MPa: link_thickness_mm*10 LARGER
  first_crank_shaft_stress_MPa: link_bore_mm*5 LARGER
  first_arm_stress_MPa: link_thickness_mm*10 LARGER
STATIC verdict.checks.part_checks:places
  branches_apart_mm branches_crossed_mm: roller_radius_mm*3 LONGER
  wheels_apart_mm: SMALLER LARGER drive.wheels:1
  cranks_apart_mm
PROCESS verdict.checks.part_checks:process
  cut_plate_mm cut_slot_mm: wheel_thickness_mm? face_width_mm? lock_thickness_mm?
    arm_thickness_mm?
BUILT verdict.checks.part_checks:built
  parts
TURNING verdict.checks.motion_checks:turning
  dwell_hold: lock_radius_mm= wheel.held_by=detent
  gap_mm idle_roller_mm dwell_play_deg dwell_play_mm hand_over_play_deg hand_over_play_mm
    hand_over_pressure_deg hand_over_offset_mm motion_play_deg motion_play_mm
TURNING verdict.checks.motion_checks:within_tolerances
  index_play_max_deg: TIGHTER
  dwell_play_max_deg: lock_clearance_mm:0
  dwell_position_max_deg: lock_clearance_mm:0 tolerance.lock_radius_mm:0
    tolerance.recess_radius_mm:0 tolerance.center_distance_mm:0 tolerance.slot_angle_deg:0
  tolerance_slot_mm: slot_clearance_mm:5
  tolerance_lock_mm: lock_clearance_mm:5
PUSHED verdict.checks.motion_checks:pushed_round
  turns strike_velocity: crank_radius_mm=
PROOFS verdict.checks.motion_checks:proof
  gap_proved_mm:
"""
# The checks of each table, of every kind and of one alone; and the words of those with their own.
_EVERY, _OF_KIND, KEYS = dict[str, Checks](), dict[tuple[str, str], Checks](), dict[str, str]()
for _kind, _rows in (("", _ROWS), *map(attrgetter("name", "checks"), KINDS)):
    for _row in _rows.strip().replace("\n    ", " ").splitlines():
        if _row[0] != " ":
            _table, _function = _row.split()
            continue
        _names, _colon, _words = _row.partition(":")
        _own = dict.fromkeys(_names.split(), _function)
        for _of in (_EVERY.setdefault(_table, {}), _OF_KIND.setdefault((_kind, _table), {})):
            _of |= _own
        KEYS |= dict.fromkeys(_own if _colon else (), _words)
MOTION, LIMITS, STATIC, PROCESS, BUILT, TURNING, PUSHED, PROOFS, *_ = _OF_KIND.values()
# The names of checks without parts, and of all but those of the whole turn.
QUICK = (*_EVERY["MOTION"], *LIMITS)
BEFORE_TURN = tuple(dict.fromkeys((*QUICK, *BUILT, *_EVERY["STATIC"], *PROCESS)))
# The names of those of the whole turn; ``full_turn``: the parts can be turned.
OF_TURN = ("full_turn", *TURNING)
# For an adviser: checks that turn the parts, and checks of no drawn size.
TURNED = (*OF_TURN, *PUSHED, *BUILT)
SIZELESS = (*QUICK, *PUSHED, "tolerance_slot_mm", "tolerance_lock_mm")


class Check(NamedTuple):
    """One check of one design.

    ``passes`` is None if it is not known. ``why`` is the reason for an unknown value, or for
    missing advice on a failing check; of a check that passes it says what is proved. ``at_deg`` is
    the input angle of the value, None if it is not a value at one angle. ``nearest`` is one change
    of the spec with which all checks pass, or one for each failing check: "a = 1 and b = 2".
    ``anew`` are the sizes that the load chooses anew with that change.
    """

    name: str
    value: float | None
    must_be: str
    limit: float | None
    passes: bool | None
    why: str = ""
    at_deg: float | None = None
    nearest: str = ""
    anew: str = ""

    @property
    def remark(self) -> str:
        """The reason, and the sizes that ``nearest`` changes."""
        anew = f"sizes chosen anew with {self.nearest}: {self.anew}" if self.anew else ""
        return "; ".join(filter(None, (self.why, anew)))

    @property
    def spare(self) -> float:
        """The margin to the limit, negative if the check fails; infinite without a value."""
        if self.value is None or self.limit is None:
            return -math.inf if self.passes is False else math.inf
        left = (self.limit - self.value) * (1.0 if self.must_be == "at most" else -1.0)
        return min(left, -5e-324) if self.passes is False else max(left, 0.0)


def compared(
    name: str,
    value: float | None,
    must_be: str,
    limit: float,
    at_deg: float | None = None,
    noise: float = 0.0,
    reason: Callable[[], str] | None = None,
    why: str = "",
) -> Check:
    """The check that a value is "at least", "at most" or "above" a limit, with why it fails.

    ``noise`` is the rounding error of the value, if it is larger than the limit's. ``why`` says why
    a value is not known, ``reason`` makes the words where it fails.

    >>> compared("jerk_max", 31.4, "at most", 30.0).passes
    False
    """
    if value is None:
        return unknown(name, why, must_be, limit)
    passes = keeps(value, must_be, limit, noise)
    own = "" if passes or not reason else reason()
    return Check(name, value, must_be, limit, passes, own, at_deg)


def unknown(
    name: str, why: str, must_be: str = "proved", limit: float | None = None, fails: bool = False
) -> Check:
    """The check of a value that is not known, or, where it ``fails``, cannot be."""
    return Check(name, None, must_be, limit, False if fails else None, why)


def refused(name: str, error: GenevaError) -> Check:
    """A failing check for parts that cannot be built, with the reason."""
    return Check(name, 0.0, "at least", 1.0, False, str(error))


def measured(
    name: str, limit: float, measure: Callable[[], float | None], noise: float = 0.0
) -> Iterator[Check]:
    """The check that a size, if there is one, is at least a limit; it fails for an error."""
    try:
        value = measure()
    except GenevaError as error:
        yield unknown(name, str(error), "at least", limit, True)
    else:
        if value is not None:
            yield compared(name, value, "at least", limit, None, noise)


def all_pass(rows: Iterable[Check]) -> bool:
    """Return True if no check fails; a check without a proof does not fail."""
    return False not in map(attrgetter("passes"), rows)


def own_checks(spec: Spec) -> tuple[Checks, Checks]:
    """The checks of a machine's motion, and of its parts at rest, without those of other kinds."""
    motion, own, added = Checks(MOTION), Checks(), Checks()
    for kind in of_wheel(spec.wheel.NAME):
        motion |= _OF_KIND.get((kind.name, "MOTION"), {})
        if kind.parts or concerns(kind, spec):
            of = own if kind.parts else added
            of |= _OF_KIND.get((kind.name, "STATIC"), {})
    return motion, (own or STATIC) | added | ({} if own else PROCESS) | BUILT


def applicable(among: Checks, machine: Parts) -> Iterator[Check]:
    """The checks of a table that apply; of those that fail for one reason, the first."""
    said = set[str]()
    for path, names in groupby(among, among.__getitem__):
        for check in load_named(path)([*names], machine):
            if check.passes is not False:
                yield check
            elif check.why not in said:
                yield check
                said |= {check.why} - {""}


def every_check(
    machine: Parts, parts: bool = True, turned: bool = True, quick: bool = False
) -> Iterator[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``.

    Without ``turned`` those of the whole turn are left out, which take the longest. If ``quick``
    they come in the order of their cost, for those who stop at one that fails. If wheel or crank
    cannot be built, or turned, a single check says so instead. A rack can be turned although some
    of its machine's parts are not built.
    """
    spec, limits = machine.mechanism.spec, applicable(LIMITS, machine)
    motion, standing = own_checks(spec)
    yield from applicable(motion, machine)
    if quick:
        yield from limits
    unbuilt = [unknown("parts", spec.no_parts)] if parts and spec.no_parts else []
    if parts and not spec.is_turned:
        yield from unbuilt
        for name in PLAYS:
            if (limit := spec.limits.as_dict()[name]) is not None:
                why = "not computed, because the parts of this machine are not turned"
                yield unknown(name, why, "at most", limit)
    elif parts:
        try:
            _ = machine.shape
            rows = unbuilt or [*applicable(standing, machine)]
        except GenevaError as error:
            rows, turned = [refused("parts", error)], False
        yield from rows
        if turned and machine.mechanism.no_turn:
            yield from applicable(PUSHED, machine)
        elif turned:
            try:
                _ = machine.turn
            except GenevaError as error:
                yield refused("full_turn", error)
            else:
                yield from applicable(TURNING, machine)
    yield from limits


def checks(
    mechanism: Mechanism, machine: Parts | None = None, parts: bool = True, turned: bool = True
) -> list[Check]:
    """Every check of one design, in the order shown."""
    return [*every_check(machine or parts_of(mechanism), parts, turned)]


def single_check(machine: Parts, name: str) -> Check | None:
    """The check with this name, without the others; None if there is no such check."""
    spec, (motion, standing) = machine.mechanism.spec, own_checks(machine.mechanism.spec)
    table = motion | LIMITS
    if name not in table and spec.is_turned:
        if name in standing:
            _ = machine.shape
        elif name in OF_TURN:
            _ = machine.turn
        table = TURNING | ({} if spec.no_parts else standing)
        table |= PUSHED if machine.mechanism.no_turn else {}
    rows: Iterable[Check] = load_named(table[name])([name], machine) if name in table else ()
    return next((check for check in rows if check.name == name), None)


# Quantities of a study: values of checks by their names.


def values_before_turn(parts: Parts) -> Values:
    """The value of each check but those of the turn."""
    return {c.name: c.value for c in every_check(parts, turned=False) if c.name in BEFORE_TURN}


def check_values(parts: Parts) -> Values:
    """The value of each check of the turn, and whether all checks pass."""
    rows = [*every_check(parts)]
    failed = [c.name for c in rows if c.passes is False]
    values: Values = {c.name: c.value for c in rows if c.name in OF_TURN}
    return values | {"passes": not failed, "failed": " ".join(failed) or None}


def passed(parts: Parts) -> Values:
    """Whether no check fails, computed until the first that does."""
    return {"passes": all_pass(every_check(parts, quick=True))}


def proved(parts: Parts) -> Values:
    """The gap that is proved."""
    return {c.name: c.value for c in applicable(PROOFS, parts)}
