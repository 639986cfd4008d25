"""The frame: one plate with a hole for every shaft that reaches it, and four mounting holes.

External wheels that orbit have a carrier instead, without mounting holes: it turns on the finger's
shaft, and has eyes for all wheels.

It lies below all moving parts. A shaft that ends above it, such as an internal wheel's, has its
bearing elsewhere. The wheel's axis is the origin, and the crank's is on the x axis. Holes are as
wide as the bores on their shafts. Turned shafts have a ball bearing in the frame, which is at least
as thick.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from geneva_cli.curves.hull import convex_hull
from geneva_cli.curves.plates import Member, Plate, Stack
from geneva_cli.curves.shapes import Circle, Point
from geneva_cli.errors import GenevaError
from geneva_cli.layout.bearings import Bearing, bearing_up_to
from geneva_cli.layout.bores import around
from geneva_cli.layout.link_positions import same
from geneva_cli.layout.plain_sizes import drawn_thicknesses, wall_min
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.preferred import bore_radius, rounded_radius
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.outlines.wheel_hub import wheel_hub
from geneva_cli.parts.arm import has_arm
from geneva_cli.parts.gear_pair import gear_shafts, gear_span
from geneva_cli.parts.link_shafts import Ends, link_shafts, outside_links
from geneva_cli.parts.links import Links, placed_holes
from geneva_cli.parts.planes import crank_stop
from geneva_cli.parts.shafts import crank_shaft_radius, shafts, wheel_shaft_radius

NAME, LAYER, HOLES = "frame", "FRAME", "BORE"


class FrameAndShafts(NamedTuple):
    """The frame, and the shafts at their positions, whether they reach it or not."""

    plate: Plate
    shafts: tuple[Member, ...]


def framed(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    base: Plate | None = None,
    first: Sequence[Member] = (),
) -> FrameAndShafts:
    """Return the frame and the shafts of a machine with its ``outlines``, if it has any.

    ``bars`` are the links, ``base`` is the lowest plate with a cam's groove, ``first`` are the
    first wheel and its locking disc of two in series. Raises GenevaError where wheel and crank do
    not stand in one plane, and where a shaft's lower end is not below its upper one.
    """
    if not mechanism.spec.wheel.FLAT:
        raise GenevaError(
            f'--part frame: the shafts of gearing = "{mechanism.spec.wheel.NAME}" are not '
            "parallel, so one plate cannot hold them"
        )
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    lows = [base.low] if base else []
    if mechanism.spec.gears:
        lows.append(gear_span(mechanism, outlines)[0])
    top = min([_lowest(mechanism, outlines, bars), *lows]) - size.washer_mm
    drawn = outlines.sizes if outlines else None
    thick = drawn_thicknesses(size, L, drawn).arm
    if size.shafts == "turned":
        _refuse_turned(mechanism, bars)
        top -= L / 50.0  # the least length of a shoulder
        thick = max([thick, *(bearing.width for bearing in _bearings(outlines))])
    bottom = top - thick
    axles = list(_shafts(mechanism, outlines, bars, (bottom, top), first))
    places = list(_standing(mechanism, bars))
    mounts = _mounted(base, L) if base else ()
    holes = [*_drilled(mechanism, axles, places, top), *_fixed(bars), *mounts]
    wall = wall_min(size, L)
    eye = max(L / 20.0, 3.0 * wall)
    # The frame contains every axis, drilled or not.
    within = [*holes, *(Circle(HOLES, at, 0.0) for at in ((0.0, 0.0), *places))]
    if mechanism.frame > 0.0:
        reach = max(c.radius for c in holes) + eye
        eyes = [Circle(LAYER, at, reach) for at in places]
        plate = Plate("carrier", LAYER, convex_hull(LAYER, eyes), tuple(holes), bottom, top)
        return FrameAndShafts(plate, tuple(outside_links(axles, bars, L)))
    low, high = (
        [pick(c.centre[k] + sense * c.radius for c in within) + 3.0 * sense * eye for k in (0, 1)]
        for sense, pick in ((-1.0, min), (1.0, max))
    )
    corners = [(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
    outline = convex_hull(LAYER, [Circle(LAYER, corner, eye) for corner in corners])
    holes += [Circle(HOLES, corner, rounded_radius(0.4 * eye)) for corner in corners]
    return FrameAndShafts(
        Plate(NAME, LAYER, outline, tuple(holes), bottom, top), tuple(outside_links(axles, bars, L))
    )


def _shafts(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    frame: tuple[float, float],
    first: Sequence[Member],
) -> Iterator[Member]:
    """Yield all shafts at their positions; ``frame`` has the frame's lower and upper face."""
    stop, own = None, (False, False)
    if outlines:
        stop = crank_stop(outlines, bars)
        own = crank_shaft_radius(outlines) > 0.0, wheel_shaft_radius(outlines) > 0.0
        _, *others = mechanism.wheel_places
        half = mechanism.engagements[0].half_step
        for one in shafts(outlines, frame, stop):
            yield one
            if same(one.at, (0.0, 0.0), mechanism.center_distance_mm):
                yield from (one._replace(at=it.at, turn=one.turn + it.turn - half) for it in others)
    size, drawn = mechanism.spec.size, outlines.sizes if outlines else None
    top = drawn_thicknesses(size, mechanism.center_distance_mm, drawn).wheel
    ends = Ends(frame[0], top, stop, *own)
    yield from link_shafts(mechanism, bars, ends, first)
    yield from gear_shafts(mechanism, outlines, ends)


