"""The motion as scripts write it: over the input angle, by hand, with ``math`` or ``numpy``.

The program is compared with these. They are in their stable form, so that a method is not blamed
for its formula. ``textbook`` is the form that handbooks print.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from geneva_cli.kinematics import registry


class Proportions(NamedTuple):
    """Sign of the gearing, l = R/L, A, and half the motion in radians; numbers or arrays."""

    sign: Any
    l: Any
    A: Any
    half: Any

    @classmethod
    def of(cls, z: int, gearing: str, A: float) -> Proportions:
        """Proportions of one design."""
        sign, b = registry.gearing(gearing).SIGN, math.pi / z
        crank = 0.5 * math.pi - sign * b
        return cls(sign, math.sin(b), A, crank + math.asin(A * math.sin(crank)))


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


def acceleration(m: Any, d: Proportions, x: Any) -> Any:
    """Acceleration at x radians from mid-motion (up to the sign of the gearing)."""
    f1, f2, g1, g2 = _parts(m, d, x, 2)
    return g2 * f1 * f1 + g1 * f2


def jerk(m: Any, d: Proportions, x: Any) -> Any:
    """Slope of the acceleration at x radians from mid-motion."""
    f1, f2, f3, g1, g2, g3 = _parts(m, d, x, 3)
    return g3 * f1 * f1 * f1 + 3.0 * g2 * f1 * f2 + g1 * f3
