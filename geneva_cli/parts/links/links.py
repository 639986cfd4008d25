"""The links of a machine, cut out of plates: bars, couplers, slotted links and their blocks.

A link's own frame has its first joint as origin, and x through its second. Its outline is the
convex hull of an eye about each hole. A pin that slides along a link has a block, and the link has
a slot as long as the pin's path. Links on one axis have one shaft (``link_pins``). Gears are blanks
(``gear_blanks``), drawn by their pitch circles.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.hull import convex_hull
from geneva_cli.geometry.plates import Member, Plate, placed
from geneva_cli.geometry.shapes import Circle, Layer, Point, Shape
from geneva_cli.geometry.stacks import apart, plate_wall
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.links.link_positions import links_at, same, turn_deg
from geneva_cli.parts.links.link_sizes import (
    SLOT_MARGIN,
    LinkSizes,
    link_sizes,
    places,
    point_at_zero,
)
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import round_bore
from geneva_cli.parts.shafts.screws import screw_through
from geneva_cli.parts.shafts.shaft_bores import ShaftBore, bore_at

if TYPE_CHECKING:
    from geneva_cli.parts.gears.gear_blanks import Gear
    from geneva_cli.parts.gears.gear_mesh import GearMesh
    from geneva_cli.parts.links.link_pins import LinkAxis

SHAFT = Joint.SHAFT


class Links(NamedTuple):
    """The links of a machine at input angle 0.

    ``cut`` are links and blocks as plates, ``joined`` the pins, washers and rollers between them,
    ``gears`` the gears as blanks.
    """

    sizes: LinkSizes | None = None  # None without links
    cut: tuple[Member, ...] = ()
    joined: tuple[Member, ...] = ()
    gears: tuple[Gear, ...] = ()
    pin_low: float | None = None  # lower end of the pin on a link that carries the wheel's roller
    standing: frozenset[str] = frozenset()  # names of the links that are fixed to the frame
    blocks: frozenset[str] = frozenset()  # names of the blocks that slide in a link
    axes: tuple[LinkAxis, ...] = ()  # axes that links and gears turn about
    mesh: GearMesh | None = None  # the teeth of round gears

    @property
    def plates(self) -> list[Plate]:
        """The plates to cut, each in its own frame."""
        return [one.part for one in self.cut if isinstance(one.part, Plate)]

    def shaft(self, at: Point, L: float) -> float:
        """Return the radius of the shaft that carries links at a point; 0 where there is none."""
        return next((axis.radius for axis in self.axes if same(axis.at, at, L)), 0.0)

    def one_piece(self, at: Point, L: float) -> list[Plate]:
        """Return the links that are one piece with the shaft at a point."""
        names = {name for axis in self.axes if same(axis.at, at, L) for name in axis.one_piece}
        return [plate for plate in self.plates if plate.name in names]


class _UnboredLink(NamedTuple):
    """A link before it is bored for its shafts; complex points in its own frame."""

    link: Link
    at: complex  # position of its origin in the machine, at input angle 0
    unit: complex  # its direction
    own: tuple[complex, ...]  # its joints
    eyes: tuple[Circle, ...]
    holes: tuple[Shape, ...]
    blocks: tuple[Member, ...]

    def clearance(self, z: complex) -> float:
        """Return the distance from a point to the nearest hole, or half-way to another shaft."""
        away = [apart(_circle("BORE", z, 0.0), hole) for hole in self.holes]
        others = (o for o, kind in zip(self.own, self.link.kinds, strict=True) if kind is SHAFT)
        return max(0.0, min([*away, *(0.5 * abs(o - z) for o in others if o != z)]))


def drawn_links(mechanism: Mechanism, parts: Outlines | None = None) -> Links:
    """Return the links of a machine as plates; ``parts`` are its outlines, if it has any.

    Raises GenevaError, naming the key, for sizes that leave no plate around a hole.
    """
    links = links_at(mechanism, turn_deg(mechanism))
    if not links:
        return Links()
    from geneva_cli.parts.links.link_pins import axes as axes_of
    from geneva_cli.parts.links.link_pins import pins, rollers

    sizes = link_sizes(mechanism, links, parts)
    L = mechanism.center_distance_mm
    bars = [link for link in links if not link.radius_mm]
    unbored = [_bar(link, sizes, L) for link in bars]
    turning = [
        _with_shaft(axis, unbored, links, sizes, parts, mechanism)
        for axis in axes_of(links, SAME_LENGTH * L)
    ]
    _refuse_unused(mechanism, turning, sizes, parts)
    cut = [member for bar in unbored for member in _members(bar, turning, sizes, L)]
    r = mechanism.roller_radius_mm
    between = [
        *pins(bars, sizes, SAME_LENGTH * L),
        *rollers(bars, sizes, r, sizes.roller_stands),
    ]
    mesh, gears = _gears([link for link in links if link.radius_mm], turning, sizes, mechanism)
    kinds = {kind for link in bars if link.plane == 1 for kind in link.kinds}
    pin_low = None
    if kinds & {Joint.ROLLER, Joint.CARRIED}:
        pin_low = sizes.span(2 if Joint.CARRIED in kinds else 1)[0]
    standing = frozenset(link.name for link in bars if link.kinds[0] is Joint.NONE)
    blocks = frozenset(block.part.name for bar in unbored for block in bar.blocks)
    return Links(
        sizes=sizes,
        cut=tuple(cut),
        joined=tuple(between),
        gears=tuple(gears),
        pin_low=pin_low,
        standing=standing,
        blocks=blocks,
        axes=tuple(turning),
        mesh=mesh,
    )


def _known(axis: LinkAxis, sizes: LinkSizes, parts: Outlines | None, L: float) -> float:
    """Return the radius of the shaft of wheel or crank, from their own bores; 0 for another."""
    if same(axis.at, (L, 0.0), L):
        return sizes.crank_shaft or 0.0
    if parts is None or not same(axis.at, (0.0, 0.0), L):
        return 0.0
    return parts.sizes.wheel_bore


def _with_shaft(
    axis: LinkAxis,
    bars: list[_UnboredLink],
    links: Iterable[Link],
    sizes: LinkSizes,
    parts: Outlines | None,
    mechanism: Mechanism,
) -> LinkAxis:
    """Return an axis with its shaft's bore, and the links that are too small to be bored."""
    if SHAFT not in axis.kinds:
        return axis._replace(bore=ShaftBore(round_bore(mechanism.spec.size, sizes.pin)))
    z, L = complex(*axis.at), mechanism.center_distance_mm
    distances = {
        bar.link.name: bar.clearance((z - bar.at) / bar.unit)
        for bar in bars
        if bar.link.name in axis.names
    }
    limits = [*distances.values()]
    limits += [g.radius_mm for g in links if g.radius_mm and g.name in axis.names]
    known = _known(axis, sizes, parts, L)
    own = [radius for limit in limits if (radius := sizes.bore(limit, L)) > 0.0]
    radius = known or min(own, default=bore_radius(L / 20.0))
    bore = bore_at(mechanism, axis.at, radius)
    if not known and sizes.shaft is not None:  # of the spec: a check reports the wall that is left
        return axis._replace(bore=bore)
    least = bore.bore.reach + sizes.wall
    tight = frozenset(name for name, limit in distances.items() if least > limit)
    return axis._replace(bore=bore, one_piece=tight)


