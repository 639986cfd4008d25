"""The best designs of different places in a sweep, and their refinement by shrinking clouds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.progress import tracked
from geneva_cli.study.sweep.best_search import Row, SweepSearch
from geneva_cli.study.sweep.values import Value

PLACES_MAX = 24  # that are kept and refined


class Place(NamedTuple):
    """A choice of words and whole numbers, and the part of each span."""

    choice: tuple[Value, ...]
    parts: tuple[int, ...]


class BestPlaces:
    """The best design of each place.

    A place is one choice of words and whole numbers, with one part of each span. A scan has few
    designs for each number of slots, so its best design may have the wrong number. Refining the
    best design of each number tells which is right.
    """

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.rows: dict[Place, Row] = {}

    def add(self, rows: Sequence[Row]) -> None:
        """Add rows; the first of equal rows stays."""
        for row in rows:
            place = self._place(row)
            best = self.rows.get(place)
            if best is None or self.search.merit(row) < self.search.merit(best):
                self.rows[place] = row
        if len(self.rows) > 8 * PLACES_MAX:
            self.rows = dict(self._foremost(4 * PLACES_MAX))

    def best(self) -> list[Row]:
        """The best designs, the best first."""
        return [row for _, row in self._foremost(PLACES_MAX)]

    def _foremost(self, most: int) -> list[tuple[Place, Row]]:
        """At most so many places, the best first: one of each choice before a second of any."""
        items = sorted(self.rows.items(), key=self._merit)
        best = {place.choice: place for place, _ in reversed(items)}
        items.sort(key=lambda item: best[item[0].choice] != item[0])
        return sorted(items[:most], key=self._merit)

    def _merit(self, item: tuple[Place, Row]) -> tuple[float, float]:
        return self.search.merit(item[1])

    def _place(self, row: Row) -> Place:
        free = self.search.free
        if not free:  # no refinement follows
            return Place((), ())
        # designs in different thirds of a span are in different places
        parts = np.minimum(self.search.fractions(row) * 3, 2).astype(int)
        keys = enumerate(self.search.keys(row))
        return Place(tuple(v for i, v in keys if i not in free), tuple(parts.tolist()))


def closer(search: SweepSearch, rows: Sequence[Row]) -> list[Row]:
    """Refine each design by clouds that shrink about it, and return those near the best.

    Returns all designs unchanged if their quantities cannot be computed for a batch.
    """
    best = list(rows)
    if not search.sweep.is_batched:
        return best
    draw = np.random.default_rng(0)
    count = 48  # designs about each place in a round
    width = 0.25  # half of the cloud's, as a fraction of the span; 16 rounds take it to 1e-4
    for _ in tracked(range(16), "rounds", 16):
        steps = draw.uniform(-width, width, (len(best), count, len(search.free)))
        about = [
            search.moved(row, search.fractions(row) + step)
            for row, row_steps in zip(best, steps, strict=True)
            for step in row_steps
        ]
        drawn = search.sweep.rows_of(about)
        clouds = [drawn[i * count : (i + 1) * count] for i in range(len(best))]
        best = [min((row, *c), key=search.merit) for row, c in zip(best, clouds, strict=True)]
        width *= 0.6
    best.sort(key=search.merit)
    least = search.cost(best[0])
    # clouds come far closer to a minimum than 1 %, so that a place above it is no rival
    return [row for row in best if search.cost(row) <= least + 0.01 * abs(least)]
