"""The links of a machine: their sizes, joints, axes, gears and plates.

Sizes are of the spec or by default with walls between holes. They are radii, in millimetres, where
a key of the spec is a diameter or a width.
"""

import math
from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Point, placed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array, half_or
from geneva_cli.numerics.tolerances import bore_radius, rounded_radius
from geneva_cli.parts.assembly import links_at, same
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import BoltCircle, Bore
from geneva_cli.parts.sizes import HUB, drawn_thicknesses, pin_hole, pin_radius, plane_span
from geneva_cli.spec.defaults import eye_about, wall_min


class LinkSizes(NamedTuple):
    """Radii of holes and of the plate around them; thicknesses along the axis; all mm."""

    wall: float  # the least wall that `check` lets pass
    pin: float
    roller_stands: float  # radius of a roller's pin; 0 if the spec has none
    roller_pin: float  # radius of its hole
    eye: float  # radius of the plate around a pin
    roller_eye: float
    shaft: float  # of the spec, or as a load needs it, for shafts that carry only links; or 0
    crank_shaft: float  # of the spec, or of the arm on it; or 0
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
        radius = bore_radius(min(L / 20.0, 0.35 * space))  # leaves most of the space as a wall
        return self.shaft or (radius if radius >= 0.01 * L else 0.0)

    def hub(self, bore: Bore) -> float:
        """Return the radius of a link's plate around a bore, or on a shaft's end."""
        return max(rounded_radius(HUB * bore.radius), bore.reach + self.wall)

    def span(self, plane: int) -> tuple[float, float]:
        """Return lower and upper end, along the axis, of links in a plane below the wheel's."""
        return plane_span(plane, self.gap, self.arm, self.thickness, self.washer)


NO_SIZES = LinkSizes(*[0.0] * len(LinkSizes._fields))  # of a machine without links


class LinkAxis(NamedTuple):
    """An axis that links turn about: their names and joints, and its position at input angle 0."""

    names: tuple[str, ...]
    kinds: tuple[Joint, ...]
    at: Point
    stands: bool  # it does not move with the input angle
    bore: Bore = Bore(0.0)  # for its shaft or pivot
    one_piece: frozenset[str] = frozenset()  # names of the links that have no bore for it


class Links(NamedTuple):
    """The links of a machine at input angle 0.

    ``cut`` are links and blocks as plates, ``joined`` the pins, washers and rollers between them,
    ``gears`` the round gears as blanks, each with the bore of its shaft; a ring has none.
    """

    sizes: LinkSizes = NO_SIZES
    cut: tuple[Member, ...] = ()
    joined: tuple[Member, ...] = ()
    gears: tuple[Member, ...] = ()
    pin_low: float | None = None  # lower end of the pin on a link that carries the wheel's roller
    standing: frozenset[str] = frozenset()  # names of links and gears that are fixed to the frame
    blocks: frozenset[str] = frozenset()  # names of the blocks that slide in a link
    axes: tuple[LinkAxis, ...] = ()  # axes that links and gears turn about
    bolts: BoltCircle | None = None  # of the gear that is fixed to the frame

    @property
    def plates(self) -> list[Plate]:
        """The plates to cut, each in its own frame."""
        return [one.plate for one in self.cut]

    def shaft(self, at: Point, L: float) -> float:
        """Return the radius of the shaft that carries links at a point; 0 where there is none."""
        return next((axis.bore.radius for axis in self.axes if same(axis.at, at, L)), 0.0)

    def one_piece(self, at: Point, L: float) -> list[Plate]:
        """Return the links that are one piece with the shaft at a point."""
        names = {name for axis in self.axes if same(axis.at, at, L) for name in axis.one_piece}
        return [plate for plate in self.plates if plate.name in names]


def placed_holes(member: Member) -> Iterator[Circle]:
    """Yield the round holes of a plate at their positions at input angle 0."""
    for hole in member.plate.holes:
        if isinstance(hole, Circle):
            yield placed(hole, member.at, member.turn)


def link_sizes(mechanism: Mechanism, links: Iterable[Link], parts: Outlines | None) -> LinkSizes:
    """Return the sizes of links, whose joints are known at many input angles."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    size, bars = spec.size, [link for link in links if not link.radius_mm]
    wall, (_, _, arm, thickness) = wall_min(size, L), drawn_thicknesses(size, L)
    stands = pin_radius(size, mechanism.roller_radius_mm)
    shaft, on_crank = half_or(size.link_bore_mm, 0.0), half_or(spec.shaft.crank_diameter_mm, 0.0)
    if parts:
        drawn = parts.sizes
        stands, shaft = drawn.first_pin or drawn.pin, drawn.first_shaft or shaft
        thickness, arm = drawn.link_thickness, drawn.arm_thickness
        on_crank = (drawn.arm_bore if parts.has_arm else drawn.crank_bore) or on_crank
    roller, loose = pin_hole(size, stands) if stands else 0.0, 0.5 * size.allowances.shaft_fit_mm
    # a fifth of the distance to the next joint leaves eyes and a gap between
    near = list[float]()
    for link in bars:
        for (p, a), (q, b) in combinations(zip(places(link), link.kinds, strict=True), 2):
            if {a, b} & {Joint.PIN, Joint.SLIDE} and Joint.NONE not in (a, b):
                near.append(float(np.abs(p - q).min()))
    pin = half_or(size.link_pin_mm, rounded_radius(min(L / 40.0, 0.2 * min(near, default=L))))
    eye = half_or(size.link_width_mm, eye_about(pin + loose, wall))
    roller_eye = eye_about(roller, wall, _eye_limit(mechanism, bars)) if roller else eye
    pins = pin, stands, roller, eye, roller_eye
    planes = thickness, arm if spec.drive.ONE_ARM else thickness
    between = size.allowances.pin_gap_mm, size.washer_mm, loose
    return LinkSizes(wall, *pins, shaft, on_crank, *planes, *between)


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
