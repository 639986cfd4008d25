"""Wheel and crank of a spherical machine as regions of its sphere.

The wheel's axis is z, and its first slot is on the azimuth 0. The slot's walls are the circles that
its roller's cone touches, with a round at its end. The rim is a circle about the wheel's axis, the
recesses are circles about the crank's. Locking sectors and rollers are in the crank's frame: its
axis is z, and the first roller is on the azimuth 0.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sphere import (
    POLE,
    Cap,
    Region,
    Rotation,
    SphereArc,
    combined,
    cross,
    opposite,
    place,
)
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.outlines.crank_outline import widest

QUARTER = 0.5 * math.pi


def wheel_regions(ball: Ball) -> list[Region]:
    """Return the wheel: a region for each slot, up to the next, and the cap that closes the ring.

    A ring without a hole for shaft or hub stays open.
    """
    b, z = ball.half_step, ball.z
    inner = min(ball.inner, 1.0) if ball.opening_mm else ball.inner  # radian: far from the edge
    azimuths = [(2 * k - 1) * b for k in range(z)]  # between slots; the last is before the first
    outer, ends = ([place(p, a) for a in azimuths] for p in (ball.between_slots, inner))
    regions = []
    for k in range(z):
        at, after = 2 * k * b, (k + 1) % z
        left, right = ((-math.sin(a), math.cos(a), 0.0) for a in (at - b, at + b))
        sides = (
            SphereArc(opposite(right), QUARTER, outer[after], ends[after]),
            SphereArc(opposite(POLE), math.pi - inner, ends[after], ends[k]),
            SphereArc(left, QUARTER, ends[k], outer[k]),
        )
        middle = place(0.5 * (inner + ball.rim), at)
        edges = edge(ball, at)
        edges[0] = edges[0]._replace(start=outer[k])
        edges[-1] = edges[-1]._replace(end=outer[after])
        regions.append(Region((*edges, *sides), middle))
    if ball.opening_mm:
        pairs = zip(ends, [*ends[1:], ends[0]], strict=True)
        regions.append(Region(tuple(SphereArc(POLE, inner, *pair) for pair in pairs), POLE))
    return regions


def edge(ball: Ball, at: float = 0.0) -> list[SphereArc]:
    """Return the edge about the slot at an azimuth, from the meridian before it to the next."""
    b, w, corner = ball.half_step, ball.half_width, ball.corner
    start, end = (place(ball.between_slots, at + side * b) for side in (-1.0, 1.0))
    low, high = start, end
    if ball.recess:
        low, high = (place(ball.rim, at + side * (b - ball.opened)) for side in (-1.0, 1.0))
    mouths = [place(ball.rim, at + side * corner) for side in (-1.0, 1.0)]
    middle, across = place(ball.bottom, at), (-math.sin(at), math.cos(at), 0.0)
    ends = [combined(middle, math.cos(w), across, side * math.sin(w)) for side in (-1.0, 1.0)]
    arcs = [
        SphereArc(POLE, ball.rim, low, mouths[0]),
        SphereArc(opposite(across), QUARTER - w, mouths[0], ends[0]),
        SphereArc(opposite(middle), math.pi - w, ends[0], ends[1]),
        SphereArc(across, QUARTER - w, ends[1], mouths[1]),
        SphereArc(POLE, ball.rim, mouths[1], high),
    ]
    if ball.recess:
        before, after = (opposite(place(ball.axes, at + side * b)) for side in (-1.0, 1.0))
        arcs.insert(0, SphereArc(before, math.pi - ball.recess, start, low))
        arcs.append(SphereArc(after, math.pi - ball.recess, high, end))
    return arcs


def edge_points(ball: Ball, each: int = 200) -> Array:
    """Return points along the edge of the whole wheel, (n, 3), ``each`` on every arc."""
    fractions = np.arange(each) / each
    one = np.concatenate([arc.at(arc.sweep * fractions)[0] for arc in edge(ball)])
    angle = 2.0 * ball.half_step * np.arange(ball.z)[:, None]  # of each slot
    c, s = np.cos(angle), np.sin(angle)
    x, y, up = one.T
    slots = np.broadcast_arrays(x * c - y * s, x * s + y * c, up)
    return np.stack(slots, axis=2).reshape(-1, 3)


def sectors(ball: Ball) -> list[Region]:
    """Return the locking sectors of the crank, outside the region that the wheel sweeps."""
    spare = min(0.25 * (ball.recess - ball.lock) + 0.1 * ball.roller, 0.1 * ball.lock)
    # A sector's inner edge is a fifth of its outer one, or farther out where the wheel needs that.
    least = 0.2 * ball.lock
    spans, most = locked(ball), (1.0 - 0.05) * ball.lock  # a thinner ring would hold nothing
    polar, azimuth = swept(ball) if spans else (np.zeros((1, 1)), np.zeros((1, 1)))
    near = polar < ball.lock * (1.0 - SAME_ANGLE)

    def sector(start: float, end: float) -> Region:
        middle = 0.5 * (start + end)
        ahead = np.stack([azimuth + turn - middle for turn in ball.rollers])
        off = np.abs(within_half_turn(ahead))

        @cache
        def nearest(half: float) -> float:
            """Return the polar angle that the wheel leaves free, over half a range of azimuths."""
            inside = near & (off < half * (1.0 - SAME_ANGLE))
            # a point that is inside at one position counts at the adjacent ones too
            inside[:, 1:] |= inside[:, :-1]
            inside[:, :-1] |= inside[:, 1:]
            reached = min(ball.lock, float((polar * inside).max(initial=0.0)))
            return max(reached + spare, least)

        half = widest(0.5 * (end - start), lambda half: nearest(half) <= most)
        if half is None:
            text = "the wheel sweeps over the whole locking sector: another lock_radius_mm may "
            raise GenevaError(text + "leave part of it; 0 omits it", ("size", "lock_radius_mm"))
        high, low, ends = ball.lock, nearest(half), (middle - half, middle + half)
        far, inner = ([place(polar, a) for a in ends] for polar in (high, low))
        sides = [(-math.sin(a), math.cos(a), 0.0) for a in ends]
        boundary = (
            SphereArc(POLE, high, far[0], far[1]),
            SphereArc(opposite(sides[1]), QUARTER, far[1], inner[1]),
            SphereArc(opposite(POLE), math.pi - low, inner[1], inner[0]),
            SphereArc(sides[0], QUARTER, inner[0], far[0]),
        )
        return Region(boundary, POLE)

    return [sector(*span) for span in spans]


def locked(ball: Ball) -> list[tuple[float, float]]:
    """Return the azimuths about the crank's axis, from and to, between which the crank locks."""
    if not ball.lock:
        return []
    after = (*ball.rollers[1:], ball.rollers[0] + math.tau)
    pairs = zip(ball.rollers, after, strict=True)
    spans = [(a + ball.half_motion, b - ball.half_motion) for a, b in pairs]
    return [(a, b) for a, b in spans if b - a > SAME_ANGLE]


