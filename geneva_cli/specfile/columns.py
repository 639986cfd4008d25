"""Readers of CSV files: of number pairs that a spec names, and of columns as a sweep writes them.

Errors name the file and the line. A sweep that resumes compares a digest of its files.
"""

import csv
import re
from collections.abc import Iterable
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.spec.rules import Csv
from geneva_cli.streams import read_bytes


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
    text = _text(path, 1 << 28, "sweep fewer designs")  # a csv of some million designs
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


def read_pairs(path: str, rule: Csv, key: tuple[str, ...]) -> list[tuple[float, float]]:
    """Pairs in a file, the first number of each ascending; a header and ``#`` lines are skipped.

    Raises GenevaError naming the file's line or, if the file cannot be read, the spec's key.
    """
    points: list[tuple[float, float]] = []
    text = _text(path, 1 << 24, "use fewer points", key)  # some hundred thousand points, in memory
    for number, line in enumerate(text.split("\n"), 1):
        row = [re.sub(r'^"(.*)"$', r"\1", cell.strip()) for cell in line.split(",")]
        if row == [""] or row[0].startswith("#") or row == ["u", "s"]:
            continue
        where = f"{path}:{number}"
        try:
            x, y = (float(cell) for cell in row)
        except ValueError:
            shown = cut(",".join(row))
            text = f'{where}: "{shown}" is not two numbers u,s, as in 0.5,0.25'
            raise GenevaError(text) from None
        points.append((x, y))
        fault = rule.fault(points, len(points) - 1)
        if fault:
            raise GenevaError(f"{where}: {fault}")
    return points


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


def _text(path: str, bytes_max: int, advice: str, key: tuple[str, ...] = ()) -> str:
    """Text of a file. Raises GenevaError, for points with the spec's key that names them."""
    data = read_bytes(path, bytes_max, advice, key)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise GenevaError(f"{cut(path, 300)}: not UTF-8 text; save the file as UTF-8") from None
