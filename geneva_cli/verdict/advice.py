"""The adviser: one change of the spec with which all checks pass, or one for each check.

A check has words for the keys that move it. One value is changed, and the machine is built again
and checked: what is advised has been tried with the digits shown. Trials are counted, not timed, so
that equal specs get equal advice on every machine.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from typing import Any, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.parts.chosen import ByLoad, by_load
from geneva_cli.parts.machine_sizes import built
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.spec.tables import Size
from geneva_cli.specfile.keys import tables_with
from geneva_cli.verdict import checks
from geneva_cli.verdict.checks import Check

# The reason why a failing check has no advice.
NONE = "no single change that was tried passes all checks"
STOPPED = "no single change passed all checks within the limit of trials"
NEAR = 0.015  # fraction of a change by which the one advised may exceed the least one
TRIALS = 80  # machines that are built for all searches of a design
# Fractions of the way to a remedy's end that are tried: the end, the first step, and between them.
PLACES = (1.0, 1.0 / 12.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 6.0)
# Requirements on the machine's size, process and walls, which no advice reduces.
REQUIRED = ("center_distance_mm", "crank_radius_mm", "face_width_mm", "process", "wall_min_mm")
# Words, the likeliest first, as each check has them in its row. A word is a key, by default of
# [size], and what becomes of its present value: key*2 is up to the double, key:5 towards 5, key=5
# only 5, key= none, key? towards the default or anywhere. Those in capitals stand for these;
# "drives" are [drive] and [drive.before]. The centre distance is changed for its own limits only,
# where the spec gives it. Sizes that the spec sets are tried behind the words. The speed is a
# requirement: it is changed where a limit forbids it, and for a part's strength only where no size
# of it helps.
WORDS = {
    "LARGER": "center_distance_mm*20",
    "SLOWER": "drive.n_rpm*0.001",
    "FASTER": "drive.n_rpm*30",
    "WIDER": "face_width_mm*10",
    "TIGHTER": "slot_clearance_mm:0",
    "SMALLER": "roller_radius_mm*0.2",
    "LONGER": "motion.alpha0_deg:-180 motion.alpha0_deg:180",
    "MILDER": "drives.A:0.99 drives.A:-0.99 drives.eccentricity:0.99 drives.eccentricity:0 LONGER "
    "wheel.z:24",
    "OTHERS": "lock_clearance_mm:0 TIGHTER roller_radius_mm*0.4 wheel.offset_mm:0",
}
Change: TypeAlias = tuple[str, Any]  # a key with its table, and a value; None leaves it out


class Remedy(NamedTuple):
    """A new value of a key; with its present one, any between both may be advised."""

    key: str  # with its table
    end: Any
    now: Any = None  # a number, or None


class Trial(NamedTuple):
    """A value of a key, and the margins of the checks with it, up to the first that fails."""

    value: Any
    spares: dict[str, float]

    @property
    def passes(self) -> bool:
        """True if no check fails."""
        return min(self.spares.values()) >= 0.0

    def zero(self, one: Trial, other: Trial) -> float:
        """The value up to which a check fails that fails here, by lines through two trials."""
        zeros = [self.value]
        for name in (name for name, spare in self.spares.items() if spare < 0.0):
            low, high = (trial.spares.get(name, math.inf) for trial in (one, other))
            slope = (high - low) / (other.value - one.value)
            zeros.append(one.value - low / slope if math.isfinite(slope) and slope else math.inf)
        return max(zeros, key=lambda zero: abs(zero - self.value))


def short(value: float, spare: float) -> float:
    """The number with the fewest digits that differs from a value by at most ``spare``."""
    rounded = (float(f"{value:.{digits}g}") for digits in range(1, 17))
    return next((number for number in rounded if abs(number - value) <= spare), value)


def words_of(name: str) -> str:
    """The words of a check, with those in capitals spelled out."""
    words = checks.KEYS.get(name, "OTHERS")
    while capitals := re.search("[A-Z]{5,}", words):
        words = words.replace(capitals[0], WORDS[capitals[0]])
    return re.sub(r"drives(\S+)", r"drive\1 drive.before\1", words)


def remedies(check: Check, mechanism: Mechanism) -> Iterator[Remedy]:
    """Changes of the spec that may make a failing check pass, the likeliest first."""
    spec, size = mechanism.spec, mechanism.spec.size.as_dict()
    usual = {} if check.name in checks.SIZELESS else Size().as_dict()
    own = [key for key in usual if size[key] != usual[key] and key not in REQUIRED]
    how = "=" if "remove it" in check.why else "?"
    # first a size that the reason names, such as "wheel_bore_mm = 30: it must be below 20"
    first, last = [key + how for key in own if key in check.why], [f"{key}?" for key in own]
    text = " ".join((*first, words_of(check.name), *last))
    if given := [key for key in REQUIRED[:2] if size[key]]:
        limited = len(given) == 1 and spec.limits.as_dict().get(check.name) is not None
        larger = WORDS["LARGER"].replace(REQUIRED[0], given[0]) if limited else ""
        text = text.replace(WORDS["LARGER"], larger)
    for table, key, how, end in re.findall(r"(?:([\w.]+)\.)?(\w+)([*:=?])(\S*)", text):
        whole, keys = f"{table or 'size'}.{key}", spec.table(table or "size")
        now = _now(mechanism, whole) if key in keys else None
        if how == "=" and key in keys:
            yield Remedy(whole, float(end) if end[-1:].isdigit() else end or None)
        elif how in "*:" and now is not None:
            yield Remedy(whole, float(end) * (now if how == "*" else 1.0), now)
        elif how == "?" and isinstance(now, float):
            with suppress(GenevaError):
                usual_now = _now(mechanism._replace(spec=spec.with_(whole, None)), whole)
                yield Remedy(whole, now if usual_now is None else usual_now, now)
            yield Remedy(whole, 0.1 * now, now)
            yield Remedy(whole, 10.0 * now, now)
        if how == "?" and keys.get(key) is not None:
            yield Remedy(whole, None)


def _now(mechanism: Mechanism, whole: str) -> Any:
    """A key's present value; the machine's for a size that the spec leaves out."""
    table, _, key = whole.rpartition(".")
    value = mechanism.spec.table(table)[key]
    return built(mechanism).as_dict()[key] if value is None and table == "size" else value


def advised(mechanism: Mechanism, rows: list[Check]) -> list[Check]:
    """The checks, those that fail with one change of the spec with which all checks pass."""
    failing = [c for c in rows if c.passes is False]
    if not failing:
        return rows
    adviser, count, own = Adviser(mechanism, failing), len(failing), dict[str, str]()
    one = adviser.advice(failing, TRIALS // min(count, 2))
    each, why = [one] if one else [], STOPPED if adviser.left < adviser.stop else NONE
    if not one and count > 1:
        some = dict[str, Change]()
        for i, c in enumerate(failing):  # one trial is for all changes together
            if change := adviser.advice([c], (adviser.left - 1) // (count - i)):
                own[c.name], some[change[0]] = f"{line(*change)} passes this one", change
        adviser.stop = 0
        together = sorted(some.values(), key=lambda change: change[1] is None)
        if len(own) == count and adviser.trial(together, adviser.failing, True).passes:
            each = together
    anew, text = "", " and ".join(line(*change) for change in each)
    if each and mechanism.spec.is_loaded:
        changed = build(mechanism.spec.with_keys(dict(each)), mechanism)
        anew = ByLoad(by_load(changed), by_load(mechanism)).changes
    out = []
    for c in rows:
        if c.passes is False and each:
            # where the same key passes, the other sizes may have changed with it
            value, but, _ = c.why.partition(", but ")
            same = but and value.startswith(f"{text.partition(' ')[0]} is ")
            c = c._replace(nearest=text, why=value if same else c.why, anew=anew)
        elif c.passes is False:
            c = c._replace(why="; ".join(filter(None, (c.why, why, own.get(c.name)))))
        out.append(c)
    return out


def line(whole: str, value: Any) -> str:
    """A change as a line of the spec; a key that an earlier table has too stands with its table."""
    table, _, key = whole.rpartition(".")
    if table != next(iter(tables_with(key))):
        key = whole
    if value is None:
        return f"leaving out {key}"
    return f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.12g}"


class Adviser:
    """Search for changes with which the ``failing`` checks pass."""

    def __init__(self, mechanism: Mechanism, failing: list[Check]) -> None:
        self.mechanism, self.left, self.stop = mechanism, TRIALS, 0
        self.failing = {c.name for c in failing}
        self._parts: dict[tuple[Change, ...], Parts] = {}

    def advice(self, wanted: list[Check], trials: int) -> Change | None:
        """The change with which some failing checks pass and no other fails, in so many trials."""
        self.stop, tried = self.left - trials, set()
        by_cost = sorted(
            wanted, key=lambda c: (c.name in checks.TURNED, c.name not in checks.QUICK)
        )
        spares = {c.name: c.spare for c in by_cost}
        for remedy in (one for check in wanted for one in remedies(check, self.mechanism)):
            key, end, now = remedy
            if now is None:
                change = (key, end) if self.trial([(key, end)], spares, True).passes else None
            elif end == now or (key, end > now) in tried:
                continue
            else:
                change = self._least(remedy, Trial(now, spares), [*spares])
                tried.add((key, end > now))
            if change or self.left < self.stop:
                return change
        return None

    def _least(self, remedy: Remedy, start: Trial, wanted: Sequence[str]) -> Change | None:
        """The least change from a failing start with which the wanted and all others pass."""
        (key, end, now), known, better = remedy, {0.0: start}, False
        for part in PLACES:
            value = start.value + (end - start.value) * part
            if start.value * end > 0.0:
                value = start.value * (end / start.value) ** part
            spare = 0.05 * abs(value - start.value) if part < 1.0 else 1e-12 * abs(value)
            known[part] = good = self.trial([(key, type(now)(short(value, spare)))], wanted)
            if good.passes:
                break
            name, spare = [*good.spares.items()][-1]
            better = better or spare > start.spares.get(name, -math.inf)
            # none passes before an end, or between places, that are no better than the start
            if part != PLACES[0] and not better:
                return None
        else:
            return None
        good = self._nearest(remedy, known[max(x for x in known if x < part)], good, wanted)
        every = self.trial([(key, good.value)], wanted, True)
        if every.passes:
            return key, good.value
        # where another check fails, it is wanted too from there on
        return self._least(remedy, every, (*wanted, [*every.spares][-1]))

    def _nearest(self, remedy: Remedy, bad: Trial, good: Trial, wanted: Sequence[str]) -> Trial:
        """The trial nearest to one that fails, between it and one that passes, which does."""
        now, whole, slow, line = remedy.now, isinstance(remedy.now, int), 0, (bad, good)
        while True:
            gap, change = good.value - bad.value, abs(good.value - now)
            near = max(NEAR * min(change, 4.0 * abs(good.value) or change), whole)
            half, part, spare = 0.5 * near / abs(gap), 0.5, 0.125
            if half >= 0.5:
                return good
            zero = (bad.zero(*line) - bad.value) / gap
            if 0.0 <= zero <= 1.0 and slow < 2 and not whole:
                part, spare = min(max(zero + 0.5 * half, half), 1.0 - half), 0.5 * half
            value = short(bad.value + part * gap, spare * abs(gap))
            trial = self.trial([(remedy.key, type(now)(value))], wanted)
            last, good, bad = (good, trial, bad) if trial.passes else (bad, good, trial)
            # after a step that leaves more than a rounded half, the line through the last two
            # values on one side
            slow = slow + 1 if abs(good.value - bad.value) > 0.625 * abs(gap) else 0
            line = (last, trial) if slow else (bad, good)

    def trial(self, changes: Sequence[Change], names: Iterable[str], every: bool = False) -> Trial:
        """The margins of some checks with changes of the spec; -inf if it makes no machine.

        With ``every`` those of all others follow that pass now.
        """
        out, key = Trial(changes[0][1], {}), tuple(changes)
        try:
            if key not in self._parts:
                self.left = max(self.left, self.stop) - 1
                if self.left < self.stop:
                    raise GenevaError(STOPPED)
                spec = self.mechanism.spec.with_keys(dict(changes))
                self._parts[key] = parts_of(build(spec, self.mechanism))
            parts = self._parts[key]
            for name in names:
                check = checks.single_check(parts, name)
                out.spares[name] = check.spare if check else math.inf
                if check and check.passes is None:  # a change is no advice that hides a check
                    out.spares[name] = -math.inf
                if not out.passes:
                    return out
            # where a check has no value, others say how near it is
            if every or math.inf in out.spares.values():
                for check in checks.every_check(parts, quick=True):
                    if check.name not in self.failing:
                        out.spares[check.name] = check.spare
                        if check.passes is False:
                            break
        except GenevaError:  # no machine, a turn that takes too long, or no trials left
            return out._replace(spares={"": -math.inf})
        return out
