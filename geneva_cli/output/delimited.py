"""CSV with every digit: reading a number back gives the number that was written."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table, flat, is_floats


def chunks(table: Table) -> Iterator[str]:
    """The header, then blocks of rows."""
    if table.record:
        table = flat(table)
    yield one_line(table.names)
    if table.columns and all(is_floats(c) for c in table.columns):
        yield from _numbers(table)
        return
    for block in table.blocks():
        yield "".join(map(one_line, block))


def one_line(row: Iterable[Any]) -> str:
    """The line of one row."""
    return ",".join(map(_field, row)) + "\n"


def _numbers(table: Table) -> Iterator[str]:
    """Blocks of number arrays: NumPy joins the columns, and one formatting makes a whole block."""
    import numpy as np

    line = ",".join(["%r"] * len(table.columns)) + "\n"
    block_rows = 1024
    for start in range(0, len(table), block_rows):
        block = np.column_stack([c[start : start + block_rows] for c in table.columns])
        block = block + 0.0  # no -0.0
        yield line * len(block) % tuple(block.ravel().tolist())


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
