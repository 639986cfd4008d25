"""The adviser: one change of the given spec with which all checks pass, or one for each check.

It changes one value, builds the machine again and makes the checks, so its advice has been tried
with the digits shown. The advice is the nearest value of its key, to ``NEARLY`` of the change.
Trials are counted, not timed, so that equal specs get equal advice on every machine. If none is
left, or no change helps, it says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.both_ways import every_way
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.verdict.both_directions import worst_checks
from geneva_cli.verdict.checks import single_check
from geneva_cli.verdict.checks.all_checks import (
    LIMITS,
    MOTION,
    TURNING,
    check_named,
    standing,
    untold,
)
from geneva_cli.verdict.checks.check import NONE, STOPPED, Check

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.parts.turn.full_turn import FullTurn
    from geneva_cli.verdict.remedies import Remedy, Value

FINE = 0.005  # fraction of a change to which its least value is searched
OTHER = -0.99  # margin where a check fails that passed before
TRIALS = 80  # machines that are built for all searches of a design
# Fractions of the way to a remedy's end that are tried: the first step, the end, and between them.
PLACES = (1.0 / 12.0, 1.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 6.0)
QUICK = {*MOTION, *LIMITS}  # which need no parts
# Keys that change no outline: the parts need not be turned again.
APART = (
    *("drive.n_rpm", "size.face_width_mm", "size.pin_held", "size.lock_edge_mm"),
    *("size.wheel_thickness_mm", "size.lock_thickness_mm", "size.arm_thickness_mm"),
    *("shaft.wheel_diameter_mm", "shaft.wheel_overhang_mm"),
    *("shaft.crank_diameter_mm", "shaft.crank_overhang_mm"),
    "material.roller.dynamic_capacity_N",
)
Advice: TypeAlias = "tuple[Remedy, Value]"
Margin: TypeAlias = Callable[[float], float]  # at a fraction of the way to a remedy's end


class OutOfTrials(Exception):
    """The adviser has no trials left: not a fault of the spec, so not a GenevaError."""


def judged(mechanism: Mechanism, machine: Parts | None = None, parts: bool = True) -> list[Check]:
    """Every check of a design; failing ones have one change with which all checks pass.

    Without such a change they say why, and name a change with which they pass themselves.
    """
    rows = worst_checks(mechanism, machine, parts)
    failing = tuple(c for c in rows if c.passes is False)
    if not failing:
        return rows
    change, why, own_changes = _advice(mechanism, failing, parts)
    own = iter(own_changes)
    return [_advised(c, change, why, next(own)) if c.passes is False else c for c in rows]


@lru_cache(maxsize=4)  # a folder of files and the report in it need the same advice
def _advice(
    mechanism: Mechanism, failing: tuple[Check, ...], parts: bool
) -> tuple[str, str, list[str]]:
    """The change with which all checks pass, or an empty text and the reason for its absence.

    Without it, for each failing check a change with which this check passes, or an empty text.
    """
    adviser = Adviser(mechanism, failing, parts)
    one, why = adviser.advice(failing, TRIALS if len(failing) == 1 else TRIALS // 2)
    if one or len(failing) == 1:
        return line(*one) if one else "", why, [""] * len(failing)
    # one trial is for all changes together
    rest = range(len(failing), 0, -1)
    each = [
        adviser.advice((c,), (adviser.left - 1) // n)[0] for c, n in zip(failing, rest, strict=True)
    ]
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


class Trial:
    """A machine with a changed spec, and its parts in every direction in which it must serve."""

    def __init__(self, spec: Spec, like: Mechanism) -> None:
        self.machine = build(spec, like)

    @cached_property
    def ways(self) -> list[Parts]:
        """The parts of each direction; an error in them does not name the roller that fits."""
        from geneva_cli.parts.parts import parts_of

        return [parts_of(way, advice=False) for way in every_way(self.machine)]

    @cached_property
    def glances(self) -> list[FullTurn]:
        """The turns at few positions: what fails there fails in the whole turn."""
        from geneva_cli.parts.turn.full_turn import full_turn

        return [full_turn(parts.turned, False) for parts in self.ways]

    def spare(self, name: str) -> float:
        """The least margin of a check, negative where it fails; of a turn at few positions."""
        if name in TURNING:
            turns = zip(self.ways, self.glances, strict=True)
            rows = [check_named(TURNING, name, parts, turn) for parts, turn in turns]
        elif name == "full_turn":
            rows = [None for _ in self.glances]
        else:
            if name == "parts":
                _ = [parts.turned for parts in self.ways]
            rows = [single_check(parts.mechanism, name, parts) for parts in self.ways]
        return min((row.spare for row in rows if row), default=math.inf)

    def rows(self, parts: bool, turn: bool) -> Iterator[Check]:
        """All checks in all directions, the quick ones first."""
        for way in self.ways:
            spec = way.mechanism.spec
            for among in (MOTION, LIMITS):
                yield from untold(among, way.mechanism)
            if parts and spec.is_turned and spec.has_parts:
                yield from untold(standing(way.mechanism), way.built)
            if parts and spec.is_turned and turn:
                yield from untold(TURNING, way, way.turned.turn)


class Adviser:
    """Search for one change of the spec with which failing checks pass.

    ``failing`` are all failing checks of the design, or without ``parts`` those of its motion and
    limits.
    """

    def __init__(
        self, mechanism: Mechanism, failing: tuple[Check, ...], parts: bool = True
    ) -> None:
        self.mechanism, self.failing, self.parts = mechanism, failing, parts
        self.left = TRIALS
        self._last: Trial | None = None

    def advice(self, wanted: tuple[Check, ...], trials: int) -> tuple[Advice | None, str]:
        """The change and its value with which some failing checks pass and no other fails.

        Without one, None and the reason.
        """
        from geneva_cli.verdict.remedies import remedies

        self.stop = self.left - trials
        by_cost = sorted(wanted, key=lambda c: (c.name in TURNING, c.name not in QUICK))
        self.units = {c.name: -c.spare if c.spare > -math.inf else 1.0 for c in by_cost}
        self.may_fail = {c.name for c in self.failing} - set(self.units)
        tried = set()
        try:
            for check in wanted:
                for remedy in remedies(check, self.mechanism):
                    if remedy.way not in tried and (advice := self.least(remedy)):
                        return advice, ""
                    tried.add(remedy.way)
        except OutOfTrials:
            return None, STOPPED
        return None, NONE

    def suffice(self, each: list[Advice]) -> bool:
        """True if all failing checks pass with several changes at once, and no other fails."""
        spec: Spec | None = self.mechanism.spec
        for (table, key, *_), value in each:
            spec = spec and changed(spec, table, key, value)
        self.stop, self.may_fail, self.units = 0, set(), {c.name: 1.0 for c in self.failing}
        try:
            return self.holds(spec) >= 0.0
        except OutOfTrials:
            return False

    def least(self, remedy: Remedy) -> Advice | None:
        """The least sufficient value of one key, with its remedy; None if there is none."""
        for value in remedy.values:
            if self.quick(remedy, value) >= 0.0 and self.whole(remedy, value) >= 0.0:
                return remedy, value
        if remedy.values:
            return None

        def quick(at: float) -> float:
            return self.quick(remedy, remedy.at(at))

        def both(at: float) -> float:
            left = quick(at)
            if left < 0.0:
                return left
            return min(left, self.whole(remedy, remedy.at(at)))

        turned = any(name in TURNING for name in self.units)
        at = _edge(remedy, both if turned else quick, 0.0, -1.0)
        found = self._rounded(remedy, at)
        if found is None and at is not None and not turned:
            at = _edge(remedy, both, at, -math.inf)
            found = self._rounded(remedy, at)
        return found or (None if at is None else (remedy, remedy.at(at)))

    def _rounded(self, remedy: Remedy, at: float | None) -> Advice | None:
        """The value at a fraction with few digits, if it is sufficient."""
        values = [] if at is None else remedy.rounded(at)
        return next(((remedy, v) for v in values if self.whole(remedy, v) >= 0.0), None)

    def quick(self, remedy: Remedy, value: Value) -> float:
        """A margin of the wanted checks, relative to its present violation.

        It is the least one, of those without parts if one of them fails. A value that makes no
        machine has -inf.
        """
        spec = changed(self.mechanism.spec, remedy.table, remedy.key, value)
        least = math.inf
        try:
            trial = self._trial(spec)
            for name, unit in self.units.items():
                if least < 0.0 and name not in QUICK:
                    break
                least = min(least, trial.spare(name) / unit)
        except GenevaError:
            return -math.inf
        return least

    def whole(self, remedy: Remedy, value: Value) -> float:
        """As ``quick`` by all checks in the whole turn; ``OTHER`` if another one begins to fail."""
        spec = changed(self.mechanism.spec, remedy.table, remedy.key, value)
        turned = any(name in TURNING for name in self.units)
        return self.holds(spec, turned or f"{remedy.table}.{remedy.key}" not in APART)

    def holds(self, spec: Spec | None, turn: bool = True) -> float:
        """The least margin of the wanted checks, negative if any check fails that must pass."""
        from geneva_cli.parts.turn.pairs import WorkLimit

        least = math.inf
        try:
            parts = self.parts and "parts" not in self.may_fail
            for check in self._trial(spec).rows(parts, turn):
                unit = self.units.get(check.name)
                if unit is not None:
                    least = min(least, check.spare / unit)
                elif check.passes is False and check.name not in self.may_fail:
                    least = OTHER
                if least < 0.0:
                    break
        except WorkLimit:
            raise OutOfTrials from None  # a trial of some seconds, which is not repeated
        except GenevaError:
            return -math.inf
        return least

    def _trial(self, spec: Spec | None) -> Trial:
        """The machine of a spec, counted if it is not that of the last trial."""
        if spec is None or spec == self.mechanism.spec:
            raise GenevaError("no other machine")
        if self._last is None or self._last.machine.spec != spec:
            self.left -= 1
            if self.left < self.stop:
                raise OutOfTrials
            self._last = Trial(spec, self.mechanism)
        return self._last


def _edge(remedy: Remedy, margin: Margin, start: float, short: float) -> float | None:
    """The fraction nearest to a failing ``start`` with which a margin is enough; None without.

    The margin may be largest between ``start`` and the remedy's end.
    """
    bracket = _bracket(margin, start, short)
    if bracket is None:
        return None
    good, left, bad, short = bracket
    first, count = good - bad, isinstance(remedy.now, int)
    reach = 8.0 * first
    # interpolation, truncated and projected (ITP): it is hardly slower than halving, whatever the
    # margin is, and much faster where that is smooth
    while good - bad > FINE * good:
        width, middle = good - bad, 0.5 * (good + bad)
        known = math.isfinite(left) and math.isfinite(short) and not count
        root = good - width * left / (left - short) if known else middle
        truncated = min(0.2 * width * width / first, abs(middle - root))
        reach = max(0.5 * reach, 0.5 * FINE * good)
        most = max(reach - 0.5 * width, 0.0)
        at = root + math.copysign(truncated, middle - root)
        at = min(max(at, middle - most), middle + most)
        if count and remedy.at(at) in (remedy.at(good), remedy.at(bad)):
            break
        here = margin(at)
        if here >= 0.0:
            good, left = at, here
        else:
            bad, short = at, here
    return good


def _bracket(
    margin: Margin, start: float, short: float
) -> tuple[float, float, float, float] | None:
    """A fraction with enough margin, and the failing one before it, each with its margin."""
    known, gain = {start: short}, math.inf
    for part in PLACES:
        at = start + (1.0 - start) * part
        left = margin(at)
        if left >= 0.0:
            before = max(x for x in known if x < at)
            return at, left, before, known[before]
        known[at] = left
        best = max(known.values())
        if part == PLACES[0]:
            gain, hopeless = left - short, left < short
        elif part == 1.0:  # no peak is expected before a bad end if the first step gains little
            hopeless = best <= short or (left <= short and short + 2.0 * gain / PLACES[0] < 0.0)
        else:
            hopeless = best <= 0.5 * short
        if hopeless and left > -math.inf:
            return None
    return None


def changed(spec: Spec, table: str, key: str, value: Value) -> Spec | None:
    """The spec with one value changed; None for a value that the reader would refuse."""
    try:
        return spec.with_(f"{table}.{key}", value)
    except GenevaError:
        return None


def line(remedy: Remedy, value: Value) -> str:
    """A change as a line of the spec; a key that an earlier table has too stands with its table."""
    from geneva_cli.specfile.keys import tables_with

    first = next(iter(tables_with(remedy.key)))
    key = remedy.key if remedy.table == first else f"{remedy.table}.{remedy.key}"
    if value is None:
        return f"leaving out {key}"
    return f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.12g}"
