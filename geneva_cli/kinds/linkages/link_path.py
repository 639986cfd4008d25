"""The closed path of a point of a linkage, and velocity and joint reactions of its link."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from typing import Any, NamedTuple, Self, TypeAlias, cast

from geneva_cli.drives.pushed import pushed
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.arrays import Array, Batchable, Complex, Enclosed, Which, enclosed, library
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


class Guide(NamedTuple):
    """How a link's joint B is guided: on a circle or a line, along whose normal the force acts."""

    length: float  # from A to B
    bend: float  # curvature of B's path: 1/c on a circle, 0 on a line
    x: float  # the normal is (x, y) - bend * B: towards a circle's centre
    y: float


Place: TypeAlias = tuple[Any, Any]
Turn: TypeAlias = tuple[float, float, float, float, float]


class LinkDisplacement(NamedTuple):
    """Displacement of a link's point, from its numbers at one crank angle.

    When A has moved by D, the link b e has turned by an angle t, with B on its circle or line. With
    the normal n there, k = ``bend`` and w = (n - k D)* e, that is

        Im w sin t + (Re w + k b)(1 - cos t) = (Re n* D - k |D|²/2) / b ,

    which tan(t/2) solves. The displacement is the velocity times sin d, and terms of second order:
    so it has all its digits where the point is much slower than its links.
    """

    # Numbers of the equation over its first factor: of sin t by sin d and 1 - cos d; of 1 - cos t;
    # of the right-hand side by sin d, which is the link's rate of rotation, and by -(1 - cos d).
    turn: Turn
    # the displacement (x, y) by sin d, by 1 - cos d, by what -sin t has beyond its linear part, and
    # by 1 - cos t
    factors: tuple[Place, ...]

    @property
    def velocity(self) -> Complex:
        """Complex velocity at that angle."""
        x, y = self.factors[0]
        return cast("Complex", x + 1j * y)

    def along(self, x: float, y: float, scale: float, sense: float) -> LinkDisplacement:
        """Return the displacement along a vector (x, y) and across it, times numbers."""
        out = []
        for u, v in self.factors:
            out.append(((u * x + v * y) * scale, (v * x - u * y) * (sense * scale)))
        return LinkDisplacement(self.turn, tuple(out))

    def __call__(self, tau: Number, order: int) -> Vector:
        """Displacement (x, y) after a rotation d of the crank, ``tau`` radians."""
        sine, versine = rotation(tau, order)
        _, fallen, bent = rotated(enclosed(tau, self.turn), sine, versine)
        (vx, vy), (px, py), (bx, by), (fx, fy) = (enclosed(tau, one) for one in self.factors)
        return (
            sine * vx + versine * px + bent * bx + fallen * fx,
            sine * vy + versine * py + bent * by + fallen * fy,
        )


