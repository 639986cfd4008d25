"""CSV with every digit: reading a number back gives the number that was written."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table, flat, plain_rows


def chunks(table: Table) -> Iterator[str]:
    """The header, then blocks of rows."""
    if table.record:
        table = flat(table)
    yield one_line(table.names)
    for columns in table.slices(1024):
        if not any(isinstance(c, (list, tuple)) or c.dtype != "float64" for c in columns):
            yield _numbers(columns)
        else:
            yield "".join(map(one_line, plain_rows(columns)))


def one_line(row: Iterable[Any]) -> str:
    """The line of one row."""
    return ",".join(map(_field, row)) + "\n"


def _numbers(columns: Sequence[Any]) -> str:
    """The lines of arrays of numbers: NumPy joins the columns, and one formatting makes all."""
    import numpy as np

    block = np.column_stack(columns) + 0.0  # no -0.0
    line = ",".join(["%r"] * len(columns)) + "\n"
    return line * len(block) % tuple(block.ravel().tolist())


def _field(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value + 0.0)
    if isinstance(value, bool):
        return "true" if value else "false"
    if not isinstance(value, str):
        return str(value)
    text = clean(value)
    if text[:1] in ("=", "+", "-", "@"):
        text = "'" + text  # a spreadsheet would run it as a formula
    if any(c in text for c in ',"'):
        text = '"' + text.replace('"', '""') + '"'
    return text
