"""The classic wheels over arrays: closed forms in tan(a/2), in place.

With t = tan(a/2), T = t², and (p, q) = (1-l, 1+l) outside, (1+l, 1-l) inside, both gearings are

    P    = p² + q² T
    psi  = atan(2 l t / (p + q T))
    psi1 = l (p - q T) / P
    psi2 = - 2 l (1-l²) t (1+T) / P²
    psi3 = l (1-l²) (1+T) (q² T² +- 12 l T - p²) / P³

Nothing cancels here as l nears 1, and one tangent is the only trigonometric function.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array


def derivatives(
    sign: float, l: float, rest: float, input_deg: Array, orders: Sequence[int]
) -> list[Array]:
    """Wheel angle (order 0) and its derivatives (1 to 3) at input angles in degrees, (k,) each.

    ``sign`` is +1 for an external wheel, -1 for an internal one; l = sin b, and ``rest`` = 1 - l.
    Each is accurate to a few units in the last place of its peak. Only the requested orders are
    computed.
    """
    tan, square, inverse, spare = np.empty((4, len(input_deg)))
    out = [np.empty(len(input_deg)) for _ in orders]
    p, q = (rest, 1.0 + l) if sign > 0.0 else (1.0 + l, rest)
    scale = l * rest * (1.0 + l)
    np.multiply(input_deg, 0.5 * DEGREE, out=tan)
    np.tan(tan, out=tan)
    np.multiply(tan, tan, out=square)
    np.multiply(square, q * q, out=inverse)
    inverse += p * p
    np.reciprocal(inverse, out=inverse)
    for order, to in zip(orders, out, strict=True):
        if order == 0:
            np.multiply(square, q, out=spare)
            spare += p
            np.divide(tan, spare, out=to)
            to *= 2.0 * l
            np.arctan(to, out=to)
        elif order == 1:
            np.multiply(square, -l * q, out=to)
            to += l * p
            to *= inverse
        elif order == 2:
            np.add(square, 1.0, out=to)
            to *= tan
            to *= inverse
            to *= inverse
            to *= -2.0 * scale
        else:
            np.multiply(square, q * q, out=to)
            to += sign * 12.0 * l
            to *= square
            to -= p * p
            np.add(square, 1.0, out=spare)
            to *= spare
            to *= inverse
            to *= inverse
            to *= inverse
            to *= scale
    return out
