"""The frame: one plate with a hole for every shaft that reaches it, and four mounting holes.

External wheels that orbit have a carrier instead, without mounting holes: it turns on the finger's
shaft, and has eyes for all wheels.

It lies below all moving parts. A shaft that ends above it, such as an internal wheel's, has its
bearing elsewhere. The wheel's axis is the origin, and the crank's is on the x axis. Holes are as
wide as the bores on their shafts. Turned shafts have a ball bearing in the frame, which is at least
as thick.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from geneva_cli.curves.hull import convex_hull
from geneva_cli.curves.plates import Member, Plate, Stack
from geneva_cli.curves.shapes import Circle, Point
from geneva_cli.errors import GenevaError
from geneva_cli.layout.bearings import SERIES_60
from geneva_cli.layout.bores import around
from geneva_cli.layout.link_positions import same
from geneva_cli.layout.plain_sizes import drawn_thicknesses, wall_min
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.preferred import bore_radius, rounded_radius
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.outlines.wheel_hub import wheel_hub
from geneva_cli.parts.arm import has_arm
from geneva_cli.parts.gear_pair import NAMES, gear_shafts, gear_span
from geneva_cli.parts.link_shafts import Ends, carried, link_shafts, outside_links
from geneva_cli.parts.links import Links, placed_holes
from geneva_cli.parts.planes import crank_stop
from geneva_cli.parts.shaft import Seat, Shaft
from geneva_cli.parts.shafts import crank_shaft_radius, shafts, wheel_shaft_radius
from geneva_cli.parts.turned_shafts import bearing_of, turned_shaft
from geneva_cli.spec.tables import Size

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
    collar = L / 50.0  # the least length of a shoulder
    top -= collar if size.shafts == "turned" else 0.0
    bottom = top - thick
    own = list(_shafts(mechanism, outlines, bars, bottom, first))
    turned = [one for one in own if _in_bearing(one, size, bottom)]
    bottom = min([bottom, *(top - bearing_of(one).width for one in turned)])
    moving = [*_moving(mechanism, outlines, bars), *map(_span, first)]
    axles = []
    for one in own:
        if one in turned:
            passed = _is_passed(one, moving)
            axles.append(turned_shaft(size, one, top, collar if passed else None))
        else:
            axles.append(one.plain(size))
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
    lowest: float,
    first: Sequence[Member],
) -> Iterator[Shaft]:
    """Yield all shafts and pivots; ``lowest`` is the frame's lower face."""
    stop, has_one = None, (False, False)
    L = mechanism.center_distance_mm
    if outlines:

        def below(at: Point) -> list[Seat]:
            """Return what a shaft carries below wheel or crank."""
            here = (axis for axis in bars.axes if same(axis.at, at, L))
            seats = [seat for axis in here for seat in carried(bars, axis, first, L)]
            if mechanism.spec.gears and same(at, (L, 0.0), L):
                seats.append(Seat("driven gear", *gear_span(mechanism, outlines)))
            return seats

        stop = crank_stop(outlines, bars)
        has_one = crank_shaft_radius(outlines) > 0.0, wheel_shaft_radius(outlines) > 0.0
        _, *others = mechanism.wheel_places
        half = mechanism.engagements[0].half_step
        for one in shafts(outlines, lowest, stop, below):
            yield one
            if same(one.at, (0.0, 0.0), L):
                yield from (one._replace(at=it.at, turn=one.turn + it.turn - half) for it in others)
    size, drawn = mechanism.spec.size, outlines.sizes if outlines else None
    top = drawn_thicknesses(size, L, drawn).wheel
    ends = Ends(lowest, top, stop, *has_one)
    yield from link_shafts(mechanism, bars, ends, first)
    yield from gear_shafts(mechanism, outlines, ends)


def _in_bearing(shaft: Shaft, size: Size, lowest: float) -> bool:
    """Return True for a turned shaft: it turns in the frame, whose lower face it reaches."""
    return size.shafts == "turned" and shaft.turns and shaft.low <= lowest


def _moving(mechanism: Mechanism, outlines: Outlines | None, bars: Links) -> Iterator[Seat]:
    """Yield links and gears: their names, lower and upper faces."""
    yield from map(_span, (*bars.cut, *bars.joined, *(gear.member for gear in bars.gears)))
    if mechanism.spec.gears:
        yield from (Seat(name, *gear_span(mechanism, outlines)) for name in NAMES)


def _span(member: Member) -> Seat:
    assert isinstance(member.part, Plate)
    return Seat(member.part.name, member.part.low, member.part.high)


def _is_passed(shaft: Shaft, moving: Iterable[Seat]) -> bool:
    """Return True if parts on other axes are lower than what a shaft carries."""
    low = shaft.seats[0].low if shaft.seats else shaft.high
    own = {seat.part for seat in shaft.seats}
    return any(one.low < low and one.part not in own for one in moving)


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
                bearing = next(b for b in SERIES_60 if b.bore == 2.0 * around(seat.outline))
                yield Circle(HOLES, at, 0.5 * bearing.outside)
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