def _refuse_unused(
    mechanism: Mechanism, turning: list[LinkAxis], sizes: LinkSizes, parts: Outlines | None
) -> None:
    """Raise GenevaError for a bore in the spec if no link has a shaft of its own."""
    L = mechanism.center_distance_mm
    own = (axis for axis in turning if SHAFT in axis.kinds and not _known(axis, sizes, parts, L))
    if sizes.shaft is not None and not any(True for _ in own):
        raise GenevaError(
            f"link_bore_mm = {2.0 * sizes.shaft:g}: it applies to no link: all are on the shafts "
            "of wheel and crank; set crank_bore_mm, arm_bore_mm or wheel_bore_mm instead",
            ("size", "link_bore_mm"),
        )


def _gears(
    links: list[Link], turning: list[LinkAxis], sizes: LinkSizes, mechanism: Mechanism
) -> tuple[GearMesh | None, list[Gear]]:
    """Return the teeth of gears, if they have some, and the gears, bored for their shafts."""
    from geneva_cli.parts.gears.gear_blanks import link_gear
    from geneva_cli.parts.gears.gear_mesh import gear_mesh

    L, size = mechanism.center_distance_mm, mechanism.spec.size
    at = [point_at_zero(*places(link)) for link in links]
    mesh = None
    if mechanism.spec.drive.round_gears and size.gear_module_mm is not None:
        driver, driven = links
        mesh = gear_mesh(driver, driven, (at[0], at[1]), size)
        if mechanism.spec.drive.both_ways and mesh.gears[driver.name].last_tip:
            raise GenevaError(
                f"gear_module_mm = {size.gear_module_mm:g}: the last tooth of the {driver.name} is "
                "lower, so that it drives one way only; remove gear_module_mm, or both_ways and "
                "--reverse",
                ("size", "gear_module_mm"),
            )
    cut = mesh.gears if mesh else {}
    bores = [next(axis.bore for axis in turning if same(axis.at, p, L)) for p in at]
    return mesh, [
        link_gear(link, p, bore, sizes, mechanism, cut.get(link.name))
        for link, p, bore in zip(links, at, bores, strict=True)
    ]


