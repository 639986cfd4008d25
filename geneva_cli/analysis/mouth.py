"""The shock at the mouth: a roller that comes beside its slot, which has no room for that.

Where the slot's clearance leaves no room for what the crank's radius and the centre distance are
off, the roller meets the corner in which one of the slot's walls ends: the mouth lies across the
slot where the roller should enter, at the foot of the perpendicular from a crank's axis. A crank's
arm that is too short comes to the corner on the side of the crank's axis, which it strikes
forwards, one too long to the one beyond, which it strikes back. On a sharp corner the blow is about

    jump / omega = tan b sqrt(2 eps) sqrt((R -+ r)/r),

less for the arm too short, eps being the share of R that is missing or too much once the clearance
is used up, r the roller's radius: some three times the first contact with the slot's axis
(``shock``) where r is R/10, as if the walls went on past the mouth. A corner rounded by c counts
as a roller of r + c.

The roller's centre P and the corner C keep their distance if the wheel turns at the speed
(P - C) . P' / (P - C) . (z x C), whatever leads the roller. On a sphere P and C are directions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.shock import SHARES, FirstContacts, SlotAxis
from geneva_cli.machine.many import taken
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import library, parameter
from geneva_cli.numerics.jet import Jet, sqrt
from geneva_cli.numerics.roots_many import roots_many

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

ROUNDING = 1e-16  # of L²: less than that the roller is not too near to a corner


class Corner(NamedTuple):
    """A corner of the mouth, and the roller that comes to it with errors of R and L.

    Places are from the wheel's centre: along the slot outwards, across it and along the wheel's
    axis, which is 0 on a plane. ``side`` is 1 for the corner on the side to which the wheel turns,
    -1 for the other; lengths are over L, on a sphere its arcs.
    """

    axis: SlotAxis
    crank: float
    center: float
    roller: float
    wide: float  # half the mouth
    side: float

    def roller_at(self, tau: Array) -> tuple[Jet, Jet, Jet]:
        """The roller's centre ``tau`` radians of the input after the true entry."""
        axis, longer = self.axis, 1.0 + self.crank
        slot, anchor = axis.engagement.slot, axis.anchor
        x, y = anchor.displacement(tau, 1)
        x = (x + anchor.along) * longer - (self.crank - self.center) * axis.along
        y = (y - axis.aside(self.crank, self.center)) * longer - slot.offset
        if slot.height is None:
            return x, y, x * 0.0
        z = slot.height(radians(anchor.input_deg) + tau, 1) * longer - self.crank * slot.height.hub
        far = sqrt(x * x + y * y + z * z)
        return x / far, y / far, z / far

    @property
    def top(self) -> float:
        """Where the mouth's middle is along the wheel's axis."""
        height = self.axis.engagement.slot.height
        start = radians(self.axis.anchor.input_deg)
        return 0.0 if height is None else parameter(height(start, 0).c[0])

    @property
    def place(self) -> tuple[float, float, float]:
        """The corner."""
        slot, far = self.axis.engagement.slot, self.axis.anchor.along
        if slot.height is None:
            return far, self.side * self.wide - slot.offset, 0.0
        m = library(self.wide)
        down = m.cos(self.wide)
        return far * down, self.side * m.sin(self.wide), self.top * down

    def outside(self, tau: Array) -> tuple[Array, Array]:
        """How far outside the mouth the roller's centre is, and its speed outwards."""
        x, _, z = self.roller_at(tau)
        far, top = self.axis.anchor.along, self.top
        out = x - far if self.axis.engagement.slot.height is None else x * top - z * far
        value, speed = out.arrays()
        return value, speed

    @property
    def reach(self) -> float:
        """The distance between corner and centre where the roller touches, a chord on a sphere."""
        if self.axis.engagement.slot.height is None:
            return self.roller
        return parameter(2.0 * library(self.roller).sin(0.5 * self.roller))

    def room(self, tau: Array) -> tuple[Array, Array]:
        """The square of the distance of centre and corner less that at contact, and its slope."""
        x, y, z = (p - c for p, c in zip(self.roller_at(tau), self.place, strict=True))
        value, slope = (x * x + y * y + z * z - self.reach**2).arrays()
        return value, slope

    def jump(self, tau: Array) -> Array:
        """The velocity that the roller gives to the wheel at this corner."""
        corner = self.place
        way = (-corner[1], corner[0], 0.0)
        given = turned = 0.0 * tau
        for p, c, w in zip(self.roller_at(tau), corner, way, strict=True):
            value, speed = p.arrays()
            given, turned = given + (value - c) * speed, turned + (value - c) * w
        out: Array = given / turned
        return out

    def contact(self) -> Array:
        """Input radians after the true entry of the first contact, (m, 1); NaN where none is.

        The roller comes from outside, and has passed once its centre is in the mouth.
        """
        span = 0.5 * self.axis.engagement.motion_deg * DEGREE
        out, speed = self.outside(np.atleast_2d(0.0 * span))
        far = -out / speed - span * SHARES[::-1]
        with np.errstate(all="ignore"):
            value = self.room(far)[0]
            far = np.broadcast_to(far, value.shape)
            meets = value <= -ROUNDING
        there, first = np.flatnonzero(meets.any(axis=1)), np.argmax(meets, axis=1)
        there = there[first[there] > 0]
        near = first[there]

        def over(tau: Array, which: Whole) -> tuple[Array, Array]:
            value, slope = taken(self, there[which]).room(tau[:, None])
            return value[:, 0], slope[:, 0]

        out = np.full((len(value), 1), np.nan)
        out[there, 0] = roots_many(over, far[there, near - 1], far[there, near])
        return out


def mouth_contacts(
    engagement: Engagement, crank: float, center: float, roller: float, clearance: float
) -> FirstContacts | None:
    """The first contacts with the mouth's sharp corners; NaN where the roller has room.

    ``crank`` and ``center`` are relative errors as of ``shock.first_contacts``, ``roller`` the
    roller's radius and ``clearance`` that of the slot per side, both over L: floats, or (m, 1) of
    m designs. None for slots that are solved for. A jump below 0 is one back.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(6)).mechanism.engagements
        >>> found = mouth_contacts(engagement, -1e-4, 0.0, roller=0.05, clearance=0.0)
        >>> round(float(found.jump[0]), 6)  # tan(30 deg) sqrt(2e-4) sqrt(9) is 0.024495
        0.024448
    """
    axis = SlotAxis.of(engagement)
    if axis is None:
        return None
    corners = [
        Corner(axis, crank, center, roller, roller + clearance, side) for side in (1.0, -1.0)
    ]
    with np.errstate(all="ignore"):
        one, other = (corner.contact() for corner in corners)
        tau = np.fmin(one, other)
        jump = np.where(tau == one, corners[0].jump(tau), corners[1].jump(tau))
    return FirstContacts(np.ravel(engagement.entry_deg + tau / DEGREE), np.ravel(jump))
