"""What makes a motion longer or shorter, in closed form: A, an eccentricity, or alpha_0.

A natural motion phi_2 is the one of the plain crank, 180 deg - 2b outside and 180 deg + 2b inside;
phi_1 is the wanted one. All angles are input angles in degrees.

Source: the law of sines in the coulisse's triangle (formula (1) of Polyudov and Kandyak,
"Kinematics of the Maltese cross mechanism with a side-crank drive"), and the focal property of
equal ellipses.
"""

from __future__ import annotations

import math

from geneva_cli.numerics.angles import DEGREE, sin_cos_pi

AXES = 1.0  # least angle between the shafts of a spherical wheel, degrees
MOST = 0.9999  # greatest |A| and eccentricity: beyond, the drive all but stands still or jumps


def side_crank(natural_deg: float, motion_deg: float) -> float | None:
    """A = sin((phi_1 - phi_2)/2) / sin(phi_2/2).

    None where no |A| below 1 makes so long (or short) a motion.
    """
    turn = 0.5 * (motion_deg - natural_deg) * DEGREE  # angle between input crank and coulisse
    if not abs(turn) < 0.5 * math.pi:
        return None
    A = math.sin(turn) / math.sin(0.5 * natural_deg * DEGREE)
    return A if abs(A) <= MOST else None


def axes(z: int, motion_deg: float) -> float | None:
    """Angle between a spherical wheel's shafts, degrees: cos S = cot b cot(phi_1/2).

    From cos(phi_1/2) = tan th / tan S with sin th = sin S sin b (th: the crank's cone). Written
    with sin S as well, -cos(phi_1/2 + b) cos(phi_1/2 - b) being the square of
    sin S sin b sin(phi_1/2), so that small angles keep their digits. None for a motion that is not
    between those of parallel shafts, 180 deg - 2b (outside) and 180 deg + 2b (inside).
    """
    a, (b, (_, cos_b)) = 0.5 * motion_deg * DEGREE, (math.pi / z, sin_cos_pi(1, z))
    square = -math.cos(a + b) * math.cos(a - b)
    if square <= 0.0:
        return None
    S = math.atan2(math.sqrt(square), math.cos(a) * cos_b) / DEGREE
    return S if AXES <= S <= 180.0 - AXES else None


def elliptical_gears(natural_deg: float, motion_deg: float) -> tuple[float, str] | None:
    """Eccentricity and phase: tan(phi_1/4) = (1+e)/(1-e) tan(phi_2/4), e < 0 being the quick phase.

    Solved for e: sin((phi_1 - phi_2)/4) / sin((phi_1 + phi_2)/4), which holds for phi_2 above 180
    as well. None where e would be 1 but for ``MOST``.
    """
    quarter = 0.25 * DEGREE
    e = math.sin((motion_deg - natural_deg) * quarter) / math.sin(
        (motion_deg + natural_deg) * quarter
    )
    return phased(e) if abs(e) <= MOST else None


def phased(e: float) -> tuple[float, str]:
    """A signed eccentricity as the spec has it."""
    return abs(e), "quick" if e < 0.0 else "slow"


def law_motion_deg(step: float, C_a: float, acceleration: float) -> float:
    """The motion on which a law reaches a given peak: step C_a / phi_1² (step in radians)."""
    return math.sqrt(step * C_a / acceleration) / DEGREE


def shortest(low: float, high: float) -> float:
    """The number of fewest digits near the middle of an interval; 0 where that lies in it."""
    if low <= 0.0 <= high:
        return 0.0
    middle = 0.5 * (low + high)
    for digits in range(1, 17):
        x = float(f"{middle:.{digits}g}")
        if low <= x <= high:
            return x
    return middle
