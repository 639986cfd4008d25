"""Gaps between hubs or shafts and parts that turn about another axis, where they share a height.

A part that makes whole turns sweeps a ring about its axis; a plate that stands is no larger than
its ring. So the least gap of a whole turn is a distance from ring to shaft. Links, which swing, are
checked in their planes (``planes``), and the frame has the shafts in holes of its own.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple, TypeVar

import numpy as np

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.measure import at, with_material_left
from geneva_cli.curves.plates import Group, Member, Part, Plate
from geneva_cli.curves.shapes import Arc, Circle, Contour, Point, Segment, closed, two_arcs
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.built import Built, built
from geneva_cli.parts.gear_drawings import PITCH, gear_span, pitch_radii
from geneva_cli.parts.link_drawings import placed
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.wheel_hub import HUB

Measure = TypeVar("Measure", float, Array)  # one gap, or one on each of some spheres


class ShaftGap(NamedTuple):
    """The least gap, mm, between a hub or shaft and a part that passes it."""

    gap: float  # negative where they overlap
    shaft: str
    part: str


class Ring(NamedTuple):
    """What a plate sweeps about the axis that it turns on."""

    name: str
    layer: str
    axis: Point
    inner: float
    outer: float
    low: float
    high: float


def ring_gap(apart: float, inner: float, outer: Measure, radius: Measure) -> Measure:
    """The gap between a ring and something round, where their axes are so far apart.

    Radii are in mm, or on a sphere in radians. Negative where they overlap: by what the round thing
    must move to be outside of the ring, or in its opening where that is less and there is one.
    """
    gap = apart - outer
    if inner:
        gap = np.maximum(gap, inner - apart)
    return gap - radius


def beside_shafts(found: Outlines) -> ShaftGap | None:
    """The least gap of all; None where nothing passes a hub or shaft.

    Raises GenevaError for sizes that leave no parts.
    """
    whole = built(found, pitch=False)
    turning = _rings_of((whole.wheel, whole.crank))
    others = _rings_of((*whole.first, *whole.standing[:-1]))
    return _least(found, whole, turning, [*turning, *others])


def beside_gears(found: Outlines) -> ShaftGap | None:
    """The least gap between noncircular gears and the hubs and shafts that pass them; else None.

    Raises GenevaError for sizes that leave no parts.
    """
    if found.assembly.given.spec.drive.gears is None:
        return None
    whole = built(found, pitch=False)
    turning = _rings_of((whole.wheel, whole.crank))
    return _least(found, whole, turning, list(_noncircular(found)))


def _least(
    found: Outlines, whole: Built, turning: list[Ring], rings: list[Ring]
) -> ShaftGap | None:
    """The least gap of some rings to the shafts, and to the hubs among wheel and crank."""
    near = SAME_LENGTH * found.assembly.L
    axes = [ring for ring in turning if ring.layer == HUB] + _rings_of(whole.shafts)
    return min(
        (
            ShaftGap(
                float(ring_gap(apart, ring.inner, ring.outer, shaft.outer)), shaft.name, ring.name
            )
            for shaft in axes
            for ring in rings
            if (apart := math.dist(ring.axis, shaft.axis)) > near
            and min(ring.high, shaft.high) - max(ring.low, shaft.low) > near
        ),
        default=None,
    )


def _noncircular(found: Outlines) -> Iterator[Ring]:
    """The rings of noncircular gears, by the farthest points of their pitch curves."""
    given = found.assembly.given
    pair, L = given.spec.drive.gears, given.center_distance_mm
    if pair is None:
        return
    (_, driven), (_, driver) = pitch_radii(pair)
    low, high = gear_span(Proof(given, found))
    yield Ring("driven gear", PITCH, (L, 0.0), 0.0, driven, low, high)
    yield Ring("driver gear", PITCH, (L + pair.distance_mm, 0.0), 0.0, driver, low, high)


def _rings_of(members: Iterable[Member]) -> list[Ring]:
    return [ring for one in members for ring in _rings(one)]


def _rings(member: Member) -> Iterator[Ring]:
    """The rings of a part's plates about the place that it turns on."""
    for plate, origin in _plates(member.part):
        shapes = [placed(_contour(s), origin, 0.0) for s in (plate.outline, *plate.holes)]
        sides = [with_material_left(shape, i == 0) for i, shape in enumerate(shapes)]
        inner = max(0.0, float(Polyarc(sides).signed(np.zeros((1, 2)))[0]))
        outer = max(math.hypot(*p) for piece in shapes[0].segments for p in _far(piece))
        yield Ring(plate.name, plate.layer, member.at, inner, outer, plate.low, plate.high)


def _plates(part: Part, origin: Point = (0.0, 0.0)) -> Iterator[tuple[Plate, Point]]:
    """The plates of a part that is one with its axis, and where their origins are from that."""
    if isinstance(part, Group):
        for member in part.members:
            yield from _plates(member.part, member.at)
    elif isinstance(part, Plate):
        yield part, origin


def _contour(shape: Contour | Circle) -> Contour:
    return shape if isinstance(shape, Contour) else closed(shape.layer, two_arcs(shape))


def _far(piece: Segment) -> Iterator[Point]:
    """Points of a piece of which one is the farthest from the origin."""
    yield piece.start
    yield piece.end
    if isinstance(piece, Arc):
        (x, y), radius = piece.centre, piece.radius
        away = math.hypot(x, y)
        far = (x * (1.0 + radius / away), y * (1.0 + radius / away)) if away else piece.start
        off = math.remainder(_turn(far, piece) - _turn(at(piece, 0.5), piece), math.tau)
        if abs(off) < 0.5 * abs(piece.sweep):
            yield far


def _turn(p: Point, arc: Arc) -> float:
    (x, y), (u, v) = arc.centre, p
    return math.atan2(v - y, u - x)
