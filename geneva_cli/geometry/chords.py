"""Places on curves, as few as possible, whose chords keep a tolerance; several may share them."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import Array

# points (n, 2) of the curves in mm at n places: one array for each curve
Curves: TypeAlias = "Callable[[Array], Sequence[Array]]"

ROWS_MAX = 200_000  # of a table between two ends
MANY_NODES = 5_000  # nodes from which on the first sufficient attempt is kept
# Fractions of a chord at which its error is measured, and of many short ones, whose curves are
# polynomials of the fourth degree.
PLACES = np.arange(1, 32) / 32.0
MIDDLE = np.array([0.25, 0.5, 0.75])
# Lagrange's weights (31, 3) of the errors at ``MIDDLE`` for those at ``PLACES``; at both ends it
# is 0.
KNOTS = (0.0, 0.25, 0.5, 0.75, 1.0)
BETWEEN = np.column_stack(
    [np.prod([(PLACES - b) / (a - b) for b in KNOTS if b != a], axis=0) for a in MIDDLE]
)
# Between measured errors the peak of an S is found to 3e-4 of itself.
AIM = 1.0 - 5e-4  # fraction of a tolerance


def nodes(curves: Curves, ends: Sequence[float], tolerance_mm: float, fewest: bool = True) -> Array:
    """Fewest places whose chords keep the tolerance on every curve; ends and cusps are among them.

    Without ``fewest`` the first sufficient number is used, some ten per cent more.
    """
    aim = AIM * tolerance_mm
    parts = [_smooth(curves, a, b, aim, fewest)[:-1] for a, b in pairwise(ends)]
    return np.concatenate((*parts, [ends[-1]]))


def _smooth(curves: Curves, a: float, b: float, tolerance_mm: float, fewest: bool) -> Array:
    """Nodes of a smooth stretch, spread evenly in the integral of the error's square root."""
    grid = np.linspace(a, b, 1025 if fewest else 257)
    area, _ = _respread(grid, np.sqrt(chord_errors(curves, grid, MIDDLE)))
    total = float(area[-1])
    fraction = area / total if total else np.linspace(0.0, 1.0, len(grid))
    count = max(1, int(np.ceil(total / np.sqrt(tolerance_mm))))
    if count > MANY_NODES or not fewest:
        count += count // (50 if fewest else 10)  # so that the first attempt is enough
    best, asked = None, f"--tolerance {tolerance_mm / AIM:g} mm"
    for _ in range(20):  # attempts; a few are enough but at the limit of double precision
        if not count < ROWS_MAX:
            text = f"use for example {2.0 * (total / ROWS_MAX) ** 2:.1g} mm"
            raise GenevaError(f"{asked} takes more than {ROWS_MAX} rows: {text}")
        places = np.interp(np.linspace(0.0, 1.0, count + 1), fraction, grid)
        for _ in range(6):  # rounds that move this number of nodes to where they are needed
            places[0], places[-1] = a, b
            inner = PLACES if fewest and len(places) < MANY_NODES else MIDDLE
            root = np.sqrt(chord_errors(curves, places, inner) / tolerance_mm)
            if root.max() <= 1.0:
                break
            _, places = _respread(places, root)
        # A chord's error is proportional to the square of its length: this number should be enough.
        enough = max(int(np.ceil(root.sum())), count // 2, 1)
        if root.max() <= 1.0:
            best = places
            if not fewest or enough >= count or count > MANY_NODES:
                break
            count = enough
        elif best is None:
            count = max(enough, count + 1 + count // 50)
        else:
            break
    if best is None:
        raise GenevaError(f"{asked} is finer than doubles can show at this size")
    return best


def _respread(places: Array, root: Array) -> tuple[Array, Array]:
    """Return the integral of the error's square root, and the places moved to where it asks."""
    # at least 5 % of the mean density: an inflection needs nodes too
    weight = np.maximum(root, 0.05 * root.mean())
    area = np.concatenate(([0.0], np.cumsum(weight)))
    return area, np.interp(np.linspace(0.0, area[-1], len(places)), area, places)


def chord_errors(curves: Curves, at: Array, places: Array) -> Array:
    """Greatest distance of the curves from each chord between adjacent places, mm.

    It is measured at fractions ``places`` of the chord. A chord that hides most of a curve between
    two of them has its length as error.
    """
    worst = np.zeros(len(at) - 1)
    block = 4096  # chords, so that memory stays flat
    for start in range(0, len(at) - 1, block):
        some, ends = slice(start, start + block), at[start : start + block + 1]
        steps = np.diff(ends)
        inner = ends[:-1, None] + steps[:, None] * places
        along = np.ones((len(steps), len(places) + 2))  # fractions of the chord, with both its ends
        along[:, 0] = 0.0
        for knots, points in zip(curves(ends), curves(inner.ravel()), strict=True):
            chord = np.diff(knots, axis=0)[:, None, :]
            offset = points.reshape(len(steps), len(places), 2) - knots[:-1, None, :]
            # distance to the chord itself, since an undercut flank folds back beyond its ends
            square = np.maximum((chord * chord).sum(axis=2), 1e-300)
            fraction = np.clip((offset * chord).sum(axis=2) / square, 0.0, 1.0)
            off = offset - fraction[..., None] * chord
            off = off if len(places) > len(MIDDLE) else BETWEEN @ off
            # the greatest size along each chord: of the parabola about the largest
            size = np.zeros((len(off), off.shape[1] + 2))
            size[:, 1:-1] = np.hypot(off[..., 0], off[..., 1])
            top = size[:, 1:-1].argmax(axis=1)[:, None] + 1
            before, most, after = (np.take_along_axis(size, top + k, 1)[:, 0] for k in (-1, 0, 1))
            bend = 2.0 * most - before - after
            rise = np.divide((after - before) ** 2, 8.0 * bend, out=0.0 * bend, where=bend > 0.0)
            error = most + rise
            along[:, 1:-1] = fraction
            # A curve that starts from rest with the fourth power of its parameter leaves 0.68. At
            # 0.75 an arc's error is a third above the measured one.
            hidden = np.diff(along, axis=1).max(axis=1) > 0.75
            long = np.where(hidden, np.sqrt(square[:, 0]), error)
            worst[some] = np.maximum(worst[some], long)
    return worst
