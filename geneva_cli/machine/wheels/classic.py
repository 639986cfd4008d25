"""The classic wheels in closed form: straight radial slots, a plain crank.

b = pi p/q is half the index angle (p/q = 1/z for equal steps), l = R/L = sin b the crank radius.
"""

from __future__ import annotations

from typing import cast

from geneva_cli.errors import GenevaError, cut, refuse
from geneva_cli.numerics.angles import one_minus_sin_pi, sin_cos_pi
from geneva_cli.numerics.arrays import library

STEPS = 8  # of Newton, from any l of three slots or more to the last digit


def half_motion_deg(sign: float, p: int, q: int) -> float:
    """Crank angle in degrees from entry to the line of centres: 90° - b outside, 90° + b inside."""
    return 90.0 * (q - 2 * int(sign) * p) / q


def gap(sign: float, p: int, q: int) -> float:
    """Least distance of the pin from the wheel's centre in units of L: 1 - l, inside 1 + l."""
    out: float = 1.0 + sin_cos_pi(p, q)[0] if sign < 0.0 else one_minus_sin_pi(p, q)
    return out


def rollers_max(motion_deg: float) -> int:
    """Greatest number of evenly spaced rollers that leave some dwell: m * motion < 360 degrees.

    A whole number; floats for an array.
    """
    return cast(int, library(motion_deg).ceil(360.0 / motion_deg)) - 1


def refuse_jam(rollers: int, motion_deg: float, inside: bool) -> None:
    """Raise GenevaError if the rollers would leave no dwell."""
    most = rollers_max(motion_deg)

    def error() -> GenevaError:
        why = (
            "an internal wheel's crank carries one roller only"
            if inside and motion_deg > 180.0
            else f"{rollers} motions of {motion_deg:.6g} degrees leave no dwell in a turn of 360"
        )
        return GenevaError(
            f"rollers = {cut(rollers)} jam: {why}; at most {most}", ("drive", "rollers")
        )

    refuse(rollers > most, error)


def velocity_peak(l: float, gap: float) -> float:
    """Peak velocity, at mid-motion: l/(1 - l) outside, l/(1 + l) inside."""
    return l / gap


def acceleration_peak(l: float, gap: float) -> tuple[float, float]:
    """Peak acceleration of an external wheel and its angle from mid-motion, degrees.

    psi3 = 0 is a quadratic in cos a. With s = 1 - cos a and B = 1 + 4 l + l² its root is s = 2
    (1-l)² / (B + sqrt(B² - 8 l (1-l)²)), which is free of cancellation up to l = 1. (An internal
    wheel's peak is its jump at entry, tan b.)
    """
    m = library(l, gap)
    big = 1.0 + 4.0 * l + l * l
    s = 2.0 * gap * gap / (big + m.sqrt(big * big - 8.0 * l * gap * gap))
    d = gap * gap + 2.0 * l * s
    size = l * gap * (1.0 + l) * m.sqrt(s * (2.0 - s)) / (d * d)
    return size, m.degrees(2.0 * m.asin(m.sqrt(0.5 * s)))


def power_peak(l: float, gap: float) -> tuple[float, float]:
    """Peak of velocity times acceleration and its angle from mid-motion, degrees.

    k is 1 - gap: l outside, -l inside. The slope vanishes where c = cos a is a root of 2 k c³ + 2
    (1 - k²) c² - k (5 + k²) c + 5 k² - 1. At entry (c = k) this cubic is -(1 - k²)², at mid-motion
    (c = 1) it is (1 - k)³. Newton's method starts at c = sqrt(1/2) + k, the tangent of the root's
    course at k = 0. From there to the root the cubic rises and is convex, so the steps go down.
    """
    k = 1.0 - gap
    square, slope, rest = 2.0 * (1.0 - k * k), k * (5.0 + k * k), 5.0 * k * k - 1.0
    c = 0.5**0.5 + k
    for _ in range(STEPS):
        value = ((2.0 * k * c + square) * c - slope) * c + rest
        c = c - value / ((6.0 * k * c + 2.0 * square) * c - slope)
    m = library(l, gap)
    s = 1.0 - c  # the peak is flat: a rounding error of c counts by its square
    d = gap * gap + 2.0 * k * s
    size = l * l * gap * (1.0 + k) * (gap - s) * m.sqrt(s * (2.0 - s)) / d**3
    return size, m.degrees(2.0 * m.asin(m.sqrt(0.5 * s)))
