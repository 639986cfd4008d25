"""How long it lasts: sliding and wear of the slot, turns of the roller, stress in pin and horn."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geneva_cli.analysis.loads.cycle import Cycle

NAMES = (
    "slot_travel_m",
    "roller_turns_per_motion",
    "equivalent_force_N",
    "friction_work_J",
    "pv_max_W_m2",
    "pin_stress_MPa",
    "horn_stress_MPa",
)


def life(cycle: Cycle) -> tuple[dict[str, float | None], list[str]]:
    """The values of ``life`` by their names, and what would give those that are None.

    ``cycle`` has the machine (``cycle.mechanism``, whose ``spec`` has sizes and materials), exact
    ``extremes`` and ``integrals`` of anything made of an ``Instant`` (by the input angle in
    radians, over a period), and ``cycle.given``.
    """
    return dict.fromkeys(NAMES), []
