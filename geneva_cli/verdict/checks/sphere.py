"""Walls and shafts of a spherical machine, mm along the sphere.

A shaft is round about its axis, with its surface as far from it as a plate's would be: seen from
the sphere's centre it fills a cone.
"""

from __future__ import annotations

import math

from geneva_cli.parts.sphere.shells import Shells
from geneva_cli.verdict.checks.check import Check, compared


def between_slots(name: str, found: Shells) -> Check:
    """Between a slot and the next one: at their ends, or at a rim past a quarter of the sphere."""
    ball = found.ball
    apart = 2.0 * math.asin(math.sin(ball.bottom) * math.sin(ball.half_step))
    wall = apart - 2.0 * ball.half_width
    if ball.rim > 0.5 * math.pi:
        corners = math.sin(ball.rim) * math.sin(ball.half_step - ball.corner())
        wall = min(wall, 2.0 * math.asin(corners))
    return _wall(name, wall, found)


def horn(name: str, found: Shells) -> Check | None:
    """Between a slot and the recess that the locking sectors run in."""
    if not found.crank:
        return None
    return compared(name, found.sizes.horn, "at least", found.sizes.wall_min)


def wheel_bore(name: str, found: Shells) -> Check:
    """Between the opening about the wheel's axis and the ends of its slots."""
    ball = found.ball
    return _wall(name, ball.bottom - ball.half_width - ball.inner, found)


def crank_shaft(name: str, found: Shells) -> Check | None:
    """The crank's shaft or hub, whichever is thicker, and the wheel's rim."""
    size, ball = found.assembly.given.spec.size, found.ball
    if not size.crank_bore_mm:
        return None
    shaft = _cone(max(size.crank_bore_mm, size.crank_hub_mm or 0.0), found)
    # a rim that lies beyond the crank's axis sweeps over it, and there is no room at all
    room = max(ball.axes - ball.rim, 0.0)
    return _room(name, room - shaft, found)


def wheel_shaft(name: str, found: Shells) -> Check | None:
    """The wheel's shaft or hub and a roller at the end of its slot."""
    size, ball = found.assembly.given.spec.size, found.ball
    widest = max(size.wheel_bore_mm or 0.0, size.wheel_hub_mm or 0.0)
    if not widest:
        return None
    return _room(name, ball.bottom - ball.half_width - _cone(widest, found), found)


def arm_to_hub(name: str, found: Shells) -> Check | None:
    """Between the arm's end, as it passes the wheel on its own shell, and the wheel's hub."""
    size, ball = found.assembly.given.spec.size, found.ball
    if size.arm_eye_mm is None:
        return None
    hub = _cone(max(size.wheel_hub_mm or 0.0, size.wheel_bore_mm or 0.0), found)
    eye = 0.5 * size.arm_eye_mm / ball.radius_mm
    return _room(name, ball.axes - ball.arm - eye - hub, found)


def _cone(diameter_mm: float, found: Shells) -> float:
    """The half angle under which a round shaft is seen where it passes the sphere."""
    return math.asin(min(1.0, 0.5 * diameter_mm / found.ball.radius_mm))


def _room(name: str, angle: float, found: Shells) -> Check:
    return compared(name, angle * found.ball.radius_mm, "at least", 0.0)


def _wall(name: str, angle: float, found: Shells) -> Check:
    return compared(name, angle * found.ball.radius_mm, "at least", found.sizes.wall_min)
