"""The pin's circle as seen from the wheel, for external and internal wheels; lengths over L.

A pose is one moment of the motion. Its x axis is the ray from the wheel's centre to the pin then.
With the crank's angle d since then the pin moves by sin(d) slope + (1 - cos(d)) bend, without
cancellation. At entry and exit the slope across the ray is exactly 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.motion.engagement import Displacement, Vector
from geneva_cli.motion.wheels.classic import gap, half_motion_deg
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.numerics.jet import Jet, Number


class PinPose(NamedTuple):
    """One moment of the pin's motion on its circle; vectors are (along the ray, across it)."""

    crank_deg: float
    wheel: float  # wheel angle, radians
    along: float  # distance from the wheel's centre to the pin
    slope: tuple[float, float]  # d(position)/d(crank angle)
    bend: tuple[float, float]  # second derivative

    def displacement(self, sine: Jet, versine: Jet) -> Vector:
        """Displacement since the pose, from sin d and 1 - cos d of the crank's rotation d."""
        (along, across), (bend_along, bend_across) = self.slope, self.bend
        return sine * along + versine * bend_along, sine * across + versine * bend_across


class PinTravel(NamedTuple):
    """Displacement of a crank's pin from a pose, by the input angle."""

    pose: PinPose
    advance: Displacement  # of the crank: sin d and 1 - cos d

    def __call__(self, tau: Number, order: int) -> Vector:
        """Displacement along the pose's ray and across it, ``tau`` input radians later."""
        return self.pose.displacement(*self.advance(tau, order))


class HalfStep(NamedTuple):
    """Half an index angle as the exact fraction b = pi p / q; equal steps have p/q = 1/z.

    In a batch p or q is an array; p may then be in degrees, with q = 180.
    """

    p: int
    q: int

    @classmethod
    def of_deg(cls, degrees: float) -> HalfStep:
        """Half an index angle in degrees."""
        p, q = degrees.as_integer_ratio() if isinstance(degrees, float) else (degrees, 1)
        return cls(p, 180 * q)

    @property
    def b(self) -> float:
        """Half the index angle, radians."""
        return math.pi * self.p / self.q

    @property
    def sin_cos(self) -> tuple[float, float]:
        """sin b and cos b."""
        return sin_cos_pi(self.p, self.q)


class Skew(NamedTuple):
    """Proportions of an offset slot."""

    e: float
    tilt: float  # d, radians: the slot against the line of centres, half-way through the step
    deepest: float  # least coordinate of the pin along the slot's axis: at mid-motion
    poses: tuple[PinPose, PinPose, PinPose]
    # The poses at both ends are in the slot's own frame, whose axis is offset by -e from the ray
    # from the wheel's centre. The pose in the middle is in the frame of the line of centres.


def middle(sign: float, l: float, gap: float) -> PinPose:
    """Pose of the pin on the line of centres, ``gap`` from the wheel's axis."""
    return PinPose(0.0, 0.0, gap, (0.0, l), (sign * l, 0.0))


def radial(sign: float, step: HalfStep) -> tuple[PinPose, PinPose, PinPose]:
    """Entry, middle and exit of a straight radial slot entered without shock: l = sin b."""
    l, cos_b = step.sin_cos
    half = half_motion_deg(sign, *step)
    return (
        PinPose(-half, -step.b, cos_b, (-sign * l, 0.0), (0.0, l)),
        middle(sign, l, gap(sign, *step)),
        PinPose(half, step.b, cos_b, (sign * l, 0.0), (0.0, -l)),
    )
