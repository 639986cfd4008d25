"""The rows of a sweep that no other beats: the Pareto front of some objectives."""

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
    """The numbers of the rows of which no other is as good in all objectives and better in one.

    A row without one of the numbers is none of them. Equal rows stay together.
    """
    some = [i for i, row in enumerate(rows) if all(is_number(row[c]) for c in columns)]
    if not some:
        return []
    asked = list(zip(columns, signs, strict=True))
    costs = np.array([[sign * rows[i][c] for c, sign in asked] for i in some])
    return [some[i] for i in best(costs)]


def best(costs: Array) -> list[int]:
    """The rows of costs that no other row dominates, in their order.

    By descending lexicographic order nothing later dominates anything earlier, so each row is held
    against the front so far alone.
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
