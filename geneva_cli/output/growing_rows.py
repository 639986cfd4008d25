"""Rows of a growing table: csv on standard output or in a file, or parquet."""

from __future__ import annotations

import sys
from collections.abc import Collection, Iterable, Sequence
from functools import partial
from typing import Any

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import refuse_columns, refuse_inches
from geneva_cli.output.delimited import one_line
from geneva_cli.output.finite import refuse_nonsense
from geneva_cli.output.growing import GrowingFile


class GrowingTable:
    """The destination of the rows of ``names``, ``done`` of which exist already.

    ``key`` is all that they depend on, for ``resume``; ``message`` says what that does. A later
    shard of a table has no ``header``.
    """

    def __init__(
        self,
        names: Sequence[str],
        key: str,
        header: bool,
        output: str,
        resume: bool = False,
        inputs: Iterable[str] = (),
    ) -> None:
        refuse_columns()
        refuse_inches("csv and parquet are for programs, and in SI units")
        self.names, self.output, self.done = names, output, 0
        self.is_whole, self.message = False, ""
        self.file: GrowingFile | None = None
        self.parquet = output.endswith(".parquet")
        if output != "-" and not output.endswith((".csv", ".parquet")):
            raise GenevaError(f'-o "{cut(output, 300)}": it must end in .csv or .parquet')
        if self.parquet:
            from geneva_cli.output.parquet import refuse_without

            refuse_without()
            header = True  # a shard is a file of its own
        first = one_line(names) if header else ""
        if output != "-":
            self.file = GrowingFile(output, first, key, resume, inputs)
            self.done = self.file.done
            self.is_whole, self.message = self.file.is_whole, self.file.message
        elif resume:
            raise GenevaError("--resume continues a file: give -o FILE")
        else:
            sys.stdout.write(first)

    def append(self, rows: Sequence[Sequence[Any]]) -> None:
        """Add rows. Raises ArithmeticError for NaN."""
        refuse_nonsense(self.names, list(zip(*rows, strict=True)))
        text = "".join(map(one_line, rows))
        if self.file:
            self.file.append(text)
        else:
            sys.stdout.write(text)

    def finish(self, texts: Collection[str] = ()) -> None:
        """Give the complete file its name; ``texts`` are columns that hold no numbers."""
        if not self.file:
            return
        if not self.parquet:
            self.file.finish()
            return
        from geneva_cli.output.parquet import convert

        self.file.finish(partial(convert, texts=texts))

    def close(self) -> None:
        """Close the file; an unfinished one can be continued."""
        if self.file:
            self.file.close()
