"""A file that grows for hours: what is done is kept when the run is stopped, and gone on from.

The rows go to ``FILE.partial`` beside the file, and what asked for them to ``FILE.partial.key``.
Only the last row turns the one into the file; until then an old file stays as it was.
"""

from __future__ import annotations

import os
import stat
from abc import ABC, abstractmethod
from collections.abc import Iterable
from contextlib import suppress
from types import TracebackType
from typing import Self

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

    ``key`` is all that the lines depend on: a run goes on only from one that asked for the same.
    Raises GenevaError where the file cannot be written, or there is nothing to go on from.
    """

    def __init__(
        self, path: str, header: str, key: str, resume: bool, inputs: Iterable[str] = ()
    ) -> None:
        self.path, self.done = path, 0
        with write_errors(path):
            self.real, self.old = place(path, inputs)
            if self.old is not None and not stat.S_ISREG(self.old.st_mode):
                raise GenevaError(
                    f"{path}: not a file that can grow; print to it with -o - instead"
                )
            self.partial, self.key = f"{self.real}.partial", f"{self.real}.partial.key"
            if resume:
                self._go_on(header, key)
            else:
                self._begin(header, key)

    def _begin(self, header: str, key: str) -> None:
        self.file = open(self.partial, "w", encoding="utf-8", newline="")
        with open(self.key, "w", encoding="utf-8") as file:
            file.write(key)
        self.file.write(header)
        self.file.flush()

    def _go_on(self, header: str, key: str) -> None:
        try:
            with open(self.key, encoding="utf-8") as file:
                same = file.read() == key
            self.file = open(self.partial, "r+", encoding="utf-8", newline="")
        except FileNotFoundError:
            raise GenevaError(
                f"--resume: there is no {cut(os.path.basename(self.partial))} to go on from; "
                "start without --resume"
            ) from None
        if not same:
            self.file.close()
            raise GenevaError(
                f"--resume: {cut(os.path.basename(self.partial))} was begun for something else "
                "(another spec, other options or another version); start without --resume"
            )
        self._cut_to_whole_lines()
        if self.done < 0:  # not even the header was written
            self.file.close()
            self.done = 0
            self._begin(header, key)

    def _cut_to_whole_lines(self) -> None:
        """A line that was being written when the run ended is written again."""
        lines, end = 0, 0
        with open(self.partial, "rb") as file:
            while piece := file.read(1 << 20):
                lines += piece.count(b"\n")
                last = piece.rfind(b"\n")
                end = file.tell() - len(piece) + last + 1 if last >= 0 else end
        self.done = lines - 1
        self.file.seek(end)
        self.file.truncate()

    def append(self, text: str) -> None:
        """Whole lines, which are on disk before the next are worked on."""
        with write_errors(self.path):
            self.file.write(text)
            self.file.flush()

    def finish(self, made: str = "") -> None:
        """The rows become the file, or another file that was ``made`` of them does."""
        with write_errors(self.path):
            self.file.close()
            with open(made or self.partial, "rb") as whole:
                if self.old is not None:
                    take_after(whole.fileno(), self.old)
                os.fsync(whole.fileno())
            os.replace(made or self.partial, self.real)
            for left in (self.partial, self.key):
                with suppress(FileNotFoundError):
                    os.unlink(left)

    def close(self) -> None:
        """What is there stays, to be gone on from."""
        self.file.close()
