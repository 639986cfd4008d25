"""Carousel: the finger stands, and a carrier takes the wheel round it.

The input turns the carrier. Seen from the carrier, the finger turns backwards, and the wheel is
that of a plain crank: path, slot, motion and clearances are the same. With the carrier at c, the
wheel stands at c + psi(c) from the ground. An internal wheel turns against the carrier: c - psi(c).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.kinematics.layout import Dimension, Layout
from geneva_cli.machine.drives.transmission import Direct
from geneva_cli.spec.example import Example

if TYPE_CHECKING:
    from geneva_cli.kinematics.drive import Plan


class Carousel(Direct, kw_only=True):
    """A wheel that orbits on a carrier about fixed fingers, which are its ``rollers``.

    ``n_rpm`` is the carrier's speed.

    >>> orbit = Design(External(4), Carousel())
    >>> orbit.mechanism.absolute_deg(45.0, 45.0)  # at exit: the carrier's angle and its own
    90.0
    """

    NAME: ClassVar[str] = "carousel"
    WORDS: ClassVar[str] = "a carrier round fixed fingers"
    EXAMPLE: ClassVar[Example] = Example(
        "a wheel orbits on a carrier and indexes at a fixed finger, as in wandering hours",
        {"wheel": {"z": 4}, "drive": {"n_rpm": 1.0}},
    )
    GEARINGS: ClassVar[tuple[str, ...]] = ("external", "internal")
    FRAME_TURNS: ClassVar[float] = 1.0

    def layout(self, plan: Plan, sign: float) -> Layout:
        """The radius on which the wheel orbits."""
        return (Dimension("orbit's radius", plan.center_distance_mm, "mm"),)
