"""The Pareto front of a sweep: rows that no other row beats."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.study.sweep.constraints import is_number

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


def front(
    rows: Sequence[Sequence[Any]], columns: Sequence[int], signs: Sequence[float]
) -> list[int]:
    """The numbers of the rows on the Pareto front.

    A row is on it if no other is as good in all objectives and better in one. Rows without one of
    the numbers are left out. Equal rows stay together.
    """
    some = [i for i, row in enumerate(rows) if all(is_number(row[c]) for c in columns)]
    if not some:
        return []
    signed = list(zip(columns, signs, strict=True))
    costs = np.array([[sign * rows[i][c] for c, sign in signed] for i in some])
    return [some[i] for i in best(costs)]


def best(costs: Array) -> list[int]:
    """The numbers of the rows of costs that no other row dominates, ascending.

    Time grows as n log n for up to two costs, and as n times the rows that are kept for more.
    """
    rows, places = np.unique(costs, axis=0, return_inverse=True)
    if costs.shape[1] <= 2:  # in lexicographic order only a new minimum of the last is kept
        last = rows[:, -1]
        kept = np.append(True, last[1:] < np.minimum.accumulate(last)[:-1])
    else:
        kept = _not_dominated(rows)
    return np.flatnonzero(kept[places.ravel()]).tolist()


def _not_dominated(rows: Array) -> Array:
    """Mask of the rows that no other dominates; the rows differ, in lexicographic order.

    In this order nothing later dominates anything earlier, so each row is held against the front
    so far alone.
    """
    kept = np.zeros(len(rows), dtype=bool)
    front_rows, size = np.empty_like(rows), 0
    for i, row in enumerate(rows):
        if not (front_rows[:size] <= row).all(axis=1).any():
            kept[i] = True
            front_rows[size] = row
            size += 1
    return kept
