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
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, N, Whole, library, parameter
from geneva_cli.numerics.jet import Array
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
        """The axis of an engagement's straight slot; None for a slot that is solved for."""
        engagement = engagement.through
        if engagement.motion.entry is None:
            return None
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
