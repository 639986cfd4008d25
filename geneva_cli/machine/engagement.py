"""One index of the wheel: pin path, slot and motion, of which two are known and give the third.

A station is the motion of one roller through one slot. Input angles are degrees from the
station's own mid-motion, wheel angles radians from half-way through the step, lengths in units of
the centre distance L. The wheel's axis is the origin, the crank's axis at (1, 0).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.machine.laws.standard import Law, remaining
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.jet import Coefficient, Jet, atan2, piecewise, sin_cos, sqrt

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Anchor(NamedTuple):
    """A moment about which the pin's path is written without cancellation."""

    input_deg: float
    wheel: float  # direction of the ray from the wheel's axis to the pin there, radians
    along: float  # distance of the pin from the wheel's axis there
    displacement: Callable[[Coefficient, int], tuple[Jet, Jet]]
    # input angle since then, radians, and order -> the pin's way (along the ray, across it)

    def way(self, input_deg: Coefficient, order: int) -> tuple[Jet, Jet]:
        """The pin's way since the anchor (along its ray, across it), at an angle in degrees."""
        return self.displacement(radians(input_deg - self.input_deg), order)

    def place(self, input_deg: Coefficient, order: int) -> tuple[Jet, Jet]:
        """The pin (along the anchor's ray, across it) at an input angle in degrees."""
        along, across = self.way(input_deg, order)
        return along + self.along, across


NEAR_END = 0.75  # share of the way to an end from the last anchor before it; beyond, its own serves
END_DEG = 0.05  # closer than this to entry or exit, relative accuracy is kept too


def is_mirrored(input_deg: Array) -> bool:
    """Whether the angles lie symmetrically about mid-motion."""
    return bool((input_deg == -input_deg[::-1]).all())


def mirror(first: Array, count: int, order: int) -> Array:
    """``count`` values of a derivative from their first half; the even ones change sign."""
    import numpy

    rest = first[: count - len(first)][::-1]
    return numpy.concatenate((first, rest if order % 2 else -rest))


