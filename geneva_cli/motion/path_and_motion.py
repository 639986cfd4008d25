"""Curved slots, which are solved for from a known pin path and a motion by a law."""

from __future__ import annotations

from typing import ClassVar

from geneva_cli.errors import refuse_text
from geneva_cli.motion.engagement import Anchor, Peak, Slot, WheelMotion
from geneva_cli.motion.laws.law import Law, greatest, remaining
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Batchable, all_true, ascending, library
from geneva_cli.numerics.jet import Jet, Number, piecewise, sin_cos


class MiddlePath(Batchable):
    """The pin's path, written about mid-motion."""

    def __init__(self, middle: Anchor) -> None:
        self.middle = middle

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) on its circle at input angles in degrees."""
        return self.middle.place(input_deg, order)


class SolvedSlot(Slot):
    """Slot along the pin's path as seen from the turning wheel."""

    curved, walls_flat = True, False

    def __init__(self, path: MiddlePath, motion: WheelMotion) -> None:
        self.path, self.motion = path, motion

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        (x, y), (s, c) = self.path(input_deg, order), sin_cos(self.motion(input_deg, order))
        return x * c + y * s, y * c - x * s


MOTION_MIN = 1e-10  # degrees: a shorter motion, or dwell, is rounding


class LawMotion(WheelMotion):
    """A law, scaled to the wheel's step and to the motion angle."""

    BREAKS_TO: ClassVar[float] = 1e-15  # a few roundings of an angle

    def __init__(self, entry_deg: float, exit_deg: float, half_step: float, law: Law) -> None:
        super().__init__(entry_deg, exit_deg, half_step)
        self.law = law

    @property
    def symmetric(self) -> bool:
        return all_true(self.law.symmetric) and super().symmetric

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        whole = self.exit_deg - self.entry_deg
        places = (0.5, *self.law.breaks)
        inner = [0.0, *[self.entry_deg + u * whole for u in places]]
        if self.symmetric:
            inner = [0.0, *[(u - 0.5) * whole for u in self.law.breaks]]
        return (self.entry_deg, *ascending(inner), self.exit_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        whole = self.exit_deg - self.entry_deg
        inner = sorted({0.5, *self.law.knots})
        return (self.entry_deg, *[self.entry_deg + u * whole for u in inner], self.exit_deg)

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        if self.law.varies:
            return None
        size, u = greatest(self.law)[quantity]
        whole, step = self.exit_deg - self.entry_deg, 2.0 * self.half_step
        at_deg = self.entry_deg + u * whole if u <= 0.5 else self.exit_deg - (1.0 - u) * whole
        if quantity == "power":  # velocity times acceleration
            size = size * step
        times = {"velocity": 1, "acceleration": 2, "jerk": 3, "power": 3}[quantity]
        return Peak(size * step / radians(whole) ** times, at_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        whole, step = self.exit_deg - self.entry_deg, 2.0 * self.half_step
        middle = 0.5 * (self.entry_deg + self.exit_deg)

        def first(x: Number) -> Jet:
            fraction = (x - self.entry_deg) / whole
            return self.law.first(fraction, order) * step - self.half_step

        def second(x: Number) -> Jet:
            rest = self.law.second((self.exit_deg - x) / whole, order)
            return remaining(rest * step, self.half_step)

        s = piecewise(input_deg, (middle,), (first, second))
        rate = 1.0 / (whole * (library(input_deg).pi / 180.0))
        return Jet([c * rate**k if k else c for k, c in enumerate(s.c)])


def refuse_alpha0(alpha0_deg: float, natural_deg: float) -> None:
    """Raise GenevaError if the extra dwell leaves no motion angle, or no dwell at all."""
    low, high = natural_deg - 360.0 + MOTION_MIN, natural_deg - MOTION_MIN
    text = "alpha0_deg = {angle:.12g} leaves no motion angle between 0 and 360 degrees; it must be "
    text += "above {low:.12g} and below {high:.12g}"
    outside = (alpha0_deg <= low) | (alpha0_deg >= high)
    key = ("motion", "alpha0_deg")
    refuse_text(outside, key, text, angle=alpha0_deg, low=low, high=high)
