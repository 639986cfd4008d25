"""Gaps between hubs or shafts and parts that turn about another axis, at shared heights.

A part that makes whole turns sweeps a ring about its axis. For a plate that stands still the ring
is a safe bound. So the least gap in a whole turn is the distance between ring and shaft. Links,
which swing, are checked in their planes (``planes``). The frame has holes for the shafts.
"""

import math
from collections.abc import Iterable, Iterator
from itertools import product
from typing import NamedTuple, TypeVar

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member, in_place, oriented
from geneva_cli.geometry.shapes import Layer, Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.gears.gear_pair import gear_span, pitch_radii
from geneva_cli.parts.outlines.outlines import Outlines

Measure = TypeVar("Measure", float, Array)  # one gap, or an array of one for each sphere


class Ring(NamedTuple):
    """The ring that a plate sweeps about the axis that it turns on."""

    layer: Layer
    axis: Point
    inner: float
    outer: float
    low: float
    high: float


def ring_gap(apart: float, inner: float, outer: Measure, radius: Measure) -> Measure:
    """Return the gap between a ring and a round part whose axis is ``apart`` from the ring's.

    Lengths are in mm, or on a sphere in radians. A negative gap is the distance that the round part
    must move to leave the ring: outwards, or into the ring's opening if that is nearer.
    """
    gap = apart - outer
    if inner:
        gap = np.maximum(gap, inner - apart)
    return gap - radius


def shaft_gaps(parts: FlatParts, gears: bool = False) -> Iterator[float]:
    """Yield the gaps of parts, or of noncircular gears, to hubs, shafts and spacers, mm."""
    turning, shafts = rings_of((parts.wheel, parts.crank)), parts.shafts
    rings = [*turning, *rings_of((*parts.first, *parts.groove_plate))]
    if gears:  # the spacers are those of a fixed gear or a guide above the gears
        rings = list(gear_rings(parts.mechanism, parts.drawn))
        shafts = (*shafts, *parts.framed.spacers)
    yield from ring_gaps(parts.mechanism, turning, rings, shafts)


def ring_gaps(
    mechanism: Mechanism, turning: list[Ring], rings: list[Ring], shafts: Iterable[Member]
) -> Iterator[float]:
    """Yield the gaps of rings to shafts, and to the hubs of wheel and crank, mm."""
    near = SAME_LENGTH * mechanism.center_distance_mm
    axes = [ring for ring in turning if ring.layer == "HUB"] + rings_of(shafts)
    for shaft, ring in product(axes, rings):
        apart = math.dist(ring.axis, shaft.axis)
        if apart > near and min(ring.high, shaft.high) - max(ring.low, shaft.low) > near:
            yield float(ring_gap(apart, ring.inner, ring.outer, shaft.outer))


def gear_rings(mechanism: Mechanism, drawn: Outlines | None) -> Iterator[Ring]:
    """Yield the rings of noncircular gears, out to their farthest points."""
    pair, x = mechanism.spec.gears, mechanism.gear_shaft.x_mm
    if pair is None:
        return
    places = x, x + pair.distance_mm
    span = gear_span(mechanism, drawn)
    for place, (_, pitch) in zip(places, pitch_radii(pair), strict=True):
        yield Ring("PITCH", (place, 0.0), 0.0, pitch, *span)


def rings_of(members: Iterable[Member]) -> list[Ring]:
    """Return the rings of some parts' plates about the axes that they turn on."""
    rings = []
    for member in members:
        for _, plate in in_place([Member(member.part)]):
            contours = oriented(plate.outline, plate.holes)
            inner = max(0.0, float(Polyarc(contours).signed(np.zeros((1, 2)))[0]))
            outer = float(Polyarc(contours[:1]).farthest(np.zeros((1, 2))).max())
            rings.append(Ring(plate.layer, member.at, inner, outer, plate.low, plate.high))
    return rings
