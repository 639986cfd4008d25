"""A file that grows for hours: a stopped run keeps its rows, and can be continued.

The rows go to the state file ``FILE.geneva``; ``FILE`` is replaced at the end, in one step. The
state's first line names the program and the request. Each block of rows follows a line with the
numbers of rows before and in it, and of its bytes. A run that may be repeated (``resume``) keeps
the state: a line with the digest of the whole file then replaces the blocks.
"""

from __future__ import annotations

import os
import re
import stat
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import partial
from typing import Any, BinaryIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import refuse_columns
from geneva_cli.output.delimited import one_line, text_of
from geneva_cli.output.files import (
    CAREFUL,
    digest_of,
    lock,
    place,
    refuse_input,
    remove,
    replacing,
    write_errors,
)
from geneva_cli.output.text import refuse_nan
from geneva_cli.streams import use_utf8

SUFFIX = ".geneva"
TITLE = b"geneva sweep state 1 "
LINE_MAX = 1000  # bytes of a line of ours; a foreign file may have one of gigabytes


class GrowingFile:
    """Lines appended to a file, ``done`` of which exist already, below the header.

    ``key`` is all that the lines depend on. With ``resume`` a run continues one with the same key,
    starts if there is none, and does nothing if the file ``is_whole``; ``message`` says which.
    Raises GenevaError if the file cannot be written, if another run writes it, or if the run to
    continue had another key.
    """

    def __init__(
        self, path: str, header: str, key: str, resume: bool, inputs: Iterable[str] = ()
    ) -> None:
        self.path, self.inputs, self.resume, self.done = path, tuple(inputs), resume, 0
        self.is_whole, self.message = False, ""
        with write_errors(path):
            self.real, old = place(path, self.inputs)
            if old is not None and not stat.S_ISREG(old.st_mode):
                raise GenevaError(
                    f"{path}: not a file that can grow; print to it with -o - instead"
                )
            self.state = self.real + SUFFIX
            self.file = _open_locked(self.state, self.inputs)
            try:
                self.first = self.file.readline(LINE_MAX)
                if self.first and not (self.first.startswith(TITLE) and self.first.endswith(b"\n")):
                    raise _not_ours(self.state)
                if not (resume and self._continue(key)):
                    self._begin(TITLE + key.encode() + b"\n")
                    if header:
                        self.append(header.encode(), 0)
            except BaseException:
                self.file.close()
                raise

    def _begin(self, first: bytes) -> None:
        self.first, self.end = first, len(first)
        self.file.seek(0)
        self.file.truncate()
        self.file.write(first)
        self.file.flush()

    def _continue(self, key: str) -> bool:
        name = cut(os.path.basename(self.real))
        same = self.first == TITLE + key.encode() + b"\n"
        whole = re.fullmatch(rb"whole ([0-9a-f]{64})\n", self.file.readline(LINE_MAX))
        if same and whole and whole[1].decode() == digest_of(self.real):
            self.is_whole = True
            self.message = f"--resume: {name} is whole already"
            return True
        if not self.first or whole:
            self.message = f"--resume: there is nothing to continue for {name}; from the first row"
            return False
        if not same:
            raise GenevaError(
                f"--resume: {name}{SUFFIX} has the rows of another run "
                "(another spec, other options or another version); start without --resume"
            )
        blocks = [rows for rows, _ in self._blocks()]
        self.done = sum(blocks)
        if os.fstat(self.file.fileno()).st_size > self.end:
            self.message = (
                f"--resume: {name}{SUFFIX} is incomplete or damaged after row {self.done}; "
                "continues there"
            )
        return bool(blocks)

    def _blocks(self) -> Iterator[tuple[int, bytes]]:
        """Yield the number of rows and the bytes of each block, up to the first incomplete one."""
        size, done, self.end = os.fstat(self.file.fileno()).st_size, 0, len(self.first)
        self.file.seek(self.end)
        head = re.compile(rb"block (\d{1,18}) (\d{1,18}) (\d{1,18})\n")
        while line := head.fullmatch(self.file.readline(LINE_MAX)):
            before, rows, length = map(int, line.groups())
            if before != done or length > size - self.file.tell():
                return
            data = self.file.read(length)
            done, self.end = done + rows, self.file.tell()
            yield rows, data

    def append(self, data: bytes, rows: int) -> None:
        """Add a block of rows, and hand it to the system before the next is computed."""
        with write_errors(self.path):
            self.file.seek(self.end)
            self.file.truncate()
            self.file.write(b"block %d %d %d\n" % (self.done, rows, len(data)))
            self.file.write(data)
            self.file.flush()
            self.end = self.file.tell()
        self.done += rows

    def finish(
        self, fill: Callable[[Callable[[], Iterator[bytes]], BinaryIO], None] | None = None
    ) -> None:
        """Replace the file by the blocks, or by what ``fill`` makes of them, in one step.

        ``fill`` takes a function that yields the blocks, and the file.
        """
        with write_errors(self.path):
            with replacing(self.path, self.inputs) as file:
                if fill:
                    fill(self._lines, file)
                else:
                    file.writelines(self._lines())
            if self.resume:
                self._begin(self.first + f"whole {digest_of(self.real)}\n".encode())
            else:
                remove(self.file, self.state)
            self.close()

    def _lines(self) -> Iterator[bytes]:
        """Yield the lines, block by block. Raises GenevaError if some are not there."""
        rows = 0
        for count, data in self._blocks():
            rows += count
            yield data
        if rows != self.done:
            raise GenevaError(
                f"{self.path}{SUFFIX}: somebody has changed this file while the run wrote it; "
                "run again with --resume"
            )

    def close(self) -> None:
        """Close the state file, which remains to be continued, and end its lock."""
        self.file.close()


