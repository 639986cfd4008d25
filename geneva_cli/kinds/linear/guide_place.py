"""Where the guide of a rack stands, and how long it is.

A bar under the rack's back slides between a rail and a wall. The rack lies on the rail, which the
arm's eye passes a quarter of a bar away. The rack covers its guide in each of its steps: when the
first one begins, it ends R - w past the crank's axis, w being half a slot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.loads.strength.pin import pin_diameter_mm
from geneva_cli.numerics.arrays import choose, larger
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.least_wall import eye_about, wall_min

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism


class GuidePlace(NamedTuple):
    """Place and sizes of a guide, mm; x runs from the deepest roller towards the crank's axis."""

    slot: float  # half of the slot's width
    bottom: float  # clearance between the deepest roller and the slot's end
    rail: float  # distance of the rail's front behind the deepest roller
    bar: float  # width of the bar on the rack's back, and of the rail
    slide: float  # clearance of the bar on either side
    half: float  # half of the guide's length; 0 or less where the slots are too wide for a guide

    @property
    def back(self) -> float:
        """The x of the bar's back."""
        return 0.0 - (self.rail + 2.0 * self.bar + self.slide)

    @property
    def middle(self) -> float:
        """The x of the bar's middle."""
        return self.back + 0.5 * self.bar


def guide_place(mechanism: Mechanism) -> GuidePlace:
    """Return the place of a rack's guide; (m, 1) each for m designs."""
    size, r = mechanism.spec.size, mechanism.roller_radius_mm
    R = mechanism.ratio * mechanism.center_distance_mm
    slide = size.allowances.slot_clearance_mm
    half_slot = r + slide
    bottom = value_or(size.slot_bottom_clearance_mm, larger(slide, r / 20.0))
    # the holes of its screws take at most half of the bar, and leave a wall on either side
    wall = wall_min(size, R)
    bar = larger(R / 10.0, 4.0 * wall)
    rail = larger(bottom + half_slot, _eye_mm(mechanism, wall) + 0.25 * bar)
    return GuidePlace(half_slot, bottom, rail, bar, slide, R - half_slot)


def _eye_mm(mechanism: Mechanism, wall: float) -> float:
    """Return the radius of the arm's eye about the pin; 0 without a pin, and so without an arm."""
    size = mechanism.spec.size
    hole = 0.5 * (pin_diameter_mm(mechanism) - size.allowances.press_fit_mm)
    eye = eye_about(hole, wall) if size.arm_eye_mm is None else 0.5 * size.arm_eye_mm
    return eye if size.pin_mm is None else choose(size.pin_mm > 0.0, eye, 0.0 * eye)
