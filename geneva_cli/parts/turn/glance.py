"""Checks of a few positions of a full turn: a failure there is a failure of the whole turn."""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.parts.turn.free_angles import free_angles
from geneva_cli.parts.turn.machine_parts import MachineParts
from geneva_cli.parts.turn.play import windows

BESIDE = np.geomspace(0.01, 6.0, 14)  # degrees of the input on either side of a position


def gap_about(parts: MachineParts, shown_deg: float) -> float:
    """Return the smallest gap of any two parts, mm, at positions around one input angle.

    A few positions take the place of a whole turn, in a search for a size that clears the parts.
    """
    pose = parts.gaps.pose(_about(parts, shown_deg))
    gap = float(parts.gaps.rollers(pose).min())
    return min(gap, float(parts.gaps.locking(pose).min())) if parts.locked else gap


def play_about(parts: MachineParts, shown_deg: float) -> float:
    """Return the largest play, degrees, around an input angle while no roller is in its slot."""
    at = _about(parts, shown_deg)
    free = np.ones(len(at), dtype=bool)
    for start, end, motion, rests in windows(parts):
        here = np.flatnonzero((at >= start - SAME_INPUT_DEG) & (at <= end + SAME_INPUT_DEG))
        if len(here) and not rests:
            free[here] &= parts.past_mouth(motion, at[here]) <= -SAME_INPUT_DEG * parts.assembly.L
    if not free.any():
        return 0.0
    return math.degrees(float(np.maximum(*free_angles(parts, at[free])).max()))


def _about(parts: MachineParts, shown_deg: float) -> Array:
    """Return input angles around one, within the turn that starts at the first entry."""
    start, turn = parts.assembly.start_deg, parts.assembly.turn_deg
    place = parts.assembly.place_deg(shown_deg)
    offsets: Array = place + np.concatenate((-BESIDE, [0.0], BESIDE)) - start
    return start + offsets % turn
