"""The links of a machine, cut out of plates: bars, couplers, slotted links and their blocks.

A link's own frame has its first joint as origin, and x through its second. Its outline is the belt
round an eye about each hole; a pin that slides along a link has a block, and the link a slot as
long as its path. Links on one axis have one shaft (``link_axes``). Gears are blanks
(``gear_blanks``), drawn by their pitch circles.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.curves.belt import belt
from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Circle, Contour, Point, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Joint, Link
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.gear_blanks import Gear, link_gear
from geneva_cli.parts.hole_walls import apart, least_wall
from geneva_cli.parts.link_axes import Axis, axes
from geneva_cli.parts.link_pins import pins, rollers
from geneva_cli.parts.link_positions import links_at, same
from geneva_cli.parts.link_sizes import SPARE, LinkSizes, link_sizes, places
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sizes import even, pin_radius

LAYER, HOLES, SHAFT = "LINK", "BORE", Joint.SHAFT
ANGLES = 1440  # input angles in a whole turn at which links are looked at; 0 is one of them


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
    axes: tuple[Axis, ...] = ()  # that links and gears turn about

    @property
    def plates(self) -> list[Plate]:
        """The plates to cut, each in its own frame."""
        return [one.part for one in self.cut if isinstance(one.part, Plate)]

    def shaft(self, at: Point, L: float) -> float:
        """The radius of the shaft that carries links at a place; 0 where there is none."""
        return next((axis.radius for axis in self.axes if same(axis.at, at, L)), 0.0)

    def one_piece(self, at: Point, L: float) -> list[Plate]:
        """The links that are one piece with the shaft at a place."""
        names = {name for axis in self.axes if same(axis.at, at, L) for name in axis.one_piece}
        return [plate for plate in self.plates if plate.name in names]


class _Bar(NamedTuple):
    """A link before it is bored for its shafts: complex places in its own frame."""

    link: Link
    at: complex  # its origin in the machine, at input angle 0
    unit: complex  # its direction
    own: tuple[complex, ...]  # its joints
    eyes: tuple[Circle, ...]
    holes: tuple[Shape, ...]
    blocks: tuple[Member, ...]

    def room(self, z: complex) -> float:
        """The distance from a place to the nearest hole, or half-way to another shaft."""
        away = [apart(_circle(HOLES, z, 0.0), hole) for hole in self.holes]
        others = (o for o, kind in zip(self.own, self.link.kinds, strict=True) if kind is SHAFT)
        return max(0.0, min([*away, *(0.5 * abs(o - z) for o in others if o != z)]))


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
    whole = [_bar(link, sizes, L) for link in bars]
    turning = [
        _with_shaft(axis, whole, links, sizes, found, L) for axis in axes(links, SAME_LENGTH * L)
    ]
    _refuse_unused(mechanism, turning, sizes, found)
    cut = [member for bar in whole for member in _members(bar, turning, sizes, L)]
    r = mechanism.roller_radius_mm
    between = [
        *pins(bars, sizes, SAME_LENGTH * L),
        *rollers(bars, sizes, r, pin_radius(mechanism.spec.size, r)),
    ]
    gears = [_gear(link, turning, sizes, mechanism) for link in links if link.radius_mm]
    kinds = {kind for link in bars if link.plane == 1 for kind in link.kinds}
    pin_low = None
    if kinds & {Joint.ROLLER, Joint.CARRIED}:
        pin_low = sizes.span(2 if Joint.CARRIED in kinds else 1)[0]
    standing = frozenset(link.name for link in bars if link.kinds[0] is Joint.NONE)
    blocks = frozenset(block.part.name for bar in whole for block in bar.blocks)
    return Links(
        sizes, tuple(cut), tuple(between), tuple(gears), pin_low, standing, blocks, tuple(turning)
    )


def _known(axis: Axis, sizes: LinkSizes, found: Outlines | None, L: float) -> float:
    """The radius of the shaft of wheel or crank, as their own bores are; 0 of another."""
    if same(axis.at, (L, 0.0), L):
        return sizes.crank_shaft or 0.0
    return found.sizes.wheel_bore if found and same(axis.at, (0.0, 0.0), L) else 0.0


def _with_shaft(
    axis: Axis,
    bars: list[_Bar],
    links: Iterable[Link],
    sizes: LinkSizes,
    found: Outlines | None,
    L: float,
) -> Axis:
    """An axis with the radius of its shaft, and with the links that have no room for it."""
    if SHAFT not in axis.kinds:
        return axis._replace(radius=sizes.pin)
    z = complex(*axis.at)
    beside = {
        bar.link.name: bar.room((z - bar.at) / bar.unit)
        for bar in bars
        if bar.link.name in axis.names
    }
    rooms = [*beside.values()]
    rooms += [g.radius_mm for g in links if g.radius_mm and g.name in axis.names]
    known = _known(axis, sizes, found, L)
    own = [radius for room in rooms if (radius := sizes.bore(room, L)) > 0.0]
    radius = known or min(own, default=even(L / 20.0))
    if not known and sizes.shaft is not None:  # as it is given: a check says what wall is left
        return axis._replace(radius=radius)
    tight = frozenset(name for name, room in beside.items() if radius + sizes.wall > room)
    return axis._replace(radius=radius, one_piece=tight)


def _refuse_unused(
    mechanism: Mechanism, turning: list[Axis], sizes: LinkSizes, found: Outlines | None
) -> None:
    """Raise GenevaError for a bore that is given where no link has a shaft of its own."""
    L = mechanism.center_distance_mm
    own = (axis for axis in turning if SHAFT in axis.kinds and not _known(axis, sizes, found, L))
    if sizes.shaft is not None and not any(True for _ in own):
        raise GenevaError(
            f"link_bore_mm = {2.0 * sizes.shaft:g}: what it would bore is on the shaft of wheel or "
            "crank, and as wide as that; remove it (crank_bore_mm, arm_bore_mm and wheel_bore_mm "
            "set those shafts)",
            ("size", "link_bore_mm"),
        )


def _gear(link: Link, turning: list[Axis], sizes: LinkSizes, mechanism: Mechanism) -> Gear:
    """A gear, bored for the shaft of its axis."""
    (way,), L = places(link), mechanism.center_distance_mm
    z = complex(way[len(way) // 2])
    at = z.real, z.imag
    bore = next(axis.radius for axis in turning if same(axis.at, at, L))
    return link_gear(link, at, bore, sizes, mechanism.spec.size, L)


def _bar(link: Link, sizes: LinkSizes, L: float) -> _Bar:
    """A link without bores for shafts, and the blocks that slide along it."""
    middle = len(link.joints[0][0]) // 2  # input angle 0
    joints = places(link)
    at = [complex(joint[middle]) for joint in joints]
    ahead = at[1] - at[0]
    unit = ahead / abs(ahead) if abs(ahead) > SAME_LENGTH * L else 1.0
    own = tuple((z - at[0]) / unit for z in at)
    low, high = sizes.span(link.plane)
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
            blocks.append(_placed(block, at[0] + z * unit, along * unit))
    return _Bar(link, at[0], unit, own, tuple(eyes), tuple(holes), tuple(blocks))


def _members(bar: _Bar, turning: list[Axis], sizes: LinkSizes, L: float) -> Iterator[Member]:
    """A link as a plate with the bores for its shafts, and its blocks."""
    eyes, holes, name = list(bar.eyes), list(bar.holes), bar.link.name
    for z, kind in zip(bar.own, bar.link.kinds, strict=True):
        if kind is SHAFT:
            there = bar.at + z * bar.unit
            axis = next(one for one in turning if same(one.at, (there.real, there.imag), L))
            eyes.append(_circle(LAYER, z, sizes.hub(axis.radius)))
            holes += [] if name in axis.one_piece else [_circle(HOLES, z, axis.radius)]
    low, high = sizes.span(bar.link.plane)
    plate = Plate(name, LAYER, belt(LAYER, eyes), tuple(holes), low, high)
    _refuse(plate)
    yield _placed(plate, bar.at, bar.unit)
    yield from bar.blocks


def _placed(plate: Plate, where: complex, direction: complex) -> Member:
    return Member(plate, (where.real, where.imag), cmath.phase(direction))


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
    return least_wall(plate.holes, [plate.outline])
