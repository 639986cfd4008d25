"""The shock at entry: a roller that meets its slot off the slot's axis.

The crank's radius R and the centre distance L always have errors. The roller should enter the
resting slot along its axis. If R/L is too large by a fraction eps, its path crosses that axis
before the entry. The wheel is then struck backwards at about tan b sqrt(2 eps) of the input's
speed: by the square root of the error. If R/L is too small, the roller never reaches the axis, and
meets the mouth.

Speeds are in units of the input's. Wheel angles are in radians, input angles in degrees from the
engagement's own mid-motion. For m designs the numbers of a machine and the errors are (m, 1), and
results are (m,).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Mask, N, Whole, library, parameter
from geneva_cli.numerics.jet import Array, Jet, sqrt
from geneva_cli.numerics.roots import find_roots

# Ascending fractions of a span, half an octave apart, which bracket a crossing.
OCTAVES = 0.5 ** (0.5 * np.arange(64, -1, -1))


class FirstContacts(NamedTuple):
    """First contacts of rollers with the axis of the slot at rest, and the jumps that follow.

    (m,) each; NaN if a roller never reaches the axis.
    """

    at_deg: Array
    jump: Array  # of the wheel's velocity, over the input's; negative if struck backwards


class RestingAxis(NamedTuple):
    """The axis of the slot at rest, for a roller that meets it with errors of R and L.

    In the frame of the axis, from the wheel's centre outwards, the roller is at (1 + crank) p -
    (crank - center) c. Here p is its true position and c the hub of the crank's arm. On a sphere
    the shafts meet for any radius, so ``center`` must be 0.
    """

    engagement: Engagement
    hub_offset: float  # distance of the hub from the line through the wheel's centre,
    along: float  # and its distance along that line

    @staticmethod
    def of(engagement: Engagement) -> RestingAxis | None:
        """The axis of an engagement's straight slot.

        None for a slot that is solved for, and for a crank as built.
        """
        engagement = engagement.through
        if engagement.motion.entry is None or engagement.built is not None:
            return None  # a crank as built crosses the axis at once
        x, y = engagement.slot(0.5 * engagement.entry_deg, 1)  # any place in a straight slot
        (px, u), (py, v) = x.c, y.c
        m = library(px)
        sense = m.copysign(1.0, px * u + py * v)
        hub, ahead = engagement.hub, engagement.half_step - m.atan2(sense * v, sense * u)
        return RestingAxis(engagement, parameter(hub * m.sin(ahead)), parameter(hub * m.cos(ahead)))

    def offset(self, crank: N, center: N) -> N:
        """Distance over L of the true path from the axis where the path with errors crosses it."""
        arm = self.hub_offset + self.engagement.slot.offset  # from the slot's axis
        return (crank * arm - center * self.hub_offset) / (1.0 + crank)

    @property
    def anchor(self) -> Anchor:
        """The true entry."""
        anchor = self.engagement.motion.entry
        assert anchor is not None  # ``of`` requires it
        return anchor

    def distance(self, tau: Array) -> tuple[Array, Array]:
        """Distance of the true path from the axis ``tau`` radians after entry, and its slope."""
        _, across = self.anchor.displacement(tau, 1)
        value, slope = across.arrays()
        return value, slope

    def jump(self, tau: Array, crank: N, center: N) -> Array:
        """Velocity that the roller gives to the wheel on the axis."""
        along, across = self.anchor.displacement(tau, 1)
        moved = (center - crank) / (1.0 + crank) * self.along
        out: Array = across.arrays()[1] / (along.arrays()[0] + self.anchor.along + moved)
        return out


def first_contacts(
    engagement: Engagement, crank: float, center: float = 0.0
) -> FirstContacts | None:
    """First contacts for relative errors of the crank's radius and of the centre distance.

    For m designs, or for m errors (m, 1). If no crank's arm carries the roller, only ``center`` has
    a meaning. NaN if a roller never reaches the slot's axis, and meets the mouth, or if there are
    no errors. None for slots and grooves that are solved for. A radial slot has sin(phi + b) = sin
    b / l at the contact.

        >>> from geneva_cli import Design, External
        >>> first_contacts(Design(External(3)).mechanism.engagements[0], crank=1e-4)
        FirstContacts(at_deg=array([-30.81025092]), jump=array([-0.02390983]))
    """
    axis = RestingAxis.of(engagement)
    if axis is None:
        return None
    tau = contact_after(axis, np.atleast_2d(axis.offset(crank, center)))
    at_deg, jump = engagement.entry_deg + tau / DEGREE, axis.jump(tau, crank, center)
    return FirstContacts(np.ravel(at_deg), np.ravel(jump))


def contact_after(axis: RestingAxis, offset: Array) -> Array:
    """Input radians after the true entry at which the rollers reach the axis, (m, 1); NaN if never.

    The roller comes from one side, ``before``. At a true entry it stays on that side (a circle) or
    crosses to the other (a path with an inflection).
    """
    span = 0.5 * axis.engagement.motion_deg * DEGREE
    before = axis.distance(np.atleast_2d(-1e-3 * span))[0]
    offset = offset + 0.0 * before
    with np.errstate(all="ignore"):
        sense = np.where(offset * before > 0.0, -1.0, np.where(offset > 0.0, 1.0, np.nan))
        far = span * sense * np.append(0.0, OCTAVES)
        passed = abs(axis.distance(far)[0]) >= abs(offset)

    def less(tau: Array, which: Whole) -> tuple[Array, Array]:
        value, slope = taken(axis, which).distance(tau)
        return value - offset[which], slope

    return first_roots(less, far, passed)


def first_roots(
    f: Callable[[Array, Whole], tuple[Array, Array]], places: Array, passed: Mask
) -> Array:
    """The roots before the first places (m, k) that are passed, (m, 1); NaN if there is none.

    ``f(x, which)`` returns value and slope of some designs at places (k, 1).
    """
    out, first = np.full((len(places), 1), np.nan), np.argmax(passed, axis=1)
    there = np.flatnonzero(passed.any(axis=1) & (first > 0))
    ends = np.sort([places[there, first[there] - k] for k in (0, 1)], axis=0)

    def one_each(x: Array, live: Whole) -> tuple[Array, Array]:
        value, slope = f(x[:, None], there[live])
        return value[:, 0], slope[:, 0]

    out[there, 0] = find_roots(one_each, *ends)
    return out


class Mouth(NamedTuple):
    """How a mouth is cut, lengths over L: the radius of its corners, and what its walls have lost.

    Blunt horns shorten the wall on the side to which the wheel turns, and the other.
    """

    rounding: float = 0.0
    lost: tuple[float, float] = (0.0, 0.0)


SHARP = Mouth()


class MouthCorner(NamedTuple):
    """A corner of the mouth, and the roller that meets it with errors of R and L.

    It is met if the errors exceed the slot's clearance. The mouth lies across the slot where the
    roller should enter, at the foot of the perpendicular from a crank's axis. An arm that is too
    short strikes the corner on the side of the crank's axis, forwards. An arm that is too long
    strikes the other corner, backwards. On a sharp corner the impact is about

        jump / omega = tan b sqrt(2 eps) sqrt((R -+ r)/r),

    less if the arm is too short. Here eps is the error of R beyond the clearance, as a fraction of
    R. r is the roller's radius. A corner rounded by c acts like a sharp one on a roller of radius
    r + c. The roller's centre P and the corner C keep their distance if the wheel turns at the
    speed (P - C) . P' / (P - C) . (z x C), for any path of the roller. On a sphere P and C are
    directions.

    Positions are from the wheel's centre: along the slot outwards, across it, and along the wheel's
    axis, which is 0 on a plane. ``side`` is 1 for the corner on the side to which the wheel turns,
    -1 for the other. Lengths are over L, on a sphere its arcs.
    """

    axis: RestingAxis
    crank: float
    center: float
    roller: float
    wide: float  # half the mouth; to the middle of a rounding
    side: float
    back: float = 0.0  # from the mouth to the middle of a rounding, along the slot

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
        slot, far = self.axis.engagement.slot, self.axis.anchor.along - self.back
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
        along, top = self.axis.anchor.along - self.back, self.top
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
    engagement: Engagement,
    crank: float,
    center: float,
    roller: float,
    clearance: float,
    mouth: Mouth = SHARP,
) -> FirstContacts | None:
    """First contacts with the mouth's corners; NaN if the roller touches none.

    ``crank`` and ``center`` are relative errors, as in ``shock.first_contacts``. ``roller`` is the
    roller's radius and ``clearance`` that of the slot per side, both over L. They are floats, or
    (m, 1) for m designs. None for slots that are solved for. A negative jump is backwards.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(6)).mechanism.engagements
        >>> contact = mouth_contacts(engagement, -1e-4, 0.0, roller=0.05, clearance=0.0)
        >>> round(float(contact.jump[0]), 6)  # tan(30 deg) sqrt(2e-4) sqrt(9) is 0.024495
        0.024448
    """
    axis, (rounding, cut) = RestingAxis.of(engagement), mouth
    if axis is None:
        return None
    far, wide = axis.anchor.along, roller + clearance
    sign: Any = 1.0  # floats, or (m, 1)
    back: Any = 0.0
    if np.any(rounding) or any(cut):
        x, y = engagement.slot(0.0, 0)
        sign = np.where(np.hypot(x.c[0], y.c[0]) < far, 1.0, -1.0)
        # its circle touches wall and rim, or the flat of a blunt horn, which is square to the wall
        rim = np.hypot(far, wide)
        back = far - np.sqrt(far * far - 2.0 * sign * rounding * (rim + sign * wide))
    corners = [
        MouthCorner(
            *(axis, crank, center, roller + rounding, wide + rounding, side),
            back=sign * (lost + rounding) if lost else back,
        )
        for side, lost in zip((1.0, -1.0), cut, strict=True)
    ]
    with np.errstate(all="ignore"):
        one, other = (corner.contact() for corner in corners)
        tau = np.fmin(one, other)
        jump = np.where(tau == one, corners[0].jump(tau), corners[1].jump(tau))
    return FirstContacts(np.ravel(engagement.entry_deg + tau / DEGREE), np.ravel(jump))
