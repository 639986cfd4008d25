"""Where the best of a sweep may be: the best designs of different places, brought closer."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from geneva_cli.study.sweep.best_search import Row, SweepSearch

MOST = 24  # places that are followed
PARTS = 3  # of each free key's span, which makes places apart
ROUNDS = 16
CLOUD = 48  # designs about each place in a round
RIVAL = 0.01  # of the least cost, above which a place is not refined: clouds come far closer
FIRST, LESS = 0.25, 0.6  # half the width of the first cloud, a share of the span; of each next one


class Places:
    """The best design of each place: of each choice of words and whole numbers, and part of spans.

    A scan has few designs for each of twenty numbers of slots, so that the best of them all may
    have the wrong number; the best of each number, brought closer, tell which is right.
    """

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.found: dict[Hashable, Row] = {}

    def add(self, rows: Sequence[Row]) -> None:
        """More rows; the first of equals stays."""
        for row in rows:
            place = self._place(row)
            before = self.found.get(place)
            if before is None or self.search.merit(row) < self.search.merit(before):
                self.found[place] = row
        if len(self.found) > 8 * MOST:
            self.found = dict(sorted(self.found.items(), key=self._merit)[: 4 * MOST])

    def best(self) -> list[Row]:
        """The best of them, the best first."""
        return [row for _, row in sorted(self.found.items(), key=self._merit)[:MOST]]

    def _merit(self, item: tuple[Hashable, Row]) -> tuple[float, float]:
        return self.search.merit(item[1])

    def _place(self, row: Row) -> Hashable:
        free = self.search.free
        if not free:  # nothing will be brought closer
            return ()
        parts = np.minimum(self.search.shares(row) * PARTS, PARTS - 1).astype(int)
        keys = enumerate(self.search.keys(row))
        return (*(v for i, v in keys if i not in free), *parts.tolist())


def closer(search: SweepSearch, rows: Sequence[Row]) -> list[Row]:
    """Of each design the best of clouds about it that draw together; those that are near the best.

    Only where many such designs are worked out at once; else all are given back as they are.
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
