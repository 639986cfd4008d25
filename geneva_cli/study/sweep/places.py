"""The best designs of different places in a sweep, and their refinement by shrinking clouds."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from geneva_cli.study.sweep.best_search import Row, SweepSearch

MOST = 24  # places that are kept and refined
PARTS = 3  # parts of each free key's span; designs in different parts are different places
ROUNDS = 16
CLOUD = 48  # designs about each place in a round
# fraction of the least cost; above it a place is not refined further, as clouds come far closer
RIVAL = 0.01
# half the width of the first cloud as a fraction of the span; ratio of each next width
FIRST, LESS = 0.25, 0.6


class Places:
    """The best design of each place.

    A place is one choice of words and whole numbers, with one part of each span. A scan has few
    designs for each number of slots, so its best design may have the wrong number. Refining the
    best design of each number tells which is right.
    """

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.found: dict[Hashable, Row] = {}

    def add(self, rows: Sequence[Row]) -> None:
        """Add rows; the first of equal rows stays."""
        for row in rows:
            place = self._place(row)
            before = self.found.get(place)
            if before is None or self.search.merit(row) < self.search.merit(before):
                self.found[place] = row
        if len(self.found) > 8 * MOST:
            self.found = dict(sorted(self.found.items(), key=self._merit)[: 4 * MOST])

    def best(self) -> list[Row]:
        """The best designs, the best first."""
        return [row for _, row in sorted(self.found.items(), key=self._merit)[:MOST]]

    def _merit(self, item: tuple[Hashable, Row]) -> tuple[float, float]:
        return self.search.merit(item[1])

    def _place(self, row: Row) -> Hashable:
        free = self.search.free
        if not free:  # no refinement follows
            return ()
        parts = np.minimum(self.search.shares(row) * PARTS, PARTS - 1).astype(int)
        keys = enumerate(self.search.keys(row))
        return (*(v for i, v in keys if i not in free), *parts.tolist())


def closer(search: SweepSearch, rows: Sequence[Row]) -> list[Row]:
    """Refine each design by clouds that shrink about it, and return those near the best.

    Returns all designs unchanged if their quantities cannot be computed for a batch.
    """
    best = list(rows)
    if not search.found.known([search.keys(row) for row in best]):
        return best
    draw = np.random.default_rng(0)
    width = FIRST
    for _ in range(ROUNDS):
        steps = draw.uniform(-width, width, (len(best), CLOUD, len(search.free)))
        about = [
            search.moved(row, search.shares(row) + step)
            for row, some in zip(best, steps, strict=True)
            for step in some
        ]
        drawn = search.found.rows_of(about)
        clouds = [drawn[i * CLOUD : (i + 1) * CLOUD] for i in range(len(best))]
        best = [min((row, *c), key=search.merit) for row, c in zip(best, clouds, strict=True)]
        width *= LESS
    best.sort(key=search.merit)
    least = search.cost(best[0])
    return [row for row in best if search.cost(row) <= least + RIVAL * abs(least)]
