"""Checks that fail in full turns of machines; machines with equal positions are turned once.

A drive in front of a crank changes when the parts reach a position, and not the positions. So
machines that differ in it, or in the speed, are turned once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.keeps import keeps
from geneva_cli.numerics.tolerances import CLEARLY
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.bounding_outlines import bounding_outlines
from geneva_cli.parts.crank import rollers_gap
from geneva_cli.parts.model import PartsModel
from geneva_cli.parts.outlines import drawn
from geneva_cli.parts.relief_overlap import leave_no_disc
from geneva_cli.parts.sizes import Sizes, sizes
from geneva_cli.parts.turn.full_turn import turning
from geneva_cli.parts.turn.gaps import WorkLimit
from geneva_cli.parts.turn.glance import gap_about, play_about, play_before_entry
from geneva_cli.parts.turn.machine_parts import MachineParts
from geneva_cli.parts.turn.one_motion import one_motion
from geneva_cli.study.synthesis.target import USUAL_RPM
from geneva_cli.verdict.checks.check import Check
from geneva_cli.verdict.checks.play import finds_slot
from geneva_cli.verdict.checks.registry import standing_checks, turn_checks

# checks that a few positions can decide
GAPS, LOOSE = {"gap_mm", "idle_roller_mm"}, {"hand_over_play_deg"}
# Times the play that lets a roller find its slot. If the wheel is this loose between lock and slot,
# no smaller roller helps. Of cams with 5 to 12 slots those up to 3.1 were mended by one, and none
# from 8.4 on.
LOST = 6.0
# From here on the true play may exceed LOST, so it must be computed precisely. Of 108 wheels with a
# law, outlines with more material had an error below this.
NEARLY = 0.5 * LOST


class Failing(NamedTuple):
    """A failing check: its name, its input angle in the machine of ``same_turn``, its ratio.

    ``share`` is the value over its limit, 0 if there is no such ratio.
    """

    name: str
    at_deg: float | None = None
    share: float = 0.0

    def looser(self, share: float) -> bool:
        """Return True if the play between lock and slot exceeds ``share`` times its limit."""
        return self.name in LOOSE and self.share > share


def same_turn(spec: Spec) -> Spec:
    """The machine that represents all machines whose parts go through the same positions."""
    drive = spec.drive
    if spec.motion is None and drive.CRANKED:
        m, angles = drive.rollers, drive.roller_angles_deg
        return spec.replace(drive=Crank(n_rpm=USUAL_RPM, rollers=m, roller_angles_deg=angles))
    return spec.replace(drive=drive.replace(n_rpm=USUAL_RPM))


class Turns:
    """Machines as they are turned, each once."""

    def __init__(self) -> None:
        self._turns: dict[Spec, _Turn] = {}

    def failing(self, machine: Mechanism) -> list[Failing]:
        """The checks of a machine's parts that fail, or the key that prevents the parts."""
        turn = self._turn(machine)
        return [*turn.standing(machine), *turn.every()]

    def first_failing(self, machine: Mechanism) -> list[Failing]:
        """The checks that fail at rest, or else the first found to fail in the turn."""
        turn = self._turn(machine)
        return turn.undrawn() or turn.standing(machine) or turn.first()

    def some_failing(self, machine: Mechanism, seen: Iterable[Failing]) -> list[Failing]:
        """Some checks that fail, tried first where checks were ``seen`` to fail."""
        turn = self._turn(machine)
        early = turn.undrawn() or turn.overlapping() or turn.loose() or turn.again(seen)
        return early or turn.standing(machine) or turn.first()

    def _turn(self, machine: Mechanism) -> _Turn:
        own = same_turn(machine.spec)
        if own not in self._turns:
            self._turns[own] = _Turn(machine if own == machine.spec else build(own))
        return self._turns[own]


