"""Counts of a sweep's designs, why no row is left, and the rows that a terminal shows."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.constraints import Nearness, Objective, is_number
from geneva_cli.study.sweep.request import SweepRequest
from geneva_cli.table import Table, rows_table

Rows: TypeAlias = list[list[Cell]]


class Outcome:
    """Counts of rows as they arrive: all, those that cannot be built, and those that are kept."""

    def __init__(self, request: SweepRequest) -> None:
        self.request = request
        self.all = self.failed = self.left = 0
        self._first = ""  # why the first of them cannot be built
        names = request.sweep.names
        self._nearness = Nearness([(names.index(c.name), c) for c in request.constraints])
        self._unknown = {names.index(o.name): o.name for o in request.objectives}

    def rows(self, row_blocks: Iterable[Rows]) -> Iterator[Rows]:
        """The rows of the request, counted: all of them, or those that it chooses."""
        counted = self.counted(row_blocks)
        for block in self.request.chosen(counted) if self.request.chooses else counted:
            self.left += len(block)
            yield block

    def counted(self, row_blocks: Iterable[Rows]) -> Iterator[Rows]:
        """All rows, counted."""
        for block in row_blocks:
            failed = [str(row[-1]) for row in block if row[-1] is not None]
            self.all += len(block)
            self.failed += len(failed)
            self._first = self._first or (failed[0] if failed else "")
            self._nearness.add(block)
            for i in list(self._unknown):
                if any(is_number(row[i]) for row in block):
                    del self._unknown[i]
            yield block

    def refused(self) -> list[str]:
        """The number of designs that cannot be built, with the first reason or where to find it."""
        if not self.failed:
            return []
        why = f"the first: {self._first}" if self.request.chooses else "column error says why"
        return [f"{self.failed:,} of {self.all:,} designs cannot be built: {why}"]

    def notes(self) -> list[str]:
        """Notes for the user besides the rows."""
        notes = self.refused()
        if self.all and not self.left:
            unknown = [f"no design has a value of {name}" for name in self._unknown.values()]
            why = dict.fromkeys([*unknown, *self._nearness.phrases()])
            notes.append(f"none of {self.all:,} rows is left: {'; '.join(why)}")
        return notes


ROWS = 5  # the first rows, and as many of the best; up to twice as many are all shown

Numbered = tuple[Cell, ...]  # a row behind its number, counted from 1


class Digest:
    """The first rows, the best rows and their count, updated as rows arrive in bounded memory.

    The best have the least, or the greatest, of the first goal of --pareto; without --pareto, the
    least of the first numeric quantity. ``place`` names the file with all rows.
    """

    def __init__(self, request: SweepRequest, place: str = "-o FILE.csv") -> None:
        self.place = place
        self.names = request.sweep.names
        self.goal = request.objectives[0] if request.objectives else None
        self.quantities = request.sweep.pick.names
        self.count = 0
        self.first: list[Numbered] = []
        self.best: list[tuple[float, Numbered]] = []  # the best first

    def add(self, rows: Sequence[Sequence[Cell]]) -> None:
        """Add rows, which are numbered in their order."""
        numbered = [(self.count + i, *row) for i, row in enumerate(rows, 1)]
        self.count += len(rows)
        self.first += numbered[: 2 * ROWS - len(self.first)]
        self.goal = self.goal or self._goal(rows)
        if self.goal:
            sign, at = self.goal.sign, 1 + self.names.index(self.goal.name)
            costs = ((sign * x, row) for row in numbered if is_number(x := row[at]))
            self.best = heapq.nsmallest(
                ROWS, [*self.best, *costs], key=lambda costed: (costed[0], costed[1][0])
            )

    def _goal(self, rows: Sequence[Sequence[Cell]]) -> Objective | None:
        """The first quantity that is a number in some row, to be minimised."""
        for name in self.quantities:
            at = self.names.index(name)
            if any(is_number(row[at]) and not isinstance(row[at], bool) for row in rows):
                return Objective(1.0, name)
        return None

    def tables(self) -> Iterator[Table]:
        """One table with all rows if they are few; otherwise the first rows and the best."""
        if self.count <= 2 * ROWS:
            yield self._table(self.first, "")
            return
        rest = f"All {self.count:,} rows: {self.place}"
        yield self._table(self.first[:ROWS], f"The first {ROWS} rows. {rest}")
        if self.goal:
            best = [row for _, row in self.best]
            yield self._table(best, f"The {len(best)} rows with the {self.goal}")

    def _table(self, rows: Sequence[Numbered], title: str) -> Table:
        names = ("row", *self.names)
        kept = [i for i in range(len(names)) if any(row[i] is not None for row in rows)]
        shown = [tuple(row[i] for i in kept) for row in rows]
        return rows_table([names[i] for i in kept], shown, title)
