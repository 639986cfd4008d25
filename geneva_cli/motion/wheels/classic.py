"""Plain wheels: the pin on its circle as seen from the wheel, and peaks in closed form.

b = pi p/q is half the index angle, l = R/L = sin b; lengths are over L. A pose is one moment of the
motion. Its x axis is the ray from the wheel's centre to the pin then. With the crank's angle d
since then the pin moves by sin(d) slope + (1 - cos(d)) bend, without cancellation. At entry and
exit the slope across the ray is exactly 0.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, cast

from geneva_cli.errors import refuse_text
from geneva_cli.numerics.angles import one_minus_sin_pi, sin_cos_pi
from geneva_cli.numerics.arrays import choose, larger, library, smaller

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Displacement, Number, Vector


class PinPose(NamedTuple):
    """One moment of the pin's motion on its circle; vectors are (along the ray, across it)."""

    crank_deg: float
    wheel: float  # wheel angle, radians
    along: float  # distance from the wheel's centre to the pin
    slope: tuple[float, float]  # d(position)/d(crank angle)
    bend: tuple[float, float]  # second derivative


class PinTravel(NamedTuple):
    """Displacement of a crank's pin from a pose, by the input angle."""

    pose: PinPose
    advance: Displacement  # of the crank: sin d and 1 - cos d

    def __call__(self, tau: Number, order: int) -> Vector:
        """Displacement along the pose's ray and across it, ``tau`` input radians later."""
        sine, versine = self.advance(tau, order)
        (along, across), (bend_along, bend_across) = self.pose.slope, self.pose.bend
        return sine * along + versine * bend_along, sine * across + versine * bend_across


class HalfStep(NamedTuple):
    """Half an index angle b = pi p / q as an exact fraction; equal steps have p/q = 1/z.

    In a batch p or q is an array; p may then be in degrees, with q = 180.
    """

    p: int
    q: int
    b: float  # radians
    sin_cos: tuple[float, float]  # sin b and cos b

    @classmethod
    def of(cls, p: int, q: int) -> HalfStep:
        """Half an index angle pi p / q."""
        return cls(p, q, math.pi * p / q, sin_cos_pi(p, q))

    @classmethod
    def of_deg(cls, degrees: float) -> HalfStep:
        """Half an index angle in degrees."""
        p, q = degrees.as_integer_ratio() if isinstance(degrees, float) else (degrees, 1)
        return cls.of(p, 180 * q)


def half_motion_deg(sign: float, p: int, q: int) -> float:
    """Crank angle in degrees from entry to the line of centres: 90° - b outside, 90° + b inside."""
    return 90.0 * (q - 2 * int(sign) * p) / q


def gap(sign: float, p: int, q: int) -> float:
    """Least distance of the pin from the wheel's centre in units of L: 1 - l, inside 1 + l."""
    out: float = 1.0 + sin_cos_pi(p, q)[0] if sign < 0.0 else one_minus_sin_pi(p, q)
    return out


def middle(sign: float, l: float, gap: float) -> PinPose:
    """Pose of the pin on the line of centres, ``gap`` from the wheel's axis."""
    return PinPose(0.0, 0.0, gap, (0.0, l), (sign * l, 0.0))


def radial(sign: float, step: HalfStep) -> tuple[PinPose, PinPose, PinPose]:
    """Entry, middle and exit of a straight radial slot entered without shock: l = sin b."""
    (l, cos_b), half = step.sin_cos, 90.0 * (step.q - 2 * int(sign) * step.p) / step.q
    least: float = 1.0 + l if sign < 0.0 else one_minus_sin_pi(step.p, step.q)
    return (
        PinPose(-half, -step.b, cos_b, (-sign * l, 0.0), (0.0, l)),
        PinPose(0.0, 0.0, least, (0.0, l), (sign * l, 0.0)),
        PinPose(half, step.b, cos_b, (sign * l, 0.0), (0.0, -l)),
    )


def rollers_max(motion_deg: float) -> int:
    """Greatest number of evenly spaced rollers that leave some dwell: m * motion < 360 degrees."""
    return cast(int, library(motion_deg).ceil(360.0 / motion_deg)) - 1


