"""The least slack with which a wheel that jams would turn: how much too tight it is."""

from __future__ import annotations

import math

from geneva_cli.extras.outline.machine import DrawnMachine
from geneva_cli.extras.outline.turning import SENSES, Turned, goes_on, one_sense, put_back
from geneva_cli.parts.turn.lazy_turn import STEPS, Turner

MOST = 0.02  # of L, and at most half a roller's radius: with more it is another wheel
CLOSE = 1.02  # of the greatest slack with which it jams: closer is not asked
HALVINGS = 12


def least_slack_mm(result: Turned) -> float | None:
    """Return the least slack with which the wheel turns, mm: that which it has if it turns.

    It is known within 2 %, and turns with what is returned. None if it does not turn with 0.02 L,
    or half a roller's radius.

    Source: bisection of the slack's logarithm.
    """
    machine = result.machine
    low = machine.free.slack
    if result.turns and result.rest.is_free:
        return low
    high = most_mm(machine)
    if high <= low or not _turns(machine, high):
        return None
    for _ in range(HALVINGS):
        if high <= CLOSE * low:
            break
        middle = math.sqrt(low * high)
        low, high = (low, middle) if _turns(machine, middle) else (middle, high)
    return high


def most_mm(machine: DrawnMachine) -> float:
    """Return the greatest slack that is tried, mm."""
    return min(MOST * machine.assembly.L, 0.5 * machine.roller.radius)


def _turns(machine: DrawnMachine, slack: float) -> bool:
    """Whether it turns in both senses from the middle of its dwell, with another slack."""
    turner = Turner(machine.free.with_slack(slack), machine.start, STEPS // 2)
    rest = turner.rest(machine.rest)
    if not rest.is_free:
        return False
    for way in SENSES:
        sense = one_sense(turner, machine, way, put_back(machine, rest), exact=False)
        if sense.jam is not None or not goes_on(machine, sense.first, way):
            return False
    return True
