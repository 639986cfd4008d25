"""A motion as a pure shape: the fraction s of the step by the fraction u of the motion's time."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.loads.vibration.panels import Panels, panels_of
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import WheelMotion
from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Number, Whole, read_only
from geneva_cli.numerics.jet import Jet

if TYPE_CHECKING:
    # The wheel's angles, and the numbers of their designs -> another value of each.
    AngleFunction = Callable[[Jet, Whole], Jet]


@lru_cache(maxsize=64)
def shape(motion: WheelMotion) -> Panels:
    """Return the panels of one motion."""
    return read_only(motion_shapes(motion, 1))


@lru_cache(maxsize=64)
def law_shape(law: Law) -> Panels:
    """Return the panels of a motion law."""

    def derivatives(u: Array, _: Whole, order: int) -> Array:
        return _by_order(law(u, order).c, 1.0, u)

    return read_only(panels_of(derivatives, np.array([sorted({0.0, *law.knots, 0.5, 1.0})])))


def motion_shapes(motion: WheelMotion, m: int, function: AngleFunction | None = None) -> Panels:
    """Return the panels of the motions of m designs, or of a ``function`` of their angles."""
    of_designs = selection(motion)

    def derivatives(u: Array, which: Whole, order: int) -> Array:
        some: WheelMotion = of_designs(which)
        whole, step = some.exit_deg - some.entry_deg, 2.0 * some.half_step
        angle = some(some.entry_deg + u * whole, order)
        c = (function(angle, which) if function else angle).c
        return _by_order([v / step for v in c], whole * DEGREE, u)

    every = np.hstack(motion.breaks(m))
    return panels_of(derivatives, (every - every[:, :1]) / (every[:, -1:] - every[:, :1]))


def _by_order(c: Sequence[Number], rate: float, u: Array) -> Array:
    """Return derivatives 1, 2, ... from Taylor coefficients by ``rate`` times the variable."""
    rows = [v * (math.factorial(k) * rate**k) for k, v in enumerate(c) if k]
    return np.array([np.broadcast_to(v, u.shape) for v in rows])
