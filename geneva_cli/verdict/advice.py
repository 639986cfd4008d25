"""The adviser: one change of the given spec by which a failing check would pass.

It changes one value, builds the machine again and makes the checks. What it advises has been tried
with the digits shown, and no check that passed fails by it. It spends at most one second of the
processor's time on a check; where it has found nothing by then, or no single change helps, it says
so.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any, cast

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.budget import OutOfTime, time_limit
from geneva_cli.numerics.roots import Falsi
from geneva_cli.verdict.changes import Change, Value, value_now
from geneva_cli.verdict.checks import checks, checks_quick_first, single_check
from geneva_cli.verdict.checks.check import NONE, Check
from geneva_cli.verdict.failures import JAMS
from geneva_cli.verdict.remedies import remedies

if TYPE_CHECKING:
    from geneva_cli.parts.proof import Proof

SECONDS = 1.0  # of processor time, for one check
LOOKS = 14  # trials between a value that fails and one that passes
NEARLY = 0.02  # share of a change by which the value found may exceed the least one

# Keys that change no outline: the parts need not be turned again.
APART = (
    ("drive", "n_rpm"),
    ("size", "face_width_mm"),
    ("size", "wheel_thickness_mm"),
    ("size", "lock_thickness_mm"),
    ("size", "arm_thickness_mm"),
    ("size", "pin_held"),
    ("size", "lock_edge_mm"),
    ("wheel", "held_by"),
    ("shaft", "wheel_diameter_mm"),
    ("shaft", "wheel_overhang_mm"),
    ("shaft", "crank_diameter_mm"),
    ("shaft", "crank_overhang_mm"),
    ("material.roller", "dynamic_capacity_N"),
)
GAPS = ("gap_mm", "idle_roller_mm")
# Checks that only a whole turn can answer.
TURNED = (*JAMS, "dwell_hold", "dwell_play_deg", "motion_play_deg")


def judged(mechanism: Mechanism, proof: Proof | None = None, parts: bool = True) -> list[Check]:
    """Every check of a design, those that fail with the nearest change that would pass."""
    start = time.process_time()
    rows = checks(mechanism, proof, parts)
    adviser = Adviser(mechanism, rows, time.process_time() - start, parts)
    return [
        c if c.nearest or c.passes is not False else c._replace(nearest=adviser.advice(c) or NONE)
        for c in rows
    ]


class Adviser:
    """Looks for one change of the spec by which a failing check passes.

    ``rows`` are all the design's checks; ``taken`` is how many seconds they took, and so how many
    a trial of all of them takes.
    """

    def __init__(
        self, mechanism: Mechanism, rows: list[Check], taken: float, parts: bool = True
    ) -> None:
        self.mechanism = mechanism
        self.spec = mechanism.spec
        self.passed = {c.name for c in rows if c.passes is not False}
        self.taken = taken
        self.parts = parts
        self.deadline = 0.0
        self.longest = 0.0  # seconds that the dearest look took

    def advice(self, failing: Check) -> str:
        """The change as a line of the spec; nothing where none was found in time."""
        self.deadline, self.longest = time.process_time() + SECONDS, 0.0
        try:
            with time_limit(self.deadline):
                for change in remedies(failing.name, self.mechanism):
                    found = self._least(change, failing)
                    if found:
                        return found
        except OutOfTime:
            pass
        return ""

    def _least(self, change: Change, failing: Check) -> str:
        """The least of one key's changes by which the check passes and no other fails."""
        now = value_now(self.mechanism, change.table, change.key)
        if now is None:
            return ""
        bad: Value = now
        short = _spare(failing)
        for good in change.values(now):
            left = self._left(change, good, failing)
            if good == now or left < 0.0:
                bad, short = good, left
                continue
            numbers = isinstance(good, float) and isinstance(bad, float)
            if numbers and failing.name not in TURNED:
                near = self._nearest(change, (good, left), (bad, short), failing)
                near = rounded(near, cast(float, good), cast(float, bad))
                if near != good and self._holds(change, near, failing):
                    return line(change.key, near)
            if self._holds(change, good, failing):
                return line(change.key, good)
            bad, short = good, -1.0
        return ""

    def _nearest(
        self, change: Change, good: tuple[Any, float], bad: tuple[Any, float], failing: Check
    ) -> float:
        """The value nearest to one that fails, as nearly as there is time for.

        The steps are those of ``numerics.roots.Falsi``, taken here because time may run out. A
        value that makes no machine leaves minus infinity of the limit: the search then halves.
        """
        start, short = bad
        found, enough = Falsi(*good, *bad), NEARLY * abs(short) if math.isfinite(short) else 0.0
        for _ in range(LOOKS):
            x = found.good
            if found.left <= enough or abs(x - found.bad) <= NEARLY * abs(x - start):
                break
            # Keep the time for a trial of the value found; for gaps also of the one known before,
            # should the first fail.
            spare = (2.0 if failing.name in GAPS else 1.0) * self._whole(change)
            if time.process_time() + self.longest + spare > self.deadline:
                break
            middle = found.middle(0.02)
            found.add(middle, self._left(change, middle, failing))
        return float(found.good)

    def _whole(self, change: Change) -> float:
        """Seconds that a trial of all checks takes."""
        return 0.0 if (change.table, change.key) in APART else self.taken

    def _left(self, change: Change, value: Value, failing: Check) -> float:
        """How far inside the failing check's limit a value is, negative outside.

        Only what is quick is worked out: this one check, or the gap where parts overlap now.
        """
        spec = changed(self.spec, change.table, change.key, value)
        if spec is None:
            return -math.inf
        if failing.name in TURNED:
            return math.inf  # only a whole turn can tell, and it is made once, with all the rest
        start = time.process_time()
        if start + self.longest > self.deadline:
            raise OutOfTime
        try:
            if failing.name in GAPS:
                return _clears(build(spec), failing.at_deg or 0.0)
            row = single_check(build(spec), failing.name)
            return _spare(row) if row else math.inf
        except GenevaError:
            return -math.inf
        finally:
            self.longest = max(self.longest, time.process_time() - start)

    def _holds(self, change: Change, value: Value, failing: Check) -> bool:
        """Whether the check passes with a value, and everything that passed before still does."""
        spec = changed(self.spec, change.table, change.key, value)
        if spec is None:
            return False
        # A machine that jams takes up to twice as long to turn as one that does not.
        if time.process_time() + 0.5 * self._whole(change) > self.deadline:
            raise OutOfTime
        apart = (change.table, change.key) in APART
        must = self.passed | {failing.name, "parts"}
        try:
            rows = checks_quick_first(
                build(spec), self.parts and (not apart or failing.name == "dwell_hold")
            )
            return all(c.passes is not False for c in rows if c.name in must)
        except GenevaError:
            return False


def _clears(mechanism: Mechanism, at_deg: float) -> float:
    """Plus infinity where no parts overlap about one input angle, minus infinity where they do."""
    from geneva_cli.parts.proof import Proof
    from geneva_cli.parts.turn.glance import gap_about

    found = Proof(mechanism).turned
    return math.inf if gap_about(found, at_deg) >= -found.contact else -math.inf


def _spare(check: Check) -> float:
    """What is left of a check's limit, negative where it fails."""
    if check.value is None or check.limit is None:
        return -math.inf
    left = check.limit - check.value
    left = left if check.must_be == "at most" else -left
    return max(left, 0.0) if check.passes else min(left, -5e-324)


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


def line(key: str, value: Value) -> str:
    """A change as it is written into the spec."""
    if value is None:
        return f"leaving out {key}"
    return f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.12g}"
