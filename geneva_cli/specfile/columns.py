"""Columns of a CSV file, as a sweep writes it; and the digest by which a sweep knows its files.

Errors name the file and the line.
"""

import csv
from collections.abc import Iterable
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.specfile.tree import read_text


class Columns(NamedTuple):
    """Columns of a CSV file as texts, by name; a missing value is an empty text."""

    path: str
    names: tuple[str, ...]
    rows: list[list[str]]

    def named(self, short: str, option: str) -> str:
        """Full name of a column: ``dwell_s`` is timing.dwell_s if no other name ends so.

        Raises GenevaError, with the nearest name, if there is no such column, or more than one.
        """
        if short in self.names:
            return short
        matches = [name for name in self.names if name.endswith(f".{short}")]
        if len(matches) == 1:
            return matches[0]
        if matches:
            raise GenevaError(f"{option} {cut(short)}: ambiguous; use {' or '.join(matches)}")
        fault = f"no column of {cut(self.path, 300)}{nearest(short, self.names)}"
        raise GenevaError(f"{option} {cut(short)}: {fault}; it has {few(short, self.names)}")

    def numbers(self, name: str, option: str) -> list[float | None]:
        """Numbers of a column, None for a missing one.

        Raises GenevaError if the column has no number at all.
        """
        numbers = [_number(row[self.names.index(name)]) for row in self.rows]
        if any(value is not None for value in numbers):
            return numbers
        fault = f"no numbers in this column of {cut(self.path, 300)}"
        raise GenevaError(f"{option} {cut(name)}: {fault}")


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) <= 1e300 else None  # NaN and infinity cannot be plotted


def read_columns(path: str) -> Columns:
    """Columns of a CSV file, whose first line names them.

    Raises GenevaError, with the line if possible, for a file that cannot be read, is not a CSV
    file, or has no rows.
    """
    shown = cut(path, 300)
    text = read_text(path, 1 << 28, "sweep fewer designs")  # a csv of some million designs
    lines = csv.reader(text.splitlines())
    names = tuple(name.strip() for name in next(lines, []))
    rows = []
    for row in filter(None, lines):
        if len(row) != len(names):
            fault = f"{len(row)} fields, but the first line names {len(names)} columns"
            raise GenevaError(f"{shown}:{lines.line_num}: {fault}")
        rows.append(row)
    if not rows:
        raise GenevaError(f"{shown}: no rows: the file needs a line of names and lines of values")
    return Columns(path, names, rows)


def digest(paths: Iterable[str]) -> str:
    """Hash of the bytes of some files, which need not exist."""
    import hashlib  # loads OpenSSL, which most runs do not need

    total = hashlib.sha256()
    for path in paths:
        try:
            with open(path, "rb") as file:
                total.update(hashlib.file_digest(file, "sha256").digest())
        except (OSError, ValueError) as error:  # ValueError: a NUL in the name
            total.update(type(error).__name__.encode())
    return total.hexdigest()
