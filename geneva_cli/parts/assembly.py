"""The positions of wheel, crank, rollers and links through a whole turn, in mm and radians.

The wheel's axis is the origin, and the crank's is at (L, 0). A drive in front of the crank does not
change which positions it goes through: such a machine is turned by its crank, like a plain one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from itertools import product
from operator import attrgetter, itemgetter
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Point
from geneva_cli.kept import Known
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.pivots import Joint, Link, PlaneMotion
from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.spec.tables import Z_DRAWN


class Passage(NamedTuple):
    """A roller's passage through a slot: its engagement, and the input angle of mid-motion."""

    engagement: Engagement
    mid: float  # degrees

    @property
    def entry(self) -> float:
        """Input angle at which the roller enters, degrees."""
        return self.mid + self.engagement.entry_deg

    @property
    def exit(self) -> float:
        """Input angle at which the roller leaves, degrees."""
        return self.mid + self.engagement.exit_deg


class Assembly(NamedTuple):
    """Positions of a machine's parts by the input angle, in degrees: mostly of a plain crank.

    ``motions`` are those of a turn, and ``rollers`` has the passage of each roller: one for each
    motion, but two where gears drive between them. ``slots`` has engagement and direction of each
    slot of the wheel, or of each pair of slots, counterclockwise from the first. ``rests`` are the
    directions of the crank's axis, seen from the resting wheel, half-way between two slots.
    """

    mechanism: Mechanism
    L: float
    sign: float  # +1 external, -1 internal
    turn_deg: float  # input angle in a whole turn of the crank
    start_deg: float  # where the first engagement begins, and a whole turn
    half_step: float  # of the wheel in its shortest motion, radians
    motions: tuple[Passage, ...]
    rollers: tuple[Passage, ...]
    slots: tuple[tuple[Engagement, float], ...]
    kinds: tuple[Engagement, ...]  # of slots, each once; most wheels have one kind
    rests: tuple[float, ...]
    full: Mechanism  # the machine of the spec, with the drive of its crank
    plane_motion: PlaneMotion  # of the wheel

    def to_input(self, input_deg: float) -> float:
        """Return the input angle of ``full``, degrees, at one of the assembly."""
        spec = self.full.spec
        if self.mechanism is self.full:
            return input_deg
        if self.full.law is None and spec.drive.crank:  # it is turned by a plain crank
            return spec.input_deg(input_deg)
        return spec.drive_before.input_deg(input_deg) if spec.drive_before else input_deg

    def shown_deg(self, input_deg: float) -> float:
        """Return the input angle as commands show it, for an input angle of the assembly."""
        return self.full.shown_deg(self.to_input(input_deg))

    def pin(self, number: int, input_deg: Array, drives: bool = False) -> Array:
        """Return the centre, mm (n, 2), of a roller, or of a motion's that ``drives``."""
        engagement, mid = (self.motions if drives else self.rollers)[number]
        at = self.from_mid(input_deg, mid)
        if engagement.groove is not None:
            from geneva_cli.motion.groove_path import roller_in_groove

            return self.L * roller_in_groove(engagement.groove, engagement.own_deg(at))
        x, y = engagement.path(at, 0)
        return self.L * np.column_stack((x.c[0] + 0.0 * at, y.c[0] + 0.0 * at))

    def geared(self, input_deg: Array) -> Mask:
        """Return a mask (n,) of the input angles at which gears drive the wheel, not a roller."""
        mask = np.zeros(len(input_deg), dtype=bool)
        for engagement, mid in self.motions:
            mask |= engagement.slot.touches(self.from_mid(input_deg, mid)) == 0.0
        return mask

    def from_mid(self, input_deg: Array, mid: float) -> Array:
        """Return input angles from a mid-motion, in degrees, within half a turn of it."""
        half = 0.5 * self.turn_deg
        return (input_deg - mid + half) % self.turn_deg - half

    def crank(self, input_deg: Array, first: Array | None = None) -> Array:
        """Return the crank's direction, radians, by its ``first`` roller's centres (n, 2)."""
        sense = self.rollers[0].engagement.crank_sense
        if sense:
            ahead = math.pi if self.sign > 0.0 else 0.0
            return ahead - self.sign * sense * np.radians(input_deg)
        x, y = ((self.pin(0, input_deg) if first is None else first) - (self.L, 0.0)).T
        # in long numbers, since processors differ in the last bit of doubles' arc tangents
        return np.arctan2(y.astype(np.longdouble), x).astype(np.float64)

    def wheel(self, input_deg: Array) -> Array:
        """Return the wheel's angle at input angles (n,), degrees; it adds up over the turns."""
        turns = np.floor((input_deg - self.start_deg) / self.turn_deg)
        within, steps = input_deg - turns * self.turn_deg, 0.0
        # rounding may put an angle before the turn: into its first motion
        number = np.zeros(len(within), dtype=int)
        for i, (engagement, mid) in enumerate(self.motions):
            number[within >= mid + engagement.entry_deg] = i
            steps += engagement.half_step
        out, turned = 2.0 * steps * turns, 0.0
        for i, (engagement, mid) in enumerate(self.motions):
            here = number == i
            at = np.clip(within[here] - mid, engagement.entry_deg, engagement.exit_deg)
            turned += engagement.half_step if i else 0.0
            out[here] += turned + engagement.motion(at, 0).c[0]
            turned += engagement.half_step
        return out


