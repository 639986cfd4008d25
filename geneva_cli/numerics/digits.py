"""Sines, cosines and angles with 50 digits, for values that must be exact before rounding."""

from __future__ import annotations

import math
from decimal import Context, Decimal

FIFTY = Context(prec=50)  # digits
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494")


def sin_cos(radians: Decimal) -> tuple[Decimal, Decimal]:
    """Sine and cosine of an angle, to the digits of the current context."""
    quarter = round(float(radians) / (0.5 * math.pi))
    x = radians - quarter * PI / 2
    sums = [Decimal(1), x]  # cosine, sine
    term, k = x, 1
    while abs(term) > Decimal("1e-60"):
        k += 1
        term = term * x / k
        sums[k % 2] += -term if k % 4 > 1 else term
    c, s = sums
    return ((s, c), (c, -s), (-s, -c), (-c, s))[quarter % 4]


def to_degrees(radians: Decimal) -> float:
    """Radians to degrees, rounded once."""
    return float(radians * 180 / PI)
