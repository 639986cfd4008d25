"""The sizes of links, of the spec or by default with walls between holes; and places of joints.

Sizes are radii, in millimetres, where a key of the spec is a diameter or a width.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import combinations

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array, half_or
from geneva_cli.numerics.tolerances import rounded_radius
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.links.links import LinkSizes
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.sizes import drawn_thicknesses, pin_hole, pin_radius
from geneva_cli.spec.defaults import eye_about, wall_min


def link_sizes(
    mechanism: Mechanism, links: Iterable[Link], parts: Outlines | None = None
) -> LinkSizes:
    """Return the sizes of links, whose joints are known at many input angles."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    size, bars = spec.size, [link for link in links if not link.radius_mm]
    drawn = parts.sizes if parts else None
    wall, thick = wall_min(size, L), drawn_thicknesses(size, L)
    stands = pin_radius(size, mechanism.roller_radius_mm)
    thickness, arm = thick.link, thick.arm
    if drawn:
        stands = drawn.first_pin or drawn.pin
        thickness, arm = drawn.link_thickness, drawn.arm_thickness
    own = None if size.link_bore_mm is None else 0.5 * size.link_bore_mm
    roller, loose = pin_hole(size, stands) if stands else 0.0, 0.5 * size.allowances.shaft_fit_mm
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
        shaft=drawn.first_shaft if drawn and drawn.first_shaft else own,
        crank_shaft=crank_shaft,
        thickness=thickness,
        arm=arm if spec.drive.ONE_ARM else thickness,
        gap=size.allowances.pin_gap_mm,
        washer=size.washer_mm,
        loose=loose,
    )


def places(link: Link) -> list[Array]:
    """Return the joints of a link as complex numbers x + iy (n,), by the input angle."""
    still = 0.0 * link.joints[0][0]
    return [np.asarray(x + still + 1j * (y + still)) for x, y in link.joints]


def joints(link: Link, *kinds: Joint) -> list[tuple[Array, Joint]]:
    """Return path, as ``places``, and kind of the joints of a link that are of some kinds."""
    both = zip(places(link), link.kinds, strict=True)
    return [(path, kind) for path, kind in both if kind in kinds]


def point_at_zero(path: Array) -> Point:
    """Return the point of a path at input angle 0, in the middle of its angles."""
    z = complex(path[len(path) // 2])
    return z.real, z.imag


def joined(links: Iterable[Link], near: float) -> Iterator[tuple[Array, list[Link]]]:
    """Yield each pin of several links: its path, and the links from the upper plane down."""
    pins = [(link, at) for link in links for at, _ in joints(link, Joint.PIN, Joint.SLIDE)]
    for i, (link, at) in enumerate(pins):
        others = [other for other, there in pins[i + 1 :] if np.abs(at - there).max() < near]
        if others:
            yield at, sorted((link, *others), key=lambda one: one.plane)


def roller_pins(mechanism: Mechanism) -> Iterator[tuple[Link, Point]]:
    """Yield the links that carry rollers, with the centre of each roller at input angle 0."""
    for link in links_at(mechanism, np.zeros(1)):
        for path, _ in joints(link, Joint.ROLLER, Joint.CARRIED):
            yield link, point_at_zero(path)


def _eye_limit(mechanism: Mechanism, links: Iterable[Link]) -> float:
    """Return a link's largest radius about the roller's pin that clears the wheel's hub."""
    size = mechanism.spec.size
    near = [float(np.abs(at).min()) for link in links for at, _ in joints(link, Joint.ROLLER)]
    if not near:
        return math.inf
    w = mechanism.roller_radius_mm * 1.05 + size.allowances.slot_clearance_mm
    hub = 0.75 * (min(near) - w) if size.wheel_hub_mm is None else 0.5 * size.wheel_hub_mm
    return min(near) - hub
