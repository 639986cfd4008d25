"""Reading a CSV of named columns, as ``geneva sweep`` writes them."""

from __future__ import annotations

import csv
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest

BYTES_MAX = 1 << 28


class Columns(NamedTuple):
    """The columns of a CSV file as texts, by their names; empty where a value is not there."""

    path: str
    names: tuple[str, ...]
    rows: list[list[str]]

    def named(self, asked: str, option: str) -> str:
        """A column's whole name: ``dwell_s`` is timing.dwell_s where no other ends so.

        Raises GenevaError, with the nearest name, where there is none, or more than one.
        """
        if asked in self.names:
            return asked
        found = [name for name in self.names if name.endswith(f".{asked}")]
        if len(found) > 1:
            raise GenevaError(f"{option} {cut(asked)}: it may be {' or '.join(found)}; say which")
        if not found:
            raise GenevaError(
                f"{option} {cut(asked)}: no column of {cut(self.path, 300)}"
                f"{nearest(asked, self.names)}; it has {', '.join(self.names)}"
            )
        return found[0]

    def texts(self, name: str) -> list[str]:
        """The texts of a column."""
        i = self.names.index(name)
        return [row[i] for row in self.rows]

    def numbers(self, name: str, option: str) -> list[float | None]:
        """A column's numbers, None where there is none.

        Raises GenevaError where the column holds no number at all.
        """
        found = [_number(text) for text in self.texts(name)]
        if not any(value is not None for value in found):
            first = next((f'as "{cut(text)}"' for text in self.texts(name) if text), "it is empty")
            raise GenevaError(
                f"{option} {cut(name)}: no numbers in this column of {cut(self.path, 300)} "
                f"({first})"
            )
        return found


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) <= 1e300 else None  # NaN and infinity are no places


def read_columns(path: str) -> Columns:
    """The columns of a CSV file, whose first line names them.

    Raises GenevaError, with the line where there is one, for a file that cannot be read, is no
    CSV, or has no rows.
    """
    shown = cut(path, 300)
    try:
        with open(path, "rb") as file:
            data = file.read(BYTES_MAX + 1)
    except (OSError, ValueError) as error:
        said = error.strerror if isinstance(error, OSError) else error
        raise GenevaError(f"{shown}: cannot read: {said}") from None
    if len(data) > BYTES_MAX:
        raise GenevaError(f"{shown}: larger than {BYTES_MAX} bytes; sweep fewer designs")
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
                f"{shown}:{lines.line_num}: {len(row)} fields where the first line names "
                f"{len(names)} columns"
            )
        rows.append(row)
    if not rows:
        raise GenevaError(f"{shown}: no rows; a line of names and lines of values are needed")
    return Columns(path, names, rows)
