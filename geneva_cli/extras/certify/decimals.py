"""Formulas of a motion with the decimals of its spec, for certificates.

A machine with straight slots behind a crank, side-crank or elliptical gears has one formula about
mid-motion. Balls evaluate it over the whole motion without cancellation: pi, sines and the spec's
numbers are exact. A spec's double stands for the shortest decimal that reads as that double.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TypeAlias, cast

from geneva_cli.extras.certify.balls import Ball
from geneva_cli.extras.certify.enclosures import EDGE_DEG
from geneva_cli.motion.engagement import Displacement, WheelMotion
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.wheels.gearing import FollowedRate
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Undecided
from geneva_cli.numerics.jet import Jet, Number

# A jet of an order by the input angle, at an angle in degrees from mid-motion.
Formula: TypeAlias = Callable[[Number, int], Jet]


def exact_rates(mechanism: Mechanism) -> list[Formula] | None:
    """The wheel's rate in each engagement; None if it needs numbers that are solved for.

    Input angles are balls of degrees from mid-motion. It is None too if the exact ends of a motion
    are not proved to be where the motion's doubles are.
    """
    spec = mechanism.spec
    wheel, drive, L = spec.wheel, spec.drive, mechanism.center_distance_mm
    known = None if spec.drive_before else drive.exact_advance(_sin_cos(Fraction(0)), _exact)
    if spec.motion is not None or known is None or (wheel.steps and not drive.direct):
        return None
    rates: list[Formula] = []
    for i, engagement in enumerate(mechanism.engagements):
        step = _decimal(wheel.steps[i]) / 360 if wheel.steps else Fraction(1, wheel.z)
        # the crank's angle at which its roller crosses the line of centres, in turns
        places = drive.roller_angles_deg
        at = _decimal(places[i]) / 360 if places else Fraction(i, drive.rollers)
        advance = drive.exact_advance(_sin_cos(at), _exact)
        followed = wheel.exact_rate(_sin_cos(step), L, _exact)
        assert advance is not None  # it is not None at angle 0
        rates.append(_followed(advance, followed))
        if not _ends_proved(rates[-1], engagement.motion):
            return None
    return rates


def _followed(advance: Displacement, followed: FollowedRate) -> Formula:
    return lambda input_deg, order: followed(*advance(radians(input_deg), order + 1))


def _ends_proved(rate: Formula, motion: WheelMotion) -> bool:
    """True if the wheel's rate changes its sign within ``EDGE_DEG`` of the motion's ends."""
    try:
        for end_deg, outwards in ((motion.entry_deg, -EDGE_DEG), (motion.exit_deg, EDGE_DEG)):
            at = Ball.exact(end_deg)
            out, in_ = (rate(cast("Number", at + d), 0).c[0] for d in (outwards, -outwards))
            if not (out < 0.0 < in_):
                return False
    except Undecided:
        return False
    return True


def _decimal(x: float) -> Fraction:
    return Fraction(repr(float(x)))


def _exact(x: float) -> float:
    return cast("float", Ball.fraction(_decimal(x)))


def _sin_cos(turn: Fraction) -> tuple[float, float]:
    angle = cast("float", Ball.fraction(turn) * Ball.library.pi)
    return Ball.library.sin(angle), Ball.library.cos(angle)
