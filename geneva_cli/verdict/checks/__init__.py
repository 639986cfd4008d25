"""The checks of a design, each with its value and its limit.

A check is one file, or a function in a file of like ones, and one line in ``registry``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.spec.tables import Z_DRAWN
from geneva_cli.verdict.checks.check import Check as Check
from geneva_cli.verdict.checks.check import all_pass as all_pass
from geneva_cli.verdict.checks.registry import (
    LIMITS,
    MOTION,
    check_named,
    motion_checks,
    shell_checks,
    static_checks,
    turn_checks,
)

if TYPE_CHECKING:
    from geneva_cli.parts.proof import Proof


def checks(mechanism: Mechanism, proof: Proof | None = None, parts: bool = True) -> list[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``."""
    motion = list(motion_checks(MOTION, mechanism))
    shown = list(_parts(mechanism, proof)) if parts else []
    return [*motion, *shown, *motion_checks(LIMITS, mechanism)]


def checks_quick_first(mechanism: Mechanism, parts: bool = True) -> Iterator[Check]:
    """The same checks one after the other, those that take longest last."""
    yield from motion_checks(MOTION, mechanism)
    yield from motion_checks(LIMITS, mechanism)
    if parts:
        yield from _parts(mechanism)


def single_check(mechanism: Mechanism, name: str) -> Check | None:
    """The check of this name, without making the others; None if the design has no such check."""
    for among in (MOTION, LIMITS):
        found = check_named(among, name, mechanism)
        if found:
            return found
    return next((c for c in _parts(mechanism) if c.name == name), None)


def _parts(mechanism: Mechanism, proof: Proof | None = None) -> Iterator[Check]:
    """Walls, shafts and the full turn of a machine whose parts are drawn.

    Where the parts cannot be made, or turned, one check says so in place of the rest.
    """
    if not mechanism.spec.has_parts:
        why = f"not proved: wheels of more than {Z_DRAWN} slots are not drawn"
        yield Check("parts", None, "proved", None, None, why)
        return
    from geneva_cli.parts.proof import Proof
    from geneva_cli.parts.turn.gaps import NotProved

    proof = proof or Proof(mechanism)
    try:
        flat = mechanism.spec.wheel.FLAT
        rows = list(static_checks(proof.found) if flat else shell_checks(proof.shells))
    except GenevaError as error:
        yield Check("parts", 0.0, "at least", 1.0, False, str(error))
        return
    yield from rows
    try:
        turn = proof.turn
    except NotProved as error:
        yield Check("full_turn", 0.0, "at least", 1.0, False, str(error))
        return
    yield from turn_checks(proof.turned, turn)
