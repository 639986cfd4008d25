"""The sizes of links: those of the spec, or defaults that leave walls between their holes.

They are radii, in millimetres, where a key of the spec is a diameter or a width.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array, half_or
from geneva_cli.numerics.preferred import bore_radius, rounded_radius
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import Bore
from geneva_cli.parts.sizes import HUB, drawn_thicknesses, pin_hole, pin_radius, plane_span
from geneva_cli.spec.defaults import eye_about, wall_min

SLOT_MARGIN = 0.25  # distance from a block to the end of its slot, as a fraction of the pin's hole


class LinkSizes(NamedTuple):
    """Radii of holes and of the plate around them; thicknesses along the axis; all mm."""

    wall: float  # the least wall that `check` lets pass
    pin: float
    roller_stands: float  # radius of a roller's pin; 0 if the spec has none
    roller_pin: float  # radius of its hole
    eye: float  # radius of the plate around a pin
    roller_eye: float
    shaft: float | None  # of the spec, or as a load needs it, for shafts that carry only links
    crank_shaft: float | None  # of the spec, or of the arm on it
    thickness: float
    arm: float  # thickness of arm or link in the first plane
    gap: float  # from the wheel to the first plane
    washer: float
    loose: float  # by which the radius of a hole is above that of the pin or shaft in it

    @property
    def ring(self) -> float:
        """The radius of washers and spacers on a pin."""
        return 0.5 * (self.pin + self.loose + self.eye)

    def hole(self, kind: Joint) -> float:
        """Return the radius of a pin's hole; for shafts see ``bore``."""
        own = kind in (Joint.ROLLER, Joint.CARRIED)
        return self.roller_pin if own and self.roller_pin else self.pin + self.loose

    def block(self, hole: float) -> tuple[float, float]:
        """Return half a sliding block's width, and the offset of its round ends' centres."""
        half = max(1.6 * hole, hole + self.wall)  # as wide as a hub about its pin
        return half, 0.5 * half  # half as long again as it is wide

    def bore(self, space: float, L: float) -> float:
        """Return the radius of a shaft ``space`` mm from the nearest hole; 0 if it is too thin."""
        if self.shaft is not None:
            return self.shaft
        radius = bore_radius(min(L / 20.0, 0.35 * space))  # leaves most of the space as a wall
        return radius if radius >= 0.01 * L else 0.0

    def hub(self, bore: Bore) -> float:
        """Return the radius of a link's plate around a bore, or on a shaft's end."""
        return max(rounded_radius(HUB * bore.radius), bore.reach + self.wall)

    def span(self, plane: int) -> tuple[float, float]:
        """Return lower and upper end, along the axis, of links in a plane below the wheel's."""
        return plane_span(plane, self.gap, self.arm, self.thickness, self.washer)


def link_sizes(
    mechanism: Mechanism, links: Iterable[Link], parts: Outlines | None = None
) -> LinkSizes:
    """Return the sizes of links, whose joints are known at many input angles.

    ``parts`` are the machine's outlines, if it has any.
    """
    spec, L = mechanism.spec, mechanism.center_distance_mm
    size, bars = spec.size, [link for link in links if not link.radius_mm]
    drawn = parts.sizes if parts else None
    wall, thick = wall_min(size, L), drawn_thicknesses(size, L, drawn)
    first = drawn.first if drawn else None
    stands = first.pin if first else pin_radius(size, mechanism.roller_radius_mm, drawn)
    own = None if size.link_bore_mm is None else 0.5 * size.link_bore_mm
    roller, loose = pin_hole(size, stands) if stands else 0.0, size.allowances.around_shaft_mm
    # a fifth of the distance to the next joint leaves eyes and a gap between
    nearest = min(
        (
            float(np.abs(p - q).min())
            for link in bars
            for (p, a), (q, b) in combinations(zip(places(link), link.kinds, strict=True), 2)
            if {a, b} & {Joint.PIN, Joint.SLIDE} and Joint.NONE not in (a, b)
        ),
        default=L,
    )
    pin = half_or(size.link_pin_mm, rounded_radius(min(L / 40.0, 0.2 * nearest)))
    eye = half_or(size.link_width_mm, eye_about(pin + loose, wall))
    if eye <= pin + loose:
        raise GenevaError(
            f"link_width_mm = {2.0 * eye:g}: it must be above {2.0 * (pin + loose):.6g}, the "
            "diameter of the pins' holes",
            ("size", "link_width_mm"),
        )
    crank_mm = spec.shaft.crank_diameter_mm
    crank_shaft = None if crank_mm is None else 0.5 * crank_mm
    if parts and (parts.has_arm or parts.sizes.crank_bore):
        crank_shaft = parts.sizes.arm_bore if parts.has_arm else parts.sizes.crank_bore
    return LinkSizes(
        wall=wall,
        pin=pin,
        roller_stands=stands,
        roller_pin=roller,
        eye=eye,
        roller_eye=eye_about(roller, wall, _eye_limit(mechanism, bars)) if roller else eye,
        shaft=first.shaft if first else own,
        crank_shaft=crank_shaft,
        thickness=thick.link,
        arm=thick.arm if spec.drive.ONE_ARM else thick.link,
        gap=size.allowances.pin_gap_mm,
        washer=size.washer_mm,
        loose=loose,
    )


def places(link: Link) -> list[Array]:
    """Return the joints of a link as complex numbers x + iy (n,), by the input angle."""
    still = 0.0 * link.joints[0][0]
    return [np.asarray(x + still + 1j * (y + still)) for x, y in link.joints]


def point_at_zero(path: Array) -> Point:
    """Return the point of a path at input angle 0, in the middle of its angles."""
    z = complex(path[len(path) // 2])
    return z.real, z.imag


def roller_pins(mechanism: Mechanism) -> Iterator[tuple[Link, Point]]:
    """Yield the links that carry rollers, with the centre of each roller at input angle 0."""
    for link in links_at(mechanism, np.zeros(1)):
        for joint, kind in zip(places(link), link.kinds, strict=True):
            if kind in (Joint.ROLLER, Joint.CARRIED):
                yield link, point_at_zero(joint)


def _eye_limit(mechanism: Mechanism, links: Iterable[Link]) -> float:
    """Return a link's largest radius about the roller's pin that clears the wheel's hub."""
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
