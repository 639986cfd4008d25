"""Links cut out of plates, the pins, washers and rollers between them, and round gears.

A link's own frame has its first joint as origin, and x through its second. Its outline is the
convex hull of an eye about each hole; a pin that slides along it has a block in a slot. Gears are
plates up to their pitch circles: whole, in sectors about a hub, or as a ring. A blank's mass is a
gear's within a few percent. A gear that stands still is screwed to the frame.
"""

import cmath
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import refuse_size
from geneva_cli.geometry import shapes
from geneva_cli.geometry.plates import Member, Plate, apart, plate_wall
from geneva_cli.geometry.shapes import ORIGIN, Circle, Layer, Point, Shape, convex_hull, placed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link, Teeth
from geneva_cli.numerics.tolerances import SAME_LENGTH, bore_radius
from geneva_cli.parts.assembly import links_at, same, turn_deg
from geneva_cli.parts.links import links as linkage
from geneva_cli.parts.links.links import LinkAxis, Links, LinkSizes
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.arm_and_shafts import bore_at
from geneva_cli.parts.shafts.bores import BoltCircle, Bore, bolt_circle, round_bore, screw_radius

SHAFT = Joint.SHAFT
SLOT_MARGIN = 0.25  # distance from a block to the end of its slot, as a fraction of the pin's hole


class _Bar(NamedTuple):
    """A link before it is bored for its shafts; complex points in its own frame."""

    link: Link
    at: complex  # position of its origin in the machine, at input angle 0
    unit: complex  # its direction
    own: tuple[complex, ...]  # its joints
    eyes: list[Circle]
    holes: list[Shape]
    blocks: list[Member]


def drawn_links(mechanism: Mechanism, parts: Outlines | None = None) -> Links:
    """Return the links of a machine as plates; ``parts`` are its outlines, if it has any."""
    links = links_at(mechanism, turn_deg(mechanism))
    if not links:
        return Links()
    sizes, L = linkage.link_sizes(mechanism, links, parts), mechanism.center_distance_mm
    linked = [link for link in links if not link.radius_mm]
    bars = [_bar(link, sizes, L) for link in linked]
    axes = []
    for axis in _axes(links, SAME_LENGTH * L):
        # the shaft of wheel or crank is as wide as their own bores
        on_crank, on_wheel = (same(axis.at, at, L) for at in ((L, 0.0), ORIGIN))
        of_wheel = parts.sizes.wheel_bore if on_wheel and parts else 0.0
        known = sizes.crank_shaft if on_crank else of_wheel
        axes.append(_with_shaft(axis, bars, links, sizes, known, mechanism))
    gears, bolts = [], None
    for link in (one for one in links if one.radius_mm):
        at = linkage.point_at_zero(*linkage.places(link))
        bore = next(axis.bore for axis in axes if same(axis.at, at, L))
        gear, own = _gear(link, at, bore, sizes, mechanism)
        gears.append(gear)
        bolts = own if own.holes else bolts
    kinds = {kind for link in linked if link.plane == 1 for kind in link.kinds}
    pin_low = None
    if kinds & {Joint.ROLLER, Joint.CARRIED}:
        pin_low = sizes.span(2 if Joint.CARRIED in kinds else 1)[0]
    cut = []
    for bar in bars:
        cut += [_bored(bar, axes, sizes, L), *bar.blocks]
    roller = mechanism.roller_radius_mm
    joined = *_pins(linked, sizes, SAME_LENGTH * L), *_rollers(linked, sizes, roller)
    fixed = (link for link in links if link.teeth.fixed or link.kinds[0] is Joint.NONE)
    standing = frozenset(link.name for link in fixed)
    blocks = frozenset(block.part.name for bar in bars for block in bar.blocks)
    named = standing, blocks
    return Links(sizes, tuple(cut), joined, tuple(gears), pin_low, *named, tuple(axes), bolts)


def _axes(links: Iterable[Link], near: float) -> Iterator[LinkAxis]:
    """Yield each axis once; ``near`` is the distance, mm, below which two axes are one."""
    turn = SHAFT, Joint.PIN
    left = [(one.name, kind, at) for one in links for at, kind in linkage.joints(one, *turn)]
    while left:
        path = left[0][2]
        here = [one for one in left if np.abs(one[2] - path).max() < near]
        left = [one for one in left if np.abs(one[2] - path).max() >= near]
        at = linkage.point_at_zero(path)
        names, kinds, _ = zip(*here, strict=True)
        yield LinkAxis(names, kinds, at, bool(np.abs(path - complex(*at)).max() < near))


