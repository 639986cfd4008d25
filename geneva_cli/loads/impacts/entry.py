"""The impact at entry: a roller that meets its slot off the slot's axis, or a corner of its mouth.

Of the errors of R and L: if R/L is too large by a fraction eps, the path crosses the axis before
the entry, and strikes the wheel backwards at about tan b sqrt(2 eps) of the input's speed. Speeds
are in units of the input's, input angles in degrees from the engagement's own mid-motion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.shock_force import Impacts, hardest, shown
from geneva_cli.loads.strength.pin_arm_key import PinSize
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Mask, N, Number, Whole, choose, library, parameter
from geneva_cli.numerics.jet import Jet, sqrt
from geneva_cli.numerics.roots import find_roots

# Ascending fractions of a span, half an octave apart, which bracket a crossing.
OCTAVES = 0.5 ** (0.5 * np.arange(64, -1, -1))


class FirstContacts(NamedTuple):
    """First contacts of rollers with a slot at rest, (m,); NaN if a roller touches nothing."""

    at_deg: Array
    jump: Array  # of the wheel's velocity, over the input's; negative if struck backwards


class RestingAxis(NamedTuple):
    """The axis of the slot at rest, for a roller that meets it with errors of R and L.

    In the frame of the axis, from the wheel's centre outwards, the roller is at (1 + crank) p -
    (crank - center) c: p is its true position, c the hub of the arm. On a sphere ``center`` is 0.
    """

    engagement: Engagement
    anchor: Anchor  # the true entry
    hub_offset: float  # distance of the hub from the line through the wheel's centre,
    along: float  # and its distance along that line

    @staticmethod
    def of(engagement: Engagement) -> RestingAxis | None:
        """The axis of an engagement's straight slot."""
        whole = engagement.through
        anchor = whole.motion.entry
        if anchor is None:
            return None
        x, y = whole.slot(0.5 * whole.entry_deg, 1)  # any place in a straight slot
        (px, u), (py, v) = x.c, y.c
        m = library(px)
        sense = m.copysign(1.0, px * u + py * v)
        hub, ahead = whole.hub, whole.half_step - m.atan2(sense * v, sense * u)
        if whole.built is not None:  # it may rest where its roller meets it, with a play
            ahead = -whole.built.angle
        offset, along = parameter(hub * m.sin(ahead)), parameter(hub * m.cos(ahead))
        return RestingAxis(engagement, anchor, offset, along)

    @staticmethod
    def each(mechanism: Mechanism) -> list[RestingAxis]:
        """The axes of all engagements; none for slots that are solved for."""
        every = map(RestingAxis.of, mechanism.engagements)
        return [axis for axis in every if axis is not None]

    def offset(self, crank: N, center: N) -> N:
        """Distance over L of the true path from the axis where the path with errors crosses it."""
        arm = self.hub_offset + self.engagement.through.slot.offset  # from the slot's axis
        return (crank * arm - center * self.hub_offset) / (1.0 + crank)

    @property
    def turn(self) -> Array:
        """Radians after entry at which the true path runs along the axis: 0 but as built."""
        tau = np.zeros((1, 1))
        for _ in range(8 if self.engagement.through.built else 0):  # Newton steps
            _, slope, bend = self.anchor.displacement(tau, 2)[1].derivatives()
            tau = tau - slope / bend
        return tau

    def distance(self, tau: Array) -> tuple[Array, Array]:
        """Distance of the true path from the axis ``tau`` radians after entry, and its slope."""
        value, slope = self.anchor.displacement(tau, 1)[1].derivatives()
        return value, slope


