"""Undercut: where the roller is too large for the wall that it must run along.

A curved slot has two branches, the way in and the way out. Each keeps only its outer wall, the
one away from the other branch; the inner walls vanish in what both cut. The outer wall is
undercut where its centre of curvature lies on its own side of the pitch curve, nearer than the
roller's radius: the flank then runs backwards, and the roller cuts away what it ran along before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.pitch_curve import pitch, retraces

NEAR = 1e-3  # share of the half motion
SAMPLES = 1024  # a half motion; the depth's error is then far below a micrometre a metre


class Undercut(NamedTuple):
    """The undercut outer wall: which flank, where, how sharp and how deep."""

    wall: str
    from_deg: float
    to_deg: float
    at_deg: float
    radius_mm: float  # the pitch curve's least radius of curvature there
    depth_mm: float  # by which the wall falls short of the roller at its deepest
    to_cusp: bool  # whether it reaches a cusp at mid-motion, which no roller is small enough for


def undercut(mechanism: Mechanism, samples: int = SAMPLES) -> Undercut | None:
    """The deepest undercut of an outer wall, on the way in or out; None if there is none."""
    engagement, size = mechanism.engagements[0], mechanism.spec.size
    if not engagement.slot.curved:
        return None
    L = mechanism.center_distance_mm
    r = (mechanism.roller_radius_mm + size.slot_clearance_mm) / L
    # Squared spacing: close together at mid-motion, where the curve can have a cusp.
    x = engagement.entry_deg * (1.0 - np.arange(samples) / samples) ** 2
    inward, outward = pitch(engagement, x), pitch(engagement, -x)
    turn = np.arctan2(inward.y, inward.x) - np.arctan2(outward.y, outward.x)
    near = np.abs(x) < NEAR * abs(engagement.entry_deg)
    turn[near] = turn[~near][-1]  # the branches meet there, and their distance is rounding
    # Left (1) or right (-1) of the travel, on both branches. Outside, the pin travels inwards
    # first; inside, outwards.
    outer = -mechanism.spec.wheel.SIGN * np.where(turn > 0.0, 1.0, -1.0)
    back = retraces(engagement)
    found = []
    for degrees, at in ((x, inward), (-x, outward)):
        bend = outer * at.turning / at.speed  # curvature towards the outer wall
        over = bend * r > 1.0
        if not over.any():
            continue
        wall_x = at.x - at.tangent_y * r * outer
        wall_y = at.y + at.tangent_x * r * outer
        gap = np.hypot(wall_x[over, None] - at.x, wall_y[over, None] - at.y).min(axis=1)
        sharp = int(np.argmax(bend))
        to_cusp = back and bool(over[-1])
        angles = np.append(degrees[over], 0.0) if to_cusp else degrees[over]
        found.append(
            Undercut(
                "right" if outer[sharp] * (1 if at is inward else -1) < 0 else "left",
                float(angles.min()),
                float(angles.max()),
                0.0 if to_cusp else float(degrees[sharp]),
                0.0 if to_cusp else float(L / bend[sharp]),
                float(L * max(0.0, r - gap.min())),
                to_cusp,
            )
        )
    return max(found, key=lambda u: u.depth_mm) if found else None
