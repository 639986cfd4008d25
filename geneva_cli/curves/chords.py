"""Places on curves, as few as serve, whose chords keep a tolerance.

A table of points promises what a drawing does: no curve is farther from its chords than the
tolerance. Several curves may share their places, as a slot's pitch curve and flanks do.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

# The curves' points (n, 2), mm, at n places: one array a curve.
Curves: TypeAlias = "Callable[[Array], Sequence[Array]]"

ROWS_MAX = 200_000  # between two ends
BLOCK = 4096  # chords that are measured at once, so that memory stays flat
ATTEMPTS = 20
MANY = 5_000  # nodes past which the first attempt that serves is kept
SPARE = 0.02  # share of the nodes that is not worth another attempt
ROUNDS = 6  # of moving a given number of nodes to where they are needed
SURVEY = 1024  # even intervals that are measured first
FLOOR = 0.05  # least density, as a share of its mean: an inflection needs nodes too
INSIDE = np.arange(1, 16) / 16.0  # where a chord's distance from the curve is measured
MIDDLE = np.array([0.25, 0.5, 0.75])  # the same for many short chords, which are parabolas


def nodes(curves: Curves, ends: Sequence[float], tolerance_mm: float, fewest: bool = True) -> Array:
    """Places from the first end to the last, so that no chord misses a curve by more.

    A chord's miss goes with the square of its length. So nodes are spread evenly in the integral
    of the miss's square root; then the misses are measured and nodes moved, added or taken away.
    All ends are nodes; cusps belong to them. Without ``fewest`` the first number that serves is
    taken, some per cent more.

    Raises GenevaError where that takes more rows than are written.
    """
    if not tolerance_mm > 0.0:
        raise GenevaError(f"--tolerance {tolerance_mm:g}: must be above 0 mm")
    parts = [_smooth(curves, a, b, tolerance_mm, fewest)[:-1] for a, b in pairwise(ends)]
    return np.concatenate((*parts, [ends[-1]]))


def _smooth(curves: Curves, a: float, b: float, tolerance_mm: float, fewest: bool) -> Array:
    grid = np.linspace(a, b, SURVEY + 1)
    share, total = _integrated_density(curves, grid)
    count = max(1, int(np.ceil(total / np.sqrt(tolerance_mm))))
    count += count // 50 if count > MANY or not fewest else 0  # to serve at the first attempt
    best, too_few = None, 0
    for _ in range(ATTEMPTS):
        if not count < ROWS_MAX:
            raise GenevaError(
                f"--tolerance {tolerance_mm:g} mm takes more than {ROWS_MAX} rows; "
                f"a coarser one would do: {2.0 * (total / ROWS_MAX) ** 2:.1g} mm, say"
            )
        found = np.interp(np.linspace(0.0, 1.0, count + 1), share, grid)
        for _ in range(ROUNDS):
            found[0], found[-1] = a, b
            root = np.sqrt(chord_errors(curves, found) / tolerance_mm)
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
    area = _integrated(root)
    return np.interp(np.linspace(0.0, area[-1], len(found)), area, found)


def _integrated_density(curves: Curves, grid: Array) -> tuple[Array, float]:
    """The integral of the node density over the grid as a share of one, and its total.

    The total over the square root of a tolerance is how many chords that takes.
    """
    area = _integrated(np.sqrt(chord_errors(curves, grid, MIDDLE)))
    total = float(area[-1])
    return (area / total if total else np.linspace(0.0, 1.0, len(grid))), total


def _integrated(root: Array) -> Array:
    weight = np.maximum(root, FLOOR * root.mean())
    return np.concatenate(([0.0], np.cumsum(weight)))


def chord_errors(curves: Curves, at: Array, places: Array | None = None) -> Array:
    """For each chord between neighbouring places, how far the curves stray from it, mm."""
    if places is None:
        places = INSIDE if len(at) < MANY else MIDDLE
    blocks = [
        _chord_errors(curves, at[start : start + BLOCK + 1], places)
        for start in range(0, len(at) - 1, BLOCK)
    ]
    return np.concatenate(blocks)


def _chord_errors(curves: Curves, at: Array, places: Array) -> Array:
    steps = np.diff(at)
    inner = at[:-1, None] + steps[:, None] * places
    worst = np.zeros(len(steps))
    for knots, points in zip(curves(at), curves(inner.ravel()), strict=True):
        chord = np.diff(knots, axis=0)[:, None, :]
        way = points.reshape(len(steps), len(places), 2) - knots[:-1, None, :]
        # To the nearest point of the chord itself: an undercut flank folds back beyond its ends.
        square = np.maximum((chord * chord).sum(axis=2), 1e-300)
        share = np.clip((way * chord).sum(axis=2) / square, 0.0, 1.0)
        off = way - share[..., None] * chord
        worst = np.maximum(worst, np.hypot(off[..., 0], off[..., 1]).max(axis=1))
    return worst
