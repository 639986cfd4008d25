"""Shafts with steps, as a lathe turns them: circlip, bearing, shoulder, seat of the part, circlip.

The bearing is in the frame, flush with its upper face. It lies between the shoulder above and a
circlip below. The part stands on the shoulder, with a circlip above it where there is space.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.curves.plates import Plate, Stack
from geneva_cli.curves.shapes import ORIGIN, Circle, Shape
from geneva_cli.errors import GenevaError
from geneva_cli.layout.bearings import Circlip, bearing_up_to, circlip_up_to
from geneva_cli.layout.bores import Bore, fitted, rounded
from geneva_cli.spec.tables import Size


class Seat(NamedTuple):
    """Where a part sits on its shaft."""

    part: str  # "wheel" or "crank"
    bore: Bore
    direction: float  # of the bore's keyway or flat, radians
    low: float
    high: float
    ends_here: bool  # True where nothing may stand above the part
    frame: float  # the frame's upper face


class Step(NamedTuple):
    """One step of a shaft: what it is, its section, and the length that it needs."""

    name: str
    section: Shape
    length: float


def turned_shaft(size: Size, seat: Seat, layer: str) -> Stack:
    """Return a shaft with its steps.

    Raises GenevaError, naming the key, for a shaft that is too thin for a bearing, and for ends
    that leave no space for the circlips.
    """
    bearing = bearing_up_to(2.0 * seat.bore.radius, seat.part)
    own = fitted(size, seat.bore)
    # rounded up to half a millimetre; the last term drops rounding errors
    shoulder = 0.5 * math.ceil(2.0 * max(bearing.shoulder, 2.5 * seat.bore.around) - 1e-9)
    below = [
        *_retained(layer, circlip_up_to(bearing.bore))[::-1],
        Step(f"seat of bearing {bearing.name}", _circle(layer, bearing.bore), bearing.width),
    ]
    above = list(_on_part(layer, own, seat))
    values = vars(size)
    keys = f"{seat.part}_shaft_low_mm", f"{seat.part}_shaft_high_mm"
    low = _end(keys[0], values[keys[0]], seat.frame - _long(below), -1.0)
    high = _end(keys[1], values[keys[1]], seat.low + _long(above), 1.0)
    heights = [low, *(seat.frame - _long(below[k:]) for k in range(1, len(below))), seat.frame]
    heights += [seat.low, *(seat.low + _long(above[:k]) for k in range(1, len(above))), high]
    steps = [*below, Step("shoulder", _circle(layer, shoulder), 0.0), *above]
    spans = zip(steps, pairwise(heights), strict=True)
    plates = (Plate(step.name, layer, step.section, (), *ends) for step, ends in spans)
    return Stack(f"{seat.part}'s shaft", layer, tuple(plates))


def _on_part(layer: str, own: Bore, seat: Seat) -> Iterator[Step]:
    """Yield the steps from the shoulder up: the part's seat, and a circlip where there is space."""
    section, name = own.section(layer, seat.direction), f"seat of {seat.part}"
    long = seat.high - seat.low
    if own.keyed:
        # a keyway that ends before both faces leaves a round seat on each side
        end = Step(name, rounded(section), 0.1 * long)
        yield from (end, Step(f"{name}, {own.shaft_note}", section, 0.8 * long), end)
    else:
        yield Step(f"{name}, {own.shaft_note}".removesuffix(", "), section, long)
    if own.end_diameter and not seat.ends_here:
        yield from _retained(layer, circlip_up_to(own.end_diameter))


def _retained(layer: str, ring: Circlip) -> list[Step]:
    """Return a circlip's groove and the shaft's end beyond it."""
    name = "circlip groove, DIN 471"
    groove = Step(name, _circle(layer, ring.groove), ring.width)
    return [groove, Step("end", _circle(layer, ring.shaft), ring.edge)]


def _end(key: str, own: float | None, needed: float, outwards: float) -> float:
    """Return a shaft's end: that of the spec, if it leaves space for the steps."""
    if own is not None and outwards * (needed - own) > 0.0:
        raise GenevaError(
            f"{key} = {own:g}: the turned shaft needs its end at {needed:.6g} mm or beyond; remove "
            "the key",
            ("size", key),
        )
    return needed if own is None else own


def _long(steps: list[Step]) -> float:
    return sum(step.length for step in steps)


def _circle(layer: str, diameter: float) -> Circle:
    return Circle(layer, ORIGIN, 0.5 * diameter)
