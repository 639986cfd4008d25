"""A table that grows for hours: a stopped run keeps its rows, and can be continued.

The rows of ``FILE`` go to the state file ``FILE.geneva``; ``FILE`` is replaced at the end, in one
step. The state's first line names the program and the request. Each block of rows follows a line
with the numbers of its rows and its bytes, and their checksum.
"""

from __future__ import annotations

import os
import re
import sys
import zlib
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from itertools import chain
from typing import Any

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import Paths, parquet, refuse_columns
from geneva_cli.output.delimited import one_line, text_of
from geneva_cli.output.files import open_locked, place, remove, replacing, write_errors
from geneva_cli.output.text import refuse_nonsense
from geneva_cli.streams import use_utf8

TITLE = b"geneva sweep state 3 "
HEAD = re.compile(rb"block (\d{1,18}) (\d{1,18}) (\d{1,18})\n")
LINE_MAX = 1000  # bytes of a line of ours; a foreign file may have one of gigabytes


class GrowingTable:
    """The destination of the rows of ``names``, ``done`` of which exist already.

    Without ``state``, an open file, rows are printed. ``message`` says where a run continues.
    """

    def __init__(self, names: Sequence[str], output: str, state: Any = None) -> None:
        self.names, self.output, self.state = names, output, state
        self.done, self.start, self.end, self.message = 0, 0, 0, ""

    def append(self, columns: Sequence[Any]) -> None:
        """Add rows as columns, arrays where infinity is no value, or lists of cells.

        Raises ArithmeticError for NaN.
        """
        refuse_nonsense(self.names, columns, endless=True)
        if self.output.endswith(".parquet"):
            data = parquet.block_of(self.names, columns)
        else:
            data = text_of(columns, infinity="").encode()
        if not self.state:
            sys.stdout.write(data.decode())
            return
        self.write(b"block %d %d %d\n%s" % (len(columns[0]), len(data), zlib.crc32(data), data))
        self.done += len(columns[0])

    def write(self, data: bytes) -> None:
        """Write after what is whole, and hand it to the system."""
        with write_errors(self.output):
            self.state.seek(self.end)
            self.state.truncate()
            self.state.write(data)
            self.state.flush()
            self.end = self.state.tell()

    def blocks(self) -> Iterator[bytes]:
        """Yield the bytes of each block up to the first damaged one, and count the rows."""
        self.done, self.end = 0, self.start
        size = os.fstat(self.state.fileno()).st_size
        self.state.seek(self.end)
        while line := HEAD.fullmatch(self.state.readline(LINE_MAX)):
            rows, length, checksum = map(int, line.groups())
            data = self.state.read(min(length, size))
            if zlib.crc32(data) != checksum:
                return
            self.done, self.end = self.done + rows, self.state.tell()
            yield data

    def begin(self, key: str, resume: bool, name: str) -> None:
        """Begin or continue the rows of ``key`` in the state, a file of this name."""
        first, known = TITLE + key.encode() + b"\n", self.state.readline(LINE_MAX)
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
        for _ in self.blocks() if resume else ():
            pass  # counts them
        if not self.done:
            self.end = 0
            self.write(first)
        if resume:
            self.message = f"--resume: {name}: continues after row {self.done}"


@contextmanager
def growing(
    names: Sequence[str],
    key: str,
    output: str,
    resume: bool = False,
    inputs: Paths = (),
    texts: Collection[str] = (),
) -> Iterator[GrowingTable]:
    """Give the destination of rows, which replaces the file if the block ends without an error.

    ``key`` is all that they depend on. With ``resume`` they continue those of the same key, if any.
    ``texts`` are columns that hold no numbers. Raises GenevaError if the file cannot be written, if
    another run writes it, or if the run to continue had another key.
    """
    refuse_columns()
    if output == "-":
        if resume:
            raise GenevaError("--resume continues a file: give -o FILE")
        use_utf8()
        sys.stdout.write(one_line(names))
        yield GrowingTable(names, output)
        return
    if not output.endswith((".csv", ".parquet")):
        raise GenevaError(f'-o "{cut(output, 300)}": it must end in .csv or .parquet')
    is_parquet = output.endswith(".parquet")
    if is_parquet:
        parquet.refuse_without()
    with write_errors(output):
        path = place(output, inputs)[0] + ".geneva"
        state = open_locked(path, output)
    with state:
        rows = GrowingTable(names, output, state)
        rows.begin(key, resume, cut(os.path.basename(path)))
        yield rows
        with replacing(output, inputs) as file:
            if is_parquet and not rows.done:
                rows.append([[] for _ in names])  # the names of the columns are in each block
            done = rows.done
            if is_parquet:
                parquet.write_blocks(rows.blocks, file, texts)
            else:
                file.writelines(chain([one_line(names).encode()], rows.blocks()))
            if rows.done != done:
                raise GenevaError(
                    f"{path}: changed or damaged while the run wrote it; run again with --resume"
                )
        remove(state, path)
