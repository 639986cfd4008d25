"""Machines drawn at random, a block at a time: where their wheels are, and how they enter."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.locking import Lock
from geneva_cli.analysis.tolerance.dimensions import Draws
from geneva_cli.analysis.tolerance.entered import Entered
from geneva_cli.analysis.tolerance.led import Led

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

BLOCK = 32768  # machines at once: they stay in the processor's cache
ROUNDING_MM = 1e-12


class Drawn(NamedTuple):
    """Machines drawn at random, radians and speeds; empty where there is nothing to draw."""

    dwell: Array
    motion: Array
    jump: Array
    missed: float
    jams: float | None


def draw(
    machines: Draws,
    samples: int,
    held: Lock | None,
    lead: tuple[Led, float, float] | None,
    comes: Entered | None,
) -> Drawn:
    """So many machines: their lock, the leading of one engagement at one place, one entry.

    ``lead`` is the engagement, the input angle in degrees, and the side of the slot.
    """
    start = 0
    dwell, motion, jump = (np.zeros(samples) for _ in range(3))
    missed = jams = 0
    for by in machines.blocks(samples, BLOCK):
        part = slice(start, start + BLOCK)
        jam = np.zeros(len(dwell[part]), dtype=bool)
        if held:
            place = held(by)
            dwell[part] = (place.angle + by.slot_angle_deg).c[0]
            jam |= place.jams
        if lead:
            one, at, side = lead
            motion[part] = one(by, at, side).c[0] * side
            jam |= one.room(by).c[0] < -ROUNDING_MM
        if comes:
            jump[part], misses = comes(by)
            missed += int(np.broadcast_to(misses, jam.shape).sum())
        jams += int(jam.sum())
        start += BLOCK
    known = held or lead
    return Drawn(dwell, motion, jump, missed / samples, jams / samples if known else None)
