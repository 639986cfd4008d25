"""The shock at the mouth: a roller that misses its slot and meets a corner.

The roller meets the corner at the end of one of the slot's walls if the errors of the crank's
radius and of the centre distance exceed the slot's clearance. The mouth lies across the slot where
the roller should enter, at the foot of the perpendicular from a crank's axis. An arm that is too
short strikes the corner on the side of the crank's axis, forwards. An arm that is too long strikes
the other corner, backwards. On a sharp corner the impact is about

    jump / omega = tan b sqrt(2 eps) sqrt((R -+ r)/r),

less if the arm is too short. Here eps is the error of R beyond the clearance, as a fraction of R. r
is the roller's radius. With r = R/10 this is about three times the first contact with the slot's
axis (``shock``), in which the walls would extend past the mouth. A corner rounded by c acts like a
sharp one on a roller of radius r + c.

The roller's centre P and the corner C keep their distance if the wheel turns at the speed (P - C) .
P' / (P - C) . (z x C), for any path of the roller. On a sphere P and C are directions.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.shock import OCTAVES, FirstContacts, RestingAxis, first_roots
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import library, parameter
from geneva_cli.numerics.jet import Array, Jet, sqrt


class MouthCorner(NamedTuple):
    """A corner of the mouth, and the roller that meets it with errors of R and L.

    Positions are from the wheel's centre: along the slot outwards, across it, and along the wheel's
    axis, which is 0 on a plane. ``side`` is 1 for the corner on the side to which the wheel turns,
    -1 for the other. Lengths are over L, on a sphere its arcs.
    """

    axis: RestingAxis
    crank: float
    center: float
    roller: float
    wide: float  # half the mouth
    side: float

    def roller_at(self, tau: Array) -> tuple[Jet, Jet, Jet]:
        """Roller centre ``tau`` radians of the input after the true entry."""
        axis, longer = self.axis, 1.0 + self.crank
        slot, anchor = axis.engagement.slot, axis.anchor
        x, y = anchor.displacement(tau, 1)
        x = (x + anchor.along) * longer - (self.crank - self.center) * axis.along
        y = (y - axis.offset(self.crank, self.center)) * longer - slot.offset
        if slot.height is None:
            return x, y, x * 0.0
        z = slot.height(radians(anchor.input_deg) + tau, 1) * longer - self.crank * slot.height.hub
        far = sqrt(x * x + y * y + z * z)
        return x / far, y / far, z / far

    @property
    def top(self) -> float:
        """Position of the mouth's middle along the wheel's axis."""
        height = self.axis.engagement.slot.height
        start = radians(self.axis.anchor.input_deg)
        return 0.0 if height is None else parameter(height(start, 0).c[0])

    @property
    def place(self) -> tuple[float, float, float]:
        """Position of the corner."""
        slot, far = self.axis.engagement.slot, self.axis.anchor.along
        if slot.height is None:
            return far, self.side * self.wide - slot.offset, 0.0
        m = library(self.wide)
        down = m.cos(self.wide)
        return far * down, self.side * m.sin(self.wide), self.top * down

    def gap(self, tau: Array) -> tuple[Array, Array]:
        """Squared distance of centre and corner minus that at contact, and its slope."""
        x, y, z = (p - c for p, c in zip(self.roller_at(tau), self.place, strict=True))
        reach = self.roller
        if self.axis.engagement.slot.height is not None:  # a chord on a sphere
            reach = parameter(2.0 * library(self.roller).sin(0.5 * self.roller))
        value, slope = (x * x + y * y + z * z - reach**2).arrays()
        return value, slope

    def jump(self, tau: Array) -> Array:
        """Velocity that the roller gives to the wheel at this corner."""
        corner = self.place
        direction = (-corner[1], corner[0], 0.0)
        supplied = turned = 0.0 * tau
        for p, c, w in zip(self.roller_at(tau), corner, direction, strict=True):
            value, speed = p.arrays()
            supplied, turned = supplied + (value - c) * speed, turned + (value - c) * w
        out: Array = supplied / turned
        return out

    def contact(self) -> Array:
        """Input radians after the true entry of the first contact, (m, 1); NaN if there is none.

        The roller comes from outside, and has passed once its centre is in the mouth.
        """
        span = 0.5 * self.axis.engagement.motion_deg * DEGREE
        x, _, z = self.roller_at(np.atleast_2d(0.0 * span))
        along, top = self.axis.anchor.along, self.top
        # distance of the roller's centre outside the mouth, and its speed outwards
        flat = self.axis.engagement.slot.height is None
        out, speed = (x - along if flat else x * top - z * along).arrays()
        far = -out / speed - span * OCTAVES[::-1]
        with np.errstate(all="ignore"):
            value = self.gap(far)[0]
        meets = value <= -1e-16  # of L²: nearer to 0 it is rounding
        places = np.broadcast_to(far, value.shape)
        return first_roots(lambda tau, which: taken(self, which).gap(tau), places, meets)


def mouth_contacts(
    engagement: Engagement, crank: float, center: float, roller: float, clearance: float
) -> FirstContacts | None:
    """First contacts with the mouth's sharp corners; NaN if the roller touches none.

    ``crank`` and ``center`` are relative errors, as in ``shock.first_contacts``. ``roller`` is the
    roller's radius and ``clearance`` that of the slot per side, both over L. They are floats, or
    (m, 1) for m designs. None for slots that are solved for. A negative jump is backwards.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(6)).mechanism.engagements
        >>> contact = mouth_contacts(engagement, -1e-4, 0.0, roller=0.05, clearance=0.0)
        >>> round(float(contact.jump[0]), 6)  # tan(30 deg) sqrt(2e-4) sqrt(9) is 0.024495
        0.024448
    """
    axis = RestingAxis.of(engagement)
    if axis is None:
        return None
    corners = [
        MouthCorner(axis, crank, center, roller, roller + clearance, side) for side in (1.0, -1.0)
    ]
    with np.errstate(all="ignore"):
        one, other = (corner.contact() for corner in corners)
        tau = np.fmin(one, other)
        jump = np.where(tau == one, corners[0].jump(tau), corners[1].jump(tau))
    return FirstContacts(np.ravel(engagement.entry_deg + tau / DEGREE), np.ravel(jump))
