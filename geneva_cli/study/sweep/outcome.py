"""Counts of a sweep's designs, and the reason why no row is left."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.constraints import Nearness, is_number
from geneva_cli.study.sweep.request import SweepRequest

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

    def refused(self) -> Sequence[str]:
        """The number of designs that cannot be built, with the first reason or where to find it."""
        if not self.failed:
            return []
        why = f"the first: {self._first}" if self.request.chooses else "column error says why"
        return [f"{self.failed:,} of {self.all:,} designs cannot be built: {why}"]

    def notes(self) -> Sequence[str]:
        """Notes for the user besides the rows."""
        notes = [*self.refused()]
        if self.all and not self.left:
            unknown = [f"no design has a value of {name}" for name in self._unknown.values()]
            why = dict.fromkeys([*unknown, *self._nearness.phrases()])
            notes.append(f"none of {self.all:,} rows is left: {'; '.join(why)}")
        return notes
