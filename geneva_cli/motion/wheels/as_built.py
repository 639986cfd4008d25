"""Straight slots on a crank as it was built, whose R/L is not what the slots need.

Where the roller's centre, on a circle of l = R/L, crosses the axis of the slot at rest inside the
rim, the wheel's velocity jumps from 0. With l above sin b there are two crossings:

    w² = l² - (sin b)²,    rho = cos b -+ w,    jump = +- w / rho

The roller comes from outside an external wheel: the outer one strikes the wheel backwards. With l
below sin b the centre never reaches the axis, and turns a slot from -asin l to asin l only. Offset
slots are tangent to the crank's circle at the end farther from the line of centres, where
sin(angle) = l + e; the other end, a step away, has the whole jump.
"""

import math
from typing import NamedTuple

from geneva_cli.errors import refuse_text
from geneva_cli.motion.engagement import AsBuilt
from geneva_cli.motion.wheels.classic import HalfStep, PinPose, middle
from geneva_cli.motion.wheels.gearing import RollerPlace
from geneva_cli.numerics.arrays import Truth, choose, choose_record, larger, library, smaller

AT_RIM = 1e-6  # of L: a crossing that is not farther outside is at the rim


class RestingSlot(NamedTuple):
    """The axis of a slot at rest, for crank radii l; lengths over the centre distance."""

    sign: float  # 1 for an external wheel, -1 for an internal one
    l: float
    angle: float  # from the line of centres, radians
    across: float  # position of the axis, and so of the roller's centre, from the crank's axis
    outer: Truth = False  # the crossing beyond the perpendicular from the crank's axis

    @property
    def beyond(self) -> float:
        """Position of the crossing from the foot of the perpendicular, outwards."""
        size = abs(self.across)
        square = larger((self.l - size) * (self.l + size), 0.0 * size)
        half = library(square).sqrt(square)
        return choose(self.outer, half, -half) * self.sign

    @property
    def along(self) -> float:
        """Position of the crossing along the slot's axis, from the wheel's centre."""
        return library(self.angle).cos(self.angle) + self.beyond

    def is_inside(self, e: float, rim: float) -> Truth:
        """True if the crossing of a slot of offset e is not beyond the rim."""
        m = library(e, rim, self.along)
        inside: Truth = self.sign * (m.hypot(self.along, e) - rim) <= AT_RIM
        return inside

    @property
    def crank_deg(self) -> float:
        """Crank angle of the crossing from the line of centres."""
        x, y = self.beyond, self.across
        m = library(self.angle, x, y)
        s, c = m.sin(self.angle), m.cos(self.angle)
        return m.degrees(m.atan2(x * s + y * c, (y * s - x * c) * self.sign))


def place(sign: float, step: HalfStep, l: float, e: float, rim: float) -> RollerPlace:
    """Place of a roller on a crank radius l in slots of offset e, on a wheel with a ``rim``.

    Lengths are over the centre distance. Raises GenevaError where the roller cannot pass the line
    of centres in its slot.
    """
    text = "crank_radius_mm and the slots' offset together must be below center_distance_mm: the "
    text += "roller would pass beyond the wheel's axis"
    refuse_text(l + abs(e) >= 1.0, ("size", "crank_radius_mm"), text)
    # the slot at rest before and after a motion, and if the roller's centre reaches its axis
    sin_b, radial = step.sin_cos[0], isinstance(e, float) and e == 0.0
    reaches: Truth = l >= sin_b
    across = choose(reaches, sin_b + 0.0 * l, l)
    angle = choose(reaches, step.b + 0.0 * l, library(across).asin(across))
    ends = RestingSlot(sign, l, -angle, -across), RestingSlot(sign, l, angle, across), reaches
    if not radial:
        ends = choose_record(e == 0.0, ends, _offset(sign, step, l, e))
    first, last, reaches = ends
    # the outer crossing comes first, if it is inside the rim
    first, last = (
        end._replace(outer=reaches & end._replace(outer=True).is_inside(e, rim))
        for end in (first, last)
    )
    inside = reaches & first.is_inside(e, rim) & last.is_inside(e, rim)
    half, tilt = 0.5 * (last.angle - first.angle), 0.5 * (last.angle + first.angle)
    half = choose(reaches, step.b, half)
    poses = []
    for end, wheel in ((first, -half), (last, half)):
        x, y = end.beyond, end.across
        poses.append(PinPose(end.crank_deg, wheel, end.along, (sign * y, -sign * x), (-x, -y)))
    entry, exit_ = poses
    mid, m = middle(sign, l, 1.0 - sign * l), library(l, e, rim)
    if not radial:
        deepest = m.sqrt((1.0 - l - e) * (1.0 - l + e))
        mid = mid._replace(wheel=m.atan2(e, deepest) - tilt)
    # the slot's direction from the wheel's axis where the pin leaves the rim, if it passes it
    cosine, one = (1.0 + rim * rim - l * l) / (2.0 * rim), 0.0 * l + 1.0
    passes = (cosine <= 1.0) & (rim > abs(e))
    along = m.sqrt(larger(rim * rim - e * e, 0.0 * one))
    leaves = m.acos(smaller(larger(cosine, -one), one)) + m.atan2(e, along)
    leaves = choose(passes, leaves, math.nan)
    built = AsBuilt(inside, leaves - tilt - step.b, first.angle, first.outer)
    moving = 0.5 * (exit_.crank_deg - entry.crank_deg)
    own = RollerPlace(step, moving, (entry, mid, exit_), l, built=built)
    return own if radial else own._replace(e=e, tilt=tilt, deepest=deepest)


def as_derived(place: RollerPlace) -> RollerPlace:
    """A place of a crank whose R/L is what its slots need, as one of a crank as built."""
    built = AsBuilt(True, math.nan, place.tilt - place.step.b, False)
    return place._replace(closed=None, built=built)


def _offset(
    sign: float, step: HalfStep, l: float, e: float
) -> tuple[RestingSlot, RestingSlot, Truth]:
    """The slot at rest as in ``place``, of offset e: tangent to the crank's circle at one end."""
    m, size = library(l, e, step.b), abs(e)
    far, least = m.asin(l + size), m.asin(l - size)
    reaches: Truth = 2.0 * step.b - far <= least
    near = choose(reaches, 2.0 * step.b - far, least)
    across = choose(reaches, m.sin(near) + size, l)
    tangent_exit = e > 0.0
    first = -choose(tangent_exit, near, far), -choose(tangent_exit, across, l)
    last = choose(tangent_exit, far, near), choose(tangent_exit, l, across)
    return RestingSlot(sign, l, *first), RestingSlot(sign, l, *last), reaches
