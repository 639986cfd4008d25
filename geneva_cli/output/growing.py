"""A file that grows for hours: a stopped run keeps its rows, and can be continued.

The rows go to the state file ``FILE.geneva``; ``FILE`` is replaced at the end, in one step. A run
that may be repeated (``resume``) keeps the state file, which then records that ``FILE`` is whole.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterable, Iterator
from typing import BinaryIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.files import digest_of, place, replacing, write_errors
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