class Station(ABC):
    """One motion: input window, pin path, slot and wheel angle, each as a function of the input."""

    # sign, l and 1 - l where closed forms hold: straight radial slots on a plain crank
    classic: tuple[float, float, float] | None = None
    # size and angle (degrees) of the peak acceleration, where there is a quicker way to it
    known_peak: Callable[[], tuple[float, float]] | None = None
    # which way the crank turns where the roller is not on its arm: with the wheel (-1) or against
    # it (1); 0 where it is, and the pin's direction is the crank's
    crank_sense = 0.0
    # of a straight slot: by how much its axis misses the wheel's centre
    offset = 0.0
    # input angle, radians, and order -> how fast the body that carries the roller turns, positive
    # with the wheel; None where that is the crank, on whose arm the roller sits
    body: Callable[[Coefficient, int], Jet] | None = None

    def __init__(self, mid_deg: float, entry_deg: float, exit_deg: float, half_step: float) -> None:
        self.mid_deg = mid_deg  # the machine's input angle at this station's mid-motion
        self.entry_deg = entry_deg  # from mid_deg, negative
        self.exit_deg = exit_deg
        self.half_step = half_step  # b: the wheel goes from -b to b

    @property
    def motion_deg(self) -> float:
        """Input angle of the motion."""
        return self.exit_deg - self.entry_deg

    @property
    def symmetric(self) -> bool:
        """Whether the second half of the motion mirrors the first."""
        return self.entry_deg == -self.exit_deg

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        """Entry, the places where a derivative may jump, mid-motion, and exit."""
        return (self.entry_deg, 0.0, self.exit_deg)

    @abstractmethod
    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """Wheel angle with its derivatives by the input angle in radians."""

    def derivatives(self, input_deg: Array, orders: Sequence[int] = (0, 1, 2, 3)) -> list[Array]:
        """The wheel's angle and its derivatives at many ascending input angles.

        A symmetric motion at symmetric angles is computed once and mirrored.
        """
        mirrored = self.symmetric and is_mirrored(input_deg)
        first = input_deg[: (len(input_deg) + 1) // 2] if mirrored else input_deg
        values = self.motion(first, max(orders)).derivatives()
        return [mirror(values[k], len(input_deg), k) if mirrored else values[k] for k in orders]

    @abstractmethod
    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller's centre (x, y) in the fixed frame."""

    @property
    def slot_station(self) -> Station:
        """The station whose roller runs through the whole slot: this one, as a rule."""
        return self

    def rail(self, input_deg: Coefficient, order: int = 0) -> tuple[Jet, Jet] | None:
        """Of a straight slot: the lever of its normal about the wheel's axis, and the pin's speed
        along it. None for a curved one.
        """
        return None

    def carrier(self, input_deg: Coefficient, order: int = 0) -> Jet:
        """Rate at which the body that carries the roller turns, positive with the wheel.

        About the roller's own axis, in radians per input radian.
        """
        if self.body:
            return self.body(radians(input_deg), order)
        x, y = self.pin(input_deg, order + 1)
        return atan2(y, x - 1.0).derivative()

    def upright(self, input_deg: Coefficient, order: int = 0) -> Jet | float:
        """Cosine of the angle between the roller's axis and the wheel's."""
        return 1.0

    def touches(self, input_deg: Coefficient) -> Coefficient:
        """1 where the roller drives the wheel, 0 where something else does."""
        return 1.0

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller's centre in the wheel's frame: the slot's pitch curve."""
        x, y = self.pin(input_deg, order)
        s, c = sin_cos(self.motion(input_deg, order))
        return x * c + y * s, y * c - x * s


class SlotDriven(Station):
    """Pin path and a straight radial slot are known and give the motion."""

    def __init__(
        self,
        mid_deg: float,
        half_step: float,
        anchors: tuple[Anchor, ...],
        classic: tuple[float, float, float] | None = None,
        ahead: float = 0.0,
        mirrored: bool = True,
    ) -> None:
        super().__init__(mid_deg, anchors[0].input_deg, anchors[-1].input_deg, half_step)
        self.anchors = anchors
        self.classic = classic
        self.mirrored = mirrored  # False where the path's two halves differ
        self.ahead = ahead  # direction of the middle anchor's ray, from the line of centres
        self.middle = anchors[len(anchors) // 2]
        # Each anchor serves what is near it; entry and exit, only where the motion goes to zero.
        first, *inner, last = [a.input_deg for a in anchors]
        self._cuts = [
            inner[0] + NEAR_END * (first - inner[0]),
            *[0.5 * (a + b) for a, b in pairwise(inner)],
            inner[-1] + NEAR_END * (last - inner[-1]),
        ]

    @property
    def symmetric(self) -> bool:
        """Whether path and slot have a mirror image about mid-motion."""
        return self.mirrored and super().symmetric

    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """The pin's direction, taken from the nearest anchor: exactly at rest at both ends."""

        def about(anchor: Anchor) -> Callable[[Coefficient], Jet]:
            def solve(x: Coefficient) -> Jet:
                along, across = anchor.place(x, order)
                return atan2(across, along) + anchor.wheel

            return solve

        return piecewise(input_deg, self._cuts, [about(a) for a in self.anchors])

    def derivatives(self, input_deg: Array, orders: Sequence[int] = (0, 1, 2, 3)) -> list[Array]:
        """As of any station; a plain crank's in closed form.

        Near the ends angle and velocity are written from there, and keep their relative accuracy.
        """
        if self.classic is None:
            return super().derivatives(input_deg, orders)
        from geneva_cli.machine.wheels.classic_arrays import Kernel

        out = Kernel(*self.classic).derivatives(input_deg, orders, is_mirrored(input_deg))
        first = int(input_deg.searchsorted(self.entry_deg + END_DEG))
        last = int(input_deg.searchsorted(self.exit_deg - END_DEG))
        for part, side in ((slice(0, first), -1.0), (slice(last, None), 1.0)):
            for k, o in zip(orders, out, strict=True):
                if k < 2 and len(o[part]):
                    o[part] = self._near_end(input_deg[part], side, k)
        return out

    def _near_end(self, input_deg: Array, side: float, order: int) -> Array:
        """Angle or velocity of a classic wheel near exit (side 1) or entry (-1), from there."""
        import numpy as np

        assert self.classic is not None
        sign, l, _ = self.classic
        tau = radians(self.exit_deg - side * input_deg)
        along = self.anchors[0].along - sign * l * np.sin(tau)
        across = 2.0 * l * np.sin(0.5 * tau) ** 2
        if order == 0:
            angle: Array = side * (self.half_step - np.arctan2(across, along))
            return angle
        half = radians(self.exit_deg) - 0.5 * tau
        speed = 2.0 * l * np.sin(0.5 * tau) * np.sin(half)
        velocity: Array = speed / (along * along + across * across)
        return velocity

    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin on its path, from mid-motion."""
        along, across = self.middle.place(input_deg, order)
        return turned(along, across, self.ahead)

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin runs along the slot's straight axis."""
        depth = _length(*self.middle.place(input_deg, order))
        return turned(depth, depth * 0.0, self.ahead - self.middle.wheel)

    def rail(self, input_deg: Coefficient, order: int = 0) -> tuple[Jet, Jet]:
        """Lever of the slot's normal about the wheel's axis, and the pin's speed along it."""
        depth = _length(*self.middle.place(input_deg, order + 1))
        return Jet(depth.c[:-1]), depth.derivative()


class SphereDriven(SlotDriven):
    """A spherical wheel: the path is the pin's projection along the wheel's axis.

    The slot is a meridian; its pitch curve is given in the flat development, along which lengths
    on the sphere are kept, from the wheel's pole.
    """

    def __init__(
        self,
        mid_deg: float,
        half_step: float,
        anchors: tuple[Anchor, ...],
        height: Callable[[Coefficient, int], Jet],
    ) -> None:
        super().__init__(mid_deg, half_step, anchors)
        self.height = height  # input angle, radians -> the pin's place along the wheel's axis

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin's polar angle on the wheel, in radians: arc length over the sphere's radius."""
        x, y = self.pin(input_deg, order)
        polar = atan2(sqrt(x * x + y * y), self.height(radians(input_deg), order))
        return polar, polar * 0.0

    def rail(self, input_deg: Coefficient, order: int = 0) -> tuple[Jet, Jet]:
        """The lever is the pin's distance from the wheel's axis."""
        polar = self.pitch(input_deg, order + 1)[0]
        return sin_cos(Jet(polar.c[:-1]))[0], polar.derivative()

    def upright(self, input_deg: Coefficient, order: int = 0) -> Jet:
        """The roller's axis passes the sphere's centre, at the polar angle of the pin."""
        return sin_cos(self.pitch(input_deg, order)[0])[1]


def _length(x: Jet, y: Jet) -> Jet:
    return sqrt(x * x + y * y)


def turned(x: Jet, y: Jet, angle: float) -> tuple[Jet, Jet]:
    """A vector turned by a fixed angle in radians."""
    if angle == 0.0:
        return x, y
    s, c = math.sin(angle), math.cos(angle)
    return x * c - y * s, x * s + y * c


class LawMotion(Station):
    """A station whose motion is given by a law."""

    def __init__(
        self, mid_deg: float, entry_deg: float, exit_deg: float, half_step: float, law: Law
    ) -> None:
        super().__init__(mid_deg, entry_deg, exit_deg, half_step)
        self.law = law

    @property
    def symmetric(self) -> bool:
        """A law with two unlike halves makes a motion with two unlike halves."""
        return self.law.first is self.law.second

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        """Entry, the law's own breaks and its middle, the crossing of the centres, and exit."""
        places = (0.5, *self.law.breaks)
        inner = {0.0, *[self.entry_deg + u * self.motion_deg for u in places]}
        if self.symmetric:
            inner = {0.0, *[(u - 0.5) * self.motion_deg for u in self.law.breaks]}
        return (self.entry_deg, *sorted(inner), self.exit_deg)

    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """The law, scaled to the step and to the motion angle."""
        whole, step = self.motion_deg, 2.0 * self.half_step
        middle = 0.5 * (self.entry_deg + self.exit_deg)

        def first(x: Coefficient) -> Jet:
            return self.law.first((x - self.entry_deg) / whole, order) * step - self.half_step

        def second(x: Coefficient) -> Jet:
            rest = self.law.second((self.exit_deg - x) / whole, order)
            return remaining(rest * step, self.half_step)

        s = piecewise(input_deg, (middle,), (first, second))
        rate = 1.0 / (whole * DEGREE)
        return Jet([c * rate**k if k else c for k, c in enumerate(s.c)])


class LawDriven(LawMotion):
    """Pin path and motion are known and give the slot (a curved one)."""

    def __init__(
        self, mid_deg: float, motion_deg: float, half_step: float, law: Law, middle: Anchor
    ) -> None:
        half = 0.5 * motion_deg
        super().__init__(mid_deg, -half, half, half_step, law)
        self.middle = middle

    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin on its circle."""
        return self.middle.place(input_deg, order)
