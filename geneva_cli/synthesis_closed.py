"""What makes a motion longer or shorter, in closed form: A, an eccentricity, or alpha_0.

A natural motion phi_2 is the one of the plain crank, 180 deg - 2b outside and 180 deg + 2b inside;
phi_1 is the wanted one. All angles are input angles in degrees.

Source: the law of sines in the coulisse's triangle (formula (1) of Polyudov and Kandyak,
"Kinematics of the Maltese cross mechanism with a side-crank drive"), and the focal property of
equal ellipses.
"""

from __future__ import annotations

import math

from geneva_cli.units import DEGREE, sin_cos_pi

MOST = 0.9999  # greatest |A| and eccentricity: beyond, the drive all but stands still or jumps


def side_crank(z: int, natural_deg: float, motion_deg: float) -> float | None:
    """A = sin((phi_1 - phi_2)/2) / sin(phi_2/2), with sin(phi_2/2) = cos b for both gearings.

    None where no |A| below 1 makes so long (or short) a motion.
    """
    turn = 0.5 * (motion_deg - natural_deg) * DEGREE  # angle between input crank and coulisse
    if not abs(turn) < 0.5 * math.pi:
        return None
    A = math.sin(turn) / sin_cos_pi(1, z)[1]
    return A if abs(A) <= MOST else None


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