class _Turn:
    """The parts of a machine and their full turn, as far as it is checked."""

    def __init__(self, machine: Mechanism) -> None:
        self._machine = machine
        self._failing: list[Failing] = []
        self._begun = False

    @cached_property
    def _made(self) -> MachineParts | Failing:
        """The parts, or the key that prevents them."""
        try:
            return (
                drawn(*self._sized)
                if self._sized
                else PartsModel(self._machine, advice=False).parts
            )
        except GenevaError as error:
            return _in_the_way(error)

    @cached_property
    def _closer(self) -> Iterator[list[Failing]]:
        return iter(()) if isinstance(self._made, Failing) else _looks(self._made)

    @cached_property
    def _sized(self) -> tuple[Assembly, Sizes] | None:
        """The assembly and the sizes of flat parts; None for other machines."""
        if not self._machine.spec.wheel.FLAT:
            return None
        try:
            where = assembly(self._machine)
            return where, sizes(where)
        except GenevaError:
            return None

    def undrawn(self) -> list[Failing]:
        """The key that prevents the parts, if nothing is left of the locking disc.

        This is known before the parts are drawn.
        """
        no_disc = self._sized is not None and leave_no_disc(*self._sized)
        return [Failing("roller_radius_mm")] if no_disc else []

    def overlapping(self) -> list[Failing]:
        """The check of two rollers on one crank that overlap, which needs no walls."""
        gap = rollers_gap(*self._sized) if self._sized else None
        return [] if gap is None or keeps(gap, "at least", 0.0) else [Failing("rollers_apart_mm")]

    def loose(self) -> list[Failing]:
        """The play between lock and slot from simpler outlines, or the key that prevents parts.

        These have more material than the parts. A wheel near the limit LOST must be drawn.
        """
        try:
            more = bounding_outlines(*self._sized) if self._sized else None
        except GenevaError as error:
            return [_in_the_way(error)]
        (name,) = LOOSE
        found = Failing(name, share=play_before_entry(more) / finds_slot(more) if more else 0.0)
        return [found] if found.share > CLEARLY and not found.looser(NEARLY) else []

    def standing(self, machine: Mechanism) -> list[Failing]:
        """The checks at rest that fail, for a machine with the same positions."""
        if isinstance(self._made, Failing):
            return [self._made]
        own = self._made.assembly._replace(full=machine, to_input=machine.spec.drive.input_deg)
        return _failing(standing_checks(self._made.over(own)))

    def every(self) -> list[Failing]:
        """All checks of the turn that fail."""
        while self._look():
            pass
        return self._failing

    def first(self) -> list[Failing]:
        """The first checks found to fail; closer sampling only reduces gaps and increases play."""
        while not self._sure() and self._look():
            pass
        return self._failing

    def again(self, seen: Iterable[Failing]) -> list[Failing]:
        """The checks among ``seen`` that fail at the same place, if the turn is not sampled yet."""
        parts = self._made
        if self._begun or isinstance(parts, Failing):
            return []
        return [one for one in seen if _fails_there(parts, one)]

    def _sure(self) -> bool:
        """Return True if a check fails, and the play is known to be below or above LOST."""
        nearly = any(one.looser(NEARLY) and not one.looser(LOST) for one in self._failing)
        return bool(self._failing) and not nearly

    def _look(self) -> bool:
        """Sample the turn more closely; return False if that is no longer possible."""
        found = next(self._closer, None)
        if found is None:
            return False
        self._begun, self._failing = True, found
        return True


def _in_the_way(error: GenevaError) -> Failing:
    """The key that an error about parts names."""
    return Failing(str(error.key[-1]) if error.key else "outline")


def _looks(parts: MachineParts) -> Iterator[list[Failing]]:
    """The checks of a turn that fail, at ever closer sampling."""
    try:
        for turn in turning(one_motion(parts)):
            yield _failing(turn_checks(parts, turn))
    except WorkLimit:
        yield [Failing("full_turn")]


def _failing(checks: Iterable[Check]) -> list[Failing]:
    return [
        Failing(c.name, c.at_deg, c.value / c.limit if c.value and c.limit else 0.0)
        for c in checks
        if c.passes is False
    ]


def _fails_there(parts: MachineParts, one: Failing) -> bool:
    """Return True if a check that failed with other sizes fails with these at the same place."""
    if one.at_deg is None:
        return False
    try:
        if one.name in GAPS:
            return gap_about(parts, one.at_deg) < -CLEARLY * parts.contact
        if one.name in LOOSE:
            return play_about(parts, one.at_deg) > CLEARLY * finds_slot(parts)
    except WorkLimit:
        return False
    return False
