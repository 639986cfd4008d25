"""Sizes with which the parts of a chosen machine pass every check in a full turn."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.tolerances import CLEARLY
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.parts.turn.full_turn import full_turn, gap_about, play_about
from geneva_cli.parts.turn.pairs import WorkLimit
from geneva_cli.parts.turn.turn_certificate import one_motion
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.study.synth.fast_parts import SPARE, USUAL, exact, parts, with_roller
from geneva_cli.study.synth.parts_data import parts_data
from geneva_cli.verdict.checks import checks
from geneva_cli.verdict.checks.all_checks import (
    LIMITS,
    MOTION,
    applicable,
    check_named,
    standing,
    standing_checks,
    turn_checks,
)
from geneva_cli.verdict.checks.check import Check, refused
from geneva_cli.verdict.checks.play_checks import finds_slot

# keys that conflict with a crank's bore
SHAFT = {"crank_shaft_mm", "crank_hub_mm", "crank_bore_wall_mm"}
UNDERCUT = "undercut_mm"
UNSIZED = {*MOTION, *LIMITS} - {UNDERCUT}  # checks that no other roller can mend
HAND_OVER_PLAY = "hand_over_play_deg"
# Times the play that lets a roller find its slot. With this much play between lock and slot no
# smaller roller helps. Of cams with 5 to 12 slots those up to 3.1 were mended by one, and none from
# 8.4 on.
LOST = 6.0


class Built(NamedTuple):
    """A spec, and the checks that fail in its parts, empty if none does."""

    spec: Spec
    trouble: str


def passes(spec: Spec) -> bool:
    """Return True if the parts pass every check with the sizes of the spec."""
    machine = build(spec)
    return not (_of_motion(machine) or Turn(machine).first_failing)


def built(spec: Spec, fixed: frozenset[str] = frozenset()) -> Built:
    """The spec with the first of some sizes with which its parts pass every check in a full turn.

    ``fixed`` are keys of its [size] that must not change. If no sizes pass, the spec is unchanged.
    """
    machine = build(spec)
    motion, turn = _of_motion(machine), Turn(machine)
    if {one.name for one in motion} & UNSIZED:  # no need to turn them
        return Built(spec, _names(motion))
    failing = known = [*motion, *turn.first_failing]
    if not failing:
        return Built(spec, "")
    if {one.name for one in failing} <= SHAFT:  # test whether other checks fail too
        failing = known = turn.failing
    for other in _others(spec, {one.name for one in failing}, fixed):
        if any(
            one.name == HAND_OVER_PLAY and (one.value or 0.0) > LOST * (one.limit or 0.0)
            for one in failing
        ):
            break
        failing = _other_failing(other, known)
        if not failing:
            return Built(other, "")
        known = [*{(one.name, one.at_deg): one for one in (*failing, *known)}.values()]
    return Built(spec, _names([*motion, *turn.failing]))


def _names(failing: Sequence[Check]) -> str:
    return ", ".join(one.name for one in failing)


def _failing(checks: Iterable[Check]) -> list[Check]:
    return [check for check in checks if check.passes is False]


def _of_motion(machine: Mechanism) -> list[Check]:
    return _failing(checks(machine, parts=False))


def _others(spec: Spec, trouble: set[str], fixed: frozenset[str]) -> Iterator[Spec]:
    """The machine with other sizes: smaller rollers, the nearest first, then larger ones.

    Larger ones are tried only if the sole failure is the wheel's play at the ends of a slot with
    different entry and exit paths: the roller's size then has less effect than their distance.
    """
    if "crank_bore_mm" not in fixed and trouble & SHAFT:
        spec = spec.with_("size.crank_bore_mm", 0.0)  # the shaft ends in the arm
        yield spec
    if trouble <= SHAFT or trouble & UNSIZED or "roller_radius_mm" in fixed:
        return
    L = build(spec).center_distance_mm
    r = spec.roller_radius_mm(L)
    least = island = SPARE * parts_data(spec).least if spec.is_flat else 0.0
    if spec.drive.LOCKS and spec.size.lock_radius_mm is None:
        least = max(least, wall_min(spec.size, L))  # a horn is no thicker than its roller's radius
    for other in [exact(0.01 * percent * L) for percent in USUAL]:
        if least <= other < r * (1.0 - 1e-9):
            yield with_roller(spec, other)
    if trouble <= {HAND_OVER_PLAY} and island:
        larger = [with_roller(spec, exact(0.01 * percent * L)) for percent in (8.0, 10.0)]
        yield from (one for one in larger if not parts(build(one)).why)


def _other_failing(spec: Spec, known: Sequence[Check]) -> list[Check]:
    """Some of the checks that fail with other sizes, after those ``known`` to fail before."""
    machine = build(spec)
    named = dict(LIMITS)
    if UNDERCUT in {one.name for one in known}:  # all of the motion that a roller changes
        named[UNDERCUT] = MOTION[UNDERCUT]
    return (
        _failing(applicable(named, machine))
        or Turn(machine).some_failing(known)
        or _of_motion(machine)
    )


class Turn:
    """The parts of a machine and their full turn, as far as it is checked."""

    def __init__(self, machine: Mechanism) -> None:
        self._machine, self._own = machine, parts_of(machine, advice=False)

    @property
    def failing(self) -> list[Check]:
        """The checks of the parts that fail, or the key that prevents the parts."""
        return [*self._standing, *self._turning]

    @property
    def first_failing(self) -> list[Check]:
        """The checks that fail at rest, or else those that fail in the turn."""
        return self._standing or self._turning

    def some_failing(self, known: Sequence[Check]) -> list[Check]:
        """Some checks that fail, tried first where checks were ``known`` to fail."""
        parts = self._parts
        if not isinstance(parts, Check) and self._machine.spec.has_parts:
            built, among = self._own.built, standing(self._machine)
            for one in known:
                check = check_named(among, one.name, built)
                if check and check.passes is False:
                    return [check]
            if still := [one for one in known if _fails_again(parts, one)]:
                return still
        return self.first_failing

    @cached_property
    def _parts(self) -> Parts | Check:
        """The parts, or a failing check that names the key that prevents them."""
        try:
            return self._own.turned
        except GenevaError as error:
            return refused(str(error.key[-1]) if error.key else "outline", error)

    @cached_property
    def _standing(self) -> list[Check]:
        if isinstance(self._parts, Check):
            return [self._parts]
        return _failing(standing_checks(self._own.built)) if self._machine.spec.has_parts else []

    @cached_property
    def _turning(self) -> list[Check]:
        parts = self._parts
        if isinstance(parts, Check):
            return []
        try:
            return _failing(turn_checks(parts, full_turn(one_motion(parts))))
        except WorkLimit as error:
            return [refused("full_turn", error)]


def _fails_again(parts: Parts, one: Check) -> bool:
    if one.at_deg is None:
        return False
    try:
        if one.name in ("gap_mm", "idle_roller_mm"):
            return gap_about(parts, one.at_deg) < -CLEARLY * parts.contact
        if one.name == HAND_OVER_PLAY:
            return play_about(parts, one.at_deg) > CLEARLY * finds_slot(parts)
    except WorkLimit:
        pass
    return False
