"""The motion as scripts write it: over the input angle, by hand, with ``math`` or ``numpy``.

The program is compared with these. Side-cranks have their stable form, so that a method is not
blamed for its formula. ``textbook`` is the form that handbooks print for a plain crank.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np


class Proportions(NamedTuple):
    """Sign of the gearing, l = R/L, A, and half the motion in radians; numbers or arrays."""

    sign: Any
    l: Any
    A: Any
    half: Any

    @classmethod
    def of(cls, sign: Any, z: Any, A: Any, m: Any = math) -> Proportions:
        """Proportions of one design by ``math``, or of a batch by NumPy."""
        b = m.pi / z
        crank = 0.5 * m.pi - sign * b
        return cls(sign, m.sin(b), A, crank + m.asin(A * m.sin(crank)))

    def blocks(self, method: Callable[[Proportions], Any]) -> Any:
        """Results of a method for batches, in blocks of designs that stay in the cache."""
        every, size = np.broadcast_arrays(*self), 4096
        starts = range(0, len(every[0]), size)
        return np.concatenate(
            [method(Proportions(*[v[i : i + size] for v in every])) for i in starts]
        )


def _parts(m: Any, d: Proportions, x: Any, order: int) -> tuple[Any, ...]:
    sine, cosine = m.sin(x), m.cos(x)
    half = m.sin(0.5 * x)
    W = (1.0 + d.A) ** 2 - 4.0 * d.A * half * half
    K = d.A * (1.0 - d.A * d.A)
    f = m.atan2(sine, d.A + cosine)
    f1 = 0.5 * (1.0 + (1.0 - d.A * d.A) / W)
    f2 = K * sine / (W * W)
    # internal is external with -l, seen from the other side
    l, sin_f, half_f = d.sign * d.l, m.sin(f), m.sin(0.5 * f)
    v = 2.0 * half_f * half_f
    D = (1.0 - l) ** 2 + 2.0 * l * v
    g1 = l * ((1.0 - l) - v) / D
    k = l * (1.0 - l) * (1.0 + l)
    g2 = -k * sin_f / (D * D)
    if order == 2:
        return f1, f2, g1, g2
    g3 = k * (v * (1.0 + 4.0 * l + l * l - 2.0 * l * v) - (1.0 - l) ** 2) / (D * D * D)
    f3 = K * ((1.0 + d.A * d.A) * cosine - 2.0 * d.A * cosine * cosine + 4.0 * d.A) / (W * W * W)
    return f1, f2, f3, g1, g2, g3


def rates(m: Any, d: Proportions, x: Any) -> tuple[Any, Any]:
    """Velocity and acceleration at x radians from mid-motion (up to the sign of the gearing)."""
    f1, f2, g1, g2 = _parts(m, d, x, 2)
    return g1 * f1, g2 * f1 * f1 + g1 * f2


def acceleration(m: Any, d: Proportions, x: Any) -> Any:
    """Acceleration at x radians from mid-motion (up to the sign of the gearing)."""
    return rates(m, d, x)[1]


def jerk(m: Any, d: Proportions, x: Any) -> Any:
    """Slope of the acceleration at x radians from mid-motion."""
    f1, f2, f3, g1, g2, g3 = _parts(m, d, x, 3)
    return g3 * f1 * f1 * f1 + 3.0 * g2 * f1 * f2 + g1 * f3


def textbook(l: Any, x: Any, orders: Sequence[int]) -> list[Any]:
    """Derivatives by the formulas of handbooks, over whole arrays; x in radians."""
    sine, cosine = np.sin(x), np.cos(x)
    D = 1.0 - 2.0 * l * cosine + l * l
    out = []
    if 0 in orders:
        out.append(np.arctan2(l * sine, 1.0 - l * cosine))
    if 1 in orders:
        out.append(l * (cosine - l) / D)
    if 2 in orders:
        out.append(-l * (1.0 - l * l) * sine / D**2)
    if 3 in orders:
        top = 4.0 * l - (1.0 + l * l) * cosine - 2.0 * l * cosine * cosine
        out.append(l * (1.0 - l * l) * top / (D * D * D))  # three times as quick as D**3
    return out
