"""The slot's profile as a table: sampled so that its chords keep a tolerance."""

from __future__ import annotations

from functools import partial

import numpy as np

from geneva_cli.geometry import chords
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pitch_curve import WALLED, pitch
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.parts.slots.slot_profile import flanks, slot
from geneva_cli.table import Table, computed_table


def nodes(mechanism: Mechanism, tolerance_mm: float, fewest: bool = True) -> Array:
    """Return input angles to sample the slot at, so that no chord misses a curve by more.

    Cusps are among them: mid-motion, where the pitch curve can have one, and the points where an
    undercut flank turns back. Without ``fewest`` the first sufficient number is used, some percent
    more. Raises GenevaError where that takes more rows than are written.
    """
    engagement = mechanism.engagements[0].through
    cusps = _flank_cusps(mechanism)
    ends = [engagement.entry_deg, *[x for x in cusps if x < 0.0], 0.0]
    if not engagement.mirrored:
        ends += [*[x for x in cusps if x > 0.0], engagement.exit_deg]
    angles = chords.nodes(partial(flanks, mechanism), ends, tolerance_mm, fewest)
    return np.concatenate((angles[:-1], -angles[::-1])) if engagement.mirrored else angles


def _flank_cusps(mechanism: Mechanism) -> list[float]:
    """Return where a flank stops and turns back, because the roller is as large as the curvature.

    For a slot with two equal branches only those of the first are returned.
    """
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    offset /= mechanism.center_distance_mm

    def excess(x: Array, side: float) -> Array:
        at = pitch(engagement, x)
        return array(at.speed - side * offset * at.turning)

    # Half a step off the grid's ends: mid-motion may be a cusp of the pitch curve itself.
    intervals = 2048
    step, mirrored = engagement.motion_deg / intervals, engagement.mirrored
    count = (intervals + 1) // 2 if mirrored else intervals  # one of two mirrored halves is enough
    grid = engagement.entry_deg + step * (np.arange(count, dtype=np.float64) + 0.5)
    at = pitch(engagement, grid)
    cusps = []
    for side in (-1.0, 1.0):
        sign = np.sign(at.speed - side * offset * at.turning)
        for i in np.flatnonzero(sign[1:] * sign[:-1] < 0.0):
            a, b = float(grid[i]), float(grid[i + 1])
            if a < 0.0 < b:
                continue
            runs = sign[i]  # sign before the flank stops
            cusps.append(boundary_by_sections(lambda x: excess(x, side) * runs, a, b))  # noqa: B023
    return sorted(cusps)


def chord_errors(mechanism: Mechanism, input_deg: Array) -> Array:
    """Return the deviation of pitch curve or flanks from each chord between samples, mm."""
    return chords.chord_errors(partial(flanks, mechanism), input_deg)


def profile_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return the slot's table: for a chord tolerance, or at ``samples`` even input angles."""
    engagement = mechanism.engagements[0].through
    names = ("input_deg", mechanism.output.column, *WALLED)
    if samples is None:
        return Table(names, _rows(mechanism, nodes(mechanism, tolerance_mm)))
    entry, exit_ = engagement.entry_deg, engagement.exit_deg

    def rows(begin: int, end: int) -> list[Array]:
        at: Array = entry + np.arange(begin, end, dtype=np.float64) * (
            (exit_ - entry) / (samples - 1)
        )
        at[samples - 1 - begin :] = exit_  # the last of all, without rounding
        return _rows(mechanism, at)

    return computed_table(names, samples, rows)


def _rows(mechanism: Mechanism, input_deg: Array) -> list[Array]:
    """Return the columns of the slot's table at input angles."""
    at = slot(mechanism, input_deg)
    points = [axis for line in (at.centre, at.left, at.right) for axis in line.T]
    return [at.input_deg, at.output, *points, at.pressure_deg, at.radius]
