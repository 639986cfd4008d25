"""Curved slots, which are solved for from a known pin path and motion."""

from __future__ import annotations

from geneva_cli.motion.engagement import Anchor, Slot, WheelMotion, in_wheel
from geneva_cli.numerics.arrays import Batchable
from geneva_cli.numerics.jet import Jet, Number


class MiddlePath(Batchable):
    """The pin's path, written about mid-motion.

    ``mirrored`` is True if its second half is the mirror image of its first.
    """

    def __init__(self, middle: Anchor, mirrored: bool = True) -> None:
        self.middle, self.mirrored = middle, mirrored

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) on its circle at input angles in degrees."""
        return self.middle.place(input_deg, order)


class SolvedSlot(Slot):
    """Slot along the pin's path as seen from the turning wheel."""

    curved = True

    def __init__(self, path: MiddlePath, motion: WheelMotion) -> None:
        self.path, self.motion = path, motion
        self.mirrored = path.mirrored

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) in the wheel's frame."""
        return in_wheel(self.path(input_deg, order), self.motion(input_deg, order))
