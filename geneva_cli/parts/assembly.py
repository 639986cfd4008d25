"""The positions of wheel, crank, rollers and links through a whole turn, in mm and radians.

The wheel's axis is the origin, and the crank's is at (L, 0). A drive in front of the crank does not
change which positions it goes through: such a machine is turned by its crank, like a plain one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Point
from geneva_cli.kept import Known
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.spec.tables import Z_DRAWN

if TYPE_CHECKING:
    from geneva_cli.motion.plane_motion import PlaneMotion


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
    motions: tuple[Passage, ...]
    rollers: tuple[Passage, ...]
    slots: tuple[tuple[Engagement, float], ...]
    rests: tuple[float, ...]
    full: Mechanism  # the machine of the spec, with the drive of its crank
    to_input: Callable[[float], float]  # input angle of the plain crank -> of ``full``, degrees
    plane_motion: PlaneMotion  # of the wheel

    def shown_deg(self, input_deg: float) -> float:
        """Return the input angle as commands show it, for an input angle of the assembly."""
        return self.full.shown_deg(self.to_input(input_deg))

    def pin(self, number: int, input_deg: Array) -> Array:
        """Return a roller's centre, mm, at input angles in degrees (n,): an array (n, 2)."""
        return self._path(*self.rollers[number], input_deg)

    def driving(self, number: int, input_deg: Array) -> Array:
        """Return the centre of a roller that drives, or beside gears will drive, mm, (n, 2)."""
        return self._path(*self.motions[number], input_deg)

    def in_wheel(self, motion: int, input_deg: Array, lead: Array | float = 0.0) -> Array:
        """Return it as seen from the wheel, turned on by ``lead`` radians: see ``driving``."""
        turn = self.wheel(input_deg) + lead
        return self.plane_motion.into(self.driving(motion, input_deg), turn)

    def geared(self, input_deg: Array) -> Mask:
        """Return a mask (n,) of the input angles at which gears drive the wheel, not a roller."""
        mask = np.zeros(len(input_deg), dtype=bool)
        for engagement, behind in self.motions:
            mask |= engagement.slot.touches(self.from_mid(input_deg, behind)) == 0.0
        return mask

    def from_mid(self, input_deg: Array, mid: float) -> Array:
        """Return input angles from a mid-motion, in degrees, within half a turn of it."""
        half = 0.5 * self.turn_deg
        return (input_deg - mid + half) % self.turn_deg - half

    def _path(self, engagement: Engagement, behind: float, input_deg: Array) -> Array:
        at = self.from_mid(input_deg, behind)
        if engagement.groove is not None:
            from geneva_cli.motion.groove_path import roller_in_groove

            return self.L * roller_in_groove(engagement.groove, engagement.own_deg(at))
        x, y = engagement.path(at, 0)
        return self.L * np.column_stack((x.c[0] + 0.0 * at, y.c[0] + 0.0 * at))

    def crank(self, input_deg: Array, first: Array | None = None) -> Array:
        """Return the crank's direction, radians: that of its first roller at input angle 0.

        ``first`` has the first roller's centres at these angles, mm (n, 2), if they are known.
        """
        engagement = self.rollers[0][0]
        if engagement.crank_sense:
            return self._ahead - self.sign * engagement.crank_sense * np.radians(input_deg)
        x, y = ((self.pin(0, input_deg) if first is None else first) - (self.L, 0.0)).T
        # in long numbers, since processors differ in the last bit of doubles' arc tangents
        return np.arctan2(y.astype(np.longdouble), x).astype(np.float64)

    @property
    def _ahead(self) -> float:
        """The crank's direction at input 0: to the wheel's axis if external, away if internal."""
        return math.pi if self.sign > 0.0 else 0.0

    def lock(self, input_deg: float) -> float:
        """Return the wheel's direction from the crank's axis, radians, in the crank's frame."""
        return self._ahead - float(self.crank(np.array([input_deg]))[0])

    def wheel(self, input_deg: Array) -> Array:
        """Return the wheel's angle at input angles (n,), degrees; it adds up over the turns."""
        turns = np.floor((input_deg - self.start_deg) / self.turn_deg)
        within = input_deg - turns * self.turn_deg
        out = 2.0 * sum(engagement.half_step for engagement, _ in self.motions) * turns
        begins = np.array([one.entry for one in self.motions])
        # rounding may put an angle before the turn
        number = np.maximum(np.searchsorted(begins, within, side="right") - 1, 0)
        turned = 0.0
        for i, (engagement, mid) in enumerate(self.motions):
            here = number == i
            at = np.clip(within[here] - mid, engagement.entry_deg, engagement.exit_deg)
            turned += engagement.half_step if i else 0.0
            out[here] += turned + engagement.motion(at, 0).c[0]
            turned += engagement.half_step
        return out

    @property
    def kinds(self) -> tuple[Engagement, ...]:
        """The kinds of slots, each once; most wheels have one kind."""
        return tuple(dict.fromkeys(engagement for engagement, _ in self.slots))

    @property
    def start_deg(self) -> float:
        """Input angle of the first engagement's entry, where a whole turn starts."""
        return self.motions[0][0].entry_deg


