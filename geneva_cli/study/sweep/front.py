"""The Pareto front of a sweep: rows that no other row beats."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.study.sweep.constraints import is_number


def front(
    rows: Sequence[Sequence[Any]], columns: Sequence[int], signs: Sequence[float]
) -> list[int]:
    """The numbers of the rows on the Pareto front.

    A row is on it if no other is as good in all objectives and better in one. Rows without one of
    the numbers are left out. Equal rows stay together.
    """
    known = [i for i, row in enumerate(rows) if all(is_number(row[c]) for c in columns)]
    if not known:
        return []
    signed = list(zip(columns, signs, strict=True))
    costs = np.array([[sign * rows[i][c] for c, sign in signed] for i in known])
    return [known[i] for i in best(costs)]


def best(costs: Array) -> list[int]:
    """The numbers of the rows of costs that no other row dominates, ascending.

    Time grows as n log n for two costs, with one more log n for each further cost.
    """
    order = np.lexsort(costs.T[::-1])
    rows = costs[order]
    new = np.append(True, (rows[1:] != rows[:-1]).any(axis=1))
    kept = np.empty(len(rows), dtype=bool)
    kept[order] = _not_dominated(rows[new])[np.cumsum(new) - 1]
    return np.flatnonzero(kept).tolist()


def _not_dominated(rows: Array) -> Mask:
    """Mask of the rows that no other dominates; the rows differ, in lexicographic order."""
    # nothing later dominates anything earlier (H. T. Kung, F. Luccio and F. P. Preparata, 1975)
    count = len(rows)
    if count <= 256:  # fewer rows take no longer all at once
        alone: Mask = _pairs(rows, rows).sum(axis=1) == 1  # with itself
        return alone
    half = count // 2
    kept = np.zeros(count, dtype=bool)
    kept[:half] = _not_dominated(rows[:half])
    rest = half + np.flatnonzero(~_covered(rows[half:, 1:], rows[:half][kept[:half], 1:]))
    kept[rest] = _not_dominated(rows[rest])
    return kept


def _covered(rows: Array, by: Array) -> Mask:
    """Mask of the rows for which a row of ``by`` is as good or better in all costs."""
    if not by.shape[1]:
        return np.full(len(rows), len(by) > 0)
    if by.shape[1] <= 2:
        by = by[np.argsort(by[:, 0], kind="stable")]
        least = np.append(np.nan, np.minimum.accumulate(by[:, -1]))  # NaN: none is up to it
        at_most: Mask = least[np.searchsorted(by[:, 0], rows[:, 0], "right")] <= rows[:, -1]
        return at_most
    if len(rows) * len(by) <= 1 << 16:  # pairs that are compared all at once
        return np.asarray(_pairs(rows, by).any(axis=1))
    middle = np.partition(by[:, 0], len(by) // 2)[len(by) // 2]
    beyond, up_to = rows[:, 0] >= middle, by[:, 0] <= middle
    out = np.zeros(len(rows), dtype=bool)
    out[beyond] = _covered(rows[beyond, 1:], by[up_to, 1:])
    out[~beyond] = _covered(rows[~beyond], by[by[:, 0] < middle])
    rest = beyond & ~out
    out[rest] = _covered(rows[rest], by[~up_to])
    return out


def _pairs(rows: Array, by: Array) -> Mask:
    """Mask (n, m) of the pairs in which a row of ``by`` is as good or better in all costs."""
    return np.asarray((rows[:, None] >= by).all(axis=2))
