"""All shafts of a flat machine before they are built, and what passes below the parts on them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from geneva_cli.geometry.plates import Member
from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import AxisPlace
from geneva_cli.parts.arm import crank_arm
from geneva_cli.parts.links.link_planes import crank_stop
from geneva_cli.parts.links.link_positions import same
from geneva_cli.parts.links.link_shafts import carried, link_shafts
from geneva_cli.parts.links.links import Links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.hub_and_shafts import crank_shaft_radius, shafts, wheel_shaft_radius
from geneva_cli.parts.shafts.shaft import Ends, Seat, Shaft, seat_of
from geneva_cli.parts.sizes.plain_sizes import drawn_thicknesses


def all_shafts(
    mechanism: Mechanism,
    outlines: Outlines | None,
    bars: Links,
    lowest: float,
    first: Sequence[Member],
) -> Iterator[Shaft]:
    """Yield all shafts and pivots; ``lowest`` is the frame's lower face."""
    stop, has_one = None, (False, False)
    L = mechanism.center_distance_mm

    def on(at: Point) -> tuple[Seat, ...]:
        """Return what a shaft carries, from the lowest up, but for wheel and crank."""
        here = (axis for axis in bars.axes if same(axis.at, at, L))
        seats = [seat for axis in here for seat in carried(bars, axis, first, L)]
        if mechanism.spec.gears and same(at, mechanism.gear_shaft.at, L):
            from geneva_cli.parts.gears.gear_pair import gear_seats

            seats += gear_seats(mechanism, outlines)[:1]
        return tuple(sorted(seats, key=lambda seat: seat.low))

    if outlines:
        stop = crank_stop(outlines, bars)
        has_one = crank_shaft_radius(outlines) > 0.0, wheel_shaft_radius(outlines) > 0.0
        _, *others = mechanism.wheel_places
        _, *cranks = mechanism.crank_places
        half = mechanism.engagements[0].half_step
        for one in shafts(outlines, lowest, stop, on):
            yield one
            if same(one.at, (0.0, 0.0), L):
                yield from (one._replace(at=it.at, turn=one.turn + it.turn - half) for it in others)
            else:
                yield from (_of_crank(one, it, outlines) for it in cranks)
    size, drawn = mechanism.spec.size, outlines.sizes if outlines else None
    top = drawn_thicknesses(size, L, drawn).wheel
    ends = Ends(lowest, top, stop, *has_one)
    yield from link_shafts(mechanism, bars, ends, on)
    if mechanism.spec.gears:
        from geneva_cli.parts.gears.gear_pair import gear_shafts

        yield from gear_shafts(mechanism, outlines, ends)


def _of_crank(first: Shaft, place: AxisPlace, outlines: Outlines) -> Shaft:
    """Return the shaft of a crank that follows the first; a plain one has no direction."""
    if first.bore.is_plain:
        return first._replace(at=place.at)
    later, now = outlines.assembly.crank(np.array([-place.behind_deg, 0.0]))
    return first._replace(at=place.at, turn=first.turn + place.turn + float(later - now))


def passing(
    mechanism: Mechanism, outlines: Outlines | None, bars: Links, others: Iterable[Member]
) -> Iterator[Seat]:
    """Yield links, gears and other parts: their names, lower and upper faces."""
    yield from (seat_of(one.part) for one in (*bars.cut, *bars.joined, *others))
    yield from (seat_of(gear.plate) for gear in bars.gears)
    if mechanism.spec.gears:
        from geneva_cli.parts.gears.gear_pair import gear_seats

        yield from gear_seats(mechanism, outlines)


def passing_arm(outlines: Outlines, own: Iterable[Shaft]) -> Iterator[Seat]:
    """Yield the faces of an arm whose end passes a wheel's shaft nearer than its shoulder."""
    from geneva_cli.parts.shafts.turned_shafts import shoulder_mm

    if not outlines.has_arm:
        return
    arm, L = crank_arm(outlines), outlines.assembly.L
    away = L - max(math.hypot(*pin.centre) for pin in arm.pins) - arm.eye
    high = -outlines.assembly.full.spec.size.allowances.pin_gap_mm
    for one in own:
        if one.part == "wheel" and away < 0.5 * shoulder_mm(one):
            yield Seat("arm", high - outlines.sizes.arm_thickness, high)
