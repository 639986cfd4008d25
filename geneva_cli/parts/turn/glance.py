"""A few positions of a full turn: what fails in them fails in the whole."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.parts.turn.freedom import free_angles
from geneva_cli.parts.turn.play import windows
from geneva_cli.parts.turn.turned import Turned

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

BESIDE = np.geomspace(0.01, 6.0, 14)  # degrees of the input, beside a place that is looked at
BEFORE = np.arange(1.0, 26.0)  # and before an entry: the larger the roller, the earlier is its play


def gap_about(parts: Turned, shown_deg: float) -> float:
    """The smallest gap of any two parts, mm, at positions about one input angle.

    A few positions instead of a whole turn: to look for a size that frees a machine there.
    """
    pose = parts.gaps.pose(_about(parts, shown_deg))
    gap = float(parts.gaps.rollers(pose).min())
    return min(gap, float(parts.gaps.locking(pose).min())) if parts.crank else gap


def loose_about(parts: Turned, shown_deg: float) -> float:
    """The largest play, degrees, at those of these positions where no roller is in its slot."""
    return _loose(parts, _about(parts, shown_deg))


def loose_before(parts: Turned) -> float:
    """The same at positions before an entry, where the lock lets go of the wheel."""
    start, turn = parts.assembly.start_deg, parts.assembly.turn_deg
    return _loose(parts, start + (-BEFORE) % turn)


def _loose(parts: Turned, at: Array) -> float:
    free = np.ones(len(at), dtype=bool)
    for start, end, motion, rests in windows(parts):
        here = np.flatnonzero((at >= start - SAME_INPUT_DEG) & (at <= end + SAME_INPUT_DEG))
        if len(here) and not rests:
            free[here] &= parts.past_mouth(motion, at[here]) <= -SAME_INPUT_DEG * parts.assembly.L
    if not free.any():
        return 0.0
    return math.degrees(float(np.maximum(*free_angles(parts, at[free])).max()))


def _about(parts: Turned, shown_deg: float) -> Array:
    """Input angles about one, as a full turn counts them."""
    start, turn = parts.assembly.start_deg, parts.assembly.turn_deg
    place = parts.assembly.place_deg(shown_deg)
    around: Array = place + np.concatenate((-BESIDE, [0.0], BESIDE)) - start
    return start + around % turn
