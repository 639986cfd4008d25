"""Checks of walls, arm and shafts of a spherical machine, mm along the sphere."""

from __future__ import annotations

import math

from geneva_cli.curves.round_holes import RoundHole
from geneva_cli.drawings.sphere.shaft_gap import shaft_gap
from geneva_cli.outlines.sphere_wheel import POLE
from geneva_cli.parts.sphere.dial import dial_wall
from geneva_cli.parts.sphere.sphere_parts import SphereParts
from geneva_cli.verdict.checks.check import Check, at_least, compared, gap


def between_slots(name: str, parts: SphereParts) -> Check:
    """The wall between adjacent slots: at their ends, or at a rim beyond a quarter sphere."""
    ball = parts.ball
    apart = 2.0 * math.asin(math.sin(ball.bottom) * math.sin(ball.half_step))
    wall = apart - 2.0 * ball.half_width
    if ball.rim > 0.5 * math.pi:
        corners = math.sin(ball.rim) * math.sin(ball.half_step - ball.corner())
        wall = min(wall, 2.0 * math.asin(corners))
    return _wall(name, wall, parts)


def horn(name: str, parts: SphereParts) -> Check | None:
    """The wall between a slot and the recess of the locking sectors."""
    sizes = parts.shells.sizes
    return compared(name, sizes.horn, "at least", sizes.wall_min) if parts.shells.crank else None


def wheel_bore(name: str, parts: SphereParts) -> Check:
    """The wall between the slots' ends and the bore, hub or opening about the wheel's axis."""
    ball = parts.ball
    opening = RoundHole(POLE, ball.opening_mm).angle(ball.span_mm[0]) or ball.inner
    return _wall(name, ball.bottom - ball.half_width - opening, parts)


def dial(name: str, parts: SphereParts) -> Check | None:
    """The least wall around the holes for a dial."""
    size = parts.mechanism.spec.size
    if not size.dial_bolts:
        return None
    return at_least(name, lambda: dial_wall(size, parts.ball), parts.shells.sizes.wall_min)


def crank_shaft(name: str, parts: SphereParts) -> Check | None:
    """The gap between the crank's shaft or hub, whichever is thicker, and the wheel's rim."""
    ball = parts.ball
    if not ball.about_crank_mm:
        return None
    shaft = RoundHole(POLE, ball.about_crank_mm).angle(ball.span_mm[0])
    # a rim beyond the crank's axis sweeps over it, so there is no clearance at all
    rim_gap = max(ball.axes - ball.rim, 0.0)
    return compared(name, (rim_gap - shaft) * ball.radius_mm, "at least", 0.0)


def arm_wall(name: str, parts: SphereParts) -> Check | None:
    """The least wall around the holes of the crank arm, and of bolts in the locking sectors."""
    wall_min = parts.shells.sizes.wall_min
    return at_least(name, lambda: parts.arm.wall if parts.arm else None, wall_min)


def passing_parts(name: str, parts: SphereParts) -> Check | None:
    """The gap between hubs or shafts and parts that turn about the other axis.

    The checks of walls report a missing arm, or a dial's bolts without a place.
    """
    walls = [check(name, parts) for check in (arm_wall, dial)]
    if any(row and row.value is None for row in walls):
        return None
    return gap(name, lambda: shaft_gap(parts), parts.ball.radius_mm)


def _wall(name: str, angle: float, parts: SphereParts) -> Check:
    return compared(name, angle * parts.ball.radius_mm, "at least", parts.shells.sizes.wall_min)
