"""Angles and speeds: degrees for people, radians for formulas, and exact fractions of pi.

Input angles are carried in degrees, in which a whole turn and the entry angles of the classic
wheels are exact; trigonometry gets radians at the last moment.
"""

from __future__ import annotations

import math
from typing import Any

DEGREE = math.pi / 180.0
_BITS = 128
_ONE = 1 << _BITS
_PI = 1069028584064966747859680373161870783300  # pi * 2**128, rounded down (OEIS A000796)


def sin_cos_pi(p: int, q: int) -> tuple[float, float]:
    """sin(pi p/q) and cos(pi p/q), correctly rounded; sin(pi/6) is 0.5.

    ``math.sin(math.pi / q)`` sees an argument that was rounded, and a wheel of three slots
    multiplies that by 12 on the way to its peak acceleration. Here the argument is an exact
    fraction, reduced to an eighth of a turn, and both series are summed in integers of 128 bits.
    """
    s, c = scaled_sin_cos(p, q)
    return s / _ONE, c / _ONE


def one_minus_sin_pi(p: int, q: int) -> float:
    """1 - sin(pi p/q), correctly rounded however near to 1 the sine is."""
    return (_ONE - scaled_sin_cos(p, q)[0]) / _ONE


def cos_squared_less(p: int, q: int, x: float) -> float:
    """cos²(pi p/q) - x for an exact double x, to the last digit however near to 0 it is.

    The square is rounded to 112 bits, which its series are exact to: cos² 30° is 3/4.
    """
    drop = 2 * _BITS - 112
    square = (scaled_sin_cos(p, q)[1] ** 2 + (1 << drop - 1)) >> drop
    n, d = x.as_integer_ratio()
    return (square * d - (n << 112)) / (d << 112)


def scaled_sin_cos(p: int, q: int) -> tuple[int, int]:
    """sin(pi p/q) and cos(pi p/q) times 2**128, each to its last digits."""
    quarter = (4 * p + q) // (2 * q)  # nearest number of quarter turns
    x = _PI * (2 * p - quarter * q) // (2 * q)
    sums = [_ONE, x]  # cosine, sine
    term, k = x, 1
    while term:
        k += 1
        term = term * x // (_ONE * k)
        if term == -1:  # floor division never reaches 0 from below
            break
        sums[k % 2] += -term if k % 4 > 1 else term
    c, s = sums
    return ((s, c), (c, -s), (-s, -c), (-c, s))[quarter % 4]


def sin_cos_deg(degrees: float) -> tuple[float, float]:
    """Sine and cosine of an angle given exactly in degrees."""
    p, q = degrees.as_integer_ratio()
    return sin_cos_pi(p, 180 * q)


def radians(degrees: Any) -> Any:
    """Degrees to radians, for numbers and arrays alike."""
    return degrees * DEGREE


def omega(n_rpm: float) -> float:
    """Angular velocity in rad/s from revolutions per minute."""
    return n_rpm * math.pi / 30.0
