"""The gaps between parts in a whole turn."""

from __future__ import annotations

from geneva_cli.collisions.full_turn import FullTurn
from geneva_cli.collisions.machine_parts import MachineParts
from geneva_cli.verdict.checks.check import Check, compared


def smallest_gap(name: str, parts: MachineParts, turn: FullTurn) -> Check:
    """The smallest gap between wheel and crank, mm, negative where they overlap."""
    smallest, touch = turn.smallest, parts.contact
    value = 0.0 if abs(smallest.mm) <= touch else smallest.mm
    return compared(name, value, "at least", 0.0, smallest.at_deg, touch)


def idle_roller(name: str, parts: MachineParts, turn: FullTurn) -> Check | None:
    """The smallest gap between the wheel and a roller that does not drive it."""
    idle, touch = turn.idle, parts.contact
    if idle is None:
        return None
    gap = max(idle.mm, 0.0) if idle.mm >= -touch else idle.mm
    return compared(name, gap, "at least", 0.0, idle.at_deg, touch)
