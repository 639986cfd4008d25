"""The clearances that ``[tolerance]`` needs, and the turn of the tightest and loosest machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.full_turn import FullTurn
from geneva_cli.spec.tables import Tolerance
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.verdict.tolerance.needed import LeastClearances


def slot_clearance(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The clearance per side of the slots, against what the tolerances need."""
    least = _least(parts)
    return least and _enough(name, "slot_clearance_mm", parts, least.slot_mm)


def lock_clearance(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The clearance per side of the lock, against what the tolerances need."""
    least = _least(parts)
    return least and _enough(name, "lock_clearance_mm", parts, least.lock_mm)


def extremes_turn(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """Check that the tightest and the loosest machine turn, if their clearances are enough."""
    least = _least(parts)
    if least is None or least.short(parts.assembly.full.spec):
        return None
    turns, why = least.turns()
    return Check(name, None if turns is None else float(turns), "at least", 1.0, turns, why)


def _enough(name: str, key: str, parts: Parts, needed: float | None) -> Check | None:
    if needed is None:  # no disc holds the wheel
        return None
    own = getattr(parts.assembly.full.spec.size.allowances, key)
    return compared(name, own, "at least", needed)


def _least(parts: Parts) -> LeastClearances | None:
    """What the tolerances need; None without tolerances, or where none are computed."""
    machine = parts.assembly.full
    tolerance = machine.spec.tolerance
    none = tolerance == Tolerance(distribution=tolerance.distribution)
    if none or not machine.output.turns:
        return None
    # a spec without tolerances is checked without their modules
    from geneva_cli.loads.tolerance.worst_effects import used
    from geneva_cli.verdict.tolerance.needed import least_clearances

    return least_clearances(machine, parts, used(machine))
