"""The slot's profile as a table: sampled so that its chords keep a tolerance."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.pitch_curve import WALLED, pitch, retraces
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.parts.slot_profile import flanks, pitch_at, slot
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

NAMES = ("input_deg", "wheel_deg", *WALLED)
ROWS_MAX = 200_000  # in a half motion
BLOCK = 4096  # chords that are measured at once, so that memory stays flat
ATTEMPTS = 20
MANY = 5_000  # nodes past which the first attempt that serves is kept
SPARE = 0.02  # share of the nodes that is not worth another attempt
ROUNDS = 6  # of moving a given number of nodes to where they are needed
SURVEY = 2048  # intervals on which the curve's density is integrated
FLOOR = 0.05  # least density, as a share of its mean: an inflection needs nodes too
INSIDE = np.arange(1, 16) / 16.0  # where a chord's distance from the curve is measured
MIDDLE = np.array([0.25, 0.5, 0.75])  # the same for many short chords, which are parabolas


def nodes(mechanism: Mechanism, tolerance_mm: float, fewest: bool = True) -> Array:
    """Input angles at which to sample the slot, so that no chord misses a curve by more.

    A chord of length h on a curve of curvature k misses it by k h²/8, so nodes are spread evenly
    in the integral of sqrt(k) ds, taken on the flank where it is largest; then the misses are
    measured and nodes moved, added or taken away. Cusps are nodes: mid-motion, where the pitch
    curve can have one, and the places where an undercut flank turns back. Without ``fewest`` the
    first number that serves is taken, some per cent more.

    Raises GenevaError where that takes more rows than are written.
    """
    if not tolerance_mm > 0.0:
        raise GenevaError(f"--tolerance {tolerance_mm:g}: must be above 0 mm")
    engagement = mechanism.engagements[0].through
    cusps = _flank_cusps(mechanism)
    ends = [engagement.entry_deg, *[x for x in cusps if x < 0.0], 0.0]
    if not engagement.motion.symmetric:
        ends += [*[x for x in cusps if x > 0.0], engagement.exit_deg]
    parts = [_smooth(mechanism, a, b, tolerance_mm, fewest)[:-1] for a, b in pairwise(ends)]
    found = np.concatenate((*parts, [ends[-1]]))
    return np.concatenate((found[:-1], -found[::-1])) if engagement.motion.symmetric else found


def _flank_cusps(mechanism: Mechanism) -> list[float]:
    """Where a flank stops and turns back, the roller being as large as the curve is sharp.

    Of a symmetric motion the first half's.
    """
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    offset /= mechanism.center_distance_mm

    def excess(x: Array, side: float) -> Array:
        at = pitch(engagement, x)
        return array(at.speed - side * offset * at.turning)

    # Half a step off the grid's ends: mid-motion may be a cusp of the pitch curve itself.
    step, mirrored = engagement.motion_deg / SURVEY, engagement.motion.symmetric
    count = (SURVEY + 1) // 2 if mirrored else SURVEY  # of a half that mirrors, one is enough
    grid = engagement.entry_deg + step * (np.arange(count, dtype=np.float64) + 0.5)
    at = pitch(engagement, grid)
    found = []
    for side in (-1.0, 1.0):
        sign = np.sign(at.speed - side * offset * at.turning)
        for i in np.flatnonzero(sign[1:] * sign[:-1] < 0.0):
            a, b = float(grid[i]), float(grid[i + 1])
            if a < 0.0 < b:
                continue
            runs = sign[i]  # as the flank does before it stops
            found.append(boundary_by_sections(lambda x: excess(x, side) * runs > 0.0, a, b))  # noqa: B023
    return sorted(found)


def _smooth(mechanism: Mechanism, a: float, b: float, tolerance_mm: float, fewest: bool) -> Array:
    grid = np.linspace(a, b, SURVEY + 1)
    share, total = _integrated_density(mechanism, grid)
    count = max(1, int(np.ceil(total / np.sqrt(8.0 * tolerance_mm) if total else 1.0)))
    count += count // 50 if count > MANY or not fewest else 0  # to serve at the first attempt
    best, too_few = None, 0
    for _ in range(ATTEMPTS):
        if not count < ROWS_MAX:
            raise GenevaError(
                f"--tolerance {tolerance_mm:g} mm takes more than {ROWS_MAX} rows; "
                f"a coarser one would do: {(total / ROWS_MAX) ** 2 / 4.0:.1g} mm, say"
            )
        found = np.interp(np.linspace(0.0, 1.0, count + 1), share, grid)
        for _ in range(ROUNDS):
            found[0], found[-1] = a, b
            root = np.sqrt(chord_errors(mechanism, found) / tolerance_mm)
            if root.max() <= 1.0:
                break
            found = _respread(found, root)
        # A chord's miss goes with the square of its length: so many of them should just do.
        enough = int(np.ceil(root.sum()))
        if root.max() <= 1.0:
            best, good = found, count
            count = max(enough, (too_few + good) // 2, 1)
        else:
            too_few = count
            more = count + max(1, 0 if fewest else count // 50)
            count = max(enough, more) if best is None else (too_few + good + 1) // 2
        if best is not None and (
            not fewest or count >= good or good - too_few <= SPARE * good or good > MANY
        ):
            return best
    if best is not None:
        return best
    raise GenevaError(
        f"--tolerance {tolerance_mm:g} mm is finer than double precision can show at this size"
    )


def _respread(found: Array, root: Array) -> Array:
    """As many nodes, moved to where the square roots of the misses say they are needed."""
    weight = np.maximum(root, FLOOR * root.mean())
    area = np.concatenate(([0.0], np.cumsum(weight)))
    return np.interp(np.linspace(0.0, area[-1], len(found)), area, found)


def _integrated_density(mechanism: Mechanism, grid: Array) -> tuple[Array, float]:
    """The integral of the node density over the grid as a share of one, and its total."""
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    L = mechanism.center_distance_mm
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    at = pitch_at(engagement, grid, retraces(engagement))
    turning = np.abs(at.turning)
    # sqrt(k) ds for the outer flank: its curve is longer by turning * offset
    density = np.sqrt(turning * (L * at.speed + offset * turning))
    steps = np.diff(grid) * (np.pi / 180.0)
    mean = float(np.mean(density))
    if mean == 0.0:
        return np.linspace(0.0, 1.0, len(grid)), 0.0
    density = np.maximum(density, FLOOR * mean)
    area = np.concatenate(([0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * steps)))
    return area / area[-1], float(area[-1])


def chord_errors(mechanism: Mechanism, input_deg: Array) -> Array:
    """For each chord between samples, how far pitch curve or flanks stray from it, mm."""
    places = INSIDE if len(input_deg) < MANY else MIDDLE
    blocks = [
        _chord_errors(mechanism, input_deg[start : start + BLOCK + 1], places)
        for start in range(0, len(input_deg) - 1, BLOCK)
    ]
    return np.concatenate(blocks)


def _chord_errors(mechanism: Mechanism, input_deg: Array, places: Array) -> Array:
    steps = np.diff(input_deg)
    inner = input_deg[:-1, None] + steps[:, None] * places
    ends, between = flanks(mechanism, input_deg), flanks(mechanism, inner.ravel())
    worst = np.zeros(len(steps))
    for knots, points in zip(ends, between, strict=True):
        chord = np.diff(knots, axis=0)[:, None, :]
        way = points.reshape(len(steps), len(places), 2) - knots[:-1, None, :]
        # To the nearest point of the chord itself: an undercut flank folds back beyond its ends.
        square = np.maximum((chord * chord).sum(axis=2), 1e-300)
        share = np.clip((way * chord).sum(axis=2) / square, 0.0, 1.0)
        off = way - share[..., None] * chord
        worst = np.maximum(worst, np.hypot(off[..., 0], off[..., 1]).max(axis=1))
    return worst


def profile_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """The slot as ``geneva profile`` writes it: for a chord tolerance, or ``samples`` evenly."""
    engagement = mechanism.engagements[0].through
    if samples is None:
        input_deg = nodes(mechanism, tolerance_mm)
    else:
        input_deg = np.linspace(engagement.entry_deg, engagement.exit_deg, samples)
    at = slot(mechanism, input_deg)
    columns = [at.input_deg, at.wheel_deg]
    for points in (at.centre, at.left, at.right):
        columns += [points[:, 0], points[:, 1]]
    return Table(NAMES, [*columns, at.pressure_deg, at.radius])
