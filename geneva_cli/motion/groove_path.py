"""The path of a roller along the fixed groove of a cam-Geneva, over a whole turn."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Number, piece_of, smaller
from geneva_cli.numerics.jet import Jet, piecewise, sin_cos

if TYPE_CHECKING:
    from geneva_cli.motion.given_motion import SolvedPath
    from geneva_cli.numerics.jet import Path

EASED_DEG = 30.0  # of the input: range in which the groove joins its arc in the dwell


def roller_in_groove(groove: SolvedPath, input_deg: Array) -> Array:
    """Return the roller's centre over a whole turn, in units of L from the wheel's axis: (n, 2)."""
    R, angle = distances(groove, input_deg, 0)[0], np.radians(input_deg)
    return np.column_stack((1.0 - groove.sign * R * np.cos(angle), R * np.sin(angle)))


def path_over_turn(
    groove: SolvedPath, moving: Path, input_deg: Number, order: int
) -> tuple[Jet, Jet]:
    """Roller (x, y), in units of L, at input angles up to half a turn from mid-motion.

    ``moving`` is the path in the motion.
    """
    part = piece_of(input_deg, (groove.motion.entry_deg, groove.motion.exit_deg))
    if part == 1:
        return moving(input_deg, order)
    at = input_deg if part else input_deg + 360.0  # in the dwell after the motion
    R = in_dwell(groove, at, order)
    s, c = sin_cos(Jet.variable(radians(at), order))
    return 1.0 - R * c * groove.sign, R * s


def distances(groove: SolvedPath, input_deg: Array, order: int = 2) -> tuple[Array, ...]:
    """The roller's distance from the crank's axis, with derivatives by the input in radians.

    In the dwell the slope fades over some degrees beyond either end; between, the groove is an arc
    about the crank's axis. If the two ends lead to different arcs, a 3-4-5 curve joins them. The
    second derivative is continuous all round.
    """
    at = (input_deg - groove.motion.entry_deg) % 360.0 + groove.motion.entry_deg

    def moving(x: Number) -> Jet:
        return groove.distances(x, order)[1]

    rests = partial(in_dwell, groove, order=order)
    return piecewise(at, (groove.motion.exit_deg,), (moving, rests)).derivatives()


def in_dwell(groove: SolvedPath, input_deg: Number, order: int) -> Jet:
    """That distance at input angles in the dwell after the motion."""
    wide_deg = 360.0 - (groove.motion.exit_deg - groove.motion.entry_deg)
    eased_deg, since_deg = smaller(EASED_DEG, wide_deg / 3.0), input_deg - groove.motion.exit_deg
    entry, exit_ = groove.ends
    after, first = _eased(exit_, 1.0, eased_deg, since_deg, order)
    before, last = _eased(entry, -1.0, eased_deg, wide_deg - since_deg, order)

    def step(x: Number) -> Jet:
        u = Jet.variable(radians(x - eased_deg), order) / radians(wide_deg - 2.0 * eased_deg)
        return u * u * u * (10.0 - u * (15.0 - u * 6.0)) * (last - first) + first

    # Each fades to a level before the other begins; a step goes from one level to the other.
    level, other = (partial(_level, one, order) for one in (first, last))
    cuts = eased_deg, wide_deg - eased_deg
    return after + before - first - last + piecewise(since_deg, cuts, (level, step, other))


def _eased(
    end: Sequence[Number], sense: float, wide_deg: float, beyond_deg: Number, order: int
) -> tuple[Jet, Number]:
    """Distance at angles beyond an end of the motion, and the level to which it fades."""
    R, slope, bend = end[0], sense * end[1], end[2]
    length = radians(wide_deg)
    m = bend * length
    level = R + length * (0.5 * slope + m / 12.0)

    def near(x: Number) -> Jet:
        u = Jet.variable(sense * radians(x), order) * (sense / length)
        high = u * (0.5 * slope + 0.25 * m) - (slope + 2.0 / 3.0 * m)
        return u * (u * (u * high + 0.5 * m) + slope) * length + R

    return piecewise(beyond_deg, (wide_deg,), (near, partial(_level, level, order))), level


def _level(level: Number, order: int, x: Number) -> Jet:
    """A constant at some places."""
    return Jet((level + x * 0.0, *[x * 0.0] * order))
