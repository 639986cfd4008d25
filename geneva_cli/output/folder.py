"""Writing files into a folder that may hold a person's work.

A list in the folder has a digest of each file that was written. A file that is not listed, or has
another digest, is a person's, and is never replaced or removed unless that is forced.
"""

from __future__ import annotations

import csv
import io
import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import NamedTuple

from geneva_cli.errors import GenevaError, below, cut, few
from geneva_cli.output.files import (
    POSIX,
    digest_of,
    fault,
    holding_signals,
    lock,
    place,
    real_path,
    stopping_cleanly,
    take_after,
    write,
    write_errors,
)

LIST = "contents.csv"
LOCK = ".geneva-export.lock"  # on Windows, which opens no folder
COLUMNS = ("file", "content", "sha256")
# In the folder, so that renaming needs no copy even where the folder is a mount point. A run that
# was killed leaves it; the next one, which has the folder's lock, removes it.
TEMPORARY = ".geneva-export.tmp"


class Row(NamedTuple):
    """A line of the list: a file, what it holds, and its digest."""

    file: str
    content: str
    digest: str = ""


class Filling(NamedTuple):
    """The folder for the new files, and the old files that were changed by a person and stay."""

    new: str
    kept: list[str]


@contextmanager
def filling_folder(
    path: str, entries: Iterable[Row], inputs: Iterable[str] = (), force: bool = False
) -> Iterator[Filling]:
    """Give an empty folder whose files go to ``path`` if the block ends without an error.

    The block writes the files of ``entries``; their list is added. Files of an earlier run that
    are no entries now are removed. All other files stay. Raises GenevaError if a file to replace
    is a person's, unless ``force`` is set, if one to replace or remove is among ``inputs``, if a
    file has a name that Windows does not take, or if ``path`` cannot be written.
    """
    real, entries, inputs = real_path(path, "a folder"), list(entries), list(inputs)
    for entry in entries:
        if why := fault(entry.file):  # others may have Windows
            raise GenevaError(f'"{entry.file}": {why}; give another name')
    if os.path.lexists(real) and not os.path.isdir(real):
        raise GenevaError(f"{cut(path, 300)}: this is a file; give -o the name of a folder")
    filling = Filling(os.path.join(real, TEMPORARY), [])
    says = (
        f"{cut(path, 300)}: another run is writing into this folder; wait until it ends, or give "
        "-o another folder"
    )
    with write_errors(path), stopping_cleanly(), _locked(real, says):
        _require_own(path, real, entries, inputs, force)  # before the work
        shutil.rmtree(filling.new, ignore_errors=True)
        try:
            os.mkdir(filling.new)
            yield filling
            # a person may have changed a file meanwhile
            _require_own(path, real, entries, inputs, force)
            with holding_signals():
                filling.kept.extend(_replace(real, filling.new, entries))
        finally:
            shutil.rmtree(filling.new, ignore_errors=True)


@contextmanager
def _locked(real: str, says: str) -> Iterator[None]:
    """Make a folder that is missing, and lock it; it is removed if nothing was written."""
    is_new, path = not os.path.isdir(real), real if POSIX else os.path.join(real, LOCK)
    if is_new:
        os.mkdir(real)
    descriptor = None
    try:
        descriptor = os.open(path, os.O_RDONLY if POSIX else os.O_RDWR | os.O_CREAT)
        lock(descriptor, says)
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)
        with suppress(OSError):  # another run has opened it, and will remove it
            if not POSIX:
                os.unlink(path)
        with suppress(OSError):  # it has files now
            if is_new:
                os.rmdir(real)


def _require_own(path: str, real: str, entries: list[Row], inputs: list[str], force: bool) -> None:
    """Raise GenevaError if a file that would be replaced is a person's, or an input."""
    rows, files = _rows(real), [entry.file for entry in entries]
    own = _own(real, rows or [])
    for file in {*files, LIST, *own}:
        shown = below(path, file)
        with write_errors(shown):
            place(shown, inputs)
    others = [file for file in files if file not in own]
    if rows is None:
        others.insert(0, LIST)
    others = [file for file in others if os.path.lexists(os.path.join(real, file))]
    if others and not force:
        raise GenevaError(
            f"{cut(path, 300)}: not written by `geneva export`, or changed since: "
            f"{few(others[0], others)}; --force replaces them, or give -o another folder"
        )


def _replace(real: str, new: str, entries: list[Row]) -> list[str]:
    """Move the new files to their places, and remove those of an earlier run; return the kept.

    Meanwhile the list has the old and the new digests, so that the next run knows the files of
    a run that was killed here.
    """

    def move(file: str) -> None:
        source, target = os.path.join(new, file), os.path.join(real, file)
        if os.path.lexists(target):
            with open(source, "rb") as opened:
                take_after(opened.fileno(), os.lstat(target))
        os.replace(source, target)

    def move_list(rows: list[Row]) -> None:
        write(os.path.join(new, LIST), [_text(rows)])
        move(LIST)

    before = _rows(real) or []
    rows = [one._replace(digest=digest_of(os.path.join(new, one.file))) for one in entries]
    own = _own(real, before)
    move_list([*before, *rows])
    for one in entries:
        move(one.file)
    listed = {row.file for row in before if os.path.lexists(os.path.join(real, row.file))}
    earlier = listed - {one.file for one in entries}
    for file in earlier & own:
        os.unlink(os.path.join(real, file))
    move_list(rows)
    return sorted(earlier - own)


def _own(real: str, rows: list[Row]) -> set[str]:
    """The listed files that nobody has changed."""
    own = set()
    for row in rows:
        file = os.path.join(real, row.file)
        if row.digest and not os.path.islink(file) and digest_of(file) == row.digest:
            own.add(row.file)
    return own


def _text(rows: list[Row]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows])
    return text.getvalue()


def _rows(real: str) -> list[Row] | None:
    """The rows of a folder's list; None if there is none, or if the file is something else."""
    with suppress(OSError, ValueError, TypeError, csv.Error):
        with open(os.path.join(real, LIST), encoding="utf-8", newline="") as file:
            text = file.read()
        _, *lines = csv.reader(io.StringIO(text))
        rows = [Row(*line) for line in lines]
        # A list of names with folders, or in other letters than ours, was not written here.
        if text == _text(rows) and all(os.path.basename(row.file) == row.file for row in rows):
            return rows
    return None