def _with_shaft(
    axis: LinkAxis,
    bars: list[_Bar],
    links: Iterable[Link],
    sizes: LinkSizes,
    known: float,
    mechanism: Mechanism,
) -> LinkAxis:
    """Return an axis with its shaft's bore, and the links that are too small to be bored."""
    if SHAFT not in axis.kinds:
        return axis._replace(bore=round_bore(mechanism.spec.size, sizes.pin))
    there, L = complex(*axis.at), mechanism.center_distance_mm
    distances = {}  # to the nearest hole of each link, or half-way to another shaft
    for bar in bars:
        if bar.link.name in axis.names:
            z = (there - bar.at) / bar.unit
            away = [apart(_circle("BORE", z, 0.0), hole) for hole in bar.holes]
            for other, kind in zip(bar.own, bar.link.kinds, strict=True):
                away += [0.5 * abs(other - z)] if kind is SHAFT and other != z else []
            distances[bar.link.name] = max(0.0, min(away))
    limits = [*distances.values()]
    limits += [g.radius_mm for g in links if g.radius_mm and g.name in axis.names]
    own = [radius for limit in limits if (radius := sizes.bore(limit, L)) > 0.0]
    bore = bore_at(mechanism, axis.at, known or min(own, default=bore_radius(L / 20.0)))
    if sizes.shaft and not known:  # of the spec: a check reports the wall that is left
        return axis._replace(bore=bore)
    least = bore.reach + sizes.wall
    tight = frozenset(name for name, limit in distances.items() if least > limit)
    return axis._replace(bore=bore, one_piece=tight)


def _bar(link: Link, sizes: LinkSizes, L: float) -> _Bar:
    """Return a link without bores for shafts, and the blocks that slide along it."""
    joints = linkage.places(link)
    at = [complex(*linkage.point_at_zero(joint)) for joint in joints]
    ahead = at[1] - at[0]
    unit = ahead / abs(ahead) if abs(ahead) > SAME_LENGTH * L else 1.0
    bar = _Bar(link, at[0], unit, tuple((z - at[0]) / unit for z in at), [], [], [])
    for joint, z, kind in zip(joints, bar.own, link.kinds, strict=True):
        hole = sizes.hole(kind)
        if kind in (Joint.PIN, Joint.ROLLER):
            eye = sizes.roller_eye if kind is Joint.ROLLER else sizes.eye
            bar.holes.append(_circle("BORE", z, hole))
            bar.eyes.append(_circle("LINK", z, eye))
        elif kind in (Joint.SLIDE, Joint.CARRIED):
            along, distances = z / abs(z), np.abs(joint - joints[0])
            half, long = sizes.block(hole)
            spare = long + SLOT_MARGIN * hole
            ends = float(distances.min()) - spare, float(distances.max()) + spare
            bar.holes.append(convex_hull("LINK", [_circle("LINK", r * along, half) for r in ends]))
            bar.eyes.extend(_circle("LINK", r * along, half + hole) for r in ends)
            if link.kinds[0] is Joint.NONE:  # screws beyond the slot fix it to the frame
                beyond = half + 2.0 * sizes.pin
                through = screw_radius(2.0 * sizes.pin) or sizes.pin
                for f in ((ends[0] - beyond) * along, (ends[1] + beyond) * along):
                    bar.holes.append(_circle("BORE", f, through))
                    bar.eyes.append(_circle("LINK", f, sizes.eye))
            outline = convex_hull("LINK", [Circle("LINK", (x, 0.0), half) for x in (-long, long)])
            bored = (Circle("BORE", ORIGIN, hole),)
            block = Plate(f"{link.name}'s block", "LINK", outline, bored, *sizes.span(link.plane))
            bar.blocks.append(_placed(block, at[0] + z * unit, along * unit))
    return bar


def _bored(bar: _Bar, turning: Iterable[LinkAxis], sizes: LinkSizes, L: float) -> Member:
    """Return a link as a plate with the bores for its shafts."""
    eyes, holes, name = [*bar.eyes], [*bar.holes], bar.link.name
    for z, kind in zip(bar.own, bar.link.kinds, strict=True):
        if kind is SHAFT:
            there = bar.at + z * bar.unit
            axis = next(one for one in turning if same(one.at, (there.real, there.imag), L))
            eyes.append(_circle("LINK", z, sizes.hub(axis.bore)))
            if name not in axis.one_piece:
                hole = axis.bore.hole(cmath.phase(bar.unit))
                holes.append(placed(hole, (z.real, z.imag), 0.0))
    span = sizes.span(bar.link.plane)
    plate = Plate(name, "LINK", convex_hull("LINK", eyes), tuple(holes), *span)
    wall = plate_wall(plate)
    text = f"--part links: no plate is left around the holes of the {name}: it lacks {-wall:.4g} "
    text += "mm; reduce link_pin_mm, link_bore_mm or pin_mm, or increase link_width_mm"
    refuse_size(wall <= 0.0, "link_pin_mm", text)
    return _placed(plate, bar.at, bar.unit)


def _placed(plate: Plate, where: complex, direction: complex) -> Member:
    return Member(plate, (where.real, where.imag), cmath.phase(direction))


def _circle(layer: Layer, at: complex, radius: float) -> Circle:
    return Circle(layer, (at.real, at.imag), radius)