def _bar(link: Link, sizes: LinkSizes, L: float) -> _UnboredLink:
    """Return a link without bores for shafts, and the blocks that slide along it."""
    joints = places(link)
    at = [complex(*point_at_zero(joint)) for joint in joints]
    ahead = at[1] - at[0]
    unit = ahead / abs(ahead) if abs(ahead) > SAME_LENGTH * L else 1.0
    own = tuple((z - at[0]) / unit for z in at)
    low, high = sizes.span(link.plane)
    eyes: list[Circle] = []
    holes: list[Shape] = []
    blocks: list[Member] = []
    for joint, z, kind in zip(joints, own, link.kinds, strict=True):
        if kind in (Joint.PIN, Joint.ROLLER):
            holes.append(_circle("BORE", z, sizes.hole(kind)))
            eye = sizes.roller_eye if kind is Joint.ROLLER else sizes.eye
            eyes.append(_circle("LINK", z, eye))
        elif kind in (Joint.SLIDE, Joint.CARRIED):
            hole = sizes.hole(kind)
            along = z / abs(z)
            distances = np.abs(joint - joints[0])
            half, long = sizes.block(hole)
            spare = long + SLOT_MARGIN * hole
            ends = float(distances.min()) - spare, float(distances.max()) + spare
            holes.append(convex_hull("LINK", [_circle("LINK", r * along, half) for r in ends]))
            eyes += [_circle("LINK", r * along, half + hole) for r in ends]
            if link.kinds[0] is Joint.NONE:  # it is fixed to the frame beyond both ends
                beyond = half + 2.0 * sizes.pin
                fixed = [(ends[0] - beyond) * along, (ends[1] + beyond) * along]
                screw = screw_through(2.0 * sizes.pin)
                bolt = 0.5 * screw.through if screw else sizes.pin
                holes += [_circle("BORE", f, bolt) for f in fixed]
                eyes += [_circle("LINK", f, sizes.eye) for f in fixed]
            block = Plate(
                f"{link.name}'s block",
                "LINK",
                convex_hull("LINK", [Circle("LINK", (x, 0.0), half) for x in (-long, long)]),
                (Circle("BORE", (0.0, 0.0), hole),),
                low,
                high,
            )
            blocks.append(_placed(block, at[0] + z * unit, along * unit))
    return _UnboredLink(link, at[0], unit, own, tuple(eyes), tuple(holes), tuple(blocks))


def _members(
    bar: _UnboredLink, turning: list[LinkAxis], sizes: LinkSizes, L: float
) -> Iterator[Member]:
    """Yield a link as a plate with the bores for its shafts, and its blocks."""
    eyes, holes, name = list(bar.eyes), list(bar.holes), bar.link.name
    for z, kind in zip(bar.own, bar.link.kinds, strict=True):
        if kind is SHAFT:
            there = bar.at + z * bar.unit
            axis = next(one for one in turning if same(one.at, (there.real, there.imag), L))
            eyes.append(_circle("LINK", z, sizes.hub(axis.bore.bore)))
            if name not in axis.one_piece:
                bored = axis.bore.hole(cmath.phase(bar.unit))
                holes.append(placed(bored, (z.real, z.imag), 0.0))
    low, high = sizes.span(bar.link.plane)
    plate = Plate(name, "LINK", convex_hull("LINK", eyes), tuple(holes), low, high)
    _refuse(plate)
    yield _placed(plate, bar.at, bar.unit)
    yield from bar.blocks


def _placed(plate: Plate, where: complex, direction: complex) -> Member:
    return Member(plate, (where.real, where.imag), cmath.phase(direction))


def placed_holes(member: Member) -> Iterator[Circle]:
    """Yield the round holes of a plate at their positions at input angle 0."""
    assert isinstance(member.part, Plate)
    for hole in member.part.holes:
        if isinstance(hole, Circle):
            yield placed(hole, member.at, member.turn)


def _circle(layer: Layer, at: complex, radius: float) -> Circle:
    return Circle(layer, (at.real, at.imag), radius)


def _refuse(plate: Plate) -> None:
    """Raise GenevaError where holes leave no plate between or around them."""
    wall = plate_wall(plate)
    if wall <= 0.0:
        raise GenevaError(
            f"--part links: no plate is left around the holes of the {plate.name}: it lacks "
            f"{-wall:.4g} mm; reduce link_pin_mm, link_bore_mm or pin_mm, or move joints apart",
            ("size", "link_pin_mm"),
        )