@lru_cache(maxsize=16)
def assembly(mechanism: Mechanism, flat: bool = True, by_input: bool = False) -> Assembly:
    """Return the assembly of a machine, cached for its sizes and its parts.

    Raises GenevaError if it has no ``flat`` parts that are drawn. Without ``flat`` it is that of
    any machine; on a sphere ``pin`` is seen along the wheel's axis. With ``by_input`` its angles
    are those of the machine's own input shaft.
    """
    spec = plain = mechanism.spec
    if flat and not spec.wheel.FLAT:
        text = f'gearing = "{spec.wheel.NAME}": its parts are not flat outlines about two axes; '
        text += "write `--part wheel`, `crank` or `assembly` as .dxf, .svg or .step"
        raise GenevaError(text, ("wheel", "gearing"))
    if flat and spec.wheel.z > Z_DRAWN:
        text = f"z = {spec.wheel.z}: parts are drawn for up to {Z_DRAWN} slots"
        raise GenevaError(text, ("wheel", "z"))
    if mechanism.law is None and (crank := spec.drive.crank):
        plain = spec.replace(drive=crank, drive_before=None)
    elif spec.drive_before:  # slots and path are by the angle of the drive's own input shaft
        plain = spec.replace(drive_before=None)
    turned = mechanism if by_input or plain == spec else build(plain)
    turn, engagements = 360.0 * turned.spec.turns, turned.engagements
    motions, rollers = list[Passage](), list[Passage]()
    for k, engagement in product(range(round(turn / turned.period_deg)), engagements):
        mid = engagement.mid_deg + k * turned.period_deg
        motions.append(Passage(engagement, mid))
        for passage, ahead in engagement.passages:
            rollers.append(Passage(passage, mid - ahead))
    # around the wheel counterclockwise; later slots follow clockwise
    L, wheel = turned.center_distance_mm, turned.spec.wheel
    several, at = len(engagements) if wheel.steps else 1, 0.0
    slots, rests = list[tuple[Engagement, float]](), list[float]()
    for k in range(wheel.z):
        engagement, following = engagements[k % several], engagements[(k + 1) % wheel.z % several]
        slots.append((engagement, at % math.tau))
        rests.append((at - engagement.half_step) % math.tau)
        at -= engagement.half_step + following.half_step
    slots.sort(key=itemgetter(1))
    ends = turn, motions[0].engagement.entry_deg, min(map(attrgetter("half_step"), engagements))
    kinds: tuple[Engagement, ...] = tuple(dict.fromkeys(map(itemgetter(0), slots)))
    passages = tuple(motions), tuple(rollers)
    around, at_rest, moves = tuple(slots), tuple(sorted(rests)), wheel.plane_motion(L)
    one = turned, L, wheel.SIGN
    return Assembly(*one, *ends, *passages, around, kinds, at_rest, mechanism, moves)


