"""The dimensions of a spherical machine: radii of its shells, and angles to make them by."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.geometry.round_holes import RoundHole
from geneva_cli.geometry.sphere import Region
from geneva_cli.kinds.spherical.arm import CapArm
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.dial import dial_holes
from geneva_cli.kinds.spherical.laid_flat import crank_cone, wheel_cone
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.motion.pivots import Dimension
from geneva_cli.parts.projection import Missing, or_missing


def dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    """Yield the dimensions of the parts; for those that cannot be built, the reason."""
    return or_missing("dimensions of the shells", lambda: _dimensions(parts))


def _dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    """Yield dimensions of shells, arm and cones."""
    ball = parts.ball
    inner, outer = ball.span_mm
    yield Dimension("shells' inner radius", inner, "mm")
    yield Dimension("shells' outer radius", outer, "mm")
    yield Dimension("roller's cone, half angle", math.degrees(ball.roller), "deg")
    yield Dimension("slot, between its walls", ball.slot_width_deg, "deg")
    yield Dimension("slot's last round, from the wheel's axis", math.degrees(ball.bottom), "deg")
    yield Dimension("rim, from the wheel's axis", math.degrees(ball.rim), "deg")
    yield Dimension("slotted ring's inner edge, from its axis", math.degrees(ball.inner), "deg")
    yield from _axle("wheel", ball.bore_mm, ball.hub_mm)
    size = parts.mechanism.spec.size
    yield from or_missing("dial's bolts", lambda: _bolts("dial's bolt", dial_holes(size, ball)))
    if ball.lock:
        yield Dimension("lock, from the crank's axis", math.degrees(ball.lock), "deg")
        yield Dimension("recess, from the crank's axis", math.degrees(ball.recess), "deg")
        yield Dimension("locking sectors' inner radius", ball.lock_span_mm[0], "mm")
    for k, region in enumerate(parts.shells.crank):
        yield from _sector(f"locking sector {k + 1}", region)
    yield from or_missing("arm's dimensions", lambda: _arm(ball, parts.arm))
    yield from _cones(ball)


def _axle(part: str, bore: float, hub: float) -> Iterator[Dimension]:
    """Yield the diameters of a bore and of the hub around it."""
    if bore:
        yield Dimension(f"{part}'s bore", 2.0 * bore, "mm")
    if hub > bore:
        yield Dimension(f"{part}'s hub", 2.0 * hub, "mm")


def _sector(name: str, region: Region) -> Iterator[Dimension]:
    rim, _, inner, _ = region.boundary
    start = math.atan2(rim.start[1], rim.start[0]) % math.tau
    yield Dimension(f"{name}: inner edge", 180.0 - math.degrees(inner.angle), "deg")
    yield Dimension(f"{name}: begins", math.degrees(start), "deg")
    yield Dimension(f"{name}: width", math.degrees(rim.sweep), "deg")


def _arm(ball: Ball, arm: CapArm | None) -> Iterator[Dimension]:
    if arm is None:
        return
    inner, outer = ball.arm_span_mm
    yield Dimension("arm's inner radius", inner, "mm")
    yield Dimension("arm's outer radius", outer, "mm")
    yield from _axle("arm", arm.bore.radius, arm.hub)
    yield Dimension("arm's cap, from the crank's axis", math.degrees(arm.cap), "deg")
    yield Dimension("arm's eyes, half angle", math.degrees(arm.eye), "deg")
    yield Dimension("pins", 2.0 * ball.pin_mm, "mm")
    yield Dimension("pins' holes in the arm", 2.0 * arm.pins[0].radius, "mm")
    yield from _bolts("lock's bolt", arm.bolts)


def _bolts(name: str, holes: tuple[RoundHole, ...]) -> Iterator[Dimension]:
    for k, bolt in enumerate(holes, 1):
        polar, azimuth = math.acos(bolt.axis[2]), math.atan2(bolt.axis[1], bolt.axis[0])
        yield Dimension(f"{name} {k}: hole", 2.0 * bolt.radius, "mm")
        yield Dimension(f"{name} {k}: from the axis", math.degrees(polar), "deg")
        yield Dimension(f"{name} {k}: azimuth", math.degrees(azimuth), "deg")


def _cones(ball: Ball) -> Iterator[Dimension]:
    for whose, cone in (("wheel", wheel_cone(ball)), ("crank", crank_cone(ball))):
        at = math.degrees(cone.polar)
        yield Dimension(f"{whose} laid flat: cone touches the sphere at", at, "deg")
        yield Dimension(f"{whose} laid flat: from there to its apex", abs(cone.apex_mm), "mm")
        yield Dimension(f"{whose} laid flat: sector", cone.sector_deg, "deg")
