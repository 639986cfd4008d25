"""Reader of CSV files with named columns, as ``geneva sweep`` writes them."""

from __future__ import annotations

import csv
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest


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
        if len(matches) > 1:
            raise GenevaError(f"{option} {cut(short)}: ambiguous; use {' or '.join(matches)}")
        if not matches:
            raise GenevaError(
                f"{option} {cut(short)}: no column of {cut(self.path, 300)}"
                f"{nearest(short, self.names)}; it has {', '.join(self.names)}"
            )
        return matches[0]

    def texts(self, name: str) -> list[str]:
        """Texts of a column."""
        i = self.names.index(name)
        return [row[i] for row in self.rows]

    def numbers(self, name: str, option: str) -> list[float | None]:
        """Numbers of a column, None for a missing one.

        Raises GenevaError if the column has no number at all.
        """
        numbers = [_number(text) for text in self.texts(name)]
        if not any(value is not None for value in numbers):
            first = next((f'as "{cut(text)}"' for text in self.texts(name) if text), "it is empty")
            raise GenevaError(
                f"{option} {cut(name)}: no numbers in this column of {cut(self.path, 300)} "
                f"({first})"
            )
        return numbers


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
    bytes_max = 1 << 28  # a csv of some million designs
    try:
        with open(path, "rb") as file:
            data = file.read(bytes_max + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise GenevaError(f"{shown}: cannot read: {reason}") from None
    if len(data) > bytes_max:
        raise GenevaError(f"{shown}: larger than {bytes_max} bytes: sweep fewer designs")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise GenevaError(f"{shown}: not UTF-8 text; save the file as UTF-8") from None
    lines = csv.reader(text.splitlines())
    names = tuple(name.strip() for name in next(lines, []))
    rows = []
    for row in lines:
        if not row:
            continue
        if len(row) != len(names):
            raise GenevaError(
                f"{shown}:{lines.line_num}: {len(row)} fields, but the first line names "
                f"{len(names)} columns"
            )
        rows.append(row)
    if not rows:
        raise GenevaError(f"{shown}: no rows: the file needs a line of names and lines of values")
    return Columns(path, names, rows)
