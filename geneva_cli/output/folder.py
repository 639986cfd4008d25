"""Writing files into a folder that may hold a person's work.

A list in the folder has a digest of each file that was written. A file that is not listed, or has
another digest, is a person's, and is never replaced or removed unless that is forced.
"""

from __future__ import annotations

import csv
import errno
import io
import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, few
from geneva_cli.output.file_locks import lock
from geneva_cli.output.files import (
    digest_of,
    holding_signals,
    place,
    real_path,
    stopping_cleanly,
    take_after,
    write,
    write_errors,
)

LIST = "contents.csv"
COLUMNS = ("file", "content", "sha256")
# In the folder, so that renaming needs no copy even where the folder is a mount point. A run that
# was killed leaves it; the next one, which has the folder's lock, removes it.
TEMPORARY = ".geneva-export.tmp"


class Entry(NamedTuple):
    """A file of a folder, and what it holds."""

    file: str
    content: str


class Row(NamedTuple):
    """A line of the list."""

    file: str
    content: str
    digest: str


@contextmanager
def filling_folder(
    path: str, entries: Iterable[Entry], inputs: Iterable[str] = (), force: bool = False
) -> Iterator[Filling]:
    """Give an empty folder whose files go to ``path`` if the block ends without an error.

    The block writes the files of ``entries``; their list is added. Files of an earlier run that
    are no entries now are removed. All other files stay. Raises GenevaError if a file to replace
    is a person's, unless ``force`` is set, if one to replace or remove is among ``inputs``, or if
    ``path`` cannot be written.
    """
    real = real_path(path, "a folder")
    if os.path.lexists(real) and not os.path.isdir(real):
        raise GenevaError(f"{cut(path, 300)}: this is a file; give -o the name of a folder")
    filling = Filling(path, real, list(entries), list(inputs), force)
    with write_errors(path), stopping_cleanly(), _existing(real), _locked(path, real):
        filling.require_own()  # before the work
        if os.path.lexists(filling.new):
            shutil.rmtree(filling.new)
        try:
            os.mkdir(filling.new)
            yield filling
            filling.require_own()  # a person may have changed a file meanwhile
            with holding_signals():
                filling.replace()
        finally:
            shutil.rmtree(filling.new, ignore_errors=True)


class Filling:
    """A folder that is being filled: ``new`` is the folder for its new files.

    At the end ``kept`` has the files of an earlier run that would have been removed, but were
    changed by a person.
    """

    def __init__(
        self, path: str, real: str, entries: list[Entry], inputs: list[str], force: bool
    ) -> None:
        self.path, self.real = path, real
        self.entries, self.inputs, self.force = entries, inputs, force
        self.files = [entry.file for entry in entries]
        self.new = os.path.join(real, TEMPORARY)
        self.kept: list[str] = []

    def require_own(self) -> None:
        """Raise GenevaError if a file that would be replaced is a person's, or an input."""
        rows = _rows(self._place(LIST))
        own = self._own(rows or [])
        for file in {*self.files, LIST, *own}:
            shown = os.path.join(self.path, file)
            with write_errors(shown):
                place(shown, self.inputs)
        others = [LIST] if self._exists(LIST) and rows is None else []
        others += [file for file in self.files if self._exists(file) and file not in own]
        if others and not self.force:
            raise GenevaError(
                f"{cut(self.path, 300)}: not written by `geneva export`, or changed since: "
                f"{few(others[0], others)}; --force replaces them, or give -o another folder"
            )

    def replace(self) -> None:
        """Move the new files to their places, and remove those of an earlier run.

        Meanwhile the list has the old and the new digests, so that the next run knows the files of
        a run that was killed here.
        """
        before = _rows(self._place(LIST)) or []
        rows = [Row(*one, digest_of(os.path.join(self.new, one.file))) for one in self.entries]
        own = self._own(before)
        self._write_list([*before, *rows])
        for file in self.files:
            self._move(file)
        earlier = {row.file for row in before if self._exists(row.file)} - {*self.files}
        for file in earlier & own:
            os.unlink(self._place(file))
        self.kept = sorted(earlier - own)
        self._write_list(rows)

    def _own(self, rows: list[Row]) -> set[str]:
        """The listed files that nobody has changed."""
        return {r.file for r in rows if r.digest and _digest(self._place(r.file)) == r.digest}

    def _exists(self, file: str) -> bool:
        return os.path.lexists(self._place(file))

    def _place(self, file: str) -> str:
        return os.path.join(self.real, file)

    def _write_list(self, rows: list[Row]) -> None:
        write(os.path.join(self.new, LIST), [_text(rows)])
        self._move(LIST)

    def _move(self, file: str) -> None:
        """Move a new file to its place; it takes the owner and permissions of the old one."""
        source, target = os.path.join(self.new, file), self._place(file)
        if self._exists(file):
            with open(source, "rb") as opened:
                take_after(opened.fileno(), os.lstat(target))
        os.replace(source, target)


def _digest(path: str) -> str:
    """The digest of a file; empty for what ``filling_folder`` does not write, such as a link."""
    return "" if os.path.islink(path) else digest_of(path)


def _text(rows: list[Row]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows])
    return text.getvalue()


def _rows(path: str) -> list[Row] | None:
    """The rows of a folder's list; None if there is none, or if the file is something else."""
    with suppress(OSError, ValueError, TypeError, csv.Error):
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
        _, *lines = csv.reader(io.StringIO(text))
        rows = [Row(*line) for line in lines]
        # A list of names with folders, or in other letters than ours, was not written here.
        if text == _text(rows) and all(os.path.basename(row.file) == row.file for row in rows):
            return rows
    return None


@contextmanager
def _existing(real: str) -> Iterator[None]:
    """Make the folder if there is none, and remove it again if nothing was written into it."""
    is_new = not os.path.isdir(real)
    if is_new:
        os.mkdir(real)
    try:
        yield
    finally:
        if is_new:
            with suppress(OSError):  # it has files now
                os.rmdir(real)


@contextmanager
def _locked(path: str, real: str) -> Iterator[None]:
    """Hold the folder's lock. Raises GenevaError if another run has it."""
    descriptor = os.open(real, os.O_RDONLY)
    try:
        try:
            lock(descriptor)
        except OSError as error:  # else a file system without locks
            if error.errno in (errno.EAGAIN, errno.EACCES):
                raise GenevaError(
                    f"{cut(path, 300)}: another run is writing into this folder; wait until it "
                    "ends, or give -o another folder"
                ) from None
        yield
    finally:
        os.close(descriptor)
