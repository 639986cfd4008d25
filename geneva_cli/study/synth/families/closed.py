"""Closed forms for parameters that lengthen or shorten a motion: A, eccentricity, alpha_0.

A natural motion phi_2 is that of the plain crank, 180 deg - 2b outside and 180 deg + 2b inside;
phi_1 is the required one. All angles are input angles in degrees.

Source: the law of sines in the coulisse's triangle (formula (1) of Polyudov and Kandyak,
"Kinematics of the Maltese cross mechanism with a side-crank drive"), and the focal property of
equal ellipses.
"""

from __future__ import annotations

import math

from geneva_cli.numerics.angles import DEGREE, sin_cos_pi
from geneva_cli.study.target import AllowedSpan

AXES = AllowedSpan(1.0, 179.0)  # angles between the shafts of a spherical wheel, degrees
PARAMETER_MAX = 0.9999  # greatest |A| and eccentricity: beyond, the drive nearly stops or jumps


def side_crank(natural_deg: float, motion_deg: float) -> float:
    """A = sin((phi_1 - phi_2)/2) / sin(phi_2/2), which increases with the motion.

    Infinite if no A makes a motion of this length.
    """
    turn = 0.5 * (motion_deg - natural_deg) * DEGREE  # angle between input crank and coulisse
    if not abs(turn) < 0.5 * math.pi:
        return math.copysign(math.inf, turn)
    return math.sin(turn) / math.sin(0.5 * natural_deg * DEGREE)


def side_crank_motion(natural_deg: float, A: float) -> float:
    """The motion that a side-crank makes: phi_1 = phi_2 + 2 asin(A sin(phi_2/2))."""
    return natural_deg + 2.0 * math.asin(A * math.sin(0.5 * natural_deg * DEGREE)) / DEGREE


def axes(z: int, motion_deg: float) -> float:
    """Angle between a spherical wheel's shafts, degrees: cos S = cot b cot(phi_1/2).

    It follows from cos(phi_1/2) = tan th / tan S and sin th = sin S sin b (th: the crank's cone).
    The code uses sin S as well, so that small angles keep their digits: -cos(phi_1/2 + b)
    cos(phi_1/2 - b) is the square of sin S sin b sin(phi_1/2). The angle increases with the motion,
    from 0 for that of parallel shafts outside, 180 deg - 2b, to 180 for that inside.
    """
    a, (b, (_, cos_b)) = 0.5 * motion_deg * DEGREE, (math.pi / z, sin_cos_pi(1, z))
    square = -math.cos(a + b) * math.cos(a - b)
    if square <= 0.0:
        return 0.0 if motion_deg < 180.0 else 180.0
    return math.atan2(math.sqrt(square), math.cos(a) * cos_b) / DEGREE


def axes_motion(z: int, axes_deg: float) -> float:
    """The motion of a spherical wheel: cos(phi_1/2) = cos S sin b / sqrt(1 - (sin S sin b)²)."""
    (sin_b, cos_b), S = sin_cos_pi(1, z), axes_deg * DEGREE
    return 2.0 * math.atan2(cos_b, math.cos(S) * sin_b) / DEGREE


def eccentricity(natural_deg: float, motion_deg: float) -> float:
    """Eccentricity of equal ellipses: tan(phi_1/4) = (1+e)/(1-e) tan(phi_2/4).

    It is negative in the quick phase. Solved for e: sin((phi_1 - phi_2)/4) / sin((phi_1 +
    phi_2)/4), which holds for phi_2 above 180 too.
    """
    quarter = 0.25 * DEGREE
    return math.sin((motion_deg - natural_deg) * quarter) / math.sin(
        (motion_deg + natural_deg) * quarter
    )


def gears_motion(natural_deg: float, e: float) -> float:
    """The motion that equal ellipses make, degrees."""
    tangent = (1.0 + e) / (1.0 - e) * math.tan(0.25 * natural_deg * DEGREE)
    return 4.0 * math.atan(tangent) / DEGREE


def law_motion_deg(step: float, C_a: float, acceleration: float) -> float:
    """The motion with which a law has a given peak: step C_a / phi_1² (step in radians)."""
    return math.sqrt(step * C_a / acceleration) / DEGREE


def shortest(low: float, high: float) -> float:
    """The number of fewest digits near the middle of an interval; 0 if that lies in it."""
    if low <= 0.0 <= high:
        return 0.0
    middle = 0.5 * (low + high)
    for digits in range(1, 17):
        x = float(f"{middle:.{digits}g}")
        if low <= x <= high:
            return x
    return middle
