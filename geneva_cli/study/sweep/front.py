"""The Pareto front of a sweep: rows that no other row beats."""

from __future__ import annotations

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole

BLOCK = 256  # rows that are compared at once with all that are kept before them


def front(costs: Array) -> Whole:
    """The numbers of the rows of costs (n, d) on the Pareto front, ascending.

    A row is on it if no other is as good in all objectives and better in one. Rows with a NaN are
    left out. Equal rows stay together.
    """
    known = np.flatnonzero(~np.isnan(costs).any(axis=1))
    if not len(known):
        return known
    rows, same = np.unique(costs[known], axis=0, return_inverse=True)
    kept = np.zeros(len(rows), dtype=bool)
    for start in range(0, len(rows), BLOCK):
        # in lexicographic order nothing later dominates anything earlier
        block = rows[start : start + BLOCK]
        stays: Mask = np.logical_not(_as_good(block, rows[:start][kept[:start]]).any(axis=1))
        left = block[stays]
        stays[stays] = _as_good(left, left).sum(axis=1) <= 1  # as itself
        kept[start : start + BLOCK] = stays
    return known[kept[same.ravel()]]


def _as_good(rows: Array, by: Array) -> Mask:
    """Mask (n, m) of the pairs in which a row of ``by`` is as good or better in all costs."""
    return np.logical_and.reduce([x[:, None] >= y for x, y in zip(rows.T, by.T, strict=True)])
