"""The adviser: one change of the given spec with which all checks pass, or one for each check.

It changes one value, builds the machine again and makes the checks, so its advice has been tried
with the digits shown. The advice is the nearest value of its key, to ``NEARLY`` of the change.
The work is counted, not timed, so that equal specs get equal advice on every machine. If no work is
left, or no change helps, it says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.latest import counted
from geneva_cli.numerics.roots import Falsi
from geneva_cli.verdict.both_directions import parts_of_ways, worst_checks
from geneva_cli.verdict.checks import checks_at_rest, single_check
from geneva_cli.verdict.checks.all_checks import STANDING, checks_of_turn, turn_checks
from geneva_cli.verdict.checks.check import NONE, STOPPED, Check

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.changes import Change, Value

# Work of all searches of a design: evaluations of a motion at an array of angles, of about 0.3 ms.
WORK = 16_000
# What else a trial takes, in evaluations: its machine and quick checks, its parts, their turn.
# Fitted to the times of searches for 26 designs: 3.4, 4.8 and 7.9 ms.
TRIAL, PARTS, TURN = 10, 15, 25
NEARLY = 0.01  # fraction of a change by which the value advised may exceed the least one

# Keys that change no outline: the parts need not be turned again.
APART = (
    ("drive", "n_rpm"),
    ("size", "face_width_mm"),
    ("size", "wheel_thickness_mm"),
    ("size", "lock_thickness_mm"),
    ("size", "arm_thickness_mm"),
    ("size", "pin_held"),
    ("size", "lock_edge_mm"),
    ("shaft", "wheel_diameter_mm"),
    ("shaft", "wheel_overhang_mm"),
    ("shaft", "crank_diameter_mm"),
    ("shaft", "crank_overhang_mm"),
    ("material.roller", "dynamic_capacity_N"),
)
# checks that a few positions can decide
GAPS = ("gap_mm", "idle_roller_mm")
NEAR = (*GAPS, "hand_over_play_deg", "hand_over_play_mm")


Advice: TypeAlias = "tuple[Change, Value]"


class OutOfWork(Exception):
    """The adviser has no work left: not a fault of the spec, so not a GenevaError."""


def judged(mechanism: Mechanism, machine: Parts | None = None, parts: bool = True) -> list[Check]:
    """Every check of a design; failing ones have one change with which all checks pass.

    Without such a change they say why, and name a change with which they pass themselves.
    """
    rows = worst_checks(mechanism, machine, parts)
    failing = [c for c in rows if c.passes is False]
    if not failing:
        return rows
    # the search needs neither values nor limits, and finds its cache whatever they are
    bare = tuple(c._replace(value=None, limit=None) for c in failing)
    change, why, own_changes = _remedies(mechanism, bare, parts)
    own = iter(own_changes)
    return [_advised(c, change, why, next(own)) if c.passes is False else c for c in rows]


@lru_cache(maxsize=4)  # a folder of files and the report in it need the same advice
def _remedies(
    mechanism: Mechanism, failing: tuple[Check, ...], parts: bool
) -> tuple[str, str, list[str]]:
    """The change with which all checks pass, or an empty text and the reason for its absence.

    Without it, for each failing check a change with which this check passes, or an empty text.
    """
    adviser = Adviser(mechanism, list(failing), parts)
    change, why = adviser.advice(list(failing))
    if change or len(failing) == 1:
        return line(*change) if change else "", why, [""] * len(failing)
    each = [adviser.advice([c])[0] for c in failing]
    own = [line(*one) if one else "" for one in each]
    by_key = {one[0][:2]: one for one in each if one}
    if all(each) and adviser.suffice([*by_key.values()]):
        lines = [line(*one) for one in by_key.values()]
        return " and ".join(sorted(lines, key=lambda one: one.startswith("leaving out"))), "", own
    return "", why, own


def _advised(check: Check, change: str, why: str, own_change: str) -> Check:
    """A failing check with the change that passes all checks, or the reason for its absence.

    The reason names ``own_change``, with which this check passes, if there is one.
    """
    if change:
        # where the same key passes, the other sizes may have changed with it
        value, but, _ = check.why.partition(", but ")
        same_key = but and value.startswith(f"{change.partition(' ')[0]} is ")
        return check._replace(nearest=change, why=value if same_key else check.why)
    reasons = (check.why, why, own_change and f"{own_change} passes this one")
    return check._replace(why="; ".join(text for text in reasons if text))


class Adviser:
    """Search for one change of the spec with which failing checks pass.

    ``failing`` are all failing checks of the design, or without ``parts`` those of its motion and
    limits.
    """

    def __init__(self, mechanism: Mechanism, failing: list[Check], parts: bool = True) -> None:
        self.mechanism = mechanism
        self.failing = failing
        self.parts = parts
        self.work = WORK

    def advice(self, wanted: list[Check]) -> tuple[Advice | None, str]:
        """The change and its value with which some failing checks pass and no other fails.

        Without one, None and the reason.
        """
        try:
            search = _Search(self, wanted)
            for change in self._changes(wanted):
                if sufficient := search.least(change):
                    return sufficient, ""
        except OutOfWork:
            return None, STOPPED
        return None, NONE

    def suffice(self, each: list[Advice]) -> bool:
        """True if all failing checks pass with several changes at once, and no other fails."""
        spec: Spec | None = self.mechanism.spec
        for change, value in each:
            spec = spec and changed(spec, change.table, change.key, value)
        try:
            return spec is not None and _Search(self, self.failing, kept=0.0).holds(spec)
        except OutOfWork:
            return False

    def _changes(self, wanted: list[Check]) -> Iterator[Change]:
        """Changes that may help any of some checks, each change once."""
        from geneva_cli.verdict.changes import value_now
        from geneva_cli.verdict.remedies import remedies

        seen = set()
        for check in wanted:
            for change in remedies(check, self.mechanism):
                now = value_now(self.mechanism, change.table, change.key)
                if now is None:
                    continue
                own = change.table, change.key, *change.values(now)
                if own not in seen:
                    seen.add(own)
                    yield change


class _Search:
    """The search for the least change with which some failing checks pass, and its trials."""

    def __init__(self, adviser: Adviser, wanted: list[Check], kept: float | None = None) -> None:
        self.adviser = adviser
        # of several searches the first may use a half of the work, others a quarter of what is left
        if kept is None:
            kept = 0.0 if len(adviser.failing) == 1 else 0.5 if len(wanted) > 1 else 0.75
        self.reserve = kept * adviser.work
        self.mechanism, self.parts = adviser.mechanism, adviser.parts
        self.wanted = sorted(wanted, key=_needs_parts)  # the quick ones first
        self.turned = any(c.name in checks_of_turn() for c in wanted)
        self.may_fail = {c.name for c in adviser.failing} - {c.name for c in wanted}
        now = list(self._margins(self.mechanism))
        self.units = [max(abs(left), 1e-300) for left in now]
        self.short = min(left / unit for left, unit in zip(now, self.units, strict=True))

    def _spend(self, work: int) -> None:
        self.adviser.work -= work
        if self.adviser.work < self.reserve:
            raise OutOfWork

    @contextmanager
    def _trial(self) -> Iterator[None]:
        """Spend the work of one trial: that of every trial, and its evaluations of motions."""
        self._spend(TRIAL)
        with counted() as work:
            try:
                yield
            finally:
                self.adviser.work -= work.evaluations

    def least(self, change: Change) -> Advice | None:
        """The least sufficient value of one key; None if there is none."""
        from geneva_cli.verdict.changes import value_now

        now = value_now(self.mechanism, change.table, change.key)
        bad, short = now, self.short
        for good in map(_as_written, change.values(now)):
            left = self._glance(change, good)
            if good == now or left < 0.0:
                bad, short = good, left
                continue
            if not (isinstance(now, float) and isinstance(bad, float) and isinstance(good, float)):
                if self._holds(change, good):
                    return change, good
                bad, short = good, left
                continue
            if short < 0.0:
                edge = self._edge(change, now, Falsi(good, left, bad, short))
                bad = rounded(edge, good, now)
                if self._holds(change, bad):
                    return change, bad
            if bad != good and self._holds(change, good):
                return change, self._halved(change, now, good, bad)
            bad, short = good, left
        return None

    def _edge(self, change: Change, now: float, bracket: Falsi) -> float:
        """The nearest value to the present one that passes the failing checks in quick trials."""
        # 20 trials between a value that fails and one that passes
        for _ in range(20):
            if abs(bracket.good - bracket.bad) <= NEARLY * abs(bracket.good - now):
                break
            middle = bracket.middle(NEARLY)
            bracket.add(middle, self._glance(change, middle))
        return bracket.good

    def _halved(self, change: Change, now: float, good: float, bad: float) -> float:
        """The nearest value to the present one with which all checks pass, beyond a failing one."""
        end = good
        while abs(good - bad) > NEARLY * abs(good - now):
            middle = float(_as_written(0.5 * (good + bad)) or 0.0)
            if middle in (good, bad):
                break
            if self._holds(change, middle):
                good = middle
            else:
                bad = middle
        near = rounded(good, end, now)
        return near if near != good and self._holds(change, near) else good

    def _glance(self, change: Change, value: Value) -> float:
        """A margin of the wanted checks, relative to its present violation.

        It is the first that is negative, or else the least. Only quick checks are made. A value
        that makes no machine has -inf.
        """
        spec = changed(self.mechanism.spec, change.table, change.key, value)
        least = math.inf
        with self._trial():
            try:
                machine = build(spec) if spec else None
            except GenevaError:
                machine = None
            if machine is None:
                return -math.inf
            for left, unit in zip(self._margins(machine), self.units, strict=False):
                least = min(least, left / unit)
                if least < 0.0:
                    break
        return least

    def _margins(self, machine: Mechanism) -> Iterator[float]:
        """The margin of each wanted check; parts are built for the first that needs them."""
        each, built = parts_of_ways(machine), False
        for check in self.wanted:
            if _needs_parts(check) and not built:
                self._spend(PARTS * len(each))
                built = True
            yield min(_left(parts, check) for parts in each)

    def _holds(self, change: Change, value: Value) -> bool:
        """Return True if the wanted checks pass with a value, and no other check begins to fail."""
        spec = changed(self.mechanism.spec, change.table, change.key, value)
        turn = self.turned or (change.table, change.key) not in APART
        return spec is not None and self.holds(spec, turn)

    def holds(self, spec: Spec, turn: bool = True) -> bool:
        """True if the wanted checks pass with a spec, and no other check begins to fail."""
        from geneva_cli.parts.turn.machine_parts import WorkLimit

        try:
            with self._trial():
                return all(self._holds_one_way(parts, turn) for parts in parts_of_ways(build(spec)))
        except WorkLimit:
            raise OutOfWork from None  # a trial of some seconds, which is not repeated
        except GenevaError:
            return False

    def _holds_one_way(self, parts: Parts, turn: bool) -> bool:
        # parts that cannot be built, and need not be, hide no check of the motion
        built = self.parts and parts.mechanism.spec.is_turned and "parts" not in self.may_fail
        self._spend(PARTS if built else 0)
        if built and any(check.name == "parts" for check in self.wanted):
            _ = parts.built  # most trials end here, before the checks of the motion
        if not self._pass(checks_at_rest(parts.mechanism, parts if built else None)):
            return False
        if not (built and turn):
            return True
        self._spend(TURN)
        return self._pass(turn_checks(parts, parts.turned.turn))

    def _pass(self, rows: Iterable[Check]) -> bool:
        return all(c.passes is not False or c.name in self.may_fail for c in rows)


def _needs_parts(check: Check) -> bool:
    """True if a quick trial of a check needs the outlines of the parts."""
    near = check.at_deg is not None and check.name in NEAR
    return near or check.name in STANDING


def _left(parts: Parts, check: Check) -> float:
    """The margin of a machine to the limit of a check that fails now, negative outside.

    A check of the turn is made near the input angle where it fails. If only a whole turn can decide
    it, the margin is infinite. Without parts to check, it is -inf.
    """
    try:
        if check.at_deg is not None and check.name in NEAR:
            from geneva_cli.parts.turn.glance import gap_about, play_about
            from geneva_cli.verdict.checks.play_checks import finds_slot

            _ = parts.turned
            if check.name in GAPS:
                return gap_about(parts, check.at_deg) + parts.contact
            output = parts.assembly.full.output
            return output.from_deg(finds_slot(parts) - play_about(parts, check.at_deg))
        if check.name in checks_of_turn():
            return math.inf
        row = single_check(parts.mechanism, check.name, parts)
        return row.spare if row else math.inf
    except GenevaError:
        return -math.inf


def _as_written(value: Value) -> Value:
    """A value with the displayed digits only."""
    return float(f"{value:.12g}") if isinstance(value, float) else value


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


def changed(spec: Spec, table: str, key: str, value: Value) -> Spec | None:
    """The spec with one value changed; None for a value that the reader would refuse."""
    try:
        return spec.with_(f"{table}.{key}", value)
    except GenevaError:
        return None


def line(change: Change, value: Value) -> str:
    """A change as a line of the spec; a key that an earlier table has too stands with its table."""
    from geneva_cli.specfile.keys import tables_with

    first = next(iter(tables_with(change.key)))
    key = change.key if change.table == first else f"{change.table}.{change.key}"
    if value is None:
        return f"leaving out {key}"
    return f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.12g}"