@lru_cache(maxsize=16)
def assembly(mechanism: Mechanism) -> Assembly:
    """Return the assembly of a mechanism with flat parts, cached for its sizes and its parts."""
    spec = mechanism.spec
    if not spec.wheel.FLAT:
        raise GenevaError(
            f'gearing = "{spec.wheel.NAME}": its parts are not flat outlines about two axes; write '
            "`--part wheel`, `crank` or `assembly` as .dxf, .svg or .step",
            ("wheel", "gearing"),
        )
    if spec.wheel.z > Z_DRAWN:
        raise GenevaError(
            f"z = {spec.wheel.z}: parts are drawn for up to {Z_DRAWN} slots", ("wheel", "z")
        )
    return assembled(mechanism)


def input_of(mechanism: Mechanism) -> Callable[[float], float]:
    """Return the function of an assembly's input angle that is the machine's, both in degrees."""
    spec = mechanism.spec
    if mechanism.law is None and spec.drive.crank:  # it is turned by a plain crank
        return spec.input_deg
    return spec.drive_before.input_deg if spec.drive_before else _same


def assembled(mechanism: Mechanism) -> Assembly:
    """Return the assembly of any machine; on a sphere ``pin`` is seen along the wheel's axis."""
    spec, plain = mechanism.spec, mechanism.spec
    if mechanism.law is None and (crank := spec.drive.crank):
        plain = spec.replace(drive=crank, drive_before=None)
    elif spec.drive_before:  # slots and path are by the angle of the drive's own input shaft
        plain = spec.replace(drive_before=None)
    turned = mechanism if plain == spec else build(plain)
    return assembled_by_input(turned)._replace(full=mechanism, to_input=input_of(mechanism))


def assembled_by_input(mechanism: Mechanism) -> Assembly:
    """Return the assembly of a machine by the angle of its own input shaft."""
    turn = 360.0 * mechanism.spec.turns
    motions = tuple(
        Passage(engagement, engagement.mid_deg + k * mechanism.period_deg)
        for k in range(round(turn / mechanism.period_deg))
        for engagement in mechanism.engagements
    )
    rollers = tuple(
        Passage(passage, behind - ahead)
        for engagement, behind in motions
        for passage, ahead in engagement.passages
    )
    L, wheel, engagements = (
        mechanism.center_distance_mm,
        mechanism.spec.wheel,
        mechanism.engagements,
    )
    # around the wheel counterclockwise; later slots follow clockwise
    z, several = wheel.z, len(engagements) if wheel.steps else 1
    kinds = [engagements[k % several] for k in range(z)]
    slots, rests, at = [], [], 0.0
    for k, engagement in enumerate(kinds):
        slots.append((engagement, at % math.tau))
        rests.append((at - engagement.half_step) % math.tau)
        at -= engagement.half_step + kinds[(k + 1) % z].half_step
    return Assembly(
        mechanism,
        L,
        wheel.SIGN,
        turn,
        motions,
        rollers,
        tuple(sorted(slots, key=lambda slot: slot[1])),
        tuple(sorted(rests)),
        mechanism,
        _same,
        wheel.plane_motion(L),
    )


def _same(input_deg: float) -> float:
    return input_deg


