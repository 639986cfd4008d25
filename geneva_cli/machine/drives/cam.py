"""Cam-Geneva: the roller slides along the crank, guided by a fixed groove; the slots stay straight.

Slot and motion are known and give the path. With the wheel at psi and the crank at phi the law of
sines gives the roller's distance from the crank's axis, R = L sin psi / sin(phi + psi), and from
the wheel's, rho = L sin phi / sin(phi + psi) (an internal wheel: phi - psi).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives import Plan
from geneva_cli.machine.engagement import LawMotion
from geneva_cli.machine.laws.chosen import law_of
from geneva_cli.machine.laws.standard import Law
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.machine.wheels.classic import SIGN, half_motion_deg
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.jet import Coefficient, Jet, piecewise, sin_cos
from geneva_cli.spec.tables import Spec

# Where psi and phi nearly vanish together, a series of psi / phi: within these angles its first
# terms are exact to a double (a spline's series ends at its fifth).
NEAR_DEG, TERMS = 3.0, 15
NEAR_SPLINE_DEG, SPLINE_TERMS = 0.06, 5
MOTION_MIN = 1e-10  # degrees: a shorter motion, or dwell, is rounding


class Keys(NamedTuple):
    """No keys of its own: the law is in ``[motion]``."""


class CamDriven(LawMotion):
    """Straight radial slot and motion are known and give the roller's path."""

    def __init__(self, motion_deg: float, half_step: float, law: Law, sign: float) -> None:
        # Input 0 is where the roller crosses the line of centres: where the wheel is half-way.
        early = _half_way(law) * motion_deg
        super().__init__(0.0, -early, motion_deg - early, half_step, law)
        self.sign = sign  # +1 external, -1 internal

    def distances(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller's distance from the wheel's axis and from the crank's, in units of L."""
        near = NEAR_DEG if self.law.analytic else NEAR_SPLINE_DEG

        def whole(x: Coefficient) -> Jet:
            return _stacked(*self._by_sines(x, order))

        def middle(x: Coefficient) -> Jet:
            return _stacked(*self._by_series(x, order))

        both = piecewise(input_deg, (-near, near), (whole, middle, whole)).c
        return Jet(both[: order + 1]), Jet(both[order + 1 :])

    def _by_sines(self, x: Coefficient, order: int) -> tuple[Jet, Jet]:
        phi, psi = Jet.variable(radians(x), order), self.motion(x, order)
        below = sin_cos(phi + psi * self.sign)[0]
        return sin_cos(phi)[0] / below, sin_cos(psi)[0] / below

    def _by_series(self, x: Coefficient, order: int) -> tuple[Jet, Jet]:
        """Near mid-motion both sines vanish: each is divided by phi first, as a series of it."""
        t = Jet.variable(radians(x), order)
        c = self.motion(0.0, TERMS if self.law.analytic else SPLINE_TERMS).c
        slope = t * 0.0
        for a in reversed(c[1:]):
            slope = slope * t + a  # psi / phi
        psi = slope * t
        angle = slope * self.sign + 1.0  # (phi +- psi) / phi
        below = angle * _sinc(angle * t)
        return _sinc(t) / below, slope * _sinc(psi) / below

    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller in its straight slot, which stands at the wheel's angle."""
        rho, _ = self.distances(input_deg, order)
        s, c = sin_cos(self.motion(input_deg, order))
        return rho * c, rho * s

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin runs along the slot's straight axis."""
        rho, _ = self.distances(input_deg, order)
        return rho, rho * 0.0

    def rail(self, input_deg: Coefficient, order: int = 0) -> tuple[Jet, Jet]:
        """The lever is the pin's distance from the wheel's axis."""
        rho, _ = self.distances(input_deg, order + 1)
        return Jet(rho.c[:-1]), rho.derivative()

    def carrier(self, input_deg: Coefficient, order: int = 0) -> Jet:
        """The roller slides along the crank, and turns with it."""
        return Jet((input_deg * 0.0 - self.sign, *[0.0] * order))

    def groove(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The fixed groove's pitch curve, the crank's axis being the origin."""
        _, R = self.distances(input_deg, order)
        s, c = sin_cos(Jet.variable(radians(input_deg), order))
        # The crank points at the wheel's axis at mid-motion (outside), or away from it (inside).
        return R * c * -self.sign, R * s


def _stacked(a: Jet, b: Jet) -> Jet:
    return Jet((*a.c, *b.c))


def _sinc(x: Jet) -> Jet:
    """sin x / x for small x: eight terms of the series are exact to a double up to 1/10."""
    square = x * x
    total = x * 0.0
    for k in range(8, -1, -1):
        total = total * square + (-1.0) ** k / math.factorial(2 * k + 1)
    return total


def _half_way(law: Law) -> float:
    """The share of the motion time after which the wheel is half-way: 1/2 for symmetric laws."""
    low, high = 0.0, 1.0
    if law(0.5, 0).c[0] == 0.5:
        return 0.5
    for _ in range(60):
        u = 0.5 * (low + high)
        low, high = (u, high) if law(u, 0).c[0] < 0.5 else (low, u)
    return 0.5 * (low + high)


def plan(spec: Spec) -> Plan:
    """The one station of a cam-Geneva."""
    if spec.motion.law is None:
        raise GenevaError(
            'kind = "cam" needs a law in [motion]: the groove is cut for it', ("drive", "kind")
        )
    if spec.motion.ratio is not None:
        raise GenevaError(
            "ratio has no meaning with a cam: the roller's distance from the crank's axis changes",
            ("motion", "ratio"),
        )
    step = gearing.Step(1, spec.wheel.z)
    law = law_of(spec)
    natural = 2.0 * half_motion_deg(spec.wheel.gearing, *step)
    motion = natural - spec.motion.alpha0_deg
    if not MOTION_MIN < motion < 360.0 - MOTION_MIN:
        raise GenevaError(
            f"alpha0_deg = {spec.motion.alpha0_deg:.12g} leaves no motion angle between 0 and 360 "
            f"degrees; it must be above {natural - 360.0:.12g} and below {natural:.12g}",
            ("motion", "alpha0_deg"),
        )
    station = CamDriven(motion, step.b, law, SIGN[spec.wheel.gearing])
    _refuse_unreachable(station, motion)
    return Plan(station, float(station.distances(0.0, 0)[1].c[0]), spec.size)


def _refuse_unreachable(station: CamDriven, motion: float) -> None:
    """Raise GenevaError where slot and crank become parallel, or the wheel stands at mid-motion."""
    V = station.motion(0.0, 1).c[1]
    if V <= 0.0 or (station.sign < 0.0 and V >= 1.0):
        raise GenevaError(
            f"the law moves the wheel {V:.4g} times as fast as the crank at mid-motion; the "
            "groove needs more than 0" + (" and less than 1 inside" if station.sign < 0 else ""),
            ("motion", "law"),
        )
    end = math.radians(station.exit_deg) + station.sign * station.half_step
    start = math.radians(-station.entry_deg) + station.sign * station.half_step
    if not 0.0 < max(start, end) < math.pi:
        raise GenevaError(
            f"with {motion:.6g} deg of motion crank and slot become parallel before the end; a "
            "larger alpha0_deg shortens it",
            ("motion", "alpha0_deg"),
        )
