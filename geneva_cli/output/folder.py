"""Writing a folder as a whole or not at all.

A folder has a list of its files with a checksum of each. So a folder with any other or changed
file is known as a person's work, and never replaced.
"""

from __future__ import annotations

import csv
import io
import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.files import digest_of, stopping_cleanly, write, write_errors

LIST = "contents.csv"
COLUMNS = ("file", "content", "sha256")


class Entry(NamedTuple):
    """A file of a folder, and what it holds."""

    file: str
    content: str


@contextmanager
def replacing_folder(
    path: str, entries: Iterable[Entry], inputs: Iterable[str] = ()
) -> Iterator[str]:
    """Give an empty folder that becomes ``path`` if the block ends without an error.

    The block writes the files of ``entries``; their list is added. Raises GenevaError if ``path``
    is a file, a folder that this function did not write, has one of ``inputs``, or cannot be
    written.
    """
    if not path or "\0" in path:
        raise GenevaError(f'-o "{path}": not a folder\'s name')
    real = os.path.realpath(path)
    for source in inputs:
        if os.path.dirname(os.path.realpath(source)) == real:
            raise GenevaError(
                f"{cut(source, 300)}: this file is an input in the folder that would be replaced; "
                "give -o another folder"
            )
    _require_own(path, real)
    new, old = (f"{real}.geneva-{os.getpid()}.{end}" for end in ("new", "old"))
    with write_errors(path), stopping_cleanly():
        try:
            os.mkdir(new)
            yield new
            _add_list(new, entries)
            if os.path.isdir(real):
                os.rename(real, old)
            try:
                os.rename(new, real)
            except OSError:
                with suppress(FileNotFoundError):
                    os.rename(old, real)
                raise
        finally:
            for folder in (new, old):
                shutil.rmtree(folder, ignore_errors=True)


def _add_list(folder: str, entries: Iterable[Entry]) -> None:
    rows = [(*entry, digest_of(os.path.join(folder, entry.file))) for entry in entries]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows])
    write(os.path.join(folder, LIST), [text.getvalue()])


def _require_own(path: str, real: str) -> None:
    """Raise GenevaError for what must not be replaced."""
    shown = cut(path, 300)
    if not os.path.lexists(real):
        return
    if not os.path.isdir(real):
        raise GenevaError(f"{shown}: this is a file; give -o the name of a folder")
    with write_errors(path):
        present = set(os.listdir(real))
    if not present:
        return
    listed = _listed(os.path.join(real, LIST))
    other = sorted(present - {LIST, *listed})
    if other:
        raise GenevaError(
            f"{shown}: this folder has a file that `geneva export` did not write, "
            f"{cut(other[0])}; give -o another folder"
        )
    for file, digest in listed.items():
        if file in present and digest_of(os.path.join(real, file)) != digest:
            raise GenevaError(
                f"{shown}: {cut(file)} was changed after `geneva export` wrote it; give -o another "
                "folder"
            )


def _listed(path: str) -> dict[str, str]:
    """The checksums by file of a folder's list; empty if there is none."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return {row["file"]: row["sha256"] for row in csv.DictReader(file)}
    except (OSError, ValueError, KeyError):
        return {}
