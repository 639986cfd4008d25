"""The checks of a design: each has a value, a limit, and says whether the value keeps it.

A check is a name in a row here, in the order shown, with the function that yields it. The
function gets the names that are asked for, and what it checks. It yields no check that does not
apply. Its module is imported when the first of its checks is asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.kept import load_extra, load_named
from geneva_cli.motion.compatible import concerns
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import KINDS, of_wheel
from geneva_cli.numerics.tolerances import keeps

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.quantities.batch_designs import Values

Checks: TypeAlias = dict[str, str]  # name -> module:function

FIRST = "first_"  # of the first of two wheels in series, and of its crank
# Checks that fail where a roller does not find its slot, or meets the rim next to it, and jams.
JAMS = ("hand_over_play_deg", "hand_over_play_mm", "hand_over_pressure_deg", "hand_over_offset_mm")
# Plays that the spec limits; a machine whose parts cannot be turned has no value of them. Then the
# clearances of all the machines within the tolerances.
PLAYS = ("index_play_max_deg", "dwell_play_max_deg", "dwell_position_max_deg")
TOLERANCES = ("tolerance_slot_mm", "tolerance_lock_mm")
# The checks of the motion, if they apply; of limits that the spec sets; of flat parts at rest, and
# those shown behind what a kind adds; of plates or shells in a whole turn; and of flat parts at
# every angle of the turn, made for a design's own answer. Each row: table, function, names.
_ROWS = """
MOTION motion_checks:motion dwell_deg driver_gear_convexity driven_gear_convexity velocity_min
  groove_pressure_deg pressure_angle_deg driven_fraction undercut_mm
MOTION load_checks:shocks entry_shock_N reversal_shock_N reversal_stress_MPa stopping_torque_Nm
LIMITS motion_checks:limits velocity_max acceleration_max acceleration_entry_max jerk_max
  entry_velocity_max dwell_min_s motion_max_s cycle_max_s pin_force_max_N input_torque_max_Nm
  contact_stress_max_MPa
LIMITS load_checks:strength_limits pv_max_W_m2 roller_life_min_h pin_stress_MPa horn_stress_MPa
  lock_horn_stress_MPa lock_stress_max_MPa lock_deflection_max_deg wheel_shaft_stress_MPa
  crank_shaft_stress_MPa arm_stress_MPa wheel_key_pressure_MPa crank_key_pressure_MPa
LIMITS load_checks:product product_acceleration_max_m_s2 product_slip
STATIC part_checks:walls wall_between_slots_mm horn_mm rollers_apart_mm wheel_bore_wall_mm
  outer_wall_mm dial_wall_mm crank_bore_wall_mm
STATIC part_checks:clearances crank_shaft_mm crank_hub_mm wheel_shaft_mm beside_shafts_mm
  gear_gap_mm arm_wall_mm arm_to_hub_mm link_wall_mm link_gap_mm
STATIC load_checks:first_stresses first_pin_stress_MPa first_horn_stress_MPa
  first_crank_shaft_stress_MPa first_arm_stress_MPa
STATIC part_checks:places branches_apart_mm branches_crossed_mm wheels_apart_mm cranks_apart_mm
PROCESS part_checks:process cut_plate_mm cut_slot_mm
PROCESS part_checks:built parts
TURNING motion_checks:turning dwell_hold gap_mm idle_roller_mm dwell_play_deg dwell_play_mm
  hand_over_play_deg hand_over_play_mm hand_over_pressure_deg hand_over_offset_mm motion_play_deg
  motion_play_mm
TURNING motion_checks:within_tolerances index_play_max_deg dwell_play_max_deg
  dwell_position_max_deg tolerance_slot_mm tolerance_lock_mm
PROOFS motion_checks:proof gap_proved_mm
"""
_TABLES: dict[str, Checks] = {}
for _row in _ROWS.strip().replace("\n  ", " ").splitlines():
    _table, _function, *_names = _row.split()
    _TABLES.setdefault(_table, {}).update(dict.fromkeys(_names, f"verdict.checks.{_function}"))
MOTION, LIMITS, STATIC, PROCESS, TURNING, PROOFS = _TABLES.values()
# All checks of parts at rest, of whatever kind.
STANDING: Checks = {**STATIC}
for _kind in KINDS:
    MOTION |= _kind.motion_checks
    STANDING |= _kind.parts_checks
STANDING |= PROCESS
# Of machines as built, by what touches.
PUSHED = ("turns", "strike_velocity")
# The names of all checks but those of the whole turn; ``parts``: they can be built.
BEFORE_TURN = tuple(dict.fromkeys((*MOTION, *LIMITS, "parts", *STANDING)))
# The names of those of the whole turn; ``full_turn``: the parts can be turned.
OF_TURN = ("full_turn", *TURNING)
# For an adviser: checks without parts, checks that turn them, and checks of no drawn size.
QUICK, TURNED = (*MOTION, *LIMITS), (*OF_TURN, *PUSHED, "parts")
SIZELESS = (*QUICK, *TOLERANCES, *PUSHED)


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
    # makes ``why`` of a failing check, which an adviser's trials do not need
    reason: Callable[[], str] | None = None

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
    value: float,
    must_be: str,
    limit: float,
    at_deg: float | None = None,
    noise: float = 0.0,
    reason: Callable[[], str] | None = None,
) -> Check:
    """The check that a value is "at least", "at most" or "above" a limit, with why it fails.

    ``noise`` is the rounding error of the value, if it is larger than the limit's.

    >>> compared("jerk_max", 31.4, "at most", 30.0).passes
    False
    """
    passes = keeps(value, must_be, limit, noise)
    own = None if passes else reason
    return Check(name, value, must_be, limit, passes, at_deg=at_deg, reason=own)


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


def own_checks(mechanism: Mechanism) -> tuple[Checks, Checks]:
    """The checks of a machine's motion, and of its parts at rest, without those of other kinds."""
    motion, own, added = Checks(MOTION), Checks(), Checks()
    kinds = of_wheel(mechanism.spec.wheel.NAME)
    for kind in KINDS:
        if kind not in kinds:
            for name in kind.motion_checks:
                del motion[name]
        elif kind.parts:
            own |= kind.parts_checks
        elif concerns(kind, mechanism.spec):
            added |= kind.parts_checks
    return motion, own | added if own else {**STATIC, **added, **PROCESS}


