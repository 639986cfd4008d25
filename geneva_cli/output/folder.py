"""Writing files into a folder that may hold a person's work.

A list in the folder has a digest of each file that was written. A file that is not listed, or has
another digest, is a person's, and is never replaced or removed unless that is forced.
"""

import csv
import hashlib
import os
import shutil
import signal
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from typing import NamedTuple

from geneva_cli.errors import GenevaError, below, cut, few
from geneva_cli.output import files
from geneva_cli.output.delimited import one_line

LIST = "contents.csv"
# In the folder, so that renaming needs no copy even where the folder is a mount point. A run that
# was killed leaves it; the next one removes it.
TEMPORARY = ".geneva-export.tmp"


class Row(NamedTuple):
    """A line of the list: a file, what it holds, and its digest."""

    file: str
    content: str
    sha256: str = ""


@contextmanager
def filling_folder(
    path: str, entries: Sequence[Row], inputs: Sequence[str] = (), force: bool = False
) -> Iterator[tuple[str, list[str]]]:
    """Give an empty folder whose files go to ``path`` if the block ends without an error.

    Beside it stands a list: at the end it has the old files that a person has changed, which stay.

    The block writes the files of ``entries``; their list is added. Files of an earlier run that
    are no entries now are removed. All other files stay. Raises GenevaError if a file to replace
    is a person's, unless ``force`` is set, if one to replace or remove is among ``inputs``, if a
    file has a name that Windows does not take, or if ``path`` cannot be written.
    """
    for entry in entries:
        files.refuse_name(entry.file)  # others may have Windows
    real = files.real_path(path)
    if os.path.lexists(real) and not os.path.isdir(real):
        raise GenevaError(f"{cut(path, 300)}: this is a file; give -o the name of a folder")
    new, kept = os.path.join(real, TEMPORARY), list[str]()
    with files.write_errors(path), files.answering(), ExitStack() as at_end:
        if not os.path.isdir(real):
            os.mkdir(real)
            at_end.callback(_remove_empty, real)
        listing = at_end.enter_context(files.replacing(below(path, LIST)))  # keeps other runs out
        _require_own(path, entries, inputs, force)  # before the work
        shutil.rmtree(new, ignore_errors=True)
        at_end.callback(shutil.rmtree, new, ignore_errors=True)
        os.mkdir(new)
        yield new, kept
        _require_own(path, entries, inputs, force)  # a person may have changed a file meanwhile
        rows = [one._replace(sha256=_digest(below(new, one.file))) for one in entries]
        with files.answering(signal.SIG_IGN):  # not half of them
            kept += _replace(real, new, rows)
            listing.writelines(_lines(rows))


def _remove_empty(folder: str) -> None:
    with suppress(OSError):  # it has files
        os.rmdir(folder)


def _require_own(path: str, entries: Sequence[Row], inputs: Sequence[str], force: bool) -> None:
    """Raise GenevaError if a file that would be replaced is a person's, or an input."""
    wanted, own = [LIST, *(entry.file for entry in entries)], _listed(path)[1]
    for file in {*wanted, *own}:
        with files.write_errors(below(path, file)):
            files.place(below(path, file), inputs)
    others = [file for file in wanted if file not in own and os.path.lexists(below(path, file))]
    if others and not force:
        raise GenevaError(
            f"{cut(path, 300)}: not written by `geneva export`, or changed since: "
            f"{few(others[0], others)}; --force replaces them, or give -o another folder"
        )


def _replace(real: str, new: str, rows: Sequence[Row]) -> list[str]:
    """Move the new files to their places, and remove those of an earlier run; return the kept.

    Meanwhile the list has the old and the new digests, so that the next run knows the files of
    a run that was killed here.
    """
    before, own = _listed(real)
    files.write(os.path.join(new, LIST), _lines([*before, *rows]))
    wanted = [LIST, *(row.file for row in rows)]
    for file in wanted:
        target = os.path.join(real, file)
        if os.path.lexists(target):
            files.take_after(os.path.join(new, file), os.lstat(target))
        os.replace(os.path.join(new, file), target)
    for file in own.difference(wanted):
        os.unlink(os.path.join(real, file))
    others = {row.file for row in before} - own.union(wanted)
    return sorted(file for file in others if os.path.lexists(os.path.join(real, file)))


def _lines(rows: Sequence[Row]) -> Iterator[bytes]:
    return (one_line(row).encode() for row in (Row._fields, *rows))


def _listed(folder: str) -> tuple[list[Row], set[str]]:
    """The rows of a folder's list, and its files that nobody has changed, with the list itself."""
    with suppress(OSError, ValueError, TypeError, csv.Error):  # no list, or something else
        with open(os.path.join(folder, LIST), encoding="utf-8", newline="") as file:
            head, *rows = (Row(*line) for line in csv.reader(file))
        # A list of names with folders was not written here.
        if head == Row._fields and all(os.path.basename(row.file) == row.file for row in rows):
            own = (
                row for row in rows if row.sha256 and _digest(below(folder, row.file)) == row.sha256
            )
            return rows, {LIST, *(row.file for row in own)}
    return [], set()


def _digest(path: str) -> str:
    """The checksum of a file; empty for a link, and for what is no file."""
    if os.path.islink(path) or not os.path.isfile(path):
        return ""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
