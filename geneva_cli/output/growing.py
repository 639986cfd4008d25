"""A file that grows for hours: what is done is kept when the run is stopped, and gone on from.

The rows go to ``FILE.partial`` beside the file, and what asked for them to ``FILE.partial.key``.
Only the last row turns the one into the file; until then an old file stays as it was. A run that
may be asked for again (``resume``) leaves ``FILE.key``, which says of what the file is whole.
"""

from __future__ import annotations

import hashlib
import os
import stat
from abc import ABC, abstractmethod
from collections.abc import Iterable
from contextlib import suppress
from types import TracebackType
from typing import Self, TextIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.files import place, take_after, write_errors


class Closing(ABC):
    """What is closed where its block is left, by whatever way."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the file."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


class Growing(Closing):
    """Lines appended to a file; ``done`` of them, below the header, are there already.

    ``key`` is all that the lines depend on: with ``resume`` a run goes on from one that asked for
    the same, begins where there is none, and has nothing to do where the file ``is_whole``;
    ``found`` says which of these. Raises GenevaError where the file cannot be written, or what is
    there was begun for something else.
    """

    def __init__(
        self, path: str, header: str, key: str, resume: bool, inputs: Iterable[str] = ()
    ) -> None:
        self.path, self.asked, self.resume, self.done = path, key, resume, 0
        self.is_whole, self.found = False, ""
        self.file: TextIO | None = None
        with write_errors(path):
            self.real, self.old = place(path, inputs)
            if self.old is not None and not stat.S_ISREG(self.old.st_mode):
                raise GenevaError(
                    f"{path}: not a file that can grow; print to it with -o - instead"
                )
            self.partial, self.key = f"{self.real}.partial", f"{self.real}.partial.key"
            self.whole_key = f"{self.real}.key"
            if not resume:
                self._begin(header)
            elif not self._go_on(header):
                self._begin_unless_whole(header)

    def _begin(self, header: str) -> None:
        self.file = open(self.partial, "w", encoding="utf-8", newline="")
        with open(self.key, "w", encoding="utf-8") as file:
            file.write(self.asked)
        self.file.write(header)
        self.file.flush()

    def _begin_unless_whole(self, header: str) -> None:
        name = cut(os.path.basename(self.real))
        with suppress(FileNotFoundError), open(self.whole_key, encoding="utf-8") as file:
            self.is_whole = file.read() == _of_what(self.asked, self.real)
        if self.is_whole:
            self.found = f"--resume: {name} is whole already"
            return
        self.found = f"--resume: there is no {name}.partial to go on from; from the first row"
        self._begin(header)

    def _go_on(self, header: str) -> bool:
        """Whether a run that was stopped is there to be gone on from."""
        try:
            with open(self.key, encoding="utf-8") as file:
                same = file.read() == self.asked
            self.file = open(self.partial, "r+", encoding="utf-8", newline="")
        except FileNotFoundError:
            return False
        if not same:
            self.file.close()
            raise GenevaError(
                f"--resume: {cut(os.path.basename(self.partial))} was begun for something else "
                "(another spec, other options or another version); start without --resume"
            )
        self.done = self._cut_to_whole_lines(self.file) - bool(header)
        if self.done < 0:  # not even the header was written
            self.file.close()
            self.done = 0
            self._begin(header)
        return True

    def _cut_to_whole_lines(self, rows: TextIO) -> int:
        """How many there are: one that was being written when the run ended is written again."""
        lines, end = 0, 0
        with open(self.partial, "rb") as file:
            while piece := file.read(1 << 20):
                lines += piece.count(b"\n")
                last = piece.rfind(b"\n")
                end = file.tell() - len(piece) + last + 1 if last >= 0 else end
        rows.seek(end)
        rows.truncate()
        return lines

    def append(self, text: str) -> None:
        """Whole lines, which are on disk before the next are worked on."""
        assert self.file is not None, "a file that is whole takes no lines"
        with write_errors(self.path):
            self.file.write(text)
            self.file.flush()

    def finish(self, made: str = "") -> None:
        """The rows become the file, or another file that was ``made`` of them does."""
        with write_errors(self.path):
            self.close()
            with open(made or self.partial, "rb") as whole:
                if self.old is not None:
                    take_after(whole.fileno(), self.old)
                os.fsync(whole.fileno())
            os.replace(made or self.partial, self.real)
            self._leave_key()
            for left in (self.partial, self.key):
                with suppress(FileNotFoundError):
                    os.unlink(left)

    def _leave_key(self) -> None:
        if not self.resume:
            with suppress(FileNotFoundError):
                os.unlink(self.whole_key)
            return
        with open(self.whole_key, "w", encoding="utf-8") as file:
            file.write(_of_what(self.asked, self.real))

    def close(self) -> None:
        """What is there stays, to be gone on from."""
        if self.file is not None:
            self.file.close()


def _of_what(key: str, path: str) -> str:
    """What was asked for, and the file's digest: of a file that was changed it holds no more.

    Raises FileNotFoundError where there is no file.
    """
    with open(path, "rb") as file:
        return f"{key}\n{hashlib.file_digest(file, 'sha256').hexdigest()}\n"