def _refuse_turned(mechanism: Mechanism, bars: Links) -> None:
    """Raise GenevaError for turned shafts that would carry links or gears too."""
    if bars.sizes or mechanism.spec.gears:
        raise GenevaError(
            f'shafts = "turned": kind = "{mechanism.spec.drive.NAME}" has links or gears on its '
            "shafts, which leave no space for a shoulder; remove it",
            ("size", "shafts"),
        )


def _bearings(outlines: Outlines | None) -> Iterator[Bearing]:
    """Yield the bearings of the turned shafts of wheel and crank."""
    if outlines is None:
        return
    for part, radius in (
        ("wheel", outlines.sizes.wheel_bore),
        ("crank", crank_shaft_radius(outlines)),
    ):
        if radius:
            yield bearing_up_to(2.0 * radius, part)


def _drilled(
    mechanism: Mechanism, shafts_: Sequence[Member], places: Sequence[Point], top: float
) -> Iterator[Circle]:
    """Yield the holes of the shafts that reach below the frame's upper face.

    They are as wide as bores for these shafts, or as the bearings on them.
    A wheel or a crank without a bore is one piece with its shaft, whose diameter is in [shaft].
    """
    L, shaft = mechanism.center_distance_mm, mechanism.spec.shaft
    diameters = {0.0: shaft.wheel_diameter_mm, L: shaft.crank_diameter_mm}
    for at in places:
        here = [one.part for one in shafts_ if same(one.at, at, L)]
        for one in here:
            if isinstance(one, Stack):
                seat = next(step for step in one.plates if step.high == top)
                yield Circle(HOLES, at, 0.5 * bearing_up_to(2.0 * around(seat.outline), "").outside)
            elif isinstance(one, Plate) and one.low < top:
                wider = 0.5 * mechanism.spec.size.allowances.shaft_fit_mm
                yield Circle(HOLES, at, around(one.outline) + wider)
        if not here:
            diameter = diameters.get(at[0], shaft.wheel_diameter_mm)
            yield Circle(HOLES, at, bore_radius(L / 20.0) if diameter is None else 0.5 * diameter)


def _standing(mechanism: Mechanism, bars: Links) -> Iterator[Point]:
    """Yield the positions of shafts, each once: of the wheels, the crank, and its drive.

    An internal wheel is open in the middle, where its crank turns below it. It is held from above.
    """
    L = mechanism.center_distance_mm
    wheels = [one.at for one in mechanism.wheel_places]
    seen = [*(wheels if mechanism.spec.wheel.SIGN > 0.0 else []), (L, 0.0)]
    if mechanism.spec.gears:
        seen.append((L + mechanism.spec.gears.distance_mm, 0.0))
    yield from seen
    for axis in bars.axes:
        if axis.stands and not any(same(axis.at, one, L) for one in seen):
            seen.append(axis.at)
            yield axis.at


def _fixed(bars: Links) -> Iterator[Circle]:
    """Yield the holes by which fixed parts, such as a guide or a gear, are screwed to the frame."""
    for member in bars.cut:
        if isinstance(member.part, Plate) and member.part.name in bars.standing:
            yield from placed_holes(member)
    for gear in bars.gears:
        for hole in gear.bolts:
            (x, y), (u, v) = gear.at, hole.centre
            yield Circle(HOLES, (x + u, y + v), hole.radius)


def _mounted(base: Plate, L: float) -> Iterator[Circle]:
    """Yield the holes that mount a plate about the crank's axis."""
    holes = placed_holes(Member(base, (L, 0.0)))
    yield from (hole for hole in holes if not same(hole.centre, (L, 0.0), L))


def _lowest(mechanism: Mechanism, parts: Outlines | None, bars: Links) -> float:
    """Return the lowest point of the moving parts, along the axis."""
    size = mechanism.spec.size
    under = [one.part.low for one in (*bars.cut, *bars.joined) if isinstance(one.part, Plate)]
    under += [gear.plate.low for gear in bars.gears]
    hub = wheel_hub(parts.assembly, parts.sizes) if parts else None
    under += [hub.low] if hub else []
    arm = parts.sizes.arm_thickness if parts and has_arm(parts) else 0.0
    return min([*under, -size.allowances.pin_gap_mm - arm])
