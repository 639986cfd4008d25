"""The checks of flat parts, as they stand and as they turn: one line each, in the order shown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.turn.full_turn import FullTurn
from geneva_cli.verdict.checks import arm, branches, play, shafts, touching, walls
from geneva_cli.verdict.checks.check import Check

# A check by its name; None where these parts have nothing of the kind.
OfParts: TypeAlias = Callable[[str, Outlines], Check | None]
OfTurn: TypeAlias = Callable[[str, Outlines, FullTurn], Check | None]

STANDING: dict[str, OfParts] = {
    "wall_between_slots_mm": walls.between_slots,
    "horn_mm": walls.horn,
    "wheel_bore_wall_mm": walls.wheel_bore,
    "outer_wall_mm": walls.outside,
    "crank_bore_wall_mm": walls.crank_bore,
    "crank_shaft_mm": shafts.crank_shaft,
    "crank_hub_mm": shafts.crank_hub,
    "wheel_shaft_mm": shafts.wheel_shaft,
    "arm_wall_mm": arm.arm_wall,
    "arm_to_hub_mm": arm.arm_to_hub,
    "branches_apart_mm": branches.apart,
    "branches_crossed_mm": branches.crossed,
}

TURNING: dict[str, OfTurn] = {
    "dwell_hold": play.dwell_hold,
    "gap_mm": touching.smallest_gap,
    "idle_roller_mm": touching.idle_roller,
    "dwell_play_deg": play.dwell,
    "hand_over_play_deg": play.hand_over,
    "hand_over_pressure_deg": play.hand_over_pressure,
    "motion_play_deg": play.motion,
}


def standing(found: Outlines) -> Iterator[Check]:
    """The checks of the parts as they stand."""
    yield from (check for name, ask in STANDING.items() if (check := ask(name, found)))


def turning(found: Outlines, turn: FullTurn) -> Iterator[Check]:
    """What a whole turn shows: no parts overlap, the wheel is held, pushed into line and led."""
    yield from (check for name, ask in TURNING.items() if (check := ask(name, found, turn)))
