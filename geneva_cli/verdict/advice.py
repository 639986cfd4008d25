"""The adviser: one change of the given spec with which all checks pass, or one for each check.

It changes one value, builds the machine again and makes the checks, so its advice has been tried
with the digits shown. The advice is the nearest value of its key, to ``NEARLY`` of the change.
Trials are counted, not timed, so that equal specs get equal advice on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.verdict.checks import checks, pushed_round, single_check
from geneva_cli.verdict.checks.all_checks import (
    LIMITS,
    MOTION,
    OF_TURN,
    PUSHED,
    TURNING,
    check_named,
    standing,
    untold,
)
from geneva_cli.verdict.checks.check import NONE, STOPPED, Check

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.remedies import Remedy, Value

FINE = 0.005  # fraction of a change to which its least value is searched
OTHER = -0.99  # margin where a check fails that passed before
TRIALS = 80  # machines that are built for all searches of a design
SLOW = 20  # trials for which one counts whose turn takes too long
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


class OutOfTrials(Exception):
    """The adviser has no trials left: not a fault of the spec, so not a GenevaError."""


def judged(mechanism: Mechanism, machine: Parts | None = None, parts: bool = True) -> list[Check]:
    """Every check of a design; failing ones have one change with which all checks pass.

    Without such a change they say why, and name a change with which they pass themselves.
    """
    rows = checks(mechanism, machine, parts)
    failing = tuple(c for c in rows if c.passes is False)
    if not failing:
        return rows
    advised = iter(_advised(mechanism, failing, parts))
    return [next(advised) if c.passes is False else c for c in rows]


@lru_cache(maxsize=4)  # a folder of files and the report in it need the same advice
def _advised(mechanism: Mechanism, failing: tuple[Check, ...], parts: bool) -> list[Check]:
    """The failing checks with the change that passes all, or with the reason for its absence."""
    adviser, count = Adviser(mechanism, failing, parts), len(failing)
    one, why = adviser.advice(failing, TRIALS if count == 1 else TRIALS // 2)
    if one:
        anew = adviser.chosen_anew([one])
        return [_with_change(c, line(*one), anew) for c in failing]
    own = [""] * count
    if count > 1:
        # one trial is for all changes together
        each = [
            adviser.advice((c,), (adviser.left - 1) // (count - i))[0]
            for i, c in enumerate(failing)
        ]
        by_key = {one[0][:2]: one for one in each if one}
        if all(each) and adviser.suffice([*by_key.values()]):
            lines = [line(*one) for one in by_key.values()]
            lines.sort(key=lambda text: text.startswith("leaving out"))
            anew = adviser.chosen_anew([*by_key.values()])
            return [_with_change(c, " and ".join(lines), anew) for c in failing]
        own = [f"{line(*one)} passes this one" if one else "" for one in each]
    return [
        c._replace(why="; ".join(text for text in (c.why, why, more) if text))
        for c, more in zip(failing, own, strict=True)
    ]


def _with_change(check: Check, change: str, anew: str) -> Check:
    # where the same key passes, the other sizes may have changed with it
    value, but, _ = check.why.partition(", but ")
    same_key = but and value.startswith(f"{change.partition(' ')[0]} is ")
    return check._replace(nearest=change, why=value if same_key else check.why, anew=anew)


class Trial:
    """A machine with a changed spec, and its parts."""

    def __init__(self, spec: Spec, like: Mechanism) -> None:
        self.machine = build(spec, like)

    @cached_property
    def built(self) -> Parts:
        """The parts; an error in them does not name the roller that fits."""
        from geneva_cli.parts.parts import parts_of

        return parts_of(self.machine, advice=False)

    def spare(self, name: str) -> float:
        """The margin of a check, negative where it fails."""
        row: Check | None
        if name in PUSHED:
            pushed = pushed_round(self.machine) if self.machine.no_turn else []
            row = next((check for check in pushed if check.name == name), None)
        elif name in OF_TURN:
            row = check_named(TURNING, name, self.built, self.built.turned.turn)
        else:
            if name == "parts":
                _ = self.built.turned
            row = single_check(self.machine, name, self.built)
        return row.spare if row else math.inf

    def rows(self, parts: bool, turn: bool) -> Iterator[Check]:
        """All checks, the quick ones first."""
        machine = self.machine
        for among in (MOTION, LIMITS):
            yield from untold(among, machine)
        if parts and machine.spec.is_turned and machine.spec.has_parts:
            yield from untold(standing(machine), self.built.built)
        if parts and machine.spec.is_turned and turn:
            if machine.no_turn:
                yield from pushed_round(machine)
            else:
                yield from untold(TURNING, self.built, self.built.turned.turn)


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

        self._aim(wanted, self.left - trials)
        tried = set()
        try:
            for check in wanted:
                for remedy in remedies(check, self.mechanism):
                    if remedy.way not in tried and (advice := self._least(remedy)):
                        return advice, ""
                    tried.add(remedy.way)
        except OutOfTrials:
            return None, STOPPED
        return None, NONE

    def suffice(self, each: list[Advice]) -> bool:
        """True if all failing checks pass with several changes at once, and no other fails."""
        self._aim(self.failing, 0)
        try:
            return self._margin(self._with(each), True, True) >= 0.0
        except OutOfTrials:
            return False

    def chosen_anew(self, each: list[Advice]) -> str:
        """The sizes that the load chooses anew with these changes, in words; empty if none."""
        from geneva_cli.parts.chosen import ByLoad, by_load

        if not self.mechanism.spec.is_loaded or (spec := self._with(each)) is None:
            return ""
        return ByLoad(by_load(build(spec, self.mechanism)), by_load(self.mechanism)).changes

    def _with(self, each: list[Advice]) -> Spec | None:
        """The spec with several changes."""
        spec: Spec | None = self.mechanism.spec
        for (table, key, *_), value in each:
            spec = spec and _changed(spec, table, key, value)
        return spec

    def _aim(self, wanted: tuple[Check, ...], stop: int) -> None:
        """Search for these checks, the quick ones first, until so many trials are left."""
        by_cost = sorted(wanted, key=lambda c: _cost(c.name))
        self.units = {c.name: -c.spare if c.spare > -math.inf else 1.0 for c in by_cost}
        self.may_fail = {c.name for c in self.failing}
        self.stop = stop

    def _least(self, remedy: Remedy) -> Advice | None:
        """The least sufficient value of one key, with its remedy; None if there is none."""

        margins = {every: partial(self._margin_with, remedy, every) for every in (False, True)}

        def passes(value: Value) -> bool:
            return margins[True](value) >= 0.0

        if remedy.values:
            return next(((remedy, value) for value in remedy.values if passes(value)), None)
        # parts that are built or turned anyway cost as much as all checks, which are last otherwise
        at_once = any(name in OF_TURN or name == "parts" for name in self.units)
        at, short = 0.0, -1.0
        for every in (True,) if at_once else (False, True):
            edge = _edge(remedy, margins[every], at, short)
            if edge is None:
                return None
            for value in remedy.rounded(edge):
                if passes(value):
                    return remedy, value
            at, short = edge, -math.inf
        return remedy, remedy.at(at)

    def _margin_with(self, remedy: Remedy, every: bool, value: Value) -> float:
        spec = _changed(self.mechanism.spec, remedy.table, remedy.key, value)
        return self._margin(spec, every, f"{remedy.table}.{remedy.key}" not in APART)

    def _margin(self, spec: Spec | None, every: bool, turn: bool) -> float:
        """The least margin of the wanted checks, relative to its present violation.

        Checks that cost more are left out if one fails. A spec that makes no machine has
        -inf. With ``every`` all checks are made, in the ``turn`` too, and another one that begins
        to fail gives ``OTHER``.
        """
        from geneva_cli.parts.turn.pairs import WorkLimit

        least, cost = math.inf, 0
        try:
            trial = self._trial(spec)
            for name, unit in self.units.items():
                if least < 0.0 and _cost(name) > cost:
                    break
                least, cost = min(least, trial.spare(name) / unit), _cost(name)
            if every and least >= 0.0:
                parts = self.parts and ("parts" in self.units or "parts" not in self.may_fail)
                for check in trial.rows(parts, turn):
                    wanted = check.name in self.units or check.name not in self.may_fail
                    if check.passes is False and wanted:
                        return OTHER
        except WorkLimit:
            self.left -= SLOW
            return -math.inf
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


def _cost(name: str) -> int:
    """The order of checks: of the motion and its limits, of parts at rest, of the whole turn."""
    return 0 if name in QUICK else 2 if name in (*OF_TURN, *PUSHED) else 1


def _edge(
    remedy: Remedy, margin: Callable[[Value], float], start: float, short: float
) -> float | None:
    """The fraction nearest to a failing ``start`` with which a margin is enough; None without.

    The margin may be largest between ``start`` and the remedy's end. ``short`` is that at the
    start.
    """
    known, gain, good, left = {start: short}, math.inf, start, short
    for part in PLACES:
        good = start + (1.0 - start) * part
        left = margin(remedy.at(good))
        if left >= 0.0:
            break
        known[good] = left
        best = max(known.values())
        if part == PLACES[0]:
            gain, hopeless = left - short, left < short
        elif part == 1.0:  # no peak is expected before a bad end if the first step gains little
            hopeless = best <= short or (left <= short and short + 2.0 * gain / PLACES[0] < 0.0)
        else:
            hopeless = best <= 0.5 * short
        if hopeless and left > -math.inf:
            return None
    if left < 0.0:
        return None
    bad = max(x for x in known if x < good)
    short, first, count = known[bad], good - bad, isinstance(remedy.now, int)
    reach = 2.0 * first
    # interpolation, truncated and projected (ITP): it takes one step more than halving at most, and
    # far fewer where the margin is smooth
    while good - bad > FINE * good:
        width, middle = good - bad, 0.5 * (good + bad)
        smooth = math.isfinite(left) and math.isfinite(short) and not count
        root = good - width * left / (left - short) if smooth else middle
        truncated = min(0.2 * width * width / first, abs(middle - root))
        reach = max(0.5 * reach, 0.5 * FINE * good)
        most = max(reach - 0.5 * width, 0.0)
        at = root + math.copysign(truncated, middle - root)
        at = min(max(at, middle - most), middle + most)
        if count and remedy.at(at) in (remedy.at(good), remedy.at(bad)):
            break
        here = margin(remedy.at(at))
        if here >= 0.0:
            good, left = at, here
        else:
            bad, short = at, here
    return good


def _changed(spec: Spec, table: str, key: str, value: Value) -> Spec | None:
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