def applicable(among: Checks, *of: object, reasons: bool = True) -> Iterator[Check]:
    """The checks of a table that apply to ``of``; of those that fail for one reason, the first.

    Without ``reasons`` all of them, without words that may take longer than the checks.
    """
    said, by_function = set[str](), dict[str, list[str]]()
    for name, path in among.items():
        by_function.setdefault(path, []).append(name)
    for path, names in by_function.items():
        for check in load_named(path)(names, *of):
            if reasons and check.reason:
                check = check._replace(why=check.reason(), reason=None)
            if not reasons or check.passes is not False:
                yield check
            elif check.why not in said:
                yield check
                said |= {check.why} - {""}


def every_check(
    mechanism: Mechanism,
    machine: Parts | None = None,
    parts: bool = True,
    turned: bool = True,
    quick: bool = False,
) -> Iterator[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``.

    Without ``turned`` those of the whole turn are left out, which take the longest. If ``quick``
    they come in the order of their cost, for those who stop at one that fails. If wheel or crank
    cannot be built, or turned, a single check says so instead. A rack can be turned although some
    of its machine's parts are not built.
    """
    spec, limits = mechanism.spec, applicable(LIMITS, mechanism, reasons=not quick)
    motion, standing = own_checks(mechanism)
    yield from applicable(motion, mechanism, reasons=not quick)
    if quick:
        yield from limits
    unbuilt = [unknown("parts", spec.no_parts)] if spec.no_parts else []
    if parts and not spec.is_turned:
        yield from unbuilt
        for name in PLAYS:
            if (limit := spec.limits.as_dict()[name]) is not None:
                why = "not computed, because the parts of this machine are not turned"
                yield unknown(name, why, "at most", limit)
    elif parts:
        from geneva_cli.parts.parts import parts_of

        machine = machine or parts_of(mechanism)
        try:
            rows = unbuilt or [*applicable(standing, machine.built)]
            _ = machine.assembly
        except GenevaError as error:
            rows, turned = [refused("parts", error)], False
        yield from rows
        if turned and mechanism.no_turn:
            yield from pushed_round(mechanism)
        elif turned:
            try:
                turn = machine.turn
            except GenevaError as error:
                yield refused("full_turn", error)
            else:
                yield from applicable(TURNING, machine, turn)
    yield from limits


def checks(
    mechanism: Mechanism, machine: Parts | None = None, parts: bool = True, turned: bool = True
) -> list[Check]:
    """Every check of one design, in the order shown."""
    return [*every_check(mechanism, machine, parts, turned)]


def single_check(mechanism: Mechanism, name: str, machine: Parts | None = None) -> Check | None:
    """The check with this name, without the others; None if there is no such check."""
    rows: Iterable[Check] = ()
    if path := MOTION.get(name) or LIMITS.get(name):
        rows = load_named(path)([name], mechanism)
    elif mechanism.spec.is_turned:
        from geneva_cli.parts.parts import parts_of

        machine = machine or parts_of(mechanism)
        if name in PUSHED and mechanism.no_turn:
            rows = pushed_round(mechanism)
        elif name in OF_TURN:
            turn = machine.turn
            rows = load_named(TURNING[name])([name], machine, turn) if name in TURNING else ()
        else:
            if name == "parts":
                _ = machine.assembly
            path = None if mechanism.spec.no_parts else own_checks(mechanism)[1].get(name)
            rows = load_named(path)([name], machine.built) if path else ()
    return next((check for check in rows if check.name == name), None)


def pushed_round(mechanism: Mechanism) -> list[Check]:
    """Whether parts turn that do not follow the formulas, and how hard they are struck."""
    try:
        rows: list[Check] = load_extra("outline", "as_built")(mechanism)
    except GenevaError:
        return [unknown("full_turn", mechanism.no_turn)]
    return rows


def proofs(parts: Parts, to_mm: float | None = None) -> list[Check]:
    """The proof that no parts collide in a whole turn; none if they cannot be made or turned."""
    if not parts.mechanism.spec.is_turned or parts.mechanism.no_turn:
        return []
    try:
        return list(applicable(PROOFS, parts, to_mm))
    except GenevaError:
        return []  # the checks of the parts report the error


# Quantities of a study: values of checks by their names.


def values_before_turn(parts: Parts) -> Values:
    """The value of each check but those of the turn."""
    rows = checks(parts.mechanism, parts, turned=False)
    return {c.name: c.value for c in rows if c.name in BEFORE_TURN}


def check_values(parts: Parts) -> Values:
    """The value of each check of the turn, and whether all checks pass."""
    rows = checks(parts.mechanism, parts)
    failed = [c.name for c in rows if c.passes is False]
    values: Values = {c.name: c.value for c in rows if c.name in OF_TURN}
    return values | {"passes": not failed, "failed": " ".join(failed) or None}


def passed(parts: Parts) -> Values:
    """Whether no check fails, computed until the first that does."""
    return {"passes": all_pass(every_check(parts.mechanism, parts, quick=True))}


def proved(parts: Parts) -> Values:
    """The gap that is proved."""
    return {c.name: c.value for c in proofs(parts)}
