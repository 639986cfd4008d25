"""A spherical wheel as adjacent regions of its sphere, one about each slot.

The wheel's axis is z, and the first slot is on the azimuth 0. The slot's walls are the circles that
its roller's cone touches, with a round at its end. The rim is a circle about the wheel's axis, the
recesses are circles about the crank's.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.geometry.sphere import POLE, Region, SphereArc, Vector, combined, opposite, place
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.numerics.arrays import Array

QUARTER = 0.5 * math.pi


def wheel_regions(ball: Ball, inner: float) -> list[Region]:
    """Return the wheel's slotted ring from a polar angle outwards, one region for each slot.

    Adjacent regions share the meridian between their slots.
    """
    b, z = ball.half_step, ball.z
    between = [place(_end(ball), (2 * k - 1) * b) for k in range(z)]
    ends = [place(inner, (2 * k - 1) * b) for k in range(z)]
    regions = []
    for k in range(z):
        after = (k + 1) % z
        sides = (between[k], between[after]), (ends[k], ends[after])
        regions.append(_region(ball, 2 * k * b, *sides, inner))
    return regions


def web_angle(ball: Ball) -> float:
    """Return the polar angle of the cap about the wheel's axis that closes its slotted ring."""
    return min(ball.inner, 1.0)  # radian: a cap far from the edge


def web_region(ball: Ball, inner: float) -> Region:
    """Return the cap about the wheel's axis that closes its slotted ring."""
    b, z = ball.half_step, ball.z
    at = [place(inner, (2 * k - 1) * b) for k in range(z)]
    return Region(tuple(SphereArc(POLE, inner, at[k], at[(k + 1) % z]) for k in range(z)), POLE)


def edge(ball: Ball, at: float = 0.0) -> list[SphereArc]:
    """Return the edge about the slot at an azimuth, from the meridian before it to the next."""
    b = ball.half_step
    return _edge(ball, at, place(_end(ball), at - b), place(_end(ball), at + b))


def edge_points(ball: Ball, each: int = 200) -> Array:
    """Return points along the edge of the whole wheel, (n, 3), ``each`` on every arc."""
    fractions = np.arange(each) / each
    one = np.concatenate([arc.at(arc.sweep * fractions)[0] for arc in edge(ball)])
    angle = 2.0 * ball.half_step * np.arange(ball.z)[:, None]  # of each slot
    c, s = np.cos(angle), np.sin(angle)
    x, y, up = one.T
    slots = np.broadcast_arrays(x * c - y * s, x * s + y * c, up)
    return np.stack(slots, axis=2).reshape(-1, 3)


def _end(ball: Ball) -> float:
    """Return the polar angle of the edge on the meridian between two slots."""
    return ball.axes - ball.recess if ball.recess else ball.rim


def _region(
    ball: Ball,
    at: float,
    between: tuple[Vector, Vector],
    ends: tuple[Vector, Vector],
    inner: float,
) -> Region:
    b = ball.half_step
    sides = [(-math.sin(a), math.cos(a), 0.0) for a in (at - b, at + b)]
    up = SphereArc(sides[0], QUARTER, ends[0], between[0])
    down = SphereArc(opposite(sides[1]), QUARTER, between[1], ends[1])
    back = SphereArc(opposite(POLE), math.pi - inner, ends[1], ends[0])
    middle = place(0.5 * (inner + ball.rim), at)
    return Region((*_edge(ball, at, *between), down, back, up), middle)


def _edge(ball: Ball, at: float, start: Vector, end: Vector) -> list[SphereArc]:
    """Return recess, rim, wall, round, wall, rim and recess, counterclockwise."""
    b, w, corner = ball.half_step, ball.half_width, ball.corner()
    out = []
    low, high = start, end
    if ball.recess:
        low = place(ball.rim, at - b + ball.opened())
        high = place(ball.rim, at + b - ball.opened())
        out.append(_recess(ball, at - b, start, low))
    mouths = [place(ball.rim, at - corner), place(ball.rim, at + corner)]
    middle, across = place(ball.bottom, at), (-math.sin(at), math.cos(at), 0.0)
    ends = [_offset(middle, across, -w), _offset(middle, across, w)]
    wall = QUARTER - w
    out += [
        SphereArc(POLE, ball.rim, low, mouths[0]),
        SphereArc(opposite(across), wall, mouths[0], ends[0]),
        SphereArc(opposite(middle), math.pi - w, ends[0], ends[1]),
        SphereArc(across, wall, ends[1], mouths[1]),
        SphereArc(POLE, ball.rim, mouths[1], high),
    ]
    if ball.recess:
        out.append(_recess(ball, at + b, high, end))
    return out


def _recess(ball: Ball, azimuth: float, start: Vector, end: Vector) -> SphereArc:
    return SphereArc(opposite(ball.crank_axis(azimuth)), math.pi - ball.recess, start, end)


def _offset(at: Vector, across: Vector, angle: float) -> Vector:
    """Return the point at an angle from ``at`` along the great circle towards ``across``."""
    return combined(at, math.cos(angle), across, math.sin(angle))
