"""The frame: one plate with a hole for every shaft that reaches it, and four mounting holes.

It lies below all moving parts. Wheels that orbit have a carrier instead. A shaft that ends above
the frame has its bearing elsewhere; that of a side-crank, whose input crank turns over the crank's
axis, in a bridge over the crank, on two posts beside all that turns.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import product

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Point, as_contour, bounds_of, convex_hull
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint
from geneva_cli.numerics.arrays import half_or
from geneva_cli.numerics.tolerances import SAME_LENGTH, bore_radius, rounded_radius
from geneva_cli.parts.assembly import is_bridged, links_at, same, turn_deg
from geneva_cli.parts.links.links import Links, placed_holes, places
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import FrameAndShafts
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, crank_arm, shaft_ends, shafts
from geneva_cli.parts.shafts.bores import SCREWS, bolt_radius, circles, screw_radius, tapped
from geneva_cli.parts.sizes import HUB, bridge_low
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import Size


def framed(
    outlines: Outlines, bars: Links, base: Plate | None, first: Sequence[Member], low: float
) -> FrameAndShafts:
    """Return the frame and the shafts of a machine with its ``outlines``.

    ``bars`` are the links, ``base`` is the lowest plate with a cam's groove, ``first`` are the
    first wheel and its locking disc of two in series. ``low`` is the lowest height of all parts.
    """
    mechanism, L, thick = outlines.assembly.full, outlines.assembly.L, outlines.sizes.arm_thickness
    size = mechanism.spec.size
    top = low - size.washer_mm
    bridge, unborne, axles = None, list[tuple[str, str]](), list[Member]()
    mounts: tuple[Circle, ...] = ()
    for shaft in _all_shafts(outlines, bars, top - thick, first):
        if shaft.turns and shaft.low >= top:
            at_crank = not bridge and same(shaft.at, mechanism.crank_shaft.at, L)
            if at_crank and (bridge := _bridge(outlines, bars, shaft)):
                shaft = shaft._replace(high=bridge.high)
            else:
                ends = f"it ends at {shaft.low:.4g} mm, above the frame at {top:.4g} mm"
                unborne.append((shaft.name, ends))
        axles.append(shaft.member)
    standing, holes = _standing(mechanism, bars), list[Circle]()
    for at, diameter_mm in standing.items():
        here = [axle._replace(at=at) for axle in axles if same(axle.at, at, L)]
        holes += shaft_holes(size, here, top) if here else [hole_without_shaft(diameter_mm, at, L)]
    fixed = [one for one in (*bars.cut, *bars.gears) if one.part.name in bars.standing]
    fixed += [Member(plate, (L, 0.0)) for plate in (base, bridge) if plate]
    screwed, spacers = list[tuple[str, str, Circle]](), list[Member]()
    for member, hole in [(one, hole) for one in fixed for hole in placed_holes(one)]:
        part = member.plate
        if same(hole.centre, member.at, L):  # for its shaft
            continue
        holes.append(tapped(hole))
        screwed.append((part.name, "the frame", hole))
        if part.low - top > SAME_LENGTH * L:
            # a ring twice as wide, turned from a rod: often it is higher than wide
            ring, bore = Circle("SHAFT", ORIGIN, 2.0 * hole.radius), hole._replace(centre=ORIGIN)
            name = f"spacer of the {part.name}"
            spacers.append(Member(Plate(name, "SHAFT", ring, (bore,), top, part.low), hole.centre))
    eye = max(L / 20.0, 3.0 * wall_min(size, L))  # it leaves walls around mounting holes
    if mechanism.frame > 0.0:
        reach = max((c.radius for c in holes), default=0.0) + eye
        outline = convex_hull("FRAME", circles("FRAME", standing, reach))
        plate = Plate("carrier", "FRAME", outline, tuple(holes), top - thick, top)
    else:
        # a frame contains every axis, drilled or not
        within = [*holes, *circles("BORE", (ORIGIN, *standing), 0.0)]
        plate, mounts = mounted_plate(holes, within, eye, (top - thick, top))
    if bars.axes:
        from geneva_cli.parts.links.link_shafts import outside_links

        axles = [*outside_links(axles, bars, L)]
    bridges = (Member(bridge, (L, 0.0)),) if bridge else ()
    on_it = tuple(spacers), tuple(screwed), bridges
    return FrameAndShafts(plate, tuple(axles), *on_it, tuple(unborne), mounts)


def _standing(mechanism: Mechanism, bars: Links) -> dict[Point, float | None]:
    """Return the positions of all shafts, each once, with the diameter that the spec gives it."""
    standing, shaft = dict[Point, float | None](), mechanism.spec.shaft
    # an internal wheel is open in the middle, and held from above
    for place in mechanism.wheel_places if mechanism.spec.wheel.SIGN > 0.0 else ():
        standing[place.at] = shaft.wheel_diameter_mm
    for place in mechanism.crank_places:
        standing[place.at] = shaft.crank_diameter_mm
    if mechanism.spec.gears:
        driver = mechanism.gear_shaft.x_mm + mechanism.spec.gears.distance_mm, 0.0
        standing[driver] = shaft.wheel_diameter_mm
    for axis in bars.axes:
        L = mechanism.center_distance_mm
        if axis.stands and not any(same(axis.at, one, L) for one in standing):
            standing[axis.at] = shaft.wheel_diameter_mm
    return standing


def _bridge(parts: Outlines, bars: Links, shaft: Shaft) -> Plate | None:
    """Return the bridge about the crank's axis; None where there is no place for one."""
    mechanism, sizes, L = parts.assembly.full, parts.sizes, parts.assembly.L
    size, thick = mechanism.spec.size, sizes.arm_thickness
    if not (sizes.crank_bore and is_bridged(mechanism)):
        return None
    # no part of crank and drive turns beyond the farthest of these
    far = [sizes.lock, sizes.crank_hub]
    if parts.has_arm:
        arm = crank_arm(parts)
        eye = max(arm.eye, sizes.roller)
        far += [arm.hub, *(math.hypot(*pin.centre) + eye for pin in arm.pins)]
    links = {link.name: link for link in links_at(mechanism, turn_deg(mechanism))}
    for plate in bars.plates:
        if plate.name in links:  # a block stays in its link
            edge = Polyarc([as_contour(plate.outline)])
            reach = float(edge.farthest(np.zeros((1, 2))).max())
            far.append(float(np.abs(places(links[plate.name])[0] - L).max()) + reach)
    wall = wall_min(size, L)
    bore = shaft.bore.around + 0.5 * size.allowances.shaft_fit_mm
    half = max(rounded_radius(HUB * bore), bore + wall)
    # also a machine that is too small for screws has those of the bridge
    screw = bolt_radius(None, L, half) or 0.5 * SCREWS[0].through
    away = max(far) + wall + max(half, 2.0 * screw)
    away = 0.5 * math.ceil(2.0 * away)  # mm: to half a millimetre, for the drill
    ends = (0.0, -away), (0.0, away)
    outline = convex_hull("FRAME", circles("FRAME", ends, half))
    holes = Circle("BORE", ORIGIN, bore), *circles("BORE", ends, screw)
    low = bridge_low(size, sizes)
    return Plate("bearing bridge", "FRAME", outline, holes, low, low + thick)


