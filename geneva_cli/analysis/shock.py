"""The shock at entry: a roller that meets its slot off its line.

The crank's radius R and the centre distance L are never quite right. The roller should come into
the resting slot along its axis; with R/L too large by a share eps its path crosses that axis
instead, before the entry, and the wheel is struck back at about tan b sqrt(2 eps) of the input's
speed: by the root of the error. With R/L too small it never reaches the axis, and meets the mouth.

Speeds are in units of the input's, angles of the wheel in radians, input angles in degrees from
the engagement's own mid-motion. Of m designs numbers of a machine and errors are (m, 1), and
answers (m,).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.engagement import Anchor, Engagement
from geneva_cli.machine.many import taken
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import N, library, parameter
from geneva_cli.numerics.roots_many import roots_many

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

STEPS = 64  # halvings, every half an octave, in which a crossing is bracketed
SHARES = 0.5 ** (0.5 * np.arange(STEPS, -1, -1))


class FirstContacts(NamedTuple):
    """Where rollers first reach the axis of the slot at rest, and what they do to the wheel.

    (m,) each; NaN where a roller never reaches the axis.
    """

    at_deg: Array
    jump: Array  # of the wheel's velocity, over the input's; < 0: the wheel is struck back


class SlotAxis(NamedTuple):
    """The axis of the slot at rest, for a roller that comes to it with errors of R and L.

    In the frame of the axis, from the wheel's centre outwards, the roller's place is
    (1 + crank) p - (crank - center) c, p being its true place and c the hub of the crank's arm.
    On a sphere, whose shafts meet whatever its radius, ``center`` has no meaning but 0.
    """

    engagement: Engagement
    beside: float  # of the hub: how far it is ahead of the line through the wheel's centre,
    along: float  # and how far along it

    @staticmethod
    def of(engagement: Engagement) -> SlotAxis | None:
        """The axis of an engagement's straight slot; None of slots that are solved for."""
        engagement = engagement.through
        if engagement.motion.entry is None:
            return None
        x, y = engagement.slot(0.5 * engagement.entry_deg, 1)  # a straight slot: anywhere
        (px, u), (py, v) = x.c, y.c
        m = library(px)
        way = m.copysign(1.0, px * u + py * v)
        hub, ahead = engagement.hub, engagement.half_step - m.atan2(way * v, way * u)
        return SlotAxis(engagement, parameter(hub * m.sin(ahead)), parameter(hub * m.cos(ahead)))

    def aside(self, crank: N, center: N) -> N:
        """How far the true path is from the axis where the one with errors crosses it, over L."""
        arm = self.beside + self.engagement.slot.offset  # from the slot's axis
        return (crank * arm - center * self.beside) / (1.0 + crank)

    @property
    def anchor(self) -> Anchor:
        """The true entry."""
        anchor = self.engagement.motion.entry
        assert anchor is not None  # ``of`` asks for it
        return anchor

    def distance(self, tau: Array) -> tuple[Array, Array]:
        """How far the true path is from the axis ``tau`` radians after entry, and its slope."""
        _, across = self.anchor.displacement(tau, 1)
        value, slope = across.arrays()
        return value, slope

    def jump(self, tau: Array, crank: N, center: N) -> Array:
        """The velocity that the roller gives to the wheel on the axis."""
        along, across = self.anchor.displacement(tau, 1)
        moved = (center - crank) / (1.0 + crank) * self.along
        out: Array = across.arrays()[1] / (along.arrays()[0] + self.anchor.along + moved)
        return out


def first_contacts(
    engagement: Engagement, crank: float, center: float = 0.0
) -> FirstContacts | None:
    """The first contacts for relative errors of the crank's radius and of the centre distance.

    Of m designs, or for m errors (m, 1); of rollers on a crank's arm, elsewhere only ``center`` has
    a meaning. NaN where a roller never reaches the slot's axis, and meets the mouth, and where
    there are no errors; None for slots and grooves that are solved for. A radial slot has
    sin(phi + b) = sin b / l there.

        >>> from geneva_cli import Design, External
        >>> first_contacts(Design(External(3)).mechanism.engagements[0], crank=1e-4)
        FirstContacts(at_deg=array([-30.81025092]), jump=array([-0.02390983]))
    """
    axis = SlotAxis.of(engagement)
    if axis is None:
        return None
    tau = contact_after(axis, np.atleast_2d(axis.aside(crank, center)))
    at_deg, jump = engagement.entry_deg + tau / DEGREE, axis.jump(tau, crank, center)
    return FirstContacts(np.ravel(at_deg), np.ravel(jump))


def contact_after(axis: SlotAxis, aside: Array) -> Array:
    """Input radians after the true entry at which the rollers reach the axis, (m, 1).

    NaN where one does not. The roller comes from one side, ``before``, and at a true entry stays
    on it (a circle) or goes over to the other (a path with an inflection).
    """
    span = 0.5 * axis.engagement.motion_deg * DEGREE
    before = axis.distance(np.atleast_2d(-1e-3 * span))[0]
    aside = aside + 0.0 * before
    with np.errstate(all="ignore"):
        way = np.where(aside * before > 0.0, -1.0, np.where(aside > 0.0, 1.0, np.nan))
        far = span * way * SHARES
        passed = abs(axis.distance(far)[0]) >= abs(aside)
    there, first = np.flatnonzero(passed.any(axis=1)), np.argmax(passed, axis=1)
    far = np.hstack((np.zeros((len(far), 1)), far))
    ends = np.sort([far[there, first[there]], far[there, first[there] + 1]], axis=0)

    def less(tau: Array, which: Whole) -> tuple[Array, Array]:
        value, slope = taken(axis, there[which]).distance(tau[:, None])
        return (value - aside[there[which]])[:, 0], slope[:, 0]

    out = np.full(aside.shape, np.nan)
    out[there, 0] = roots_many(less, *ends)
    return out
