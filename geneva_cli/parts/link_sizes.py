"""The sizes of links: as the spec gives them, or defaults that leave walls between their holes.

Radii, in millimetres, where a key is a diameter or a width.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Joint, Link
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.arm import has_arm, shaft_bore
from geneva_cli.parts.arm_sizes import HUB, eye_about, half_or, pin_hole
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sizes import even, pin_radius, thicknesses, wall_min

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

NEAR = 0.2  # of the way to the next joint: how large a pin is at most
BORED = 0.35  # of the room beside other holes: how large a bore is at most
THIN = 0.01  # of the centre distance: no shaft is thinner by default
BLOCK = 1.6  # of its pin's hole: how wide a sliding block is
LONG = 0.5  # of a block's width: how much longer it is
SPARE = 0.25  # of a pin: from a block to the end of its slot


class LinkSizes(NamedTuple):
    """Radii of holes, and of the plate round them; thicknesses along the axis."""

    wall: float  # the least that `check` lets pass
    pin: float
    roller_pin: float  # its hole; 0 where the spec has no pin
    eye: float  # round a pin
    roller_eye: float
    shaft: float | None  # as it is given, of shafts that carry links alone
    crank_shaft: float | None  # as it is given, or of the arm on it
    thickness: float
    arm: float  # of what is in the first plane
    gap: float  # from the wheel to that
    washer: float

    @property
    def ring(self) -> float:
        """The radius of washers and spacers on a pin."""
        return 0.5 * (self.pin + self.eye)

    def hole(self, kind: Joint) -> float:
        """The radius of a pin's hole; ``bore`` has a shaft's."""
        own = kind in (Joint.ROLLER, Joint.CARRIED)
        return self.roller_pin if own and self.roller_pin else self.pin

    def block(self, hole: float) -> tuple[float, float]:
        """Half a sliding block's width, and distance of its round ends' centres from its own."""
        half = max(BLOCK * hole, hole + self.wall)
        return half, LONG * half

    def bore(self, room: float, L: float) -> float:
        """The radius of a shaft with ``room`` mm to the nearest hole; 0 where it is too thin."""
        if self.shaft is not None:
            return self.shaft
        found = even(min(L / 20.0, BORED * room))
        return found if found >= THIN * L else 0.0

    def hub(self, bore: float) -> float:
        """The radius of a link's plate round a bore, or on a shaft's end."""
        return max(even(HUB * bore), bore + self.wall)

    def span(self, plane: int) -> tuple[float, float]:
        """The lower and upper end, along the axis, of the links in a plane below the wheel's."""
        high = -self.gap
        if plane > 1:
            high -= self.arm + self.washer + (plane - 2) * (self.thickness + self.washer)
        return high - (self.arm if plane == 1 else self.thickness), high


def link_sizes(
    mechanism: Mechanism, links: Iterable[Link], parts: Outlines | None = None
) -> LinkSizes:
    """The sizes of links that are known at many input angles.

    ``found`` are the machine's outlines, where it has some. Raises GenevaError, naming the key,
    where there is no hole for the roller's pin, or no plate round a pin.
    """
    spec, L = mechanism.spec, mechanism.center_distance_mm
    size, links = spec.size, [link for link in links if not link.radius_mm]
    wall, thick = wall_min(size, L), thicknesses(size, L)
    stands = pin_radius(size, mechanism.roller_radius_mm)
    roller = pin_hole(size, stands) if stands else 0.0
    nearest = min((way for link in links for way in _ways(link)), default=L)
    pin = even(min(L / 40.0, NEAR * nearest)) if size.link_pin_mm is None else size.link_pin_mm / 2
    eye = half_or(size.link_width_mm, eye_about(pin, wall))
    if eye <= pin:
        raise GenevaError(
            f"link_width_mm = {2.0 * eye:g}: it must be above {2.0 * pin:.6g}, the pins in it",
            ("size", "link_width_mm"),
        )
    room = _beside_hub(mechanism, links)
    arm = thick.arm if spec.drive.ONE_ARM else thick.link
    return LinkSizes(
        wall=wall,
        pin=pin,
        roller_pin=roller,
        eye=eye,
        roller_eye=eye_about(roller, wall, room) if roller else eye,
        shaft=None if size.link_bore_mm is None else 0.5 * size.link_bore_mm,
        crank_shaft=_crank_shaft(mechanism, parts),
        thickness=thick.link,
        arm=arm,
        gap=size.pin_gap_mm,
        washer=size.washer_mm,
    )


def _crank_shaft(mechanism: Mechanism, parts: Outlines | None) -> float | None:
    """The radius of the crank's shaft: that of arm or locking disc, or the given one."""
    if parts and has_arm(parts):
        return shaft_bore(parts)
    if parts and parts.sizes.crank_bore:
        return parts.sizes.crank_bore
    given = mechanism.spec.shaft.crank_diameter_mm
    return None if given is None else 0.5 * given


def places(link: Link) -> list[Array]:
    """The joints of a link as complex numbers x + iy (n,), by the input angle."""
    still = 0.0 * link.joints[0][0]
    return [np.asarray(x + still + 1j * (y + still)) for x, y in link.joints]


def _ways(link: Link) -> Iterator[float]:
    """The least distance of each pin of a link from its other joints."""
    for (p, a), (q, b) in combinations(zip(places(link), link.kinds, strict=True), 2):
        if {a, b} & {Joint.PIN, Joint.SLIDE} and Joint.NONE not in (a, b):
            yield float(np.abs(p - q).min())


def _beside_hub(mechanism: Mechanism, links: Iterable[Link]) -> float:
    """The room of a link beyond the roller's pin: to the wheel's hub, where that is nearest."""
    size = mechanism.spec.size
    near = [
        float(np.abs(at).min())
        for link in links
        for at, kind in zip(places(link), link.kinds, strict=True)
        if kind is Joint.ROLLER
    ]
    if not near:
        return math.inf
    w = mechanism.roller_radius_mm * 1.05 + size.allowances.slot_clearance_mm
    hub = 0.75 * (min(near) - w) if size.wheel_hub_mm is None else 0.5 * size.wheel_hub_mm
    return min(near) - hub
