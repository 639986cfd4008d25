"""The checks that fail in full turns of machines."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import CLEARLY
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.parts.turn.full_turn import full_turn, gap_about, play_about
from geneva_cli.parts.turn.pairs import WorkLimit
from geneva_cli.parts.turn.turn_certificate import one_motion
from geneva_cli.verdict.checks.all_checks import check_named, standing, standing_checks, turn_checks
from geneva_cli.verdict.checks.check import Check, refused
from geneva_cli.verdict.checks.play_checks import finds_slot

HAND_OVER_PLAY = "hand_over_play_deg"
# Times the play that lets a roller find its slot. With this much play between lock and slot no
# smaller roller helps. Of cams with 5 to 12 slots those up to 3.1 were mended by one, and none from
# 8.4 on.
LOST = 6.0


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

    def some_failing(self, known: Iterable[Check]) -> list[Check]:
        """Some checks that fail, tried first where checks were ``known`` to fail."""
        return self._still_failing(known) or self.first_failing

    @cached_property
    def _parts(self) -> Parts | Check:
        """The parts, or a failing check that names the key that prevents them."""
        try:
            return self._own.turned
        except GenevaError as error:
            return refused(str(error.key[-1]) if error.key else "outline", error)

    @cached_property
    def _turning(self) -> list[Check]:
        """The checks of the turn that fail."""
        parts = self._parts
        if isinstance(parts, Check):
            return []
        try:
            return failing_of(turn_checks(parts, full_turn(one_motion(parts))))
        except WorkLimit as error:
            return [refused("full_turn", error)]

    @cached_property
    def _standing(self) -> list[Check]:
        """The checks at rest that fail."""
        if isinstance(self._parts, Check):
            return [self._parts]
        if not self._machine.spec.has_parts:
            return []
        return failing_of(standing_checks(self._own.built))

    def _still_failing(self, known: Iterable[Check]) -> list[Check]:
        """The first check of ``known`` at rest that fails, or else those of the turn.

        The latter are tried at the places where they failed.
        """
        parts = self._parts
        if isinstance(parts, Check) or not self._machine.spec.has_parts:
            return []
        built, among = self._own.built, standing(self._machine)
        at_rest = (check_named(among, one.name, built) for one in known)
        first = next((check for check in at_rest if check and check.passes is False), None)
        if first:
            return [first]
        return [one for one in known if _fails_at_the_same_place(parts, one)]


def is_lost(check: Check) -> bool:
    """Return True for so much play between lock and slot that no smaller roller helps."""
    return check.name == HAND_OVER_PLAY and (check.value or 0.0) > LOST * (check.limit or 0.0)


def failing_of(checks: Iterable[Check]) -> list[Check]:
    """The checks that fail."""
    return [check for check in checks if check.passes is False]


def _fails_at_the_same_place(parts: Parts, one: Check) -> bool:
    """Return True if a check that failed with other sizes fails with these at the same place."""
    if one.at_deg is None:
        return False
    try:
        if one.name in ("gap_mm", "idle_roller_mm"):
            return gap_about(parts, one.at_deg) < -CLEARLY * parts.contact
        if one.name == HAND_OVER_PLAY:
            return play_about(parts, one.at_deg) > CLEARLY * finds_slot(parts)
    except WorkLimit:
        return False
    return False
