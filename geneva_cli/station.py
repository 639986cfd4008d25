"""One index of the wheel: pin path, slot and motion, of which two are known and give the third.

A station is the motion of one roller through one slot. Input angles are degrees from the
station's own mid-motion, wheel angles radians from half-way through the step, lengths in units of
the centre distance L. The wheel's axis is the origin, the crank's axis at (1, 0).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import NamedTuple

from geneva_cli.jet import Coefficient, Jet, atan2, piecewise, sin_cos, sqrt
from geneva_cli.laws import Law, remaining
from geneva_cli.units import DEGREE, radians


class Anchor(NamedTuple):
    """A moment about which the pin's path is written without cancellation."""

    input_deg: float
    wheel: float  # direction of the ray from the wheel's axis to the pin there, radians
    along: float  # distance of the pin from the wheel's axis there
    displacement: Callable[[Jet], tuple[Jet, Jet]]
    # input angle since then, radians -> the pin's way (along the ray, across it)

    def place(self, input_deg: Coefficient, order: int) -> tuple[Jet, Jet]:
        """The pin (along the anchor's ray, across it) at an input angle in degrees."""
        tau = Jet.variable(radians(input_deg - self.input_deg), order)
        along, across = self.displacement(tau)
        return along + self.along, across


class Station(ABC):
    """One motion: input window, pin path, slot and wheel angle, each as a function of the input."""

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

    @abstractmethod
    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller's centre (x, y) in the fixed frame."""

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The roller's centre in the wheel's frame: the slot's pitch curve."""
        x, y = self.pin(input_deg, order)
        s, c = sin_cos(self.motion(input_deg, order))
        return x * c + y * s, y * c - x * s


class SlotDriven(Station):
    """Pin path and straight radial slot are known and give the motion."""

    def __init__(self, mid_deg: float, half_step: float, anchors: tuple[Anchor, ...]) -> None:
        super().__init__(mid_deg, anchors[0].input_deg, anchors[-1].input_deg, half_step)
        self.anchors = anchors
        degs = [a.input_deg for a in anchors]
        self._cuts = [0.5 * (a + b) for a, b in zip(degs, degs[1:], strict=False)]

    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """The pin's direction, taken from the nearest anchor: exactly at rest at both ends."""

        def about(anchor: Anchor) -> Callable[[Coefficient], Jet]:
            def solve(x: Coefficient) -> Jet:
                along, across = anchor.place(x, order)
                return atan2(across, along) + anchor.wheel

            return solve

        return piecewise(input_deg, self._cuts, [about(a) for a in self.anchors])

    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin on its path, from mid-motion."""
        return self.anchors[1].place(input_deg, order)

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin runs along the slot's straight axis."""
        x, y = self.pin(input_deg, order)
        return sqrt(x * x + y * y), x * 0.0


class LawDriven(Station):
    """Pin path and motion are known and give the slot (a curved one)."""

    def __init__(
        self, mid_deg: float, motion_deg: float, half_step: float, law: Law, middle: Anchor
    ) -> None:
        half = 0.5 * motion_deg
        super().__init__(mid_deg, -half, half, half_step)
        self.law = law
        self.middle = middle

    @property
    def symmetric(self) -> bool:
        """A law with two unlike halves makes a motion with two unlike halves."""
        return self.law.first is self.law.second

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        """Entry, the law's own breaks, mid-motion, and exit."""
        inner = {0.0, *[(u - 0.5) * self.motion_deg for u in self.law.breaks]}
        return (self.entry_deg, *sorted(inner), self.exit_deg)

    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """The law, scaled to the step and to the motion angle."""
        whole, step = self.motion_deg, 2.0 * self.half_step

        def first(x: Coefficient) -> Jet:
            return self.law.first((x - self.entry_deg) / whole, order) * step - self.half_step

        def second(x: Coefficient) -> Jet:
            rest = self.law.second((self.exit_deg - x) / whole, order)
            return remaining(rest * step, self.half_step)

        s = piecewise(input_deg, (0.0,), (first, second))
        rate = 1.0 / (whole * DEGREE)
        return Jet([c * rate**k if k else c for k, c in enumerate(s.c)])

    def pin(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin on its circle."""
        return self.middle.place(input_deg, order)