def rollers(ball: Ball) -> list[Region]:
    """Return the rollers' cones."""
    return [Cap(place(ball.arm, azimuth), ball.roller).region for azimuth in ball.rollers]


def at_mid_motion(ball: Ball) -> Rotation:
    """Return the crank's frame in the wheel's frame, with the first roller at mid-motion."""
    axis, ahead = place(ball.axes, 0.0), place(ball.axes - QUARTER, 0.0)
    return Rotation(ahead, cross(axis, ahead), axis)


def swept(ball: Ball) -> tuple[Array, Array]:
    """Return the paths of points of the wheel's edge in the crank's frame, in the first motion.

    These are polar angles from the crank's axis and azimuths about it, radians, one row for each
    position, of points that come within the locking edge.
    """
    frame = np.column_stack(at_mid_motion(ball))
    wheel = edge_points(ball, 100)
    # the wheel turns by half a step either way: the position nearest to the crank's axis counts
    off = np.maximum(np.abs(np.arctan2(wheel[:, 1], wheel[:, 0])) - ball.half_step, 0.0)
    nearest = math.sin(ball.axes) * np.hypot(wheel[:, 0], wheel[:, 1]) * np.cos(off)
    nearest += math.cos(ball.axes) * wheel[:, 2]
    wheel = wheel[nearest > math.cos(ball.lock) - SAME_ANGLE]
    turns = np.linspace(-ball.half_motion, ball.half_motion, 361)
    # rotations (n, 3, 3) of rows of points that bring the wheel's slot under the roller
    flat, up = math.sin(ball.arm), np.full(len(turns), math.cos(ball.arm))
    x, y, _ = frame @ np.stack((flat * np.cos(turns), -flat * np.sin(turns), up))
    away = np.hypot(x, y)
    c, s, no = x / away, y / away, 0.0 * away
    index = np.moveaxis(np.array(((c, s, no), (-s, c, no), (no, no, 1.0 + no))), -1, 0)
    x, y, up = np.moveaxis((wheel @ np.ascontiguousarray(index)) @ frame, -1, 0)
    # the limit is below the locking edge's angle, so that points along the edge do not count
    comes = np.flatnonzero(up.max(axis=0) > math.cos((1.0 - 0.5 * SAME_ANGLE) * ball.lock))
    x, y, up = x[:, comes], y[:, comes], up[:, comes]
    return np.arctan2(np.hypot(x, y), up), np.arctan2(y, x) + turns[:, None]
