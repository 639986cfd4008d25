"""Carousel: the finger stands, and a carrier takes the wheels round it.

The input turns the carrier. Seen from the carrier, the finger turns backwards, and a wheel is that
of a plain crank: path, slot, motion and clearances are the same. With the carrier at c, the wheel
stands at c + psi(c) from the ground. An internal wheel turns against the carrier: c - psi(c).
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar

from geneva_cli.drives.transmission import Transmission
from geneva_cli.errors import refuse_text
from geneva_cli.motion.compatible import (
    KIND,
    ONE_ROLLER,
    UNBALANCED,
    Conflict,
    of_transmission,
    unset,
)
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.pivots import Dimension, Layout, Pivot, wheel_places
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.rules import Range


class Carousel(Transmission, kw_only=True):
    """Equal ``wheels`` that orbit on a carrier, evenly spaced, and index at a fixed finger.

    ``n_rpm`` is the carrier's speed. ``rollers`` are the fingers, if there is one wheel.

    >>> orbit = Design(External(4), Carousel(wheels=3))
    >>> orbit.timing.motion_deg
    90.0
    """

    NAME: ClassVar[str] = "carousel"
    WORDS: ClassVar[str] = "a carrier round a fixed finger"
    direct: ClassVar[bool] = True
    SHARED: ClassVar[tuple[str, ...]] = ("rollers", "wheels")  # they decide when loads repeat
    FIRST: ClassVar[str] = "its carrier turns at a constant speed"
    wheels: Annotated[int, Range(1, 24), "number of wheels on the carrier, evenly spaced"] = 1

    def __post_init__(self) -> None:
        super().__post_init__()
        vars(self)["wheels_on_carrier"] = self.wheels

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """Plan of one wheel; the others do the same later. Only one of them moves at a time."""
        plan = super().plan(wheel, motion, L)
        moving = plan.engagements[0].motion_deg  # several wheels have one kind of motion
        text = "wheels = {wheels}: each moves for {moving:.6g} deg of the carrier, so that they "
        values = {"wheels": self.wheels, "moving": moving, "most": rollers_max(moving)}
        text, meet = text + "would meet; at most {most}", self.wheels * moving >= 360.0
        refuse_text(self.wheels > 1 and meet, (self.TABLE, "wheels"), text, **values)
        return plan

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Axes and number of wheels, and the radius on which they orbit."""
        _, *others = wheel_places(self.wheels, sign, plan.center_distance_mm)
        return (
            *(Pivot(f"axis of wheel {place.number}", *place.at) for place in others),
            Dimension("wheels on the carrier", self.wheels),
            Dimension("orbit's radius", plan.center_distance_mm, "mm"),
        )


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of wheels on a carrier."""
    yield from of_transmission(spec)
    why = f"is for a wheel at a fixed place, not for {KIND}, whose wheels orbit at constant speed"
    yield from unset(spec, "drive.stop_s product.pitch_mm support.gear_ratio", why)
    text = f"{KIND} needs balanced wheels, as a body off the axis would pull in another direction "
    yield spec.unbalanced, ("mass", "radius_mm"), f"{text}in each motion: {UNBALANCED}"
    if spec.drive.wheels_on_carrier > 1:
        why = "is not for several wheels that meet one finger; set wheels = 1, or"
        yield from unset(spec, ONE_ROLLER, why)
        text = "an internal wheel surrounds the finger, so that one alone fits: set wheels = 1"
        yield spec.wheel.SIGN < 0.0, ("drive", "wheels"), text