def _open_locked(path: str, inputs: Iterable[str]) -> BinaryIO:
    name = cut(os.path.basename(path.removesuffix(SUFFIX)))
    busy = f"{name}: another run is writing this file; wait until it ends, or give -o another name"
    if os.path.lexists(path):
        status = os.lstat(path)
        if not stat.S_ISREG(status.st_mode):
            raise _not_ours(path)
        refuse_input(path, status, inputs)
    # A link or a pipe that somebody puts there now is neither followed nor waited for.
    file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT | CAREFUL, 0o666), "r+b")
    try:
        lock(file.fileno(), busy, alone=True)
        if not os.fstat(file.fileno()).st_nlink:  # the run with the lock has just removed it
            raise GenevaError(busy)
    except BaseException:
        file.close()
        raise
    return file


def _not_ours(path: str) -> GenevaError:
    return GenevaError(
        f"{cut(os.path.basename(path))}: a sweep keeps its state under this name, but something "
        "else has it; rename it, or give -o another name"
    )


class GrowingTable:
    """The destination of the rows of ``names``, ``done`` of which exist already.

    ``key`` is all that they depend on, for ``resume``; ``message`` says what that does.
    """

    def __init__(
        self,
        names: Sequence[str],
        key: str,
        output: str,
        resume: bool = False,
        inputs: Iterable[str] = (),
    ) -> None:
        refuse_columns()
        self.names, self.done, self.is_whole, self.message = names, 0, False, ""
        self.file: GrowingFile | None = None
        self.parquet = output.endswith(".parquet")
        if output != "-" and not output.endswith((".csv", ".parquet")):
            raise GenevaError(f'-o "{cut(output, 300)}": it must end in .csv or .parquet')
        if self.parquet:
            from geneva_cli.output.parquet import refuse_without

            refuse_without()
        first = one_line(names) if not self.parquet else ""
        if output != "-":
            self.file = GrowingFile(output, first, key, resume, inputs)
            self.done = self.file.done
            self.is_whole, self.message = self.file.is_whole, self.file.message
        elif resume:
            raise GenevaError("--resume continues a file: give -o FILE")
        else:
            use_utf8()
            sys.stdout.write(first)

    def append(self, columns: Sequence[Any]) -> None:
        """Add rows as columns, arrays where infinity is no value, or lists of cells.

        Raises ArithmeticError for NaN.
        """
        refuse_nan(self.names, columns)
        if self.file and self.parquet:
            from geneva_cli.output.parquet import block_of

            self.file.append(block_of(self.names, columns), len(columns[0]))
            return
        text = text_of(columns, infinity="")
        if self.file:
            self.file.append(text.encode(), len(columns[0]))
        else:
            sys.stdout.write(text)

    def finish(self, texts: Collection[str] = ()) -> None:
        """Give the complete file its name; ``texts`` are columns that hold no numbers."""
        if self.file and self.parquet:
            from geneva_cli.output.parquet import block_of, write_blocks

            if not self.file.done:  # the names of the columns are in each block
                self.file.append(block_of(self.names, [[] for _ in self.names]), 0)
            self.file.finish(partial(write_blocks, texts=texts))
        elif self.file:
            self.file.finish()

    def close(self) -> None:
        """Close the file; an unfinished one can be continued."""
        if self.file:
            self.file.close()
