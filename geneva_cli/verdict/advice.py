"""The adviser: one change of the spec as it was given that would make a check pass.

It changes one value, builds the machine anew and asks the checks; what it says has been tried,
digits and all, and breaks nothing that passed. It takes a second of the processor's time at most
for a check; where it has found nothing by then, or no single change helps, it says so.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any, cast

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.budget import OutOfTime, until
from geneva_cli.numerics.roots import Falsi
from geneva_cli.verdict.checks import checks, each, one
from geneva_cli.verdict.checks.check import Check
from geneva_cli.verdict.remedies import Value, Way, value_now, ways

if TYPE_CHECKING:
    from geneva_cli.parts.proof import Proof

SECONDS = 1.0  # of the processor, for one check
NONE = "none found"
LOOKS = 14  # between a value that fails and one that passes
NEARLY = 0.02  # of the way to a value that passes: near enough to the nearest, for a round value

# Keys that change no part: the parts need not be turned again.
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
# A roller that does not find its slot, or meets the rim beside it, jams.
JAMS = ("hand_over_play_deg", "hand_over_pressure_deg")
# Below the wheel's plane: the wheel can be cut all the same.
BELOW = ("link_wall_mm", "link_gap_mm")
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


def verdict(proof: Proof) -> tuple[str, list[str]]:
    """Why parts jam or cannot be made; and what else `check` fails, each in words.

    The first is empty where the parts can be written.
    """
    turn = None
    refused, warned, advice = [], [], ""
    for c in judged(proof.mechanism, proof):
        if c.passes is not False:
            continue
        nearest = c.nearest if c.nearest != NONE else ""
        if c.name == "full_turn":
            refused.append(c.nearest)
        elif c.name in JAMS or (
            c.name not in BELOW
            and c.must_be == "at least"
            and c.name.endswith("_mm")
            and (c.value or 0.0) < 0.0
        ):
            turn = turn or proof.turn
            refused.append(said(c, turn.smallest.parts))
            advice = advice or nearest
        else:
            warned.append(said(c) + (f"; {nearest} would pass" if nearest else ""))
    return "; ".join(refused) + (f"; {advice} would free it" if advice else ""), warned


def said(c: Check, parts: str = "parts") -> str:
    """A check that fails, in words."""
    from geneva_cli.verdict.checks.walls import NO_WALL

    where = "" if c.at_deg is None else f" at input angle {c.at_deg:.6g} deg"
    value, limit = c.value or 0.0, c.limit or 0.0
    if c.name == "gap_mm":
        return f"{parts} overlap by {-value:.4g} mm{where}"
    if c.name == "idle_roller_mm":
        return f"an idle roller overlaps the wheel by {-value:.4g} mm{where}"
    if c.name in NO_WALL and value < 0.0:
        return f"{NO_WALL[c.name]} by {-value:.4g} mm"
    if c.name == "dwell_hold":
        return "nothing holds the wheel in its dwell"
    if c.name == "hand_over_play_deg":
        return (
            f"between lock and slot the wheel can turn by {value:.4g} deg{where}, more than the "
            f"{limit:.4g} at which the roller still finds its slot"
        )
    if c.name == "hand_over_pressure_deg":
        return (
            f"the roller meets the wheel{where} at a pressure angle of {value:.4g} deg, above "
            f"{limit:g}"
        )
    if c.name == "motion_play_deg":
        return (
            f"in its slot the roller leaves the wheel {value:.4g} deg either way{where}, more than "
            f"{limit:.4g}"
        )
    return f"{c.name} is {value:.6g}{where}; it must be {c.must_be} {limit:.6g}"


class Adviser:
    """Looks for the one change by which a check passes that fails.

    ``rows`` are all the design's checks, ``taken`` the seconds that they took, which a trial of
    all of them takes again.
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
            with until(self.deadline):
                for way in ways(failing.name, self.mechanism):
                    found = self._along(way, failing)
                    if found:
                        return found
        except OutOfTime:
            pass
        return ""

    def _along(self, way: Way, failing: Check) -> str:
        """The least change along one way that helps and holds."""
        now = value_now(self.mechanism, way.table, way.key)
        if now is None:
            return ""
        bad: Value = now
        short = _spare(failing)
        for good in way.values(now):
            left = self._left(way, good, failing)
            if good == now or left < 0.0:
                bad, short = good, left
                continue
            numbers = isinstance(good, float) and isinstance(bad, float)
            if numbers and failing.name not in TURNED:
                near = self._nearest(way, (good, left), (bad, short), failing)
                near = rounded(near, cast(float, good), cast(float, bad))
                if near != good and self._holds(way, near, failing):
                    return line(way.key, near)
            if self._holds(way, good, failing):
                return line(way.key, good)
            bad, short = good, -1.0
        return ""

    def _nearest(
        self, way: Way, good: tuple[Any, float], bad: tuple[Any, float], failing: Check
    ) -> float:
        """The value nearest to one that fails, as nearly as there is time for.

        The steps are those of ``numerics.roots.Falsi``, taken here because time may run out. Where
        what is left of the limit is without bound, as of a value that makes no machine, the search
        halves.
        """
        start, short = bad
        found, enough = Falsi(*good, *bad), NEARLY * abs(short) if math.isfinite(short) else 0.0
        for _ in range(LOOKS):
            x = found.good
            if found.left <= enough or abs(x - found.bad) <= NEARLY * abs(x - start):
                break
            # Time stays to try what is found, and of gaps, should it not hold, what is known.
            spare = (2.0 if failing.name in GAPS else 1.0) * self._whole(way)
            if time.process_time() + self.longest + spare > self.deadline:
                break
            middle = found.middle(0.02)
            found.told(middle, self._left(way, middle, failing))
        return float(found.good)

    def _whole(self, way: Way) -> float:
        """Seconds that a trial of all checks takes."""
        return 0.0 if (way.table, way.key) in APART else self.taken

    def _left(self, way: Way, value: Value, failing: Check) -> float:
        """How far a value keeps the check's limit, negative where it does not.

        What is quick to ask, before all is: the one check, or the gap where parts overlap now.
        """
        spec = changed(self.spec, way.table, way.key, value)
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
            row = one(build(spec), failing.name)
            return _spare(row) if row else math.inf
        except GenevaError:
            return -math.inf
        finally:
            self.longest = max(self.longest, time.process_time() - start)

    def _holds(self, way: Way, value: Value, failing: Check) -> bool:
        """Whether the check passes with a value, and everything that passed before still does."""
        spec = changed(self.spec, way.table, way.key, value)
        if spec is None:
            return False
        # A machine that jams takes up to twice as long to turn as one that does not.
        if time.process_time() + 0.5 * self._whole(way) > self.deadline:
            raise OutOfTime
        apart = (way.table, way.key) in APART
        must = self.passed | {failing.name, "parts"}
        try:
            rows = each(build(spec), self.parts and (not apart or failing.name == "dwell_hold"))
            return all(c.passes is not False for c in rows if c.name in must)
        except GenevaError:
            return False


def _clears(mechanism: Mechanism, at_deg: float) -> float:
    """Whether no parts overlap about one input angle, as an infinity: what touches has no gap."""
    from geneva_cli.parts.outlines import outlines

    found = outlines(mechanism)
    return math.inf if found.gap_about(at_deg) >= -found.contact else -math.inf


def _spare(check: Check) -> float:
    """What is left of a check's limit, negative where it fails."""
    if check.value is None or check.limit is None:
        return -math.inf
    left = check.limit - check.value
    left = left if check.must_be == "at most" else -left
    return max(left, 0.0) if check.passes else min(left, -5e-324)


def rounded(good: float, far: float, bad: float) -> float:
    """A value that passes, rounded away from one that fails: digits enough to stay near it."""
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
