"""The holes for a dial in a spherical wheel: about its axis, between hub and slots."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.round_holes import RoundHole, least_wall
from geneva_cli.geometry.sphere import POLE, place
from geneva_cli.geometry.sphere_hull import Cap
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.wheel import web_angle
from geneva_cli.parts.shafts.screws import bolt_circle
from geneva_cli.spec.tables import Size


def dial_holes(size: Size, ball: Ball) -> tuple[RoundHole, ...]:
    """Return the holes of the dial's bolts, evenly spaced and pointing at the centre.

    The first lies in the middle between two slots. Raises GenevaError where the wheel is open about
    its axis, or the holes do not fit.
    """
    if not size.dial_bolts:
        return ()
    if not ball.opening_mm:
        raise GenevaError(
            "dial_bolts: the wheel is open about its axis, so the bolts have no material around "
            "them; set wheel_bore_mm, or remove dial_bolts",
            ("size", "dial_bolts"),
        )
    L, inside, high = ball.radius_mm, ball.span_mm[0], web_angle(ball)
    low = RoundHole(POLE, ball.opening_mm).angle(inside)
    bolts = bolt_circle(size, "dial", L, (L * low, L * high), ball.half_step)
    far, r = bolts.radius / L, bolts.hole
    if size.dial_bolt_circle_mm is not None:  # a diameter, not an arc as the ring's
        far = math.asin(min(1.0, far))
    holes = tuple(RoundHole(place(far, azimuth), r) for azimuth in bolts.turns)
    all_holes = RoundHole(POLE, ball.opening_mm), *holes
    if least_wall(Cap(POLE, high).region, all_holes, inside) <= 0.0:
        circles = [f"{2.0 * L * math.sin(angle):.6g}" for angle in (far, low, high)]
        raise GenevaError(
            f"dial_bolts: {2.0 * r:.6g} mm holes on a {circles[0]} mm circle overlap, or cut hub "
            f"or slots; they must lie between circles of {circles[1]} and {circles[2]} mm",
            ("size", "dial_bolts"),
        )
    return holes


def dial_wall(size: Size, ball: Ball) -> float:
    """Return the least wall between the dial's holes, the hub and the slots' ends, mm."""
    ends = Cap(POLE, min(ball.bottom - ball.half_width, 0.5 * math.pi)).region
    holes = RoundHole(POLE, ball.opening_mm), *dial_holes(size, ball)
    return least_wall(ends, holes, ball.span_mm[0])
