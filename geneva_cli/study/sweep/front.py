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
    asked = list(zip(columns, signs, strict=True))
    costs = np.array([[sign * rows[i][c] for c, sign in asked] for i in some])
    return [some[i] for i in best(costs)]


def best(costs: Array) -> list[int]:
    """The numbers of the rows of costs that no other row dominates, ascending.

    In lexicographic order no row dominates an earlier one. So each row is compared with the front
    before it only.
    """
    order = np.lexsort(costs.T[::-1])
    found: list[int] = []
    held = np.empty((0, costs.shape[1]))
    for i in order.tolist():
        row = costs[i]
        dominated = ((held <= row).all(axis=1) & (held < row).any(axis=1)).any()
        if not dominated:
            found.append(i)
            held = np.vstack((held, row))
    return sorted(found)
