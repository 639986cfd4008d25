"""A spherical crank as regions of its sphere: locking sectors and rollers, which its arm carries.

In the crank's frame: its axis z, the first roller on the azimuth 0, the others where they are.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.sphere import Region, Rotation, SphereArc, cross, opposite, place
from geneva_cli.curves.sphere_belt import Cap
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.locking_rings import SHARES
from geneva_cli.parts.sphere.sizes import Ball, NoRoom
from geneva_cli.parts.sphere.wheel import POLE, QUARTER, edge_points

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

STEPS = 361  # positions of a motion
EACH = 100  # points of an arc of the wheel's edge
# Fractions of the locking edge's angle from the crank's axis. The first is larger than on a plane,
# where it guards against a tip: here it is the inner edge wherever the wheel stays clear of it.
POINTED = 0.2  # no sector reaches nearer to the axis
THIN = 0.05  # a ring as thin as this holds nothing


def sectors(found: Ball) -> list[Region]:
    """Where the crank locks: outside of what the wheel sweeps in a motion.

    Between two rollers, or over as much of that as the wheel leaves free.
    Raises NoRoom where nothing is left of them.
    """
    spare = min(0.25 * (found.recess - found.lock) + 0.1 * found.roller, 0.1 * found.lock)
    # what is about the axis fills a cone up to where it ends
    about = math.asin(min(1.0, found.about_crank_mm / found.lock_span_mm[0]))
    least = max(POINTED * found.lock, about)
    regions = []
    spans = locked(found)
    ways = swept(found) if spans else None
    for start, end in spans:
        middle, whole = 0.5 * (start + end), 0.5 * (end - start)
        assert ways
        reached = _reached(found, ways, middle)

        def nearest(half: float, reached: Callable[[float], float] = reached) -> float:
            return max(reached(half) + spare, least)

        most = (1.0 - THIN) * found.lock
        if about > most:
            wide = 2.0 * found.lock_span_mm[0] * math.sin(most)
            raise NoRoom(
                f"the crank's shaft and hub leave nothing of the locking sector: crank_bore_mm and "
                f"crank_hub_mm must be below {wide:.4g}, or 0, or lock_radius_mm greater; "
                "lock_radius_mm = 0 leaves the sector out, where the wheel is held in another way",
                ("size", "crank_bore_mm"),
            )
        # a narrower sector is no nearer to the edge
        i = bisect_left(SHARES, True, key=lambda share: nearest(share * whole) <= most)
        if i < len(SHARES):
            half = SHARES[i] * whole
            regions.append(_sector(found.lock, nearest(half), middle - half, middle + half))
        else:
            raise NoRoom(
                "the wheel sweeps over the whole locking sector: another lock_radius_mm may leave "
                "room for one; 0 leaves it out, where the wheel is held in another way",
                ("size", "lock_radius_mm"),
            )
    return regions


def locked(found: Ball) -> list[tuple[float, float]]:
    """Where the crank locks: azimuths about its axis, from and to."""
    if not found.lock:
        return []
    after = (*found.rollers[1:], found.rollers[0] + math.tau)
    spans = [
        (a + found.half_motion, b - found.half_motion)
        for a, b in zip(found.rollers, after, strict=True)
    ]
    return [(a, b) for a, b in spans if b - a > SAME_ANGLE]


def _sector(high: float, low: float, start: float, end: float) -> Region:
    """From one azimuth to another, between two angles from the axis."""
    far, near = ([place(polar, a) for a in (start, end)] for polar in (high, low))
    sides = [(-math.sin(a), math.cos(a), 0.0) for a in (start, end)]
    boundary = (
        SphereArc(POLE, high, far[0], far[1]),
        SphereArc(opposite(sides[1]), QUARTER, far[1], near[1]),
        SphereArc(opposite(POLE), math.pi - low, near[1], near[0]),
        SphereArc(sides[0], QUARTER, near[0], far[0]),
    )
    return Region(boundary, POLE)


def rollers(found: Ball) -> list[Region]:
    """The rollers' cones."""
    return [Cap(place(found.arm, azimuth), found.roller).region for azimuth in found.rollers]


def at_mid_motion(found: Ball) -> Rotation:
    """The crank's frame in the wheel's, with the first roller at mid-motion."""
    axis = found.crank_axis(0.0)
    ahead = place(found.axes - QUARTER, 0.0)
    return Rotation(ahead, cross(axis, ahead), axis)


def _reached(found: Ball, ways: tuple[Array, Array], middle: float) -> Callable[[float], float]:
    """How near to the locking edge, from the crank's axis, the wheel comes within so much on either
    side of an azimuth, in all motions; radians, 0 where it stays clear of it."""
    polar, azimuth = ways
    ahead = [azimuth + turn - middle for turn in found.rollers]
    off = np.abs(np.remainder(np.stack(ahead) + math.pi, math.tau) - math.pi)
    near = polar < found.lock * (1.0 - SAME_ANGLE)

    def reached(half: float) -> float:
        inside = near & (off < half * (1.0 - SAME_ANGLE))
        # what comes in or goes out from one position to the next does so on its way
        inside[:, 1:] |= inside[:, :-1]
        inside[:, :-1] |= inside[:, 1:]
        return min(found.lock, float((polar * inside).max(initial=0.0)))

    return reached


def swept(found: Ball) -> tuple[Array, Array]:
    """The ways of the wheel's edge in the crank's frame, in the motion of the first roller.

    Polar angles from the crank's axis and azimuths about it, radians, a row a position; only what
    comes within the locking edge. The crank turns clockwise about its axis where the wheel turns
    counterclockwise.
    """
    frame = np.column_stack(at_mid_motion(found))
    wheel = edge_points(found, EACH)
    # the wheel turns by half a step either way: what is nearer to the crank's axis then
    off = np.maximum(np.abs(np.arctan2(wheel[:, 1], wheel[:, 0])) - found.half_step, 0.0)
    flat = math.sin(found.axes) * np.hypot(wheel[:, 0], wheel[:, 1]) * np.cos(off)
    wheel = wheel[math.cos(found.axes) * wheel[:, 2] + flat > math.cos(found.lock) - SAME_ANGLE]
    turns = np.linspace(-found.half_motion, found.half_motion, STEPS)
    x, y, up = np.moveaxis((wheel @ _index(found, frame, turns)) @ frame, -1, 0)
    # less than their angles tells which points come there; those along the edge do not
    comes = np.flatnonzero(up.max(axis=0) > math.cos((1.0 - 0.5 * SAME_ANGLE) * found.lock))
    x, y, up = x[:, comes], y[:, comes], up[:, comes]
    return np.arctan2(np.hypot(x, y), up), np.arctan2(y, x) + turns[:, None]


def _index(found: Ball, frame: Array, turns: Array) -> Array:
    """The rotations of the wheel that bring its slot under the roller, (n, 3, 3), for rows of
    points.
    """
    flat, up = math.sin(found.arm), np.full(len(turns), math.cos(found.arm))
    x, y, _ = frame @ np.stack((flat * np.cos(turns), -flat * np.sin(turns), up))
    away = np.hypot(x, y)
    c, s, no = x / away, y / away, 0.0 * away
    rows = np.array(((c, s, no), (-s, c, no), (no, no, 1.0 + no)))
    return np.ascontiguousarray(np.moveaxis(rows, -1, 0))
