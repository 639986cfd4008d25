"""CSV with every digit: reading a number back gives the number that was written."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table


def chunks(table: Table, terminal: bool) -> Iterator[str]:
    """The header, then blocks of rows."""
    yield ",".join(table.names) + "\n"
    for block in table.blocks():
        if all(type(v) is float for v in block[0]):
            line = ",".join(["%r"] * len(table.names)) + "\n"
            yield line * len(block) % tuple(v + 0.0 for row in block for v in row)
        else:
            yield "".join(",".join(_field(v) for v in row) + "\n" for row in block)


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