def refuse_jam(rollers: int, motion_deg: float) -> None:
    """Raise GenevaError if the rollers would leave no dwell."""
    most = rollers_max(motion_deg)
    text = "rollers = {rollers} jam: {rollers} motions of {motion:.6g} degrees leave no dwell in a "
    text += "turn of 360; at most {most}"
    values = {"rollers": rollers, "motion": motion_deg, "most": most}
    refuse_text(rollers > most, ("drive", "rollers"), text, **values)


def acceleration_peak(l: float, gap: float) -> tuple[float, float]:
    """Peak acceleration of an external wheel and its angle from mid-motion, degrees.

    psi3 = 0 is a quadratic in cos a. With s = 1 - cos a and B = 1 + 4 l + l² its root is

        s = 2 (1-l)² / (B + sqrt(B² - 8 l (1-l)²))

    which is free of cancellation up to l = 1. An internal wheel's peak is its jump at entry, tan b.
    """
    m = library(l, gap)
    big = 1.0 + 4.0 * l + l * l
    s = 2.0 * gap * gap / (big + m.sqrt(big * big - 8.0 * l * gap * gap))
    d = gap * gap + 2.0 * l * s
    size = l * gap * (1.0 + l) * m.sqrt(s * (2.0 - s)) / (d * d)
    return size, m.degrees(2.0 * m.asin(m.sqrt(0.5 * s)))


def power_peak(l: float, gap: float) -> tuple[float, float]:
    """Peak of velocity times acceleration and its angle from mid-motion, degrees.

    With g = ``gap`` and 1 - cos a = g² t, the slope vanishes at the least root t of

        1 - (10 - 7 g + g²) t + (6 - 2 g - 2 g²) g t² - 2 (1 - g) g³ t³

    That root is nearly (1 + 2 g) / 10, from g = 0 (l = 1 outside) to 2 (l = 1 inside).
    """
    k = 1.0 - gap
    first, second = 10.0 - (7.0 - gap) * gap, (6.0 - 2.0 * gap * (1.0 + gap)) * gap
    third = 2.0 * k * gap**3
    t = 0.1 + 0.2 * gap
    for _ in range(5):  # Newton; four steps give all digits from l = 0.9 inside to l = 1 outside
        value = 1.0 - t * (first - t * (second - t * third))
        t = t + value / (first - t * (2.0 * second - 3.0 * t * third))
    m = library(l, gap)
    s = gap * gap * t  # the peak is flat: a rounding error of s counts by its square
    d = gap * gap + 2.0 * k * s
    size = l * l * gap * (1.0 + k) * (gap - s) * m.sqrt(s * (2.0 - s)) / d**3
    return size, m.degrees(2.0 * m.asin(m.sqrt(0.5 * s)))


def jerk_peak(l: float, gap: float, half_deg: float) -> tuple[float, float]:
    """Peak jerk and its angle from mid-motion, degrees; ``half_deg`` is half the motion.

    With k = 1 - gap (l outside, -l inside), c = cos a and D = 1 - 2 k c + k² the jerk is

        -l (1 - k²) N / D³ ,    N = 2 k c² + (1 + k²) c - 4 k

    Outside it is greatest at mid-motion. Inside its slope by c vanishes once for c <= 1, where
    w = 2 k c is a root of

        w² + 4 (1 + k²) w + (1 + k²)² - 24 k²

    If that c is below k (exit), the jerk is greatest at the ends; if above 1, at mid-motion.
    """
    k = 1.0 - gap
    m = library(l, gap)
    both = 1.0 + k * k
    w = (24.0 * k * k - both * both) / (m.sqrt(3.0 * both * both + 24.0 * k * k) + 2.0 * both)
    turn = choose(k > 0.0, 1.0 + 0.0 * k, smaller(0.5 * w / k, 1.0 + 0.0 * k))
    s = 1.0 - larger(turn, k)
    d = gap * gap + 2.0 * k * s
    n = gap * gap - s * (1.0 + 4.0 * k + k * k - 2.0 * k * s)
    at_deg = choose(turn > k, m.degrees(2.0 * m.asin(m.sqrt(0.5 * s))), half_deg)
    return l * gap * (1.0 + k) * abs(n) / d**3, at_deg
