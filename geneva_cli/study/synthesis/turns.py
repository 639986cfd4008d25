"""What fails in the full turns of machines; those with the same parts are turned together.

A drive in front of a crank changes when the parts come to a position, and not the positions that
they go through: machines that differ in it, or in the speed, are turned once.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.turn.gaps import NotProved
from geneva_cli.parts.turn.glance import gap_about, loose_about
from geneva_cli.parts.turn.turned import Turned
from geneva_cli.study.synthesis.wish import USUAL_RPM
from geneva_cli.verdict.checks.check import Check
from geneva_cli.verdict.checks.play import finds_slot
from geneva_cli.verdict.checks.registry import shell_checks, static_checks, turn_checks

GAPS, LOOSE = {"gap_mm", "idle_roller_mm"}, {"hand_over_play_deg"}  # told by a few positions
CLEARLY = 1.0 + 1e-6  # times a limit: what is beyond it is so whatever the rounding


class Failing(NamedTuple):
    """A check that fails: the input angle of its value in the machine of ``same_turn``, and the
    value over its limit, 0 where there is no such share.
    """

    name: str
    at_deg: float | None = None
    share: float = 0.0


def same_turn(spec: Spec) -> Spec:
    """The machine that stands for all those whose parts go through the same positions."""
    drive = spec.drive
    if spec.motion is None and drive.CRANKED:
        m, angles = drive.rollers, drive.roller_angles_deg
        return spec.replace(drive=Crank(n_rpm=USUAL_RPM, rollers=m, roller_angles_deg=angles))
    return spec.replace(drive=drive.replace(n_rpm=USUAL_RPM))


class Turns:
    """Machines as they are turned, each once."""

    def __init__(self) -> None:
        self._proofs: dict[Spec, Proof] = {}
        self._shown: dict[Spec, list[Failing]] = {}

    def failing(self, machine: Mechanism, seen: Iterable[Failing] = ()) -> list[Failing]:
        """The checks of a machine's parts that fail; for parts that cannot be made the key in the
        way.

        With what has been ``seen`` to fail with other sizes, the first that is found to fail: what
        stands still, and the places where those failed, are looked at before a whole turn.
        """
        own = same_turn(machine.spec)
        if own not in self._proofs:
            stands = machine if own == machine.spec else build(own)
            self._proofs[own] = Proof(stands, advice=False)
        proof = self._proofs[own]
        try:
            parts: Any = proof.turned
        except GenevaError as error:
            return [Failing(str(error.key[-1]) if error.key else "outline")]
        turned = parts.assembly._replace(given=machine, to_input=machine.spec.drive.input_deg)
        parts = parts._replace(assembly=turned)
        flat = machine.spec.wheel.FLAT
        found = _failing(static_checks(parts) if flat else shell_checks(parts))
        if seen and (found or own not in self._shown):
            found = found or [one for one in seen if _fails_there(proof.turned, one)]
            if found:
                return found
        if own not in self._shown:
            try:
                self._shown[own] = _failing(turn_checks(proof.turned, proof.turn))
            except NotProved:
                self._shown[own] = [Failing("full_turn")]
        return [*found, *self._shown[own]]


def _failing(checks: Iterable[Check]) -> list[Failing]:
    return [
        Failing(c.name, c.at_deg, c.value / c.limit if c.value and c.limit else 0.0)
        for c in checks
        if c.passes is False
    ]


def _fails_there(parts: Turned, one: Failing) -> bool:
    """Whether a check that fails with other sizes does so with these at the same place."""
    if one.at_deg is None:
        return False
    try:
        if one.name in GAPS:
            return gap_about(parts, one.at_deg) < -CLEARLY * parts.contact
        if one.name in LOOSE:
            return loose_about(parts, one.at_deg) > CLEARLY * finds_slot(parts)
    except NotProved:
        return False
    return False
