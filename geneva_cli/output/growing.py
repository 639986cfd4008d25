"""A table that grows for hours: a stopped run keeps its rows, and can be continued.

Rows go to the state ``FILE.geneva``, from which a later run takes them. At the end they become
``FILE``. The state's first line names the request. Each block of rows follows a line with the
numbers of its rows and its bytes, and their checksum.
"""

import os
import re
import sys
import zlib
from collections import deque
from collections.abc import Callable, Collection, Iterator, Sequence
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

    Each block of rows, as ``encode`` makes it, goes to ``state``, an open file. Without a state
    rows are printed. ``message`` says where a run continues.
    """

    def __init__(self, names: Sequence[str], state: Any = None, name: str = "") -> None:
        self.names, self.state, self.name = names, state, name
        self.encode: Callable[..., bytes] = lambda _, columns: text_of(columns, "").encode()
        self.done, self.message = 0, ""

    def append(self, columns: Sequence[Any]) -> None:
        """Add rows as columns, arrays where infinity is no value, or lists of cells.

        Raises ArithmeticError for NaN.
        """
        refuse_nonsense(self.names, columns, endless=True)
        data, count = self.encode(self.names, columns), len(columns[0])
        if self.state:
            self.state.write(b"block %d %d %d\n%s" % (count, len(data), zlib.crc32(data), data))
            self.state.flush()
        else:
            sys.stdout.write(data.decode())
        self.done += count

    def blocks(self) -> Iterator[bytes]:
        """Yield the bytes of each block, and count the rows; cut off the first damaged block."""
        self.state.seek(0)
        self.done, end = 0, len(self.state.readline(LINE_MAX))
        size = os.fstat(self.state.fileno()).st_size
        while line := HEAD.fullmatch(self.state.readline(LINE_MAX)):
            rows, length, checksum = map(int, line.groups())
            data = self.state.read(min(length, size))
            if zlib.crc32(data) != checksum:
                break
            self.done, end = self.done + rows, self.state.tell()
            yield data
        self.state.seek(end)
        self.state.truncate()

    def begin(self, key: str, resume: bool) -> None:
        """Begin or continue the rows of ``key`` in the state."""
        first, known = TITLE + key.encode() + b"\n", self.state.readline(LINE_MAX)
        if known and not (known.startswith(TITLE) and known.endswith(b"\n")):
            why = "not the state of a sweep, which has this name"
            raise GenevaError(f"{self.name}: {why}; rename it, or give -o another name")
        if resume and known not in (b"", first):
            why = "another spec, other options or another version); start without --resume"
            raise GenevaError(f"--resume: {self.name} has the rows of another run ({why}")
        if not (resume and known):
            self.state.seek(0)
            self.state.truncate()
            self.state.write(first)
        if resume:
            deque(self.blocks(), maxlen=0)
            self.message = f"--resume: {self.name}: continues after row {self.done}"


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
        yield GrowingTable(names)
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
        with replacing(output, inputs) as file:  # keeps other runs out
            rows = GrowingTable(names, state, cut(os.path.basename(path)))
            rows.begin(key, resume)
            if is_parquet:
                rows.encode = parquet.block_of
            yield rows
            if is_parquet and not rows.done:
                rows.append([[] for _ in names])  # the names of the columns are in each block
            done = rows.done
            if is_parquet:
                parquet.write(file, rows.blocks, texts)
            else:
                file.writelines(chain([one_line(names).encode()], rows.blocks()))
            if rows.done != done:
                why = "changed or damaged while the run wrote it; run again with --resume"
                raise GenevaError(f"{rows.name}: {why}")
        remove(state, path)
