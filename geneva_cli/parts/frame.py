"""The frame: one plate with a hole for every shaft that reaches it, and four mounting holes.

It lies below all moving parts. Wheels that orbit have a carrier instead. A shaft that ends above
the frame has its bearing elsewhere; that of a side-crank, whose input crank turns over the crank's
axis, in a bridge over the crank, on two posts beside all that turns.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from geneva_cli.geometry.distance import Polyarc, farthest
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Point, as_contour, convex_hull
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint
from geneva_cli.numerics.preferred import rounded_radius
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.assembly import is_bridged, links_at, same, turn_deg
from geneva_cli.parts.links.link_shafts import carried, crank_stop, outside_links
from geneva_cli.parts.links.link_sizes import places
from geneva_cli.parts.links.links import Links, placed_holes
from geneva_cli.parts.mounted_plate import (
    FrameAndShafts,
    corner_radius,
    hole_without_shaft,
    mounted_plate,
    shaft_holes,
)
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_circles import wheel_hub
from geneva_cli.parts.shafts.screws import SCREWS, bolt_radius, tapped
from geneva_cli.parts.shafts.shaft import (
    Shaft,
    crank_shaft_radius,
    shaft_ends,
    shafts,
    wheel_shaft_radius,
)
from geneva_cli.parts.sizes import HUB, bridge_low, drawn_thicknesses
from geneva_cli.spec.defaults import wall_min


def framed(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    base: Plate | None = None,
    first: Sequence[Member] = (),
) -> FrameAndShafts:
    """Return the frame and the shafts of a machine with its ``outlines``, if it has any.

    ``bars`` are the links, ``base`` is the lowest plate with a cam's groove, ``first`` are the
    first wheel and its locking disc of two in series.
    """
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    moving = [one.part for one in (*bars.cut, *bars.joined, *first)]
    lows = [part.low for part in moving if isinstance(part, Plate)]
    lows += [gear.plate.low for gear in bars.gears]
    lows += [base.low] if base else []
    if mechanism.spec.gears:
        from geneva_cli.parts.gears.gear_pair import gear_span

        lows.append(gear_span(mechanism, outlines)[0])
    arm = outlines.sizes.arm_thickness if outlines and outlines.has_arm else 0.0
    lows.append(-size.allowances.pin_gap_mm - arm)
    hub = wheel_hub(outlines.assembly, outlines.sizes) if outlines else None
    lows += [hub.low] if hub else []
    top = min(lows) - size.washer_mm
    thick = drawn_thicknesses(size, L, outlines.sizes if outlines else None).arm
    own = list(_all_shafts(mechanism, outlines, bars, top - thick, first))
    hanging = [one for one in own if one.turns and one.low >= top]
    crank = next((one for one in hanging if same(one.at, mechanism.crank_shaft.at, L)), None)
    bridge = _bridge(mechanism, outlines, bars, crank, thick) if outlines and crank else None
    if bridge and crank:
        own[own.index(crank)] = crank._replace(high=bridge.high)
        hanging.remove(crank)
    axles = [one.member for one in own]
    standing = list(_standing(mechanism, bars))
    holes: list[Circle] = []
    for at in standing:
        here = [one._replace(at=at) for one in axles if same(one.at, at, L)]
        holes += shaft_holes(size, here, top)
        if not here:
            table = mechanism.spec.shaft
            on_crank = at in [one.at for one in mechanism.crank_places]
            diameter = table.crank_diameter_mm if on_crank else table.wheel_diameter_mm
            holes.append(hole_without_shaft(diameter, at, L))
    fixed = list(_fixed(bars))
    for plate in (base, bridge):
        if plate:  # about the crank's axis
            bored = placed_holes(Member(plate, (L, 0.0)))
            fixed += [(hole, plate) for hole in bored if not same(hole.centre, (L, 0.0), L)]
    holes += [tapped(hole) for hole, _ in fixed]
    spacers = []
    for hole, part in fixed:
        if part.low - top > SAME_LENGTH * L:
            # a ring twice as wide, turned from a rod: often it is higher than wide
            ring, bore = Circle("SHAFT", ORIGIN, 2.0 * hole.radius), hole._replace(centre=ORIGIN)
            name = f"spacer of the {part.name}"
            spacers.append(Member(Plate(name, "SHAFT", ring, (bore,), top, part.low), hole.centre))
    eye = corner_radius(size, L)
    if mechanism.frame > 0.0:
        reach = max((c.radius for c in holes), default=0.0) + eye
        outline = convex_hull("FRAME", [Circle("FRAME", at, reach) for at in standing])
        plate = Plate("carrier", "FRAME", outline, tuple(holes), top - thick, top)
    else:
        # a frame contains every axis, drilled or not
        within = [*holes, *(Circle("BORE", at, 0.0) for at in (ORIGIN, *standing))]
        plate = mounted_plate(holes, within, eye, (top - thick, top))
    return FrameAndShafts(
        plate,
        tuple(outside_links(axles, bars, L)),
        tuple(spacers),
        tuple((hole, part.name) for hole, part in fixed),
        Member(bridge, (L, 0.0)) if bridge else None,
        tuple((one.name, _why_above(one, mechanism, bars, top)) for one in hanging),
    )


def _why_above(shaft: Shaft, mechanism: Mechanism, bars: Links, top: float) -> str:
    """Return the reason why a shaft ends above the frame's upper face ``top``."""
    ends = f"it ends at {shaft.low:.4g} mm, above the frame at {top:.4g} mm"
    key = f"{shaft.part}_shaft_low_mm"
    if vars(mechanism.spec.size).get(key) is not None:
        return f"{ends}, because {key} = {shaft.low:g}"
    if shaft.part == "wheel":
        return f"{ends}, because wheel_hub_mm = 0 ends it in the wheel"
    below = [plate.name for plate in bars.plates if plate.high <= shaft.low]
    return f"{ends}, because the {' and the '.join(below)} passes below it"


