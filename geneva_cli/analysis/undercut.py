"""Undercut: where the roller is too large for the wall that it must run along.

A curved slot has two branches, the way in and the way out. Each keeps only its outer wall, the
one away from the other branch; the inner walls vanish in what both cut. The outer wall is
undercut where its centre of curvature lies on its own side of the pitch curve, nearer than the
roller's radius: the flank then runs backwards, and the roller cuts away what it ran along before.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.pitch_curve import Pitch, pitch, retraces
from geneva_cli.numerics.arrays import only_of
from geneva_cli.numerics.roots import TIE

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask

NEAR = 1e-3  # share of the half motion
SAMPLES = 1024  # a half motion; the depth's error is then far below a micrometre a metre
PAIRS = 1 << 18  # distances looked at at once


class Undercut(NamedTuple):
    """The undercut outer wall: which flank, where, how sharp and how deep."""

    wall: str
    from_deg: float
    to_deg: float
    at_deg: float
    radius_mm: float  # the pitch curve's least radius of curvature there
    depth_mm: float  # by which the wall falls short of the roller at its deepest
    to_cusp: bool  # whether it reaches a cusp at mid-motion, which no roller is small enough for


class Undercuts(NamedTuple):
    """The same of m designs, (m,) each; NaN where none is undercut."""

    left: Array  # 1 where the wall is the left flank, 0 where it is the right one
    from_deg: Array
    to_deg: Array
    at_deg: Array
    radius_mm: Array
    depth_mm: Array
    to_cusp: Array  # 1 where it reaches a cusp at mid-motion, else 0


def undercut(mechanism: Mechanism, samples: int = SAMPLES) -> Undercut | None:
    """The deepest undercut of an outer wall, on the way in or out; None if there is none."""
    found = undercuts(mechanism, samples)
    if found is None or None in (one := only_of(found)):
        return None
    left, from_deg, to_deg, at_deg, radius, depth, to_cusp = cast("list[float]", one)
    wall = "left" if left else "right"
    return Undercut(wall, from_deg, to_deg, at_deg, radius, depth, bool(to_cusp))


def undercuts(mechanism: Mechanism, samples: int = SAMPLES) -> Undercuts | None:
    """The deepest undercuts of m designs, or of one; None of straight slots, which have none."""
    engagement, size = mechanism.engagements[0], mechanism.spec.size
    if not engagement.slot.curved:
        return None
    L = mechanism.center_distance_mm
    r = (mechanism.roller_radius_mm + size.allowances.slot_clearance_mm) / L
    # Squared spacing: close together at mid-motion, where the curve can have a cusp.
    share = (1.0 - np.arange(samples) / samples) ** 2
    x = np.atleast_2d(engagement.entry_deg * share)
    with np.errstate(all="ignore"):
        inward, outward = pitch(engagement, x), pitch(engagement, -x)
        turn = np.atleast_2d(np.arctan2(inward.y, inward.x) - np.arctan2(outward.y, outward.x))
        # the branches meet at mid-motion, and near it their distance is rounding
        far = int(np.flatnonzero(share >= NEAR)[-1])
        turn[:, far + 1 :] = turn[:, far : far + 1]
        # Left (1) or right (-1) of the travel, on both branches. Outside, the pin travels inwards
        # first; inside, outwards.
        outer = -mechanism.spec.wheel.SIGN * np.where(turn > 0.0, 1.0, -1.0)
        back = np.asarray(retraces(engagement))
        one, other = (
            _of_branch(at, degrees, outer, side, r, L, back)
            for at, degrees, side in ((inward, x, 1.0), (outward, -x, -1.0))
        )
    deeper = (other.depth_mm > one.depth_mm * (1.0 + TIE)) | np.isnan(one.depth_mm)
    return Undercuts(*(np.where(deeper, b, a) for a, b in zip(one, other, strict=True)))


def _of_branch(
    at: Pitch, degrees: Array, outer: Array, side: float, r: float, L: float, back: Mask
) -> Undercuts:
    """The undercut on the way in (``side`` 1) or out (-1)."""
    bend = outer * at.turning / at.speed  # curvature towards the outer wall
    over = bend * r > 1.0
    n, count = over.shape
    bend, degrees, outer, x, y = (
        np.broadcast_to(v, over.shape) for v in (bend, degrees, outer, at.x, at.y)
    )
    wall_x, wall_y = x - at.tangent_y * r * outer, y + at.tangent_x * r * outer
    gap = np.full(n, np.inf)
    design, place = np.nonzero(over)
    for i in range(0, len(design), PAIRS // count):
        d, k = design[i : i + PAIRS // count], place[i : i + PAIRS // count]
        way = np.hypot(wall_x[d, k][:, None] - x[d], wall_y[d, k][:, None] - y[d])
        np.minimum.at(gap, d, way.min(axis=1))
    every, sharp = np.arange(n), np.argmax(bend, axis=1)
    to_cusp = np.ravel(back) & over[:, -1]
    reach = [np.where(over, degrees, np.nan), np.where(to_cusp[:, None], 0.0, np.nan)]
    reached = np.hstack(reach)
    cut = over.any(axis=1)
    radius = np.ravel(L / bend[every, sharp][:, None])
    rows = (
        outer[every, sharp] * side > 0.0,
        np.fmin.reduce(reached, axis=1),
        np.fmax.reduce(reached, axis=1),
        np.where(to_cusp, 0.0, degrees[every, sharp]),
        np.where(to_cusp, 0.0, radius),
        np.ravel(L * np.maximum(0.0, r - gap[:, None])),
        to_cusp,
    )
    return Undercuts(*(np.where(cut, row, np.nan) for row in rows))
