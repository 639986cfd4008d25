"""Mean squares of the loads of an inertia alone, for motions that are symmetric.

Mirrored at mid-motion, an inertia's torque changes sign. Friction then acts as its negative would:
in the pair x and -x, it occurs once with either sign, whatever the roller's direction. So the sum
of both squares is smooth where the sliding reverses, and that place is not needed.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.analysis.contact import mirrored
from geneva_cli.analysis.forces import NEGLIGIBLE
from geneva_cli.analysis.load_functions import LoadFunctions, SignFunctions, signed_instant
from geneva_cli.analysis.quantities import square_of
from geneva_cli.analysis.stretches import spans_of
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Whole, all_true, array
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.pieces import gathered, spread
from geneva_cli.numerics.quadrature import Integrands, span_integrals
from geneva_cli.numerics.search import search


def is_balanced(load: LoadFunctions) -> bool:
    """Return True if the method applies to these designs.

    No torque may resist, and the only loss may be friction in straight slots. The friction of a
    rack's guide depends on the pin's side.
    """
    engagement, case, _ = load.batch
    alone = all_true(case.resists_Nm == 0.0) and all_true(case.efficiency == 1.0)
    return load.mirrored and alone and not (engagement.slot.curved or case.guided)


def squares(load: LoadFunctions, n: int) -> Array:
    """The integrals of the squares by the angle in radians, of ``is_balanced`` designs: (names, n).

    Infinite where friction holds the wheel.
    """
    engagement = load.engagement
    frictionless = load.batch._replace(case=load.batch.case._replace(friction=0.0))
    rolling = LoadFunctions(frictionless, load.names)
    spans, torque = spans_of(engagement, n), SignFunctions(rolling)
    half = spans[: len(spans) // 2]
    pieces = search(torque, half, n, False, w=load.spread).stretches
    design, (a, b), w = pieces.design, pieces.x, load.spread[pieces.design, 0]
    signs = np.full((load.signs, len(design), 1), np.nan)
    signs[: rolling.signs, :, 0] = np.where(pieces.positive, 1.0, -1.0)
    bounded = np.full((load.wanted, n), True)

    def rows(u: Array, which: Whole) -> Array:
        x, rate = gathered(u, w[which, None])
        x = np.clip(x, a[which, None], b[which, None])
        case, at, shape, wanted = load.at(x, design[which], 0)
        total = np.zeros((load.wanted, *shape[::-1])).swapaxes(1, 2)
        for step, here in ((1, at), (-1, mirrored(at))):
            instant = signed_instant(load.kinds, case, here, step * signs[:, which]).instant
            for k, (name, quantity) in enumerate(zip(load.names, wanted, strict=True)):
                row = quantity(instant, here)
                total[k] += square_of(array(row.value.c[0]), name)[:, ::step]
                if row.margin is not None:  # an unbounded function is not evaluated again
                    lost = np.any(row.margin.c[0] <= NEGLIGIBLE, axis=1)
                    bounded[k, design[which[lost]]] = False
        return total * rate

    with np.errstate(all="ignore"):
        total = span_integrals(Integrands(rows, spread(a, w), spread(b, w)), design, bounded)
    return np.where(bounded, total * DEGREE, np.inf)