def _bridge(
    mechanism: Mechanism, parts: Outlines, bars: Links, shaft: Shaft, thick: float
) -> Plate | None:
    """Return the bridge about the crank's axis; None where there is no place for one."""
    size, sizes, L = mechanism.spec.size, parts.sizes, mechanism.center_distance_mm
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
            reach = float(farthest(Polyarc([as_contour(plate.outline)]), 0.0, 0.0).max())
            far.append(float(np.abs(places(links[plate.name])[0] - L).max()) + reach)
    wall = wall_min(size, L)
    bore = shaft.bore.around + 0.5 * size.allowances.shaft_fit_mm
    half = max(rounded_radius(HUB * bore), bore + wall)
    # also a machine that is too small for screws has those of the bridge
    screw = bolt_radius(None, L, half) or 0.5 * SCREWS[0].through
    away = max(far) + wall + max(half, 2.0 * screw)
    away = 0.5 * math.ceil(2.0 * away)  # mm: to half a millimetre, for the drill
    ends = (0.0, -away), (0.0, away)
    outline = convex_hull("FRAME", [Circle("FRAME", at, half) for at in ends])
    holes = Circle("BORE", ORIGIN, bore), *(Circle("BORE", at, screw) for at in ends)
    low = bridge_low(size, sizes)
    return Plate("bearing bridge", "FRAME", outline, holes, low, low + thick)


def _standing(mechanism: Mechanism, bars: Links) -> Iterator[Point]:
    """Yield the positions of shafts, each once: of the wheels, the crank, and its drive.

    An internal wheel is open in the middle, where its crank turns below it. It is held from above.
    """
    L = mechanism.center_distance_mm
    wheels = [one.at for one in mechanism.wheel_places]
    cranks = [one.at for one in mechanism.crank_places]
    seen = [*(wheels if mechanism.spec.wheel.SIGN > 0.0 else []), *cranks]
    if mechanism.spec.gears:
        seen.append((mechanism.gear_shaft.x_mm + mechanism.spec.gears.distance_mm, 0.0))
    yield from seen
    for axis in bars.axes:
        if axis.stands and not any(same(axis.at, one, L) for one in seen):
            seen.append(axis.at)
            yield axis.at


