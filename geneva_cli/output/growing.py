"""A file that grows for hours: a stopped run keeps its rows, and can be continued.

The rows go to the state file ``FILE.geneva``; ``FILE`` is replaced at the end, in one step. A run
that may be repeated (``resume``) keeps the state file, which then records that ``FILE`` is whole.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import partial
from typing import Any, BinaryIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import refuse_columns, refuse_inches
from geneva_cli.output.delimited import one_line
from geneva_cli.output.files import digest_of, place, replacing, write_errors
from geneva_cli.output.finite import refuse_nonsense
from geneva_cli.output.state import SUFFIX, StateFile


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
            self.state = StateFile(self.real + SUFFIX, self.inputs)
            try:
                if not (resume and self._continue(key)):
                    self.state.begin(key)
                    if header:
                        self.state.append(0, header.encode())
            except BaseException:
                self.state.close()
                raise

    def _continue(self, key: str) -> bool:
        """Return True if the file is whole, or if there are rows to continue."""
        name = cut(os.path.basename(self.real))
        digest = self.state.whole_digest()
        if self.state.request == key and digest == digest_of(self.real):
            self.is_whole = True
            self.message = f"--resume: {name} is whole already"
            return True
        if self.state.request is None or digest is not None:
            self.message = f"--resume: there is nothing to continue for {name}; from the first row"
            return False
        if self.state.request != key:
            raise GenevaError(
                f"--resume: {name}{SUFFIX} has the rows of another run "
                "(another spec, other options or another version); start without --resume"
            )
        blocks = [rows for rows, _ in self.state.blocks()]
        self.done = sum(blocks)
        if self.state.is_damaged:
            self.message = (
                f"--resume: {name}{SUFFIX} is incomplete or damaged after row {self.done}; "
                "continues there"
            )
        return bool(blocks)

    def append(self, text: str) -> None:
        """Add whole lines, and hand them to the system before the next are computed."""
        with write_errors(self.path):
            self.state.append(text.count("\n"), text.encode())
        self.done += text.count("\n")

    def finish(self, fill: Callable[[Iterator[bytes], BinaryIO], None] | None = None) -> None:
        """Replace the file by the lines, or by the output of ``fill`` for them, in one step."""
        with write_errors(self.path):
            with replacing(self.path, self.inputs) as file:
                if fill:
                    fill(self._lines(), file)
                else:
                    file.writelines(self._lines())
            if self.resume:
                self.state.mark_whole(digest_of(self.real))
            else:
                self.state.remove()
            self.close()

    def _lines(self) -> Iterator[bytes]:
        """Yield the lines, block by block. Raises GenevaError if somebody has changed them."""
        rows = 0
        for count, data in self.state.blocks():
            rows += count
            yield data
        if rows != self.done:
            raise GenevaError(
                f"{self.path}{SUFFIX}: somebody has changed this file while the run wrote it; "
                "run again with --resume"
            )

    def close(self) -> None:
        """Close the state file, which remains to be continued."""
        self.state.close()


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
