"""The guide of a rack: its place, the forces at its ends, and the friction at which it locks.

At the crank angle a the roller's centre is x = R (1 - cos a) from its deepest place and y = R sin a
from the line of centres. It presses with F on a wall across x, and friction with mu F along x. With
d = 1 where it drives the rack and -1 where it holds it back, s the sign of its sliding, and the
guide's middle at x0, they turn the rack about that middle by

    M = F (d (x - x0) - s mu (y + d r))

A guide that is 2 h long bears on its bar at its two ends, with s mu F/2 + M/(2 h) and s mu F/2 -
M/(2 h). Its friction nu holds the rack back by D = nu times the greater of |M|/h and mu F: d F =
T/R + D. Where D is F, no force moves the rack: the guide locks from nu = h over the greatest of
R - x0 - mu (R - r), mu (R + r) - (R - x0) and mu h.
"""

from typing import NamedTuple

from geneva_cli.kinds.linear.motion import guided
from geneva_cli.loads.contact import Contact, LoadCase, lesser
from geneva_cli.loads.strength.pin_arm_key import pin_diameter_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import choose, larger, value_or
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.spec.defaults import eye_about, wall_min


class GuidePlace(NamedTuple):
    """Place and sizes of a guide, mm; x runs from the deepest roller towards the crank's axis."""

    slot: float  # half of the slot's width
    bottom: float  # clearance between the deepest roller and the slot's end
    bar: float  # width of the bar on the rack's back, and of the rail
    slide: float  # clearance of the bar on either side
    half: float  # half of the guide's length; 0 or less where the slots are too wide for a guide
    back: float  # the x of the bar's back

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
    # the arm's eye about the pin; none without a pin, and so without an arm
    hole = 0.5 * (pin_diameter_mm(mechanism) - size.allowances.press_fit_mm)
    eye = eye_about(hole, wall) if size.arm_eye_mm is None else 0.5 * size.arm_eye_mm
    if size.pin_mm is not None:
        eye = choose(size.pin_mm > 0.0, eye, 0.0 * eye)
    rail = larger(bottom + half_slot, eye + 0.25 * bar)
    back = 0.0 - (rail + 2.0 * bar + slide)
    return GuidePlace(half_slot, bottom, bar, slide, R - half_slot, back)


class RackGuide(NamedTuple):
    """The guide of a rack, lengths over L; floats, or (m, 1) for m designs."""

    friction: float
    middle: float  # x of its middle from the deepest roller
    half: float  # half its length

    def lever(self, case: LoadCase, at: Contact, drives: Number, slides: Number) -> Jet:
        """Lever of the force on a rack about its guide's middle, over L, for a roller that drives.

        It is M/F of this file's head, over d. The crank turns against the rack,
        at the rate ``spin``, so that cos a is -velocity/spin, and sin a -along/spin.
        """
        lever = at.velocity / at.spin + (1.0 - self.middle)
        if not case.rubs:
            return lever
        height = drives * case.radius - at.along / at.spin
        return lever - height * (case.friction * slides * drives)

    def leaning(self, case: LoadCase, at: Contact, drives: Number, slides: Number) -> Jet:
        """A value above 0 where the rack bears on opposite sides of its guide's ends: smooth."""
        lever = self.lever(case, at, drives, slides)
        return lever * lever - (case.friction * self.half) ** 2

    def drag(self, case: LoadCase, at: Contact, drives: Number, slides: Number) -> Jet:
        """Friction in a rack's guide over the pin's force: nu (|N1| + |N2|)/F.

        The forces at both ends add up to mu F across the travel, and their moment about the guide's
        middle is that of the roller. So |N1| + |N2| is the greater of |M|/h and mu F.
        """
        turns = self.lever(case, at, drives, slides) * (1.0 / self.half)
        both = lesser(turns * -1.0, turns)  # less their size
        return lesser(both, turns * 0.0 - case.friction) * (0.0 - self.friction)


def with_guide(mechanism: Mechanism, case: LoadCase) -> LoadCase:
    """Return a load case with the guide of a rack, if the machine has one."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    if not guided(spec):
        return case
    place = guide_place(mechanism)
    friction = value_or(spec.load.guide_friction, spec.load.friction)
    there = place.half > 0.0
    half = choose(there, place.half / L, 1.0)
    return case._replace(guide=RackGuide(choose(there, friction, 0.0), place.middle / L, half))
