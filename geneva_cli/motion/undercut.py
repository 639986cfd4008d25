"""Undercut: a roller that is too large for the curvature of the wall along which it runs.

A curved slot has two branches, one for entry and one for exit. Each keeps only its outer wall, the
one away from the other branch; the inner walls lie in the area that both cut. The outer wall is
undercut where its centre of curvature is on its own side of the pitch curve, nearer than the
roller's radius. The flank then runs backwards, and the roller cuts away the wall before it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pitch_curve import Pitch, opposites, pitch, retraces
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
    walls = outer_walls(mechanism, samples) or ()
    roller = mechanism.roller_radius_mm + mechanism.spec.size.allowances.slot_clearance_mm
    with np.errstate(all="ignore"):
        each = [_undercut(wall, roller, mechanism.center_distance_mm) for wall in walls]
    found = [one for one in each if one]
    if len(found) == 2 and found[1].depth_mm > found[0].depth_mm * (1.0 + TIE):
        return found[1]
    return found[0] if found else None


def _undercut(wall: OuterWall, roller_mm: float, L: float) -> Undercut | None:
    """The undercut of a design's wall by a roller with its clearance."""
    (degrees,), (bend,) = wall.degrees, wall.bend
    over = bend * (roller_mm / L) > 1.0
    if not over.any():
        return None
    to_cusp, sharp = bool(wall.retraces[0, -1] and over[-1]), int(np.argmax(bend))
    reached = [*degrees[over].tolist(), *([0.0] if to_cusp else [])]
    return Undercut(
        "left" if wall.left[0, sharp] else "right",
        min(reached),
        max(reached),
        0.0 if to_cusp else float(degrees[sharp]),
        0.0 if to_cusp else float(L / bend[sharp]),
        float(depths_mm(wall, roller_mm, L)[0]),
        to_cusp,
    )


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
    x, y = np.atleast_2d(own.entry_deg * fraction, own.exit_deg * fraction)
    with np.errstate(all="ignore"):
        inward, outward = pitch(own, x), pitch(own, y)
        leads = _lead(own, inward, outward, x), -_lead(own, outward, inward, y)
        # the branches meet at mid-motion, and within 1e-3 of it their distance is rounding
        far = int(np.flatnonzero(fraction >= 1e-3)[-1])
        for lead in leads:
            lead[:, far + 1 :] = lead[:, far : far + 1]
        # Left (1) or right (-1) of the travel. Outside, the pin travels inwards first; inside,
        # outwards.
        entry, exit_ = (-mechanism.spec.wheel.SIGN * np.where(k > 0.0, 1.0, -1.0) for k in leads)
        back = np.atleast_2d(retraces(own))
        x, y = engagement.inputs_deg(x), engagement.inputs_deg(y)
        return _wall(inward, x, entry, entry > 0.0, back), _wall(
            outward, y, exit_, exit_ < 0.0, back
        )


def _lead(engagement: Engagement, here: Pitch, mirrored: Pitch, degrees: Array) -> Array:
    """Angle of one branch over the other at equal radii, (m, k); that at its end where none is."""
    x, y = mirrored.x, mirrored.y
    if not engagement.slot.mirrored:
        x, y = (jet.c[0] for jet in engagement.slot(opposites(engagement, degrees), 0))
    lead = np.atleast_2d(np.arctan2(here.y, here.x) - np.arctan2(y, x))
    known = ~np.isnan(lead)
    first = np.take_along_axis(lead, np.argmax(known, axis=1)[:, None], axis=1)
    return np.where(known, lead, first)


def _wall(at: Pitch, degrees: Array, outer: Array, left: Mask, back: Mask) -> OuterWall:
    """A branch's outer wall; ``outer`` is 1 where it lies to the left of the pin's travel."""
    normal = -at.tangent_y * outer, at.tangent_x * outer
    rows = (degrees, at.x, at.y, *normal, outer * at.turning / at.speed, left, back)
    return OuterWall(*np.broadcast_arrays(*rows))


def depths_mm(wall: OuterWall, roller_mm: Number, L: Number) -> Array:
    """Depth to which a roller with its clearance cuts a wall, (m,); 0 where it does not."""
    r = np.asarray(roller_mm / L)
    return np.ravel(L * np.maximum(0.0, r - _gap(wall, r)[:, None]))


def _gap(wall: OuterWall, r: Array) -> Array:
    """Least distance of the pitch curve from undercut places of the wall, (m,)."""
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
        # a fraction of the time of hypot, which is used for the nearest places only
        square = x * x + y * y
        # beyond 1e-14 a square is greater whatever the rounding; NaN stays NaN
        near = ~(square > (1.0 + 1e-14) * square.min(axis=1, keepdims=True))
        np.minimum.at(gap, d[np.nonzero(near)[0]], np.hypot(x[near], y[near]))
    return gap
