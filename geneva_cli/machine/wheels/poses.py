"""The pin's circle as the wheel sees it, for external and internal wheels.

The wheel's axis is the origin, the crank's axis at (1, 0): lengths are in units of the centre
distance L. b = pi/z is half the index angle, l = R/L the crank radius.

A pose is one moment of the motion, described in the frame whose x axis is the ray from the
wheel's centre to the pin at that moment. About it the pin moves by

    sin(d) * slope + (1 - cos(d)) * bend        (d: crank angle since the pose)

without cancellation: at entry and exit the pin moves along the ray only, so the part of the
slope across it is exactly zero, and so are the wheel's angle and velocity there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.machine.wheels.classic import SIGN, gap, half_motion_deg
from geneva_cli.numerics.angles import sin_cos_deg, sin_cos_pi
from geneva_cli.numerics.jet import Jet


class Pose(NamedTuple):
    """One moment of the pin's turn on its circle; vectors are (along the ray, across it)."""

    crank_deg: float
    wheel: float  # wheel angle, radians
    along: float  # distance of the pin from the wheel's centre
    slope: tuple[float, float]  # d(position)/d(crank angle)
    bend: tuple[float, float]  # second derivative

    def displacement(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """The pin's way since the pose, after the crank has turned by d: sin d and 1 - cos d."""
        u = sine * self.slope[0] + versine * self.bend[0]
        v = sine * self.slope[1] + versine * self.bend[1]
        return u, v


class Step(NamedTuple):
    """Half an index angle as the exact fraction b = pi p / q; equal steps have p/q = 1/z."""

    p: int
    q: int

    @property
    def b(self) -> float:
        """Half the index angle, radians."""
        return math.pi * self.p / self.q

    @property
    def sin_cos(self) -> tuple[float, float]:
        """sin b and cos b."""
        return sin_cos_pi(self.p, self.q)


def middle(gearing: str, l: float, gap: float) -> Pose:
    """The pin on the line of centres, ``gap`` from the wheel's, for a crank of any radius l."""
    return Pose(0.0, 0.0, gap, (0.0, l), (SIGN[gearing] * l, 0.0))


def radial(gearing: str, step: Step) -> tuple[Pose, Pose, Pose]:
    """Entry, middle and exit of a straight radial slot entered without shock: l = sin b."""
    g = SIGN[gearing]
    l, cos_b = step.sin_cos
    half = half_motion_deg(gearing, *step)
    return (
        Pose(-half, -step.b, cos_b, (-g * l, 0.0), (0.0, l)),
        middle(gearing, l, gap(gearing, *step)),
        Pose(half, step.b, cos_b, (g * l, 0.0), (0.0, -l)),
    )


class Sphere(NamedTuple):
    """A spherical wheel: shafts at the angle S, the pin on a cone of half angle th.

    sin th = sin S sin b, so that the pin enters its meridian slot along it. Seen along the wheel's
    axis the pin runs on an ellipse, (sin S - tan th cos S cos a, tan th sin a) times cos th.
    """

    sin_S: float
    cos_S: float
    sin_th: float
    cos_th: float
    cos_a: float  # of the half motion angle: tan th / tan S
    sin_a: float

    @property
    def half_motion_deg(self) -> float:
        """Crank angle from entry to mid-motion."""
        return math.degrees(math.atan2(self.sin_a, self.cos_a))


def sphere(step: Step, axes_deg: float) -> Sphere:
    """The proportions of a spherical wheel with shafts at ``axes_deg``."""
    sin_b, cos_b = step.sin_cos
    sin_S, cos_S = sin_cos_deg(axes_deg)
    sin_th = sin_S * sin_b
    # cos² th = cos² S + sin² S cos² b: a sum of positive terms
    cos_th = math.hypot(cos_S, sin_S * cos_b)
    return Sphere(sin_S, cos_S, sin_th, cos_th, sin_b * cos_S / cos_th, cos_b / cos_th)


def spherical(step: Step, ball: Sphere) -> tuple[Pose, Pose, Pose]:
    """Entry, middle and exit of a spherical wheel's pin, in its projection along the wheel's axis.

    Lengths are in units of the sphere's radius.
    """
    sin_b, cos_b = step.sin_cos
    half = ball.half_motion_deg
    # derivatives of the pin's place at the crank angle a, by it
    across, along = ball.sin_th * ball.cos_S, ball.sin_th
    mouth = math.hypot(ball.sin_S * ball.cos_th - across * ball.cos_a, along * ball.sin_a)
    slope = across * ball.sin_a * cos_b + along * ball.cos_a * sin_b
    inward = across * ball.cos_a * cos_b - along * ball.sin_a * sin_b
    aside = across * ball.cos_a * sin_b + along * ball.sin_a * cos_b
    # sin(S - th), where both are positive as sin² S cos² b / sin(S + th)
    middle_ = ball.sin_S * ball.cos_th - across
    if across > 0.0:
        middle_ = (ball.sin_S * cos_b) ** 2 / (ball.sin_S * ball.cos_th + across)
    return (
        Pose(-half, -step.b, mouth, (-slope, 0.0), (inward, aside)),
        Pose(0.0, 0.0, middle_, (0.0, along), (across, 0.0)),
        Pose(half, step.b, mouth, (slope, 0.0), (inward, -aside)),
    )
