"""A table that grows for hours: a stopped run keeps its rows, and can be continued.

The rows of ``FILE`` go to the state file ``FILE.geneva``; ``FILE`` is replaced at the end, in one
step. The state's first line names the program and the request. Each block of rows follows a line
with the numbers of its rows and its bytes, and a checksum of all blocks up to it.
"""

from __future__ import annotations

import os
import re
import sys
import zlib
from collections.abc import Collection, Iterator, Sequence
from typing import Any

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import Paths, refuse_columns
from geneva_cli.output.delimited import one_line, text_of
from geneva_cli.output.files import open_locked, place, remove, replacing, write_errors
from geneva_cli.output.text import refuse_nonsense
from geneva_cli.streams import use_utf8

TITLE = b"geneva sweep state 2 "
HEAD = re.compile(rb"block (\d{1,18}) (\d{1,18}) (\d{1,18})\n")
LINE_MAX = 1000  # bytes of a line of ours; a foreign file may have one of gigabytes


class GrowingTable:
    """The destination of the rows of ``names``, ``done`` of which exist already.

    ``key`` is all that they depend on. With ``resume`` a run continues one with the same key, or
    starts if there is none; ``message`` says where. Raises GenevaError if the file cannot be
    written, if another run writes it, or if the run to continue had another key.
    """

    def __init__(
        self, names: Sequence[str], key: str, output: str, resume: bool = False, inputs: Paths = ()
    ) -> None:
        refuse_columns()
        self.names, self.path, self.inputs = names, output, tuple(inputs)
        self.done, self.sum, self.message = 0, 0, ""
        self.state: Any = None  # a file
        self.parquet = output.endswith(".parquet")
        if output == "-":
            if resume:
                raise GenevaError("--resume continues a file: give -o FILE")
            use_utf8()
            sys.stdout.write(one_line(names))
            return
        if not output.endswith((".csv", ".parquet")):
            raise GenevaError(f'-o "{cut(output, 300)}": it must end in .csv or .parquet')
        if self.parquet:
            from geneva_cli.output.parquet import refuse_without

            refuse_without()
        with write_errors(output):
            self.state_path = place(output, self.inputs)[0] + ".geneva"
            self.state = open_locked(self.state_path, output)
            try:
                self._begin(TITLE + key.encode() + b"\n", resume)
            except BaseException:
                self.close()
                raise

    def _begin(self, first: bytes, resume: bool) -> None:
        name, known = cut(os.path.basename(self.state_path)), self.state.readline(LINE_MAX)
        if known and not (known.startswith(TITLE) and known.endswith(b"\n")):
            raise GenevaError(
                f"{name}: not the state of a sweep, which has this name; rename it, or give -o "
                "another name"
            )
        if resume and known not in (b"", first):
            raise GenevaError(
                f"--resume: {name} has the rows of another run "
                "(another spec, other options or another version); start without --resume"
            )
        self.start = len(first)
        if resume and known:
            for _ in self._blocks():
                pass
        if not self.done:
            self.end = 0
            self._write(first)
        if resume:
            self.message = f"--resume: {name}: continues after row {self.done}"

    def _write(self, data: bytes) -> None:
        """Write after what is whole, and hand it to the system."""
        with write_errors(self.path):
            self.state.seek(self.end)
            self.state.truncate()
            self.state.write(data)
            self.state.flush()
            self.end = self.state.tell()

    def _blocks(self) -> Iterator[bytes]:
        """Yield the bytes of each block up to the first damaged one, and count the rows."""
        self.done, self.end, self.sum = 0, self.start, 0
        size = os.fstat(self.state.fileno()).st_size
        self.state.seek(self.end)
        while line := HEAD.fullmatch(self.state.readline(LINE_MAX)):
            rows, length, wanted = map(int, line.groups())
            data = self.state.read(min(length, size))
            if len(data) < length or zlib.crc32(data, self.sum) != wanted:
                return
            self.done, self.end, self.sum = self.done + rows, self.state.tell(), wanted
            yield data

    def append(self, columns: Sequence[Any]) -> None:
        """Add rows as columns, arrays where infinity is no value, or lists of cells.

        Raises ArithmeticError for NaN.
        """
        refuse_nonsense(self.names, columns, endless=True)
        if self.parquet:
            from geneva_cli.output.parquet import block_of

            data = block_of(self.names, columns)
        else:
            text = text_of(columns, infinity="")
            if not self.state:
                sys.stdout.write(text)
                return
            data = text.encode()
        self.sum = zlib.crc32(data, self.sum)
        self._write(b"block %d %d %d\n%s" % (len(columns[0]), len(data), self.sum, data))
        self.done += len(columns[0])

    def finish(self, texts: Collection[str] = ()) -> None:
        """Replace the file by all rows; ``texts`` are columns that hold no numbers."""
        if not self.state:
            return
        if self.parquet and not self.done:
            self.append([[] for _ in self.names])  # the names of the columns are in each block
        done = self.done
        with write_errors(self.path), replacing(self.path, self.inputs) as file:
            if self.parquet:
                from geneva_cli.output.parquet import write_blocks

                write_blocks(self._blocks, file, texts)
            else:
                file.write(one_line(self.names).encode())
                file.writelines(self._blocks())
            if self.done != done:
                raise GenevaError(
                    f"{self.state_path}: changed or damaged while the run wrote it; run again with "
                    "--resume"
                )
        remove(self.state, self.state_path)
        self.close()

    def close(self) -> None:
        """Close the state file, which remains to be continued, and end its lock."""
        if self.state:
            self.state.close()
