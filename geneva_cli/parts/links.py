"""The links of a machine, cut out of plates: bars, couplers, slotted links and their blocks.

A link's own frame has its first joint as origin, and x through its second. Its outline is the belt
round an eye about each hole; a pin that slides along a link has a block, and the link a slot as
long as its path. Gears are blanks (``gear_blanks``), drawn by their pitch circles.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.curves.belt import belt
from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Circle, Contour, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Joint, Link
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.gear_blanks import Gear, link_gear
from geneva_cli.parts.hole_walls import apart, least_wall
from geneva_cli.parts.link_pins import pins, rollers
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.link_sizes import SPARE, LinkSizes, link_sizes, places
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sizes import pin_radius

LAYER, HOLES, SHAFT = "LINK", "BORE", Joint.SHAFT
ANGLES = 1440  # input angles in a whole turn at which links are looked at; 0 is one of them
SAME = 1e-9  # of the centre distance: joints nearer to each other are one


class Links(NamedTuple):
    """The links of a machine at input angle 0.

    ``cut`` are the links and blocks as plates, ``joined`` the pins, washers and rollers between
    them; ``gears`` are blanks about their places.
    """

    sizes: LinkSizes | None  # None where there are none
    cut: tuple[Member, ...]
    joined: tuple[Member, ...]
    gears: tuple[Gear, ...]
    pin_low: float | None = None  # lower end of the pin, on a link, that carries the wheel's roller
    standing: frozenset[str] = frozenset()  # names of those that are fixed to the frame
    blocks: frozenset[str] = frozenset()  # and of those that slide in another

    @property
    def plates(self) -> list[Plate]:
        """The plates to cut, each in its own frame."""
        return [one.part for one in self.cut if isinstance(one.part, Plate)]


def drawn_links(mechanism: Mechanism, found: Outlines | None = None) -> Links:
    """The links of a machine as plates; ``found`` are its outlines, if it has any.

    Raises GenevaError, naming the key, for sizes that leave no plate round a hole.
    """
    turns = mechanism.spec.drive.turns
    turn = np.linspace(-180.0 * turns, 180.0 * turns, ANGLES * turns + 1)
    links = links_at(mechanism, turn)
    if not links:
        return Links(None, (), (), ())
    sizes = link_sizes(mechanism, links, found)
    L = mechanism.center_distance_mm
    bars = [link for link in links if not link.radius_mm]
    each = [list(_members(link, sizes, L)) for link in bars]
    cut = [member for members in each for member in members]
    r = mechanism.roller_radius_mm
    between = [
        *pins(bars, sizes, SAME * L),
        *rollers(bars, sizes, r, pin_radius(mechanism.spec.size, r)),
    ]
    bored = [hole for member in cut for hole in placed_holes(member)]
    if found and found.sizes.wheel_bore:  # as wide as the wheel's shaft, where it is on that
        bored.append(Circle(HOLES, (0.0, 0.0), found.sizes.wheel_bore))
    gears = [_gear(link, sizes, mechanism, bored) for link in links if link.radius_mm]
    kinds = {kind for link in bars if link.plane == 1 for kind in link.kinds}
    pin_low = None
    if kinds & {Joint.ROLLER, Joint.CARRIED}:
        pin_low = sizes.span(2 if Joint.CARRIED in kinds else 1)[0]
    standing = frozenset(link.name for link in bars if link.kinds[0] is Joint.NONE)
    blocks = frozenset(block.part.name for members in each for block in members[1:])
    return Links(sizes, tuple(cut), tuple(between), tuple(gears), pin_low, standing, blocks)


def _gear(link: Link, sizes: LinkSizes, mechanism: Mechanism, bored: list[Circle]) -> Gear:
    """A gear has the bore of the link, or the wheel, on its shaft, if there is one."""
    (at,), L = places(link), mechanism.center_distance_mm
    z = complex(at[len(at) // 2])
    own = sizes.bore(link.radius_mm, L, abs(z - L) < SAME * L)
    there = (hole.radius for hole in bored if abs(complex(*hole.centre) - z) < SAME * L)
    bore = next(there, own)
    return link_gear(link, (z.real, z.imag), bore, sizes, mechanism.spec.size, L)


def _members(link: Link, sizes: LinkSizes, L: float) -> Iterator[Member]:
    """A link as a plate, and the blocks that slide along it."""
    middle = len(link.joints[0][0]) // 2  # input angle 0
    joints = places(link)
    at = [complex(joint[middle]) for joint in joints]
    ahead = at[1] - at[0]
    unit = ahead / abs(ahead) if abs(ahead) > SAME * L else 1.0
    own = [(z - at[0]) / unit for z in at]
    low, high = sizes.span(link.plane)

    def placed(plate: Plate, where: complex, direction: complex) -> Member:
        return Member(plate, (where.real, where.imag), cmath.phase(direction))

    eyes: list[Circle] = []
    holes: list[Shape] = []
    blocks: list[Member] = []
    for joint, z, kind in zip(joints, own, link.kinds, strict=True):
        if kind in (Joint.PIN, Joint.ROLLER):
            holes.append(_circle(HOLES, z, sizes.hole(kind)))
            eye = sizes.roller_eye if kind is Joint.ROLLER else sizes.eye
            eyes.append(_circle(LAYER, z, eye))
        elif kind in (Joint.SLIDE, Joint.CARRIED):
            hole = sizes.hole(kind)
            along = z / abs(z)
            way = np.abs(joint - joints[0])
            half, long = sizes.block(hole)
            spare = long + SPARE * hole
            ends = float(way.min()) - spare, float(way.max()) + spare
            holes.append(_slot(along, ends, half))
            eyes += [_circle(LAYER, r * along, half + hole) for r in ends]
            if link.kinds[0] is Joint.NONE:  # it stands, and is fixed beyond both ends
                beyond = half + 2.0 * sizes.pin
                fixed = [(ends[0] - beyond) * along, (ends[1] + beyond) * along]
                holes += [_circle(HOLES, f, sizes.pin) for f in fixed]
                eyes += [_circle(LAYER, f, sizes.eye) for f in fixed]
            block = Plate(
                f"{link.name}'s block",
                LAYER,
                belt(LAYER, [Circle(LAYER, (x, 0.0), half) for x in (-long, long)]),
                (Circle(HOLES, (0.0, 0.0), hole),),
                low,
                high,
            )
            blocks.append(placed(block, at[0] + z * unit, along * unit))
    pins, shafts = tuple(holes), [z for z, k in zip(own, link.kinds, strict=True) if k is SHAFT]
    for z, kind in zip(own, link.kinds, strict=True):
        if kind is SHAFT:
            on_crank = abs(at[0] + z * unit - L) < SAME * L
            bore = sizes.bore(_room(z, pins, shafts), L, on_crank)
            eyes.append(_circle(LAYER, z, sizes.hub(bore)))
            holes += [_circle(HOLES, z, bore)] if bore else []
    plate = Plate(link.name, LAYER, belt(LAYER, eyes), tuple(holes), low, high)
    _refuse(plate)
    yield placed(plate, at[0], unit)
    yield from blocks


def placed_holes(member: Member) -> Iterator[Circle]:
    """The round holes of a plate, where they are at input angle 0."""
    assert isinstance(member.part, Plate)
    turn, (x, y) = cmath.rect(1.0, member.turn), member.at
    for hole in member.part.holes:
        if isinstance(hole, Circle):
            z = complex(*hole.centre) * turn + complex(x, y)
            yield Circle(hole.layer, (z.real, z.imag), hole.radius)


def _circle(layer: str, at: complex, radius: float) -> Circle:
    return Circle(layer, (at.real, at.imag), radius)


def _slot(along: complex, ends: tuple[float, float], half: float) -> Contour:
    """A slot of round ends about two places in a direction from the origin."""
    return belt(LAYER, [_circle(LAYER, r * along, half) for r in ends])


def _room(at: complex, holes: Iterable[Shape], shafts: Iterable[complex]) -> float:
    """The distance from a shaft to the nearest hole, or half-way to another shaft."""
    away = [apart(_circle(HOLES, at, 0.0), hole) for hole in holes]
    return max(0.0, min([*away, *(0.5 * abs(z - at) for z in shafts if z != at)]))


def _refuse(plate: Plate) -> None:
    """Raise GenevaError where holes leave no plate between or round them."""
    wall = link_wall(plate)
    if wall <= 0.0:
        raise GenevaError(
            f"--part links: no plate is left round the holes of the {plate.name}, which are "
            f"{-wall:.4g} mm too large, or its joints too near; a smaller link_pin_mm, "
            "link_bore_mm or pin_mm leaves some",
            ("size", "link_pin_mm"),
        )


def link_wall(plate: Plate) -> float:
    """The least wall between the holes of a link, and round them."""
    return least_wall(plate.holes, plate.outline)