def first_contacts(axis: RestingAxis, crank: Number, center: Number = 0.0) -> FirstContacts:
    """First contacts with the axis for relative errors of the crank's radius and of L: (m, 1) each.

    NaN if a roller never reaches the slot's axis, and meets the mouth, or if there are no errors. A
    radial slot has sin(phi + b) = sin b / l there.
    """
    # The roller comes from one side, ``before``. At a true entry it stays on that side (a circle)
    # or crosses to the other (a path with an inflection).
    span = 0.5 * axis.engagement.through.motion_deg * DEGREE
    before, turn = axis.distance(np.atleast_2d(-1e-3 * span))[0], axis.turn
    offset = np.atleast_2d(axis.offset(crank, center)) + 0.0 * before
    left = offset - axis.distance(turn)[0]
    with np.errstate(all="ignore"):
        sense = np.where(offset * before > 0.0, -1.0, np.where(offset > 0.0, 1.0, np.nan))
        if (built := axis.engagement.through.built) is not None:  # the crossing that is its entry
            off = (abs(turn) > 1e-9) | np.logical_not(built.crosses)
            sense = np.where(off, np.where(turn > 1e-9, -1.0, 1.0), sense)
        far = span * np.append(0.0, OCTAVES)
        passed = np.zeros((len(offset), far.shape[-1]), dtype=bool)
        for side in (-1.0, 1.0):  # many errors of one machine have its path in common
            if (sense == side).any():
                beyond = axis.distance(turn + side * far)[0] - offset
                passed |= (sense == side) & (beyond * left >= 0.0)

    def less(tau: Array, which: Whole) -> tuple[Array, Array]:
        value, slope = taken(axis, which).distance(tau)
        return value - offset[which], slope

    tau = _first_roots(less, turn + sense * far, passed)
    along, across = axis.anchor.displacement(tau, 1)
    moved = (center - crank) / (1.0 + crank) * axis.along
    jump = across.derivatives()[1] / (along.derivatives()[0] + axis.anchor.along + moved)
    return FirstContacts(np.ravel(axis.engagement.entry_deg + tau / DEGREE), np.ravel(jump))


def _first_roots(
    f: Callable[[Array, Whole], tuple[Array, Array]], places: Array, passed: Mask
) -> Array:
    """The roots before the first places (m, k) that are passed, (m, 1); NaN if there is none."""
    out, first = np.full((len(places), 1), np.nan), np.argmax(passed, axis=1)
    there = np.flatnonzero(passed.any(axis=1) & (first > 0))
    ends = np.sort([places[there, first[there] - k] for k in (0, 1)], axis=0)

    def one_each(x: Array, live: Whole) -> tuple[Array, Array]:
        value, slope = f(x[:, None], there[live])
        return value[:, 0], slope[:, 0]

    out[there, 0] = find_roots(one_each, *ends)
    return out


class _Corner(NamedTuple):
    """A corner of the mouth, and the roller that meets it with errors of R and L."""

    axis: RestingAxis
    crank: Number
    center: Number
    reach: Number  # distance of the roller's centre at which they touch
    place: tuple[Number, Number, Number]

    def roller(self, tau: Array) -> tuple[Jet, Jet, Jet]:
        """Roller centre ``tau`` radians of the input after the true entry."""
        axis, longer = self.axis, 1.0 + self.crank
        slot, anchor = axis.engagement.through.slot, axis.anchor
        x, y = anchor.displacement(tau, 1)
        x = (x + anchor.along) * longer - (self.crank - self.center) * axis.along
        y = (y - axis.offset(self.crank, self.center)) * longer - slot.offset
        if slot.height is None:
            return x, y, x * 0.0
        z = slot.height(radians(anchor.input_deg) + tau, 1) * longer - self.crank * slot.height.hub
        far = sqrt(x * x + y * y + z * z)
        return x / far, y / far, z / far

    def gap(self, tau: Array) -> tuple[Array, Array]:
        """Squared distance of centre and corner minus that at contact, and its slope."""
        x, y, z = (p - c for p, c in zip(self.roller(tau), self.place, strict=True))
        value, slope = (x * x + y * y + z * z - self.reach**2).derivatives()
        return value, slope

    def contact(self, along: Number, top: Number) -> tuple[Array, Array]:
        """Radians after the true entry of the first contact, and the jump, (m, 1); NaN without any.

        The roller comes from outside, and has passed once its centre is in the mouth, whose middle
        is at ``along`` and ``top``. Centre P and corner C keep their distance at the speed
        (P - C) . P' / (P - C) . (z x C).
        """
        engagement = self.axis.engagement.through
        span = 0.5 * engagement.motion_deg * DEGREE
        x, _, z = self.roller(np.atleast_2d(0.0 * span))
        # its distance outside, and its speed outwards
        out, speed = (
            x - along if engagement.slot.height is None else x * top - z * along
        ).derivatives()
        places = -out / speed - span * OCTAVES[::-1]
        meets = self.gap(places)[0] <= -1e-16  # of L²: nearer to 0 it is rounding
        places = np.broadcast_to(places, meets.shape)
        tau = _first_roots(lambda x, which: taken(self, which).gap(x), places, meets)
        supplied = turned = 0.0 * tau
        direction = -self.place[1], self.place[0], 0.0
        for p, c, w in zip(self.roller(tau), self.place, direction, strict=True):
            value, rate = p.derivatives()
            supplied, turned = supplied + (value - c) * rate, turned + (value - c) * w
        return tau, supplied / turned