def rotated(numbers: Turn, sine: Jet, versine: Jet) -> tuple[Jet, Jet, Jet]:
    """sin t, 1 - cos t and what -sin t has beyond its linear part, from sin d and 1 - cos d."""
    ahead, back, side, rate, fall = numbers
    more, low = sine * ahead + versine * back, versine * fall
    first, level, right = more + 1.0, side - sine * back + versine * ahead, sine * rate - low
    root = sqrt(first * first + right * (level * 2.0 - right))
    tangent = right / (first + root)
    turn = tangent * 2.0 / (tangent * tangent + 1.0)
    fallen = turn * tangent
    return turn, fallen, low + level * fallen + more * turn


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
        numbers = (cast("Array", x)[which] if is_array(x) else x for x in self.numbers)
        return self.having(cast("tuple[float, ...]", tuple(numbers)))

    def having(self, numbers: tuple[float, ...]) -> Self:
        """The path with other numbers."""
        other = copy.copy(self)
        other.numbers = numbers
        return other

    def link(self, angle: Jet) -> Vector:
        """Unit vector along the link, from A towards B, for the crank's angle in radians."""
        path, (sine, cosine) = self, sin_cos(angle)
        if isinstance(angle.c[0], Enclosed):  # the rounding of what its numbers make counts, too
            path = self.having(enclosed(angle.c[0], self.numbers))
        x, y, _ = path.pose(cosine, sine)
        return x, y

    def turn(self, crank: Any, order: int = 2) -> tuple[Place, Place, Turn]:
        """Unit vector (x, y) along the link, place (x, y) of A, and how the link turns from there.

        ``crank`` is the direction of A, a complex unit vector, or an array of them. Order 1 asks
        for the link's rate alone.
        """
        (u, v, sine), (b, bend, x, y) = self.pose(crank.real, crank.imag), self.guide
        # products of real numbers take half the time of complex ones
        px, py, one = self.numbers[0] * crank.real, self.numbers[0] * crank.imag, 1.0 / sine
        over, back = one / b, (v * px - u * py) * bend
        rate, ahead, fall, side = (y * px - x * py - b * back) * over, 0.0, 0.0, 0.0
        if order > 1:
            ahead = (u * px + v * py) * bend
            fall, side = (x * px + y * py - b * ahead) * over, (x * u + y * v - ahead) * one
        return (u, v), (px, py), (ahead * one, back * one, side, rate, fall)

    @property
    @abstractmethod
    def guide(self) -> Guide:
        """The guide of the link at its joint B."""

    @abstractmethod
    def pose(self, c: Any, s: Any) -> tuple[Any, Any, Any]:
        """Unit vector (x, y) along the link, and the sine of its angle from the normal of B's path.

        They are numbers or jets, as the cosine and the sine of the crank's angle.
        """

    def about(self, crank: Any, velocity: Any = None) -> LinkDisplacement:
        """The point's displacement since a direction of the crank; exactly 0 for no rotation.

        The direction is a complex unit vector, and so is the velocity, if it is known.
        """
        (x, y), (px, py), turn = self.turn(crank)
        pin, arm = px + 1j * py, (x + 1j * y) * (self.numbers[-2] + 1j * self.numbers[-1])
        if velocity is None:
            velocity = 1j * (pin + turn[3] * arm)
        factors = velocity, -pin, -1j * arm, -arm
        return LinkDisplacement(turn, tuple((z.real, z.imag) for z in factors))

    def joints(self, crank: Any) -> tuple[Any, Any, Any]:
        """Crank pin A, the other joint B and the point, for directions of the crank; complex."""
        a, *_, p, q = self.numbers
        pin, (x, y, _) = a * crank, self.pose(crank.real, crank.imag)
        along = x + 1j * y
        return pin, pin + self.guide.length * along, pin + along * (p + 1j * q)


def root(x: Any) -> Any:
    """Square root of a number or a jet."""
    return sqrt(x) if isinstance(x, Jet) else library(x).sqrt(x)


class LinkRate(NamedTuple):
    """Angular velocity of the link that carries the roller."""

    path: LinkPath
    middle: float  # the crank's angle at mid-motion
    sense: float

    def __call__(self, tau: Number, order: int) -> Jet:
        """Rate in radians per input radian, positive with the wheel, ``tau`` after mid-motion."""
        x, y = self.path.link(Jet.variable(tau + self.middle, order + 1))
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
        angle = turn + self.middle
        (sine, cosine), (ex, ey) = sin_cos(angle), self.path.link(angle)
        (a, *_, p, q), (length, bend, nx, ny) = self.path.numbers, self.path.guide
        arm, point = (ex * length, ey * length), (ex * p - ey * q, ex * q + ey * p)
        normal = (cosine * a + arm[0]) * -bend + nx, (sine * a + arm[1]) * -bend + ny
        # from A, over L, and from the path's axes to the machine's
        place, held, direction = (
            ((x * self.x + y * self.y) / self.L, (y * self.x - x * self.y) * (self.sense / self.L))
            for x, y in (point, arm, (normal[0] * self.L, normal[1] * self.L))
        )
        return pushed(loads, place, direction, cross(held, direction))
