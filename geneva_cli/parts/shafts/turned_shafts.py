"""Shafts with steps, as a lathe turns them: circlip, bearing, shoulder, seats of parts, circlip.

The bearing is in the frame, flush with its upper face. It lies between the shoulder above and a
circlip below. The lowest part stands on the shoulder. Where other parts pass below that part, the
shoulder is a collar just above the frame. Above the highest part there is a circlip if there is
space.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.pieces import SHORTEST_MM
from geneva_cli.geometry.plates import Member, Plate, Stack
from geneva_cli.geometry.shapes import ORIGIN, Circle, Shape
from geneva_cli.parts.shafts.bearings import Bearing, bearing_up_to, circlip_up_to
from geneva_cli.parts.shafts.bores import Bore, rounded
from geneva_cli.parts.shafts.shaft import Seat, Shaft
from geneva_cli.spec.tables import Size


class Step(NamedTuple):
    """One step of a shaft: what it is, its section, and its upper end."""

    name: str
    section: Shape
    high: float


def bearing_of(shaft: Shaft) -> Bearing:
    """Return the bearing of a shaft. Raises GenevaError for a shaft that is too thin for one."""
    return bearing_up_to(2.0 * shaft.bore.radius, shaft.name, shaft.bore_key)


def shoulder_mm(shaft: Shaft) -> float:
    """Return the diameter of a shoulder: wider than bearing and bore by a quarter, or by 2 mm."""
    wide = max(bearing_of(shaft).shoulder, 2.5 * shaft.bore.around)
    # rounded up to half a millimetre; the last term drops rounding errors
    return 0.5 * math.ceil(2.0 * wide - 1e-9)


def turned_shaft(size: Size, shaft: Shaft, frame: float, free: float | None = None) -> Member:
    """Return a shaft with its steps.

    ``frame`` is the frame's upper face. Other parts pass above ``free``, where the shoulder ends;
    otherwise it reaches the lowest part. Raises GenevaError, naming the key, for
    a shaft that is too thin for a bearing, and for ends that leave no space for the circlips.
    """
    bearing, own = bearing_of(shaft), shaft.bore
    under = frame - bearing.width
    ring = circlip_up_to(bearing.bore)
    groove = under - ring.width
    values = vars(size)
    low_key, high_key = f"{shaft.part}_shaft_low_mm", f"{shaft.part}_shaft_high_mm"
    low = _end(low_key, values.get(low_key), groove - ring.edge, -1.0)
    steps = [
        Step("end", _circle(ring.shaft), groove),
        Step("circlip groove, DIN 471", _circle(ring.groove), under),
        Step(f"seat of bearing {bearing.name}", _circle(bearing.bore), frame),
        *_above(shaft, own, free),
    ]
    *others, last = steps
    high = _end(high_key, values.get(high_key), last.high, 1.0)
    steps = [*others, last._replace(high=high)]
    heights = pairwise([low, *(step.high for step in steps)])
    plates = (
        Plate(step.name, "SHAFT", step.section, (), *ends)
        for step, ends in zip(steps, heights, strict=True)
    )
    return Member(Stack(shaft.name, "SHAFT", tuple(plates)), shaft.at, shaft.turn)


def _above(shaft: Shaft, own: Bore, free: float | None) -> Iterator[Step]:
    """Yield the steps from the frame's upper face up."""
    section = own.section("SHAFT", shaft.direction)
    below = rounded(section) if own.is_round else _circle(2.0 * own.radius)
    first = shaft.seats[0].low if shaft.seats else shaft.high
    top = first if free is None else min(first, free)
    yield Step("shoulder", _circle(shoulder_mm(shaft)), top)
    if first - top > SHORTEST_MM:
        yield Step("shaft", below, first)
    for seat, after in pairwise(shaft.seats):
        if seat.held:
            yield from _on_part(own, seat, section, ends_here=True)
            # a flat or a hexagon does not pass a round step; what is keyed does
            below = below if own.key else section
        else:
            yield Step(f"seat of {seat.part}", below, seat.high)
        if after.low - seat.high > SHORTEST_MM:  # faces that touch may differ by rounding
            yield Step("shaft", below, after.low)
    if shaft.seats:
        yield from _on_part(own, shaft.seats[-1], section, shaft.ends_here)


def _on_part(own: Bore, seat: Seat, section: Shape, ends_here: bool) -> Iterator[Step]:
    """Yield the steps of a part's seat, and a circlip where there is space above it."""
    name, long = f"seat of {seat.part}", seat.high - seat.low
    if own.key:
        # a keyway that ends before both faces leaves a round seat on each side
        yield Step(name, rounded(section), seat.low + 0.1 * long)
        yield Step(f"{name}, {own.shaft_note}", section, seat.high - 0.1 * long)
        yield Step(name, rounded(section), seat.high)
    else:
        yield Step(f"{name}, {own.shaft_note}".removesuffix(", "), section, seat.high)
    if own.end_diameter and not ends_here:
        ring = circlip_up_to(own.end_diameter)
        yield Step("circlip groove, DIN 471", _circle(ring.groove), seat.high + ring.width)
        yield Step("end", _circle(ring.shaft), seat.high + ring.width + ring.edge)


def _end(key: str, own: float | None, needed: float, outwards: float) -> float:
    """Return a shaft's end: that of the spec, if it leaves space for the steps."""
    if own is not None and outwards * (needed - own) > 0.0:
        raise GenevaError(
            f"{key} = {own:g}: the turned shaft needs its end at {needed:.6g} mm or beyond; remove "
            "the key",
            ("size", key),
        )
    return needed if own is None else own


def _circle(diameter: float) -> Circle:
    return Circle("SHAFT", ORIGIN, 0.5 * diameter)


def built_shafts(
    size: Size, own: list[Shaft], adjacent: list[Seat], heights: tuple[float, float, float]
) -> tuple[list[Member], float]:
    """Return the shafts, plain or turned, and the frame's lower face.

    Shafts that turn in the frame and reach its lower face are turned. ``adjacent`` are the faces of
    parts that pass them. ``heights`` are the lower face of a frame of plain shafts, the upper face,
    and the lowest height at which parts pass.
    """
    usual, top, free = heights
    turned = [size.shafts == "turned" and one.turns and one.low <= usual for one in own]
    bottom = usual
    if any(turned):
        widths = (bearing_of(one).width for one, steps in zip(own, turned, strict=True) if steps)
        bottom = min([usual, *(top - width for width in widths)])
    axles = []
    for one, steps in zip(own, turned, strict=True):
        if steps:
            axles.append(turned_shaft(size, one, top, free if _is_passed(one, adjacent) else None))
        else:
            axles.append(one._replace(low=bottom if one.low == usual else one.low).plain())
    return axles, bottom


def _is_passed(shaft: Shaft, adjacent: Iterable[Seat]) -> bool:
    """Return True if parts on other axes are lower than what a shaft carries."""
    low = shaft.seats[0].low if shaft.seats else shaft.high
    own = {seat.part for seat in shaft.seats}
    return any(one.low < low and one.part not in own for one in adjacent)