def mouth_contacts(
    axis: RestingAxis, crank: Number, center: Number, sizes: tuple[Number, Number, Number]
) -> FirstContacts:
    """First contacts with the mouth's corners; NaN if the roller touches none.

    ``crank`` and ``center`` are relative errors. ``sizes`` are the roller's radius, the slot's
    clearance per side, and the radius of the corners, all over L. The mouth lies across the slot
    where the roller should enter. An arm that is too short strikes the corner beside the crank's
    axis, forwards; one that is too long the other, backwards. On a sharp corner the jump is about
    tan b sqrt(2 eps) sqrt((R -+ r)/r), eps beyond the clearance. A corner rounded by c acts like a
    sharp one on a roller of r + c. On a sphere centre and corner are directions.
    """
    roller, clearance, rounding = sizes
    slot, along, wide = axis.engagement.through.slot, axis.anchor.along, roller + clearance
    if np.any(rounding):  # its circle touches wall and rim
        x, y = slot(0.0, 0)
        sign = np.where(np.hypot(x.c[0], y.c[0]) < along, 1.0, -1.0)
        rim = np.hypot(along, wide)
        square = along * along - 2.0 * sign * rounding * (rim + sign * wide)
        along = parameter(np.sqrt(square))
    reach, wide = roller + rounding, wide + rounding
    top: Number = 0.0  # of the mouth's middle along the wheel's axis
    if slot.height is not None:
        top = slot.height(radians(axis.anchor.input_deg), 0).c[0]
        reach = 2.0 * np.sin(0.5 * reach)  # a chord
    found = []
    with np.errstate(all="ignore"):
        for side in (1.0, -1.0):  # first the corner on the side to which the wheel turns
            place: tuple[Number, Number, Number] = along, side * wide - slot.offset, 0.0
            if slot.height is not None:
                m, own = library(wide), parameter(wide)
                place = along * m.cos(own), side * m.sin(own), top * m.cos(own)
            found.append(_Corner(axis, crank, center, reach, place).contact(along, top))
        (one, forwards), (other, backwards) = found
        tau = np.fmin(one, other)
        jump = np.where(tau == one, forwards, backwards)
    return FirstContacts(np.ravel(axis.engagement.entry_deg + tau / DEGREE), np.ravel(jump))


def entry_impacts(mechanism: Mechanism, pin: PinSize | None = None) -> Impacts:
    """Impacts at entry of m designs with the greatest errors of R and L.

    Without the ``pin`` as it is drawn, forces are not known. The roller meets the slot's axis, or a
    corner of the mouth where the slot is too narrow. A jump below 0 strikes the wheel backwards.
    """
    tolerance, size, L = mechanism.spec.tolerance, mechanism.spec.size, mechanism.center_distance_mm
    # the largest roller in the narrowest slot
    lost = 0.5 * (tolerance.roller_diameter_mm + tolerance.slot_width_mm)
    spare = parameter(np.maximum(size.allowances.slot_clearance_mm - lost, 0.0)) / L
    sizes = mechanism.roller_radius_mm / L, spare, size.mouth_radius_mm / L
    each = list[Array]()
    as_built = any(one.built for one in mechanism.engagements)  # it strikes without errors, too
    for axis in [] if as_built else RestingAxis.each(mechanism):
        errors = [*_errors(mechanism, axis)]
        every = [first_contacts(axis, *error) for error in errors]
        every += [mouth_contacts(axis, *error, sizes) for error in errors]
        each += [shown(mechanism, axis.engagement, *one, np.array(np.nan)) for one in every]
    return hardest(mechanism, each, pin)


def _errors(mechanism: Mechanism, axis: RestingAxis) -> Iterator[tuple[float, float]]:
    """Greatest relative errors of R and L that act across the slot, in both directions."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    arm = arm_mm(mechanism, axis.engagement)
    crank = spec.tolerance.crank_radius_mm / arm if spec.drive.ONE_ARM else 0.0
    center = spec.tolerance.center_distance_mm / L if spec.wheel.FLAT else 0.0
    between = axis.hub_offset * (axis.hub_offset + axis.engagement.through.slot.offset) < 0.0
    center = choose(between, -center, center)
    if np.any(crank) or np.any(center):
        yield crank, -center
        yield -crank, center


def arm_mm(mechanism: Mechanism, engagement: Engagement) -> float:
    """Crank radius at an engagement, mm; its rollers' arms may differ."""
    L = mechanism.center_distance_mm
    if not mechanism.spec.wheel.FLAT:
        return mechanism.ratio * L
    x, y = (z.c[0] for z in engagement.path(0.0, 0))
    return parameter(L * library(x, y).hypot(x - engagement.hub, y))