def turn_deg(mechanism: Mechanism) -> Array:
    """Return input angles of a whole turn, a quarter of a degree apart; 0 is in the middle."""
    turns = mechanism.spec.turns
    return np.linspace(-180.0 * turns, 180.0 * turns, 1440 * turns + 1)


def links_at(mechanism: Mechanism, input_deg: Array, before: bool = True) -> tuple[Link, ...]:
    """Return a machine's links at input angles (n,), in degrees within half a period of mid-motion.

    A cam-Geneva's crank is one; with ``before`` there are also those of the drive before it.
    """
    spec, sign = mechanism.spec, mechanism.spec.wheel.SIGN
    if spec.drive.direct and spec.drive_before is None:
        return ()  # the input carries the crank
    own_deg = mechanism.engagements[0].own_deg(input_deg)
    own, L = spec.drive.links(mechanism.plan, sign, own_deg), mechanism.center_distance_mm
    groove = mechanism.engagements[0].groove
    if groove is not None:
        from geneva_cli.motion.groove_path import roller_in_groove

        m, still = spec.drive.rollers, 0.0 * input_deg
        joints = [(still + L, still)]
        for k in range(m):
            x, y = L * roller_in_groove(groove, own_deg - 360.0 * k / m).T
            joints.append((x, y))
        own = (*own, Link("crank", tuple(joints), (Joint.SHAFT, *[Joint.CARRIED] * m), 1))
    if spec.drive_before is None or not before:
        return own
    # the links of the drive before are on the shaft that it turns, below all others
    shaft, names, links = mechanism.own_shaft, {link.name for link in own}, [*own]
    mirror, shift, below = -sign * shaft.sense, shaft.x_mm - L, _deepest(mechanism, own)
    for link in spec.drive_before.links(mechanism.plan, sign, input_deg):
        name = f"first {link.name}" if link.name in names else link.name
        moved = tuple((x + shift, y * mirror) for x, y in link.joints)
        links.append(link._replace(name=name, joints=moved, plane=link.plane - 1 + below))
    return tuple(links)


def _deepest(mechanism: Mechanism, own: Iterable[Link]) -> int:
    """Return the number of the lowest plane of the arm, the drive's links, or a groove plate."""
    if mechanism.engagements[0].groove is not None:
        return 3  # of its base, below the groove and the crank
    return max((link.plane for link in own), default=1)


def gear_plane(mechanism: Mechanism) -> int:
    """Return the number of the plane of noncircular gears: below the arm and the drive's links."""
    return 1 + _deepest(mechanism, links_at(mechanism, np.zeros(1), before=False))


@Known
def is_bridged(mechanism: Mechanism) -> bool:
    """Return True if a bridge bears the crank's shaft, because a link turns over its axis below."""
    spec, size, L = mechanism.spec, mechanism.spec.size, mechanism.center_distance_mm
    single = len(mechanism.wheel_places) == len(mechanism.crank_places) == 1
    own_ends = size.crank_shaft_low_mm is None and size.crank_shaft_high_mm is None
    if spec.drive_before or spec.wheel.SIGN < 0.0 or not (single and own_ends):
        return False
    near, lowest, over = SAME_LENGTH * L, -math.inf, -math.inf
    for link in links_at(mechanism, np.array([-180.0, 0.0])):
        if link.radius_mm:
            continue
        (x, y), (u, v), *_ = link.joints
        p, q = x + 1j * y - L, u + 1j * v - L
        if np.abs(p).max() < near:
            lowest = max(lowest, link.plane)  # of the links on the crank's shaft
        # the axis lies between the ends of a link with which it is in line
        across, along = np.imag(p * np.conj(q)), np.real(p * np.conj(q))
        if np.any((np.abs(across) < near * L) & (along < 0.0)):
            over = max(over, link.plane)
    return over > lowest > -math.inf


def same(p: Point, q: Point, L: float) -> bool:
    """Return True if two points coincide, with the centre distance L."""
    return abs(complex(*p) - complex(*q)) < SAME_LENGTH * L
