"""The path of a roller along the fixed groove of a cam-Geneva, over a whole turn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Number, smaller

if TYPE_CHECKING:
    from geneva_cli.motion.given_motion import SolvedPath

EASED_DEG = 30.0  # of the input: range in which the groove joins its arc in the dwell


def roller_in_groove(groove: SolvedPath, input_deg: Array) -> Array:
    """Return the roller's centre over a whole turn, in units of L from the wheel's axis: (n, 2)."""
    R, angle = distances(groove, input_deg, 0)[0], np.radians(input_deg)
    return np.column_stack((1.0 - groove.sign * R * np.cos(angle), R * np.sin(angle)))


def dwell_rates(groove: SolvedPath) -> tuple[float, float]:
    """Return bounds of the sizes of a roller path's two derivatives in the dwell, in units of L.

    They are those of the parts that ``back`` adds, each at its greatest: u (1 - u)² reaches 4/27,
    (1 - u) (1 - 3 u) lies between -1/3 and 1, and the step's derivatives reach 15/8 and 10/sqrt(3).
    """
    span = radians(360.0 - (groove.motion.exit_deg - groove.motion.entry_deg))
    eased = smaller(math.radians(EASED_DEG), span / 3.0)
    none, far, slope, bend = np.zeros(1), 0.0, 0.0, 0.0
    levels = []
    for end, sense in zip(groove.ends, (-1.0, 1.0), strict=True):
        R, first, second = (float(x) for x in end)
        levels.append(float(_eased(end, eased, none, sense)[3]))
        m = abs(second) * eased
        far = max(far, abs(R)) + eased * (abs(first) + m)
        slope = max(slope, abs(first) + 4.0 / 27.0 * m)
        bend = max(bend, (1.5 * abs(first) + m) / eased)
    rise, length = abs(levels[0] - levels[1]), span - 2.0 * eased
    slope = max(slope, 1.875 * rise / length)
    bend = max(bend, 10.0 / math.sqrt(3.0) * rise / length**2)
    return math.hypot(slope, far), bend + 2.0 * slope + far


def distances(groove: SolvedPath, input_deg: Array, order: int = 2) -> list[Array]:
    """Return the roller's distance from the crank's axis, with derivatives by the input in radians.

    There are ``order`` derivatives, at most two. In the dwell the slope fades over some degrees
    beyond either end; between, the groove is an arc about the crank's axis. If the two ends lead to
    different arcs, a 3-4-5 curve joins them. The second derivative is continuous all round.
    """
    at = (input_deg - groove.motion.entry_deg) % 360.0 + groove.motion.entry_deg
    moving = at <= groove.motion.exit_deg
    out = [np.empty(len(at)) for _ in range(order + 1)]
    for here in (moving, ~moving):
        if here.any():
            if here is moving:
                values = [*groove.distances(at[here], order)[1].arrays()]
            else:
                values = back(groove, at[here], order)
            for column, own in zip(out, values, strict=True):
                column[here] = own
    return out


def back(groove: SolvedPath, input_deg: Array, order: int) -> list[Array]:
    """Return distance and derivatives at input angles in the dwell; see ``distances``."""
    span = radians(360.0 - (groove.motion.exit_deg - groove.motion.entry_deg))
    eased = smaller(math.radians(EASED_DEG), span / 3.0)
    t = np.radians(input_deg - groove.motion.exit_deg)
    entry, exit_ = groove.ends
    after = _eased(exit_, eased, t, 1.0)
    before = _eased(entry, eased, span - t, -1.0)
    # Each fades to a constant before the other begins; the step goes from one level to the other.
    length, rise = span - 2.0 * eased, before[3] - after[3]
    u = np.clip((t - eased) / length, 0.0, 1.0)
    step = (
        u**3 * (10.0 - 15.0 * u + 6.0 * u * u),
        30.0 * (u * (1.0 - u)) ** 2 / length,
        60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / length**2,
    )
    out = [a + b + rise * s for a, b, s in zip(after[:3], before[:3], step, strict=True)]
    out[0] -= before[3]
    return out[: order + 1]


def _eased(
    end: Sequence[Number], length: float, t: Array, sense: float
) -> tuple[Array, Array, Array, Number]:
    """Return distance and two derivatives ``t`` beyond an end, and the distance it fades to."""
    R, slope, bend = end[0], sense * end[1], end[2]
    u = np.minimum(t / length, 1.0)
    m = bend * length
    run = slope * (u - u**3 + 0.5 * u**4) + m * (0.5 * u**2 - 2.0 / 3.0 * u**3 + 0.25 * u**4)
    rate = slope * (1.0 - u) ** 2 * (1.0 + 2.0 * u) + m * u * (1.0 - u) ** 2
    turn = (-6.0 * slope * u * (1.0 - u) + m * (1.0 - u) * (1.0 - 3.0 * u)) / length
    level = R + length * (0.5 * slope + m / 12.0)
    return R + length * run, sense * rate, turn, level
