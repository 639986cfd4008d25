"""A spherical crank as regions of its sphere: locking sectors and rollers on its arm.

They are in the crank's frame: its axis is z, and the first roller is on the azimuth 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from geneva_cli.geometry.sphere import POLE, Region, Rotation, SphereArc, cross, opposite, place
from geneva_cli.geometry.sphere_hull import Cap
from geneva_cli.kinds.spherical.ball import Ball, PartDoesNotFit
from geneva_cli.kinds.spherical.wheel import QUARTER, edge_points
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.outlines.crank_outline import widest


def sectors(ball: Ball) -> list[Region]:
    """Return the locking sectors of the crank, outside the region that the wheel sweeps.

    Each lies between two rollers, and is as wide as the wheel leaves free. Raises PartDoesNotFit
    where nothing is left of one.
    """
    spare = min(0.25 * (ball.recess - ball.lock) + 0.1 * ball.roller, 0.1 * ball.lock)
    # shaft and hub fill a cone about the axis, up to their end
    about = math.asin(min(1.0, ball.about_crank_mm / ball.lock_span_mm[0]))
    # A sector's inner edge is a fifth of its outer one, or farther out where the wheel needs that.
    least = max(0.2 * ball.lock, about)
    spans, most = locked(ball), (1.0 - 0.05) * ball.lock  # a thinner ring would hold nothing
    if spans and about > most:
        wide = 2.0 * ball.lock_span_mm[0] * math.sin(most)
        raise PartDoesNotFit(
            "the crank's shaft and hub leave nothing of the locking sector: crank_bore_mm and "
            f"crank_hub_mm must be below {wide:.4g}, or lock_radius_mm greater, or 0 for none",
            ("size", "crank_bore_mm"),
        )
    paths = cache(lambda: swept(ball))

    def sector(start: float, end: float) -> Region:
        middle = 0.5 * (start + end)
        reached = _reached(ball, paths(), middle)

        def nearest(half: float) -> float:
            return max(reached(half) + spare, least)

        half = widest(0.5 * (end - start), lambda half: nearest(half) <= most)
        if half is None:
            raise PartDoesNotFit(
                "the wheel sweeps over the whole locking sector: another lock_radius_mm may leave "
                "part of it; 0 omits it",
                ("size", "lock_radius_mm"),
            )
        return _sector(ball.lock, nearest(half), middle - half, middle + half)

    return [sector(*span) for span in spans]


def locked(ball: Ball) -> list[tuple[float, float]]:
    """Return the azimuths about the crank's axis, from and to, between which the crank locks."""
    if not ball.lock:
        return []
    after = (*ball.rollers[1:], ball.rollers[0] + math.tau)
    spans = [
        (a + ball.half_motion, b - ball.half_motion)
        for a, b in zip(ball.rollers, after, strict=True)
    ]
    return [(a, b) for a, b in spans if b - a > SAME_ANGLE]


def _sector(high: float, low: float, start: float, end: float) -> Region:
    """Return a sector from one azimuth to another, between two angles from the axis."""
    far, near = ([place(polar, a) for a in (start, end)] for polar in (high, low))
    sides = [(-math.sin(a), math.cos(a), 0.0) for a in (start, end)]
    boundary = (
        SphereArc(POLE, high, far[0], far[1]),
        SphereArc(opposite(sides[1]), QUARTER, far[1], near[1]),
        SphereArc(opposite(POLE), math.pi - low, near[1], near[0]),
        SphereArc(sides[0], QUARTER, near[0], far[0]),
    )
    return Region(boundary, POLE)


def rollers(ball: Ball) -> list[Region]:
    """Return the rollers' cones."""
    return [Cap(place(ball.arm, azimuth), ball.roller).region for azimuth in ball.rollers]


def at_mid_motion(ball: Ball) -> Rotation:
    """Return the crank's frame in the wheel's frame, with the first roller at mid-motion."""
    axis = ball.crank_axis(0.0)
    ahead = place(ball.axes - QUARTER, 0.0)
    return Rotation(ahead, cross(axis, ahead), axis)


def _reached(ball: Ball, paths: tuple[Array, Array], middle: float) -> Callable[[float], float]:
    """Return a function of half an azimuth range: the greatest polar angle that the wheel reaches.

    The range is centred on ``middle``, over all motions. Angles are radians from the crank's axis;
    the result is 0 where the wheel stays outside the locking edge.
    """
    polar, azimuth = paths
    ahead = [azimuth + turn - middle for turn in ball.rollers]
    off = np.abs(np.remainder(np.stack(ahead) + math.pi, math.tau) - math.pi)
    near = polar < ball.lock * (1.0 - SAME_ANGLE)

    def reached(half: float) -> float:
        inside = near & (off < half * (1.0 - SAME_ANGLE))
        # a point that is inside at one position counts at the adjacent ones too
        inside[:, 1:] |= inside[:, :-1]
        inside[:, :-1] |= inside[:, 1:]
        return min(ball.lock, float((polar * inside).max(initial=0.0)))

    return reached


def swept(ball: Ball) -> tuple[Array, Array]:
    """Return the paths of points of the wheel's edge in the crank's frame, in the first motion.

    These are polar angles from the crank's axis and azimuths about it, radians, one row for each
    position. Only points that come within the locking edge are included. The crank turns clockwise
    about its axis where the wheel turns counterclockwise.
    """
    frame = np.column_stack(at_mid_motion(ball))
    wheel = edge_points(ball, 100)
    # the wheel turns by half a step either way: the position nearest to the crank's axis counts
    off = np.maximum(np.abs(np.arctan2(wheel[:, 1], wheel[:, 0])) - ball.half_step, 0.0)
    flat = math.sin(ball.axes) * np.hypot(wheel[:, 0], wheel[:, 1]) * np.cos(off)
    wheel = wheel[math.cos(ball.axes) * wheel[:, 2] + flat > math.cos(ball.lock) - SAME_ANGLE]
    turns = np.linspace(-ball.half_motion, ball.half_motion, 361)
    x, y, up = np.moveaxis((wheel @ _index(ball, frame, turns)) @ frame, -1, 0)
    # the limit is below the locking edge's angle, so that points along the edge do not count
    comes = np.flatnonzero(up.max(axis=0) > math.cos((1.0 - 0.5 * SAME_ANGLE) * ball.lock))
    x, y, up = x[:, comes], y[:, comes], up[:, comes]
    return np.arctan2(np.hypot(x, y), up), np.arctan2(y, x) + turns[:, None]


def _index(ball: Ball, frame: Array, turns: Array) -> Array:
    """Return the rotations of the wheel that bring its slot under the roller, (n, 3, 3).

    They multiply rows of points.
    """
    flat, up = math.sin(ball.arm), np.full(len(turns), math.cos(ball.arm))
    x, y, _ = frame @ np.stack((flat * np.cos(turns), -flat * np.sin(turns), up))
    away = np.hypot(x, y)
    c, s, no = x / away, y / away, 0.0 * away
    rows = np.array(((c, s, no), (-s, c, no), (no, no, 1.0 + no)))
    return np.ascontiguousarray(np.moveaxis(rows, -1, 0))
