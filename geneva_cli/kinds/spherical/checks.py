"""Checks of walls, arm and shafts of a spherical machine, mm along the sphere."""

import math
from collections.abc import Collection, Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry import shapes
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.sphere import POLE
from geneva_cli.geometry.sphere_arcs import RoundHole
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import refuse_bored_hub
from geneva_cli.spec.defaults import wall_min
from geneva_cli.verdict.checks import Check, compared, measured
from geneva_cli.verdict.checks.part_checks import cuts, least_gap
from geneva_cli.verdict.shaft_gap import ring_gap


def standing(names: Collection[str], parts: SphereParts) -> Iterator[Check]:
    """Walls of wheel and arm, gaps at shafts, and what the process can cut."""
    ball, least = parts.ball, wall_min(parts.mechanism.spec.size, parts.ball.radius_mm)
    # between adjacent slots: at their ends, or at a rim beyond a quarter sphere
    apart = 2.0 * math.asin(math.sin(ball.bottom) * math.sin(ball.half_step))
    wall = apart - 2.0 * ball.half_width
    if ball.rim > 0.5 * math.pi:
        corners = math.sin(ball.rim) * math.sin(ball.half_step - ball.corner)
        wall = min(wall, 2.0 * math.asin(corners))
    yield compared("wall_between_slots_mm", wall * ball.radius_mm, "at least", least)
    if parts.shape.crank:  # between a slot and the recess of the locking sectors
        yield compared("horn_mm", parts.sizes.horn, "at least", least)
    yield from measured("wheel_bore_wall_mm", least, lambda: _bore_wall(parts))
    arm = [*measured("arm_wall_mm", least, lambda: parts.arm.wall if parts.arm else None)]
    if "beside_shafts_mm" in names and not (arm and arm[0].value is None):
        yield from least_gap("beside_shafts_mm", _shaft_gaps(parts), ball.radius_mm)
    yield from arm
    spans = ball.span_mm, ball.lock_span_mm, ball.arm_span_mm
    (inner, outer), thickest = ball.span_mm, max(end - start for start, end in spans)
    wide = 2.0 * inner * math.sin(ball.half_width)  # of the slots inside
    yield from cuts(parts.mechanism, thickest, wide, outer - inner)


def _bore_wall(parts: SphereParts) -> float:
    """The wall between the slots' ends and what is about the wheel's axis, and the hub's own."""
    ball = parts.ball
    opening = RoundHole(POLE, ball.opening_mm).angle(ball.span_mm[0]) or ball.inner
    to_slots = ball.radius_mm * (ball.slot_end - opening)
    if not 0.0 < ball.bore_mm < ball.hub_mm:
        return to_slots
    bored = reach_or_bore(parts.mechanism.spec.size, "wheel", ball.bore_mm)
    refuse_bored_hub("wheel", ball.hub_mm, bored, ball.bore_mm)
    return min(to_slots, ball.hub_mm - bored)


class _Sweep(NamedTuple):
    """The region that a part sweeps in a whole turn: between two angles and two spheres."""

    # A round part begins at the sphere that touches its flat end, which limits it on larger ones.

    back: bool  # on the far side of the centre
    low: float
    high: float
    inner: float
    outer: float
    wide: float = 0.0  # radius of a round part, mm


def _shaft_gaps(parts: SphereParts) -> Iterator[float]:
    """Yield the gaps of hubs and shafts to parts about the other axis, mm along a sphere."""
    ball, arm, sectors = parts.ball, parts.arm, parts.shape.crank
    on_wheel, on_crank = list[_Sweep](), list[_Sweep]()
    for member in parts.members:
        for plate in (p for p in plates(member.part) if p.layer != "ROLLER"):
            (on_crank if member.frame else on_wheel).extend(_round(plate))
    # what arm, locking sectors and rollers sweep about the crank's axis
    low, high = ball.arm - ball.roller, ball.arm + ball.roller
    out = ball.arm_span_mm[1] if arm else ball.span_mm[1]
    crank_rings = [_Sweep(False, low, high, ball.span_mm[0], out)]
    if arm:
        crank_rings.append(_Sweep(False, 0.0, arm.reach, *ball.arm_span_mm))
    if sectors:
        low = min(math.pi - sector.boundary[2].angle for sector in sectors)
        crank_rings.append(_Sweep(False, low, ball.lock, *ball.lock_span_mm))
    ring = _Sweep(False, 0.0 if ball.opening_mm else ball.inner, ball.rim, *ball.span_mm)
    pairs = [*product(on_wheel, [*on_crank, *crank_rings]), *((one, ring) for one in on_crank)]
    for one, other in pairs:
        low, high = max(one.inner, other.inner), min(one.outer, other.outer)
        if high - low > SAME_LENGTH * ball.radius_mm:
            # beyond these spheres both angles only shrink, and an arc grows with its sphere
            grow = (math.hypot(each.inner, each.wide) for each in (one, other) if each.wide)
            sphere = np.linspace(low, min(high, max((low, *grow))), 257)
            sphere = sphere[sphere > 0.0]  # both may be at the centre
            apart = ball.axes if one.back is other.back else math.pi - ball.axes
            away = ring_gap(apart, other.low, _angle(other, sphere), _angle(one, sphere))
            yield float((sphere * away).min())


def _round(plate: Plate) -> Iterator[_Sweep]:
    """Yield the region that a round plate sweeps on each side of the centre: the plate itself."""
    wide = plate.bore.around if plate.bore else shapes.bounds(plate.outline).x1
    for back, low, high in ((False, plate.low, plate.high), (True, -plate.high, -plate.low)):
        if high > 0.0:
            yield _Sweep(back, 0.0, 0.0, max(low, 0.0), math.hypot(high, wide), wide)


def _angle(part: _Sweep, sphere: Array) -> Array:
    """Return the greatest angle of a part from its axis on spheres (n,), radians."""
    if not part.wide:
        return np.full_like(sphere, part.high)
    end = np.arccos(np.minimum(1.0, part.inner / sphere))
    return np.minimum(np.arcsin(np.minimum(1.0, part.wide / sphere)), end)