def _fixed(bars: Links) -> Iterator[tuple[Circle, Plate]]:
    """Yield the screws' holes of a guide or a gear that is fixed to the frame, with that part."""
    for member in bars.cut:
        if isinstance(member.part, Plate) and member.part.name in bars.standing:
            for hole in placed_holes(member):
                yield hole, member.part
    for gear in bars.gears:
        for hole in gear.screws.holes if gear.screws else ():
            (x, y), (u, v) = gear.at, hole.centre
            yield Circle("BORE", (x + u, y + v), hole.radius), gear.plate


def _all_shafts(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    lowest: float,
    first: Sequence[Member],
) -> Iterator[Shaft]:
    """Yield all shafts and pivots, as ``framed``; ``lowest`` is the frame's lower face."""
    L, stop = mechanism.center_distance_mm, None
    known: list[Point] = []  # axes whose shafts carry wheel or crank
    if outlines:
        stop = crank_stop(outlines, bars)
        known += [(L, 0.0)] if crank_shaft_radius(outlines) > 0.0 else []
        known += [ORIGIN] if wheel_shaft_radius(outlines) > 0.0 else []
        _, *wheels = mechanism.wheel_places
        _, *cranks = mechanism.crank_places
        half = mechanism.engagements[0].half_step
        for one in shafts(outlines, lowest, stop):
            yield one
            if same(one.at, ORIGIN, L):
                for place in wheels:
                    yield one._replace(at=place.at, turn=one.turn + place.turn - half)
                continue
            for place in cranks:
                turn = 0.0
                if not one.bore.is_plain:  # a plain one has no direction
                    crank = outlines.assembly.crank(np.array([-place.behind_deg, 0.0]))
                    turn = one.turn + place.turn + float(crank[0] - crank[1])
                yield one._replace(at=place.at, turn=turn)
    yield from _link_shafts(mechanism, outlines, bars, (lowest, stop), known, first)
    if mechanism.spec.gears:
        from geneva_cli.parts.gears.gear_pair import gear_shafts

        yield from gear_shafts(mechanism, outlines, lowest, (L, 0.0) in known)


def _link_shafts(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    ends: tuple[float, float | None],
    known: Sequence[Point],
    first: Sequence[Member],
) -> Iterator[Shaft]:
    """Yield the shafts and pivots that carry only links and gears: on no ``known`` axis.

    ``ends`` has the frame's lower face, and where links stop the crank's shaft, if they do.
    """
    size, L, (lowest, stop) = mechanism.spec.size, mechanism.center_distance_mm, ends
    wheel = drawn_thicknesses(size, L, outlines.sizes if outlines else None).wheel
    for axis in bars.axes:
        if any(same(axis.at, at, L) for at in known):
            continue
        here = (one for one in bars.axes if same(one.at, axis.at, L))
        spans = [span for one in here for span in carried(bars, one, first, L)]
        if mechanism.spec.gears and same(axis.at, mechanism.gear_shaft.at, L):
            from geneva_cli.parts.gears.gear_pair import gear_span

            spans.append(gear_span(mechanism, outlines))
        low, high = min(low for low, _ in spans), max(high for _, high in spans)
        bore, direction = axis.bore.bore, axis.bore.direction
        if axis.stands:
            turns, on_wheel = Joint.SHAFT in axis.kinds, same(axis.at, ORIGIN, L)
            on_crank = same(axis.at, (L, 0.0), L)
            whose = "crank" if on_crank else "wheel" if on_wheel else axis.names[0]
            low = stop if on_crank and stop is not None else lowest
            low, high = shaft_ends(size, whose, low, wheel if on_wheel else high)
            name = f"{whose}'s {'shaft' if turns else 'pivot'}"
            yield Shaft(name, whose, bore, low, high, axis.at, direction, turns=turns)
        elif len(axis.names) > 1 and Joint.PIN not in axis.kinds:  # those are pins between links
            name = f"shaft of {', '.join(axis.names)}"
            yield Shaft(name, axis.names[0], bore, low, high, axis.at, turns=False)
