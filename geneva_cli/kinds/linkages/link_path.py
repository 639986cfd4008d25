"""The closed path of a point of a linkage, and velocity and joint reactions of its link."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from typing import Any, NamedTuple, Self, cast

from geneva_cli.drives.pushed import pushed
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.arrays import Array, Batchable, Complex, Which, enclosed
from geneva_cli.numerics.jet import (
    Held,
    Jet,
    Loads,
    Number,
    Vector,
    cross,
    rotation,
    sin_cos,
    sqrt,
    turning,
)
from geneva_cli.spec.rules import is_array


class LinkPose(NamedTuple):
    """A link at some places of A, and the path of its other joint B: a circle or a line."""

    along: Any  # unit vector from A towards B, complex
    length: float  # from A to B
    sine: Any  # of the angle from the path's normal to the link
    bend: float  # curvature of the path: 1/c on a circle, 0 on a line
    foot: tuple[float, float]  # the normal is ``foot - bend * B``: towards a circle's centre


class LinkDisplacement(NamedTuple):
    """Displacement of a link's point, from its numbers at one crank angle.

    When A has moved by D, the link b e has turned by an angle t, with B on its circle or line. With
    the normal n there, k = ``bend`` and w = (n - k D)* e, that is

        Im w sin t + (Re w + k b)(1 - cos t) = (Re n* D - k |D|²/2) / b ,

    which tan(t/2) solves. The displacement is the velocity times sin d, and terms of second order:
    so it has all its digits where the point is much slower than its links.
    """

    # numbers of the equation over its first factor: of sin t by sin d and 1 - cos d
    ahead: float
    back: float
    side: float  # of 1 - cos t
    rate: float  # of the right-hand side by sin d, which is the link's rate of rotation
    fall: float  # and by -(1 - cos d)
    # the displacement (x, y) by sin d, by 1 - cos d, by what -sin t has beyond its linear part, and
    # by 1 - cos t
    velocity_x: float
    velocity_y: float
    pin_x: float
    pin_y: float
    bent_x: float
    bent_y: float
    fallen_x: float
    fallen_y: float

    @property
    def velocity(self) -> Complex:
        """Complex velocity at that angle."""
        return cast("Complex", self.velocity_x + 1j * self.velocity_y)

    def along(self, x: float, y: float, scale: float, sense: float) -> LinkDisplacement:
        """Return the displacement along a vector (x, y) and across it, times numbers."""
        factors, out = self[5:], list[float]()
        for u, v in zip(factors[::2], factors[1::2], strict=True):
            out += [(u * x + v * y) * scale, (v * x - u * y) * (sense * scale)]
        return LinkDisplacement(*self[:5], *out)

    def __call__(self, tau: Number, order: int) -> Vector:
        """Displacement (x, y) after a rotation d of the crank, ``tau`` radians."""
        sine, versine = rotation(tau, order)
        ahead, back, side, rate, fall, vx, vy, px, py, bx, by, fx, fy = enclosed(sine.c[0], self)
        more, low = sine * ahead + versine * back, versine * fall
        first, level, right = more + 1.0, side - sine * back + versine * ahead, sine * rate - low
        root = sqrt(first * first + right * (level * 2.0 - right))
        tangent = right / (first + root)
        turn = tangent * 2.0 / (tangent * tangent + 1.0)
        fallen = turn * tangent
        bent = low + level * fallen + more * turn
        return (
            sine * vx + versine * px + bent * bx + fallen * fx,
            sine * vy + versine * py + bent * by + fallen * fy,
        )


class LinkPath(Batchable, ABC):
    """The closed path of a point of the link that crank pin A carries, about the crank's axis.

    ``numbers`` are the lengths in mm, the crank's a first, and last the point's coordinates p along
    the link and q across it: floats, or arrays (n, 1) of a batch.
    """

    def __init__(self, *lengths: float, reach_mm: float, angle_deg: float) -> None:
        sine, cosine = sin_cos_deg(angle_deg)
        self.numbers = (*lengths, reach_mm * cosine, reach_mm * sine)

    def of(self, which: Which | tuple[Which, int]) -> Self:
        """Paths of some of the designs; with numbers (n,) for ``which, 0``."""
        some = copy.copy(self)
        some.numbers = tuple(
            cast(float, cast("Array", x)[which]) if is_array(x) else x for x in self.numbers
        )
        return some

    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Crank pin A (x, y)."""
        a, *_ = self.numbers
        return cosine * a, sine * a

    @abstractmethod
    def link(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Unit vector along the link, from A towards B."""

    @abstractmethod
    def pose(self, crank: Any) -> LinkPose:
        """The link for directions of the crank, complex unit vectors."""

    @abstractmethod
    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """Distance along the link from A to the other joint B, and the line of the force at B."""

    def about(self, crank: Any, velocity: Any = None) -> LinkDisplacement:
        """The point's displacement since a direction of the crank; exactly 0 for no rotation.

        The direction is a complex unit vector, and so is the velocity, if it is known.
        """
        a, *_, p, q = self.numbers
        along, b, sine, bend, (x, y) = self.pose(crank)
        pin, arm, lever = a * crank, along * (p + 1j * q), b * sine
        ahead = along.conjugate() * pin * bend
        rate = (y * pin.real - x * pin.imag + b * ahead.imag) / lever
        fall = (x * pin.real + y * pin.imag - b * ahead.real) / lever
        side = (x * along.real + y * along.imag - ahead.real) / sine
        sizes = ahead.real / sine, -ahead.imag / sine, side, rate, fall
        if velocity is None:
            velocity = 1j * (pin + rate * arm)
        factors = velocity, -pin, -1j * arm, -arm
        return LinkDisplacement(*sizes, *(x for z in factors for x in (z.real, z.imag)))

    def place(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Point (x, y) for a crank direction."""
        a, *_, p, q = self.numbers
        x, y = self.link(sine, cosine)
        return x * p - y * q + cosine * a, x * q + y * p + sine * a


class LinkRate(NamedTuple):
    """Angular velocity of the link that carries the roller."""

    path: LinkPath
    middle: float  # the crank's angle at mid-motion
    sense: float

    def __call__(self, tau: Number, order: int) -> Jet:
        """Rate in radians per input radian, positive with the wheel, ``tau`` after mid-motion."""
        x, y = self.path.link(*sin_cos(Jet.variable(tau + self.middle, order + 1)))
        return turning(x, y) * self.sense


class LinkReactions(NamedTuple):
    """Equilibrium of the link, held by the crank's pin at A, and at B along a known line."""

    path: LinkPath
    middle: float  # the crank's angle at mid-motion
    sense: float
    L: float  # millimetres
    x: float  # direction of the line of centres from the wheel's axis, on the path's axes
    y: float

    def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held:
        """Reactions of the crank's shaft, equal to those at A, and of the third body."""
        sine, cosine = sin_cos(turn + self.middle)
        known = self.path.link, self.path.place, self.path.joint
        (ex, ey), (px, py), (ax, ay) = (f(sine, cosine) for f in known)
        arm, h = self.path.hold(sine, cosine)
        # from A, over L, and from the path's axes to the machine's
        ends = (px - ax, py - ay), (ex * arm, ey * arm), (h[0] * self.L, h[1] * self.L)
        place, held, direction = (
            ((x * self.x + y * self.y) / self.L, (y * self.x - x * self.y) * (self.sense / self.L))
            for x, y in ends
        )
        return pushed(loads, place, direction, cross(held, direction))
