"""Checks of walls, arm and shafts of a spherical machine, mm along the sphere."""

from __future__ import annotations

import math

from geneva_cli.geometry.round_holes import RoundHole
from geneva_cli.geometry.sphere import POLE
from geneva_cli.kinds.spherical.dial import dial_wall
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.shaft_gap import shaft_gap
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import refuse_thin_hub
from geneva_cli.verdict.checks.check import Check, at_least, compared, gap
from geneva_cli.verdict.checks.clearances import built, cut_width, plate_thickness


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


def wheel_bore(name: str, parts: SphereParts) -> Check | None:
    """The wall between the slots' ends and what is about the wheel's axis, and the hub's own."""
    ball = parts.ball
    opening = RoundHole(POLE, ball.opening_mm).angle(ball.span_mm[0]) or ball.inner
    to_slots = ball.radius_mm * (ball.slot_end - opening)

    def least() -> float:
        return min(to_slots, _in_hub("wheel", parts) or math.inf)

    return at_least(name, least, parts.shells.sizes.wall_min)


def crank_bore(name: str, parts: SphereParts) -> Check | None:
    """The wall around the bore of the crank's hub inside the arm; None without that hub."""
    return at_least(name, lambda: _in_hub("crank", parts), parts.shells.sizes.wall_min)


def _in_hub(part: str, parts: SphereParts) -> float | None:
    """Return the wall of a hub around its bore and keyway, mm; None without hub or bore.

    Raises GenevaError, naming the key, for a hub that its keyway cuts through.
    """
    bore, hub = parts.hub_radii(part)
    if not 0.0 < bore < hub:
        return None
    bored = reach_or_bore(parts.mechanism.spec.size, part, bore)
    refuse_thin_hub(part, hub, bored, bore)
    return hub - bored


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


def thickest(name: str, parts: SphereParts) -> Check | None:
    """The thickest shell of a sphere, where the process has a limit for plates."""
    ball = parts.ball
    spans = ball.span_mm, ball.lock_span_mm, ball.arm_span_mm
    return plate_thickness(name, parts.mechanism, max(outer - inner for inner, outer in spans))


def slot_width(name: str, parts: SphereParts) -> Check | None:
    """The width of a sphere's slots inside, where the process cuts none that is narrow."""
    inner, outer = parts.ball.span_mm
    wide = 2.0 * inner * math.sin(parts.ball.half_width)
    return cut_width(name, parts.mechanism, wide, outer - inner)


def solids_built(name: str, parts: SphereParts) -> Check | None:
    """The check that fails if a solid of a spherical machine cannot be built; else None."""
    return built(name, lambda: parts.members)


def _wall(name: str, angle: float, parts: SphereParts) -> Check:
    return compared(name, angle * parts.ball.radius_mm, "at least", parts.shells.sizes.wall_min)