def turn_deg(mechanism: Mechanism) -> Array:
    """Return input angles of a whole turn, a quarter of a degree apart; 0 is in the middle."""
    turns = mechanism.spec.turns
    return np.linspace(-180.0 * turns, 180.0 * turns, 1440 * turns + 1)


def links_at(mechanism: Mechanism, input_deg: Array) -> tuple[Link, ...]:
    """Return a machine's links at input angles (n,), in degrees within half a period of mid-motion.

    They are those of the drive and of the one before it and, for a cam-Geneva, the crank along
    which its rollers slide.
    """
    own, spec = _own_links(mechanism, input_deg), mechanism.spec
    if spec.drive_before is None:
        return own
    # the links of the drive before are on the shaft that it turns, below all others
    shaft, sign, names = mechanism.own_shaft, spec.wheel.SIGN, {link.name for link in own}
    mirror, shift = -sign * shaft.sense, shaft.x_mm - mechanism.center_distance_mm
    below = _deepest(mechanism, own)
    before = (
        link._replace(
            name=f"first {link.name}" if link.name in names else link.name,
            joints=tuple((x + shift, y * mirror) for x, y in link.joints),
            plane=link.plane - 1 + below,
        )
        for link in spec.drive_before.links(mechanism.plan, sign, input_deg)
    )
    return (*own, *before)


def _own_links(mechanism: Mechanism, input_deg: Array) -> tuple[Link, ...]:
    """Return the links of the drive itself."""
    sign, own_deg = mechanism.spec.wheel.SIGN, mechanism.engagements[0].own_deg(input_deg)
    own = mechanism.spec.drive.links(mechanism.plan, sign, own_deg)
    groove = mechanism.engagements[0].groove
    if groove is None:
        return own
    from geneva_cli.motion.groove_path import roller_in_groove

    L, m, still = mechanism.center_distance_mm, mechanism.spec.drive.rollers, 0.0 * input_deg
    joints = [(still + L, still)]
    for k in range(m):
        x, y = L * roller_in_groove(groove, own_deg - 360.0 * k / m).T
        joints.append((x, y))
    return (*own, Link("crank", tuple(joints), (Joint.SHAFT, *[Joint.CARRIED] * m), 1))


def _deepest(mechanism: Mechanism, own: Iterable[Link]) -> int:
    """Return the number of the lowest plane of the arm, the drive's links, or a groove plate."""
    if mechanism.engagements[0].groove is not None:
        return 3  # of its base, below the groove and the crank
    return max((link.plane for link in own), default=1)


def gear_plane(mechanism: Mechanism) -> int:
    """Return the number of the plane of noncircular gears: below the arm and the drive's links."""
    return 1 + _deepest(mechanism, _own_links(mechanism, np.zeros(1)))


@Known
def is_bridged(mechanism: Mechanism) -> bool:
    """Return True if a bridge bears the crank's shaft, because a link turns over its axis below."""
    spec, size, L = mechanism.spec, mechanism.spec.size, mechanism.center_distance_mm
    single = len(mechanism.wheel_places) == len(mechanism.crank_places) == 1
    own_ends = size.crank_shaft_low_mm is None and size.crank_shaft_high_mm is None
    if spec.drive_before or spec.wheel.SIGN < 0.0 or not (single and own_ends):
        return False
    bars = [link for link in links_at(mechanism, np.array([-180.0, 0.0])) if not link.radius_mm]
    joints = {link.name: [x + 1j * y - L for x, y in link.joints] for link in bars}
    near = SAME_LENGTH * L
    on_shaft = [link.plane for link in bars if np.abs(joints[link.name][0]).max() < near]
    below = (link for link in bars if link.plane > max(on_shaft, default=math.inf))
    # the axis lies between the ends of the link, with which it is in line
    return any(
        bool(np.any((np.abs(np.imag(p * np.conj(q))) < near * L) & (np.real(p * np.conj(q)) < 0.0)))
        for p, q, *_ in (joints[link.name] for link in below)
    )


def same(p: Point, q: Point, L: float) -> bool:
    """Return True if two points coincide, with the centre distance L."""
    return abs(complex(*p) - complex(*q)) < SAME_LENGTH * L
