"""Undercut: a roller that is too large for the curvature of the wall along which it runs.

Each branch of a curved slot keeps its outer wall only, away from the other branch. It is undercut
where its centre of curvature is on its side of the pitch curve, nearer than the roller's radius.
"""

from typing import NamedTuple

import numpy as np

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import pitch, retraces
from geneva_cli.numerics.arrays import Array, Mask, Number
from geneva_cli.numerics.tolerances import TIE

HALF_SAMPLES = 1024  # of a half motion; the depth's error is then far below a micrometre per metre


class Undercut(NamedTuple):
    """The undercut outer wall of a design: its flank, place, curvature and depth."""

    wall: str  # the flank, "left" or "right"
    from_deg: float
    to_deg: float
    at_deg: float
    radius_mm: float  # the pitch curve's least radius of curvature there
    depth_mm: float  # the wall's greatest shortfall from the roller
    to_cusp: bool  # True if it reaches a cusp at mid-motion, too sharp for any roller


def undercut(mechanism: Mechanism, samples: int = HALF_SAMPLES) -> Undercut | None:
    """The deepest undercut of an outer wall, at entry or exit; None if there is none."""
    L, roller = mechanism.center_distance_mm, mechanism.roller_radius_mm
    roller += mechanism.spec.size.allowances.slot_clearance_mm
    deepest: Undercut | None = None
    for wall in outer_walls(mechanism, samples) or ():
        (degrees,), (bend,), (left,) = wall.degrees, wall.bend, wall.left
        with np.errstate(all="ignore"):
            over, depth_mm = bend * (roller / L) > 1.0, float(depths_mm(wall, roller, L)[0])
        if not over.any() or (deepest and depth_mm <= deepest.depth_mm * (1.0 + TIE)):
            continue
        to_cusp, sharp = bool(wall.retraces[0, -1] and over[-1]), int(np.argmax(bend))
        reached = [*degrees[over].tolist(), *([0.0] if to_cusp else [])]
        at_deg, radius_mm = float(degrees[sharp]), float(L / bend[sharp])
        if to_cusp:
            at_deg = radius_mm = 0.0
        flank = "left" if left[sharp] else "right"
        deepest = Undercut(flank, min(reached), max(reached), at_deg, radius_mm, depth_mm, to_cusp)
    return deepest


class OuterWall(NamedTuple):
    """The outer wall of one branch of m designs' slots, for any roller; lengths over L.

    It has k places from the branch's end to near mid-motion, (m, k) each.
    """

    degrees: Array  # input angles
    x: Array  # the pitch curve
    y: Array
    normal_x: Array  # unit normal towards the wall
    normal_y: Array
    bend: Array  # the pitch curve's curvature towards the wall
    left: Mask  # True for the left flank
    retraces: Mask  # True if the branch ends in a cusp; equal at all places


def outer_walls(
    mechanism: Mechanism, samples: int = HALF_SAMPLES
) -> tuple[OuterWall, OuterWall] | None:
    """The outer walls at entry and at exit; None for straight slots."""
    engagement = mechanism.engagements[0]
    if not engagement.slot.curved:
        return None
    own = engagement.own  # by the angle of the crank's own drive the branches mirror each other
    # Squared spacing: close together at mid-motion, where the curve can have a cusp.
    fraction = (1.0 - np.arange(samples) / samples) ** 2
    # the branches meet at mid-motion, and within 1e-3 of it their distance is rounding
    far = int(np.flatnonzero(fraction >= 1e-3)[-1])
    ends = np.atleast_2d(own.entry_deg * fraction, own.exit_deg * fraction)
    walls = []
    with np.errstate(all="ignore"):
        curves, back = [pitch(own, x) for x in ends], np.atleast_2d(retraces(own))
        for x, at, other, way in zip(ends, curves, curves[::-1], (1.0, -1.0), strict=True):
            # the angle of one branch over the other at equal radii
            lead = np.arctan2(at.y, at.x) - np.arctan2(other.y, other.x)
            lead = way * np.atleast_2d(lead)
            lead[:, far + 1 :] = lead[:, far : far + 1]
            # Left (1) or right (-1) of the travel. Outside, the pin travels inwards first; inside,
            # outwards.
            outer = -mechanism.spec.wheel.SIGN * np.where(lead > 0.0, 1.0, -1.0)
            normal, bend = (-at.tangent_y * outer, at.tangent_x * outer), outer * at.turning
            left, degrees = way * outer > 0.0, engagement.inputs_deg(x)
            rows = (degrees, at.x, at.y, *normal, bend / at.speed, left, back)
            walls.append(OuterWall(*np.broadcast_arrays(*rows)))
    return walls[0], walls[1]


def depths_mm(wall: OuterWall, roller_mm: Number, L: Number) -> Array:
    """Depth to which a roller with its clearance cuts a wall, (m,); 0 where it does not."""
    r = np.asarray(roller_mm / L)
    # the least distance of the pitch curve from undercut places of the wall
    gap = np.full(len(wall.bend), np.inf)
    design, place = np.nonzero(wall.bend * r > 1.0)
    # 32,768 distances at once fit in the cache
    step = (1 << 15) // wall.bend.shape[1]
    for i in range(0, len(design), step):
        d, k = design[i : i + step], place[i : i + step]
        own = r[d, 0] if r.ndim > 1 else r
        x, y = wall.x[d, k] + own * wall.normal_x[d, k], wall.y[d, k] + own * wall.normal_y[d, k]
        # a single design needs no copy for each place
        own_wall = slice(None) if len(wall.bend) == 1 else d
        x, y = x[:, None] - wall.x[own_wall], y[:, None] - wall.y[own_wall]
        np.minimum.at(gap, d, np.sqrt((x * x + y * y).min(axis=1)))
    return np.ravel(L * np.maximum(0.0, r - gap[:, None]))