def _all_shafts(
    outlines: Outlines, bars: Links, lowest: float, first: Sequence[Member]
) -> Iterator[Shaft]:
    """Yield all shafts and pivots, as ``framed``; ``lowest`` is the frame's lower face."""
    mechanism, own, L = outlines.assembly.full, outlines.sizes, outlines.assembly.L
    stop = None
    if bars.axes:
        from geneva_cli.parts.links.link_shafts import carried, crank_stop

        stop = crank_stop(outlines, bars)
    if mechanism.spec.gears:
        from geneva_cli.parts.gears.gear_pair import gear_shafts, gear_span
    carrying = [*shafts(outlines, lowest, stop)]  # wheel or crank
    yield from carrying
    for axis in bars.axes:  # of which others carry only links and gears
        if any(same(axis.at, one.at, L) for one in carrying):
            continue
        here = (one for one in bars.axes if same(one.at, axis.at, L))
        spans = [span for one in here for span in carried(bars, one, first, L)]
        if mechanism.spec.gears and same(axis.at, mechanism.gear_shaft.at, L):
            spans.append(gear_span(mechanism, outlines))
        low, high = min(low for low, _ in spans), max(high for _, high in spans)
        if axis.stands:
            turns, on_wheel = Joint.SHAFT in axis.kinds, same(axis.at, ORIGIN, L)
            on_crank = same(axis.at, (L, 0.0), L)
            whose = "crank" if on_crank else "wheel" if on_wheel else axis.names[0]
            low = stop if on_crank and stop is not None else lowest
            high = own.wheel_thickness if on_wheel else high
            low, high = shaft_ends(mechanism.spec.size, whose, low, high)
            name = f"{whose}'s {'shaft' if turns else 'pivot'}"
            yield Shaft(name, whose, axis.bore, low, high, axis.at, turns=turns)
        elif len(axis.names) > 1 and Joint.PIN not in axis.kinds:  # those are pins between links
            name = f"shaft of {', '.join(axis.names)}"
            yield Shaft(name, axis.names[0], axis.bore, low, high, axis.at, turns=False)
    if mechanism.spec.gears:
        has_crank = any(one.at == (L, 0.0) for one in carrying)
        yield from gear_shafts(mechanism, outlines, lowest, has_crank)


def mounted_plate(
    holes: Sequence[Circle], within: Iterable[Circle], eye: float, span: tuple[float, float]
) -> tuple[Plate, tuple[Circle, ...]]:
    """Return a frame around circles, its corners of the radius ``eye``, from and up to ``span``.

    With it go its mounting holes, about the corners.
    """
    box, away = bounds_of(within), 3.0 * eye
    places = [*product((box.x0 - away, box.x1 + away), (box.y0 - away, box.y1 + away))]
    outline, screw = convex_hull("FRAME", circles("FRAME", places, eye)), screw_radius(0.8 * eye)
    mounts = tuple(circles("BORE", places if screw else (), screw))
    return Plate("frame", "FRAME", outline, (*holes, *mounts), *span), mounts


def shaft_holes(size: Size, axles: Iterable[Member], top: float) -> list[Circle]:
    """Return the holes of a frame for the shafts that reach below its upper face ``top``."""
    holes, loose = list[Circle](), 0.5 * size.allowances.shaft_fit_mm
    for axle in axles:
        if axle.plate.low < top:
            holes.append(Circle("BORE", axle.at, axle.plate.bore.around + loose))
    return holes


def hole_without_shaft(diameter_mm: float | None, at: Point, L: float) -> Circle:
    """Return the hole for a part that is one piece with its shaft, of the spec or L/10 wide."""
    return Circle("BORE", at, half_or(diameter_mm, bore_radius(L / 20.0)))
