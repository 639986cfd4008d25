"""The rows of a sweep that no other beats: the Pareto front of some objectives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.study.sweep.constraints import is_number

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SENSES = {"min": 1.0, "max": -1.0}


class Objective(NamedTuple):
    """A quantity that should be small (sign 1) or large (-1)."""

    sign: float
    name: str


def objective(text: str, option: str = "--pareto") -> Objective:
    """The objective that ``min:acceleration.max`` means. Raises GenevaError for another text."""
    sense, _, name = text.strip().partition(":")
    if sense not in SENSES or not name:
        raise GenevaError(
            f"{option} {cut(text.strip())}: it must be min:FIELD or max:FIELD, as "
            "min:acceleration.max"
        )
    return Objective(SENSES[sense], name)


def refuse_opposites(given: Sequence[Objective]) -> None:
    """Raise GenevaError for a quantity that should be small and large, which every row is."""
    names = [o.name for o in dict.fromkeys(given)]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice:
        raise GenevaError(f"--pareto {twice}: it cannot be both min and max; keep one of them")


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
