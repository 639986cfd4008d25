"""CSV with every digit: reading a number back gives the number that was written."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, repeat
from typing import Any

from geneva_cli.errors import clean
from geneva_cli.table import Table, flat

# Numbers of a block from which orjson saves more than its import, 7 ms, costs.
FEW = 8192


def chunks(table: Table) -> Iterator[str]:
    """The header, then blocks of rows."""
    if table.record:
        table = flat(table)
    yield one_line(table.names)
    for columns in table.slices():
        yield text_of(columns)


def one_line(row: Iterable[Any]) -> str:
    """The line of one row."""
    return ",".join(map(_field, row)) + "\n"


def text_of(columns: Sequence[Any], infinity: str = "inf") -> str:
    """The lines of columns, arrays or lists of cells, of equal length, at least one.

    ``infinity`` stands for infinite numbers of arrays.
    """
    parts: list[str | Sequence[str]] = []  # one text for all rows, or one for each
    for is_numbers, group in groupby(columns, _is_numbers):
        own = [*group]
        parts += [_number_lines(own, infinity)] if is_numbers else map(_fields, own)
    varied = [k for k, part in enumerate(parts) if not isinstance(part, str)]
    if len(varied) == 1:  # the usual sweep: numbers, and no error; rows need no work of Python
        (k,) = varied
        before = ",".join([*map(str, parts[:k]), ""])
        after = ",".join(["", *map(str, parts[k + 1 :])]) + "\n"
        return before + (after + before).join(parts[k]) + after
    each = [repeat(part, len(columns[0])) if isinstance(part, str) else part for part in parts]
    return "".join([",".join(row) + "\n" for row in zip(*each, strict=True)])


def _is_numbers(column: Any) -> bool:
    return not isinstance(column, (list, tuple)) and column.dtype == "float64"


def _fields(column: Any) -> str | Sequence[str]:
    """The field of each cell, or one field for all."""
    cells = column if isinstance(column, (list, tuple)) else column.tolist()
    if len({*map(type, cells)}) == 1 and cells.count(cells[0]) == len(cells):
        return _field(cells[0])
    return [*map(_field, cells)]


def _number_lines(columns: Sequence[Any], infinity: str) -> list[str]:
    """The fields of each row of float arrays: the shortest numerals that read back, as of repr."""
    import numpy as np

    block = np.column_stack(columns) + 0.0  # no -0.0
    line = ",".join(["%r"] * len(columns))

    def plain(rows: Any) -> list[str]:
        lines = [line % tuple(row) for row in rows.tolist()]
        return lines if infinity == "inf" else [one.replace("inf", infinity) for one in lines]

    try:
        if block.size < FEW:
            raise ImportError
        import orjson  # makes the digits in a tenth of the time
    except ImportError:
        return plain(block)
    text = orjson.dumps(block, option=orjson.OPT_SERIALIZE_NUMPY).decode()
    lines: list[str] = text[2:-2].split("],[")
    # The numbers outside this range have exponents, which orjson writes in another way than repr.
    size = abs(block)
    other = ((size < 1e-4) & (size != 0.0) | ~(size < 1e16)).any(axis=1)
    for i, text in zip(np.flatnonzero(other).tolist(), plain(block[other]), strict=True):
        lines[i] = text
    return lines


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
