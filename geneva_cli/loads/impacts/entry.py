"""The impact at entry: a roller that meets its slot off the slot's axis, or a corner of its mouth.

Of the errors of R and L: if R/L is too large by a fraction eps, the path crosses the axis before
the entry, and strikes the wheel backwards at about tan b sqrt(2 eps) of the input's speed. Speeds
are in units of the input's, input angles in degrees from the engagement's own mid-motion.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.shock_force import Impacts, hardest, shown
from geneva_cli.loads.strength.pin_arm_key import PinSize
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Mask, N, Whole, array, choose, library, parameter
from geneva_cli.numerics.jet import Array, Jet, Number, sqrt
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


class _Approach(NamedTuple):
    """A roller with errors of R and L that comes to the slot's axis, or to a corner of its mouth.

    Positions are along the axis, across it from the axis, and along the wheel's own axis.
    """

    axis: RestingAxis
    crank: Number
    center: Number
    corner: tuple[Number, Number, Number] | None = None
    reach: Number = 0.0  # distance of the roller's centre at which it touches the corner

    def roller(self, tau: Array) -> tuple[Jet, Jet, Jet]:
        """Roller centre ``tau`` radians of the input after the true entry."""
        (axis, crank, center, *_), longer = self, 1.0 + self.crank
        slot, anchor = axis.engagement.through.slot, axis.anchor
        x, y = anchor.displacement(tau, 1)
        x = (x + anchor.along) * longer - (crank - center) * axis.along
        y = (y - axis.offset(crank, center)) * longer
        if slot.height is None:
            return x, y, x * 0.0
        z = slot.height(radians(anchor.input_deg) + tau, 1) * longer - crank * slot.height.hub
        far = sqrt(x * x + y * y + z * z)
        return x / far, y / far, z / far

    def gap(self, tau: Array) -> tuple[Array, Array]:
        """The distance from the axis, or the squared one beyond the corner's, and its slope."""
        place = self.roller(tau)
        if self.corner is None:
            return array(place[1].c[0]), array(place[1].c[1])
        x, y, z = (p - c for p, c in zip(place, self.corner, strict=True))
        value, slope = (x * x + y * y + z * z - self.reach**2).derivatives()
        return value, slope

    def contacts(self, places: Array, passed: Mask) -> FirstContacts:
        """The contacts before the first places (m, k) that are passed; NaN if there is none.

        The roller's centre P and the point C that it meets keep their distance along the normal n
        at the speed n . P' / n . (z x C).
        """
        every, first = np.arange(len(places)), np.argmax(passed, axis=1)
        reached = np.where(passed.any(axis=1) & (first > 0), 1.0, np.nan)
        ends = np.sort([places[every, first - k] * reached for k in (0, 1)], axis=0)

        def gap(x: Array, live: Whole) -> tuple[Array, Array]:
            value, slope = taken(self, live).gap(x[:, None])
            return value[:, 0], slope[:, 0]

        out = find_roots(gap, *ends)[:, None]
        engagement, place = self.axis.engagement, self.roller(out)
        point: list[Number] = [p.c[0] for p in place]
        normal: list[Number] = [0.0, 1.0, 0.0]
        if self.corner is not None:
            normal = [p - c for p, c in zip(point, self.corner, strict=True)]
            point = [*self.corner]
        supplied = sum(n * p.c[1] for n, p in zip(normal, place, strict=True))
        turned = normal[1] * point[0] - normal[0] * (point[1] - engagement.through.slot.offset)
        at_deg = engagement.entry_deg + out / DEGREE
        return FirstContacts(np.ravel(at_deg), np.ravel(supplied / turned))


def first_contacts(axis: RestingAxis, crank: Number, center: Number = 0.0) -> FirstContacts:
    """First contacts with the axis for relative errors of the crank's radius and of L: (m, 1) each.

    NaN if a roller never reaches the slot's axis, and meets the mouth, or if there are no errors. A
    radial slot has sin(phi + b) = sin b / l there.
    """
    # The roller comes from one side, ``before``. At a true entry it stays on that side (a circle)
    # or crosses to the other (a path with an inflection).
    span = 0.5 * axis.engagement.through.motion_deg * DEGREE
    before = array(axis.anchor.displacement(np.atleast_2d(-1e-3 * span), 0)[1].c[0])
    turn, offset = axis.turn, np.atleast_2d(axis.offset(crank, center)) + 0.0 * before
    roller = _Approach(axis, crank + 0.0 * offset, center + 0.0 * offset)
    with np.errstate(all="ignore"):
        sense = np.where(offset * before > 0.0, -1.0, np.where(offset > 0.0, 1.0, np.nan))
        if (built := axis.engagement.through.built) is not None:  # the crossing that is its entry
            off = (abs(turn) > 1e-9) | np.logical_not(built.crosses)
            sense = np.where(off, np.where(turn > 1e-9, -1.0, 1.0), sense)
        far = span * np.append(0.0, OCTAVES)
        # many errors of one machine have its path in common
        back, ahead = (roller.gap(turn + side * far)[0] for side in (-1.0, 1.0))
        passed = np.where(sense > 0.0, ahead, back) * roller.gap(turn)[0] <= 0.0
        return roller.contacts(turn + sense * far, passed)


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
    found, outwards = list[FirstContacts](), 0.5 * axis.engagement.through.motion_deg * DEGREE
    with np.errstate(all="ignore"):
        for side in (1.0, -1.0):  # first the corner on the side to which the wheel turns
            place: tuple[Number, Number, Number] = along, side * wide, 0.0
            if slot.height is not None:
                m, own = library(wide), parameter(wide)
                place = along * m.cos(own), side * m.sin(own), top * m.cos(own)
            # it comes from outside, and has passed once its centre is in the mouth
            coming = _Approach(axis, crank, center, place, reach)
            x, _, z = coming.roller(np.atleast_2d(0.0 * outwards))
            out, speed = (x - along if slot.height is None else x * top - z * along).derivatives()
            places = -out / speed - outwards * OCTAVES[::-1]
            meets = coming.gap(places)[0] <= -1e-16  # of L²: nearer to 0 it is rounding
            found.append(coming.contacts(np.broadcast_to(places, meets.shape), meets))
    (one, forwards), (other, backwards) = found
    at_deg = np.fmin(one, other)
    return FirstContacts(at_deg, np.where(at_deg == one, forwards, backwards))


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
