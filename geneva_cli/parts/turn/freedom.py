"""How far the wheel can be turned from its position until parts touch, at given input angles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.parts.turn.turned import Stopped, Turned

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

EXACT = 1e-10  # radians: smaller angles are rounding


def search_deg(parts: Turned) -> float:
    """The largest play that is looked for, half a step: beyond it the wheel's position is lost."""
    return math.degrees(min(engagement.half_step for engagement, _ in parts.assembly.motions))


def free_angles(parts: Turned, at: Array, fits: bool = False) -> tuple[Array, Array]:
    """How far the wheel can be turned back and on at input angles (n,), radians, (n,) each."""
    back, on = stopped(parts, at, fits)
    return back.lead, on.lead


def stopped(parts: Turned, at: Array, fits: bool = False) -> tuple[Stopped, Stopped]:
    """What stops the wheel on its way back and on at input angles (n,), and where.

    ``fits`` says that nothing overlaps there; else it is looked for. Gears hold the wheel both
    ways where they drive it: their teeth are taken to fit.
    """
    gaps, close = parts.gaps, parts.close
    pose, held = gaps.pose(at), parts.assembly.geared(at)
    if not fits:  # where parts overlap as it stands there is no play
        held |= gaps.gap(pose, np.zeros(len(at)), close) < -close
    back, on = gaps.stops(pose, math.radians(search_deg(parts)), close)
    for each in (*back, *on):
        each[held] = 0.0
    return back, on


def touching(parts: Turned) -> float:
    """The largest play, radians, that may be none: parts that touch tangentially part slowly.

    It is the angle by which two circles of the rim's radius overlap by ``close``.
    """
    return math.sqrt(2.0 * parts.close / parts.sizes.rim)