def _pins(links: Iterable[Link], sizes: LinkSizes, near: float) -> Iterator[Member]:
    """Yield each pin that joins links, with the washers and spacers on it."""
    pin, ring = Circle("ROLLER", ORIGIN, sizes.pin), Circle("LINK", ORIGIN, sizes.ring)
    hole = Circle("LINK", ORIGIN, sizes.pin + sizes.loose)
    for path, both in linkage.joined(links, near):
        where, name = linkage.point_at_zero(path), " and ".join(link.name for link in both)
        spans = [sizes.span(link.plane) for link in both]
        yield Member(Plate(f"pin of {name}", "ROLLER", pin, (), spans[-1][0], spans[0][1]), where)
        for (high, _), (_, low) in zip(spans, spans[1:], strict=False):
            if high > low:
                what = "washer" if high - low <= sizes.washer else "spacer"
                yield Member(Plate(f"{what} of {name}", "LINK", ring, (hole,), low, high), where)


def _rollers(links: Iterable[Link], sizes: LinkSizes, roller: float) -> Iterator[Member]:
    """Yield rollers below the wheel's plane: a first wheel's, with its pin, and a groove's."""
    radius = sizes.roller_stands
    if not radius:
        return
    pin, hole, whole = (Circle("ROLLER", ORIGIN, r) for r in (radius, radius + sizes.loose, roller))
    for link in links:
        for at, kind in linkage.joints(link, Joint.ROLLER, Joint.CARRIED):
            where = linkage.point_at_zero(at)
            if kind is Joint.CARRIED:
                span = sizes.span(link.plane + 1)
                yield Member(Plate("roller in the groove", "ROLLER", whole, (hole,), *span), where)
            elif link.plane > 1:
                (below, _), (low, high) = sizes.span(link.plane), sizes.span(link.plane - 1)
                own = Plate(f"{link.name}'s roller", "ROLLER", whole, (hole,), low, high)
                yield Member(own, where)
                yield Member(Plate(f"{link.name}'s pin", "ROLLER", pin, (), below, high), where)


def _gear(
    link: Link, at: Point, on: Bore, sizes: LinkSizes, mechanism: Mechanism
) -> tuple[Member, BoltCircle]:
    """Return a gear on a shaft, bored round if it is fixed, and the screws that then fix it."""
    teeth, L, radius = link.teeth, mechanism.center_distance_mm, link.radius_mm
    if teeth.fixed:
        on = Bore(on.around, on.loose)
    hub = on.reach if teeth.all_round else sizes.hub(on)
    outline: Circle | shapes.Contour = Circle("PITCH", ORIGIN, radius)
    holes: list[Shape] = [on.hole()] if on.reach else []
    inner, outer = on.reach, radius
    if teeth.inside:
        inner, outer, hub = radius, radius + 2.0 * sizes.eye, 0.0
        outline = Circle("LINK", ORIGIN, outer)
        holes = [Circle("PITCH", ORIGIN, inner)]
    elif not teeth.all_round and hub < radius:
        outline = _gear_sectors(radius, hub, teeth)
    screws = BoltCircle(0.0, 0.0, ())
    if teeth.fixed:
        # the first at 45 degrees, off the line on which the shafts lie
        screws = bolt_circle(mechanism.spec.size, "gear", L, (inner, outer), 0.25 * math.pi)
        holes += screws.holes
    bore, span = None if teeth.inside else on, sizes.span(link.plane)
    plate = Plate(link.name, "PITCH", outline, tuple(holes), *span, bore)
    wall = min(radius - hub, plate_wall(plate))
    # the key that sets its bore, unless its bolts are in the way
    key = {0.0: "wheel_bore_mm", L: "crank_bore_mm"}.get(math.hypot(*at), "link_bore_mm")
    key = "gear_bolt_circle_mm" if screws.holes and hub < radius else key
    text = f"no blank of the {link.name} is left: its holes reach {-wall:.4g} mm too far; change "
    refuse_size(wall <= 0.0, key, text + key)
    return Member(plate, at), screws


def _gear_sectors(radius: float, hub: float, teeth: Teeth) -> shapes.Contour:
    """Return evenly spaced sectors of a pitch circle, joined by the hub between them."""
    wide, pitch = math.radians(teeth.each_deg), math.tau / teeth.sectors
    first = math.radians(teeth.middle_deg) - 0.5 * wide
    end = shapes.about(ORIGIN, hub, first, 1.0).start
    pieces: list[shapes.Line | shapes.Arc] = []
    for k in range(teeth.sectors):
        start = first + k * pitch
        rim = shapes.about(ORIGIN, radius, start, wide)
        back = shapes.about(ORIGIN, hub, start + wide, pitch - wide)
        pieces += [shapes.Line(end, rim.start), rim, shapes.Line(rim.end, back.start), back]
        end = back.end
    return shapes.closed("PITCH", pieces)
