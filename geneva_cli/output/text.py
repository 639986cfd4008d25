"""Tables as plain text, for a pipe or a file: every column, whatever the width.

Also, for every format, the choice of columns, and the last check: no NaN is written, and infinity
only where it has a meaning.
"""

import math
import textwrap
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import Any

from geneva_cli.errors import GenevaError, clean, cut, few
from geneva_cli.progress import Meter
from geneva_cli.table import Table, flat, for_people, record_table

WIDTH = 90  # letters of a line in a file or a pipe
GAP = "  "  # between two columns


def chunks(table: Table) -> Iterator[str]:
    """The table as text, line by line."""
    for text in filter(None, (table.title, table.prose)):
        for paragraph in text.split("\n"):
            yield "\n".join(textwrap.wrap(clean(paragraph), WIDTH)) + "\n"
        yield "\n"
    if not table.record:
        yield from _plain(table)
        return
    for _, piece in apart(table):
        if not piece.record:
            yield "\n"
            yield from _plain(piece)
            yield "\n"
            continue
        # one line for each value, and a heading where the first part of the dotted name changes
        shown, width, current, own = [], 0, "", flat(piece)
        for name, (value,) in zip(own.names, own.columns, strict=True):
            if value not in (None, ""):  # a value that does not apply has no line
                group, _, last = name.rpartition(".")
                shown.append((group, "  " * bool(group) + last, value))
                width = max(width, len(shown[-1][1]))
        for group, label, value in shown:
            if group != current:
                yield f"{group}\n" if group else ""
                current = group
            yield f"{label.ljust(width)}  {cell(value)}\n"


def cell(value: Any) -> str:
    """A value as a person wants to read it."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return for_people(value, digits=7)  # enough for people; csv and json have all digits
    return clean(str(value))


def _plain(table: Table) -> Iterator[str]:
    """Rows under their headings; empty if there are no columns."""
    if not table.names:
        return
    # names broken at underscores, so that sixteen columns stay readable
    parts = (clean(name).split("_")[::-1] for name in table.names)
    heads = [*zip_longest(*parts, fillvalue="")][::-1]
    for block in table.blocks():
        lines = [[cell(v) for v in row] for row in (block if table.mixed else without_noise(block))]
        widths = [max(map(width_of, column)) for column in zip(*heads, *lines, strict=True)]
        left = [isinstance(v, str) for v in block[0]]
        if heads:
            lines = [*map(list, heads), ["-" * width for width in widths], *lines]
            heads = []
        for line in lines:
            yield line_of(line, widths, left) + "\n"


def without_noise(block: list[tuple[Any, ...]]) -> Iterator[list[Any]]:
    """Rows in which numbers below 1e-13 of their column's largest, which are rounding, are 0."""
    scales = [
        max((abs(v) for v in column if isinstance(v, float) and v == v), default=0.0)
        for column in zip(*block, strict=True)
    ]
    for row in block:
        yield [
            0.0 if isinstance(v, float) and abs(v) < 1e-13 * scale < math.inf else v
            for v, scale in zip(row, scales, strict=True)
        ]


def line_of(texts: Sequence[str], widths: Sequence[int], left: Sequence[bool]) -> str:
    """Texts side by side in columns of these widths, to their left or their right."""
    cells = []
    for text, width, is_left in zip(texts, widths, left, strict=True):
        space = " " * (width - width_of(text))
        cells.append(text + space if is_left else space + text)
    return GAP.join(cells).rstrip()


def width_of(text: str) -> int:
    """Columns that a text takes on a terminal."""
    if text.isascii():
        return len(text)
    return sum(
        0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1
        for c in text
    )


def apart(record: Table) -> Iterator[tuple[str, Table]]:
    """The parts of a record in order: each table with its name, and records between them."""
    values: dict[str, Any] = {}
    for name, (value,) in zip(record.names, record.columns, strict=True):
        if isinstance(value, Table):
            yield from [("", record_table(values))] if values else []
            yield name, value
            values = {}
        else:
            values[name] = value
    yield from [("", record_table(values))] if values else []


def checked(table: Table, is_seen: bool = False) -> Table:
    """The table, checked; a table that is computed while it is written is checked then.

    Its progress is reported, unless the rows are seen as they come. Raises ArithmeticError as
    ``refuse_nonsense`` does.
    """
    meter, done = Meter("rows", len(table)) if table.later and not is_seen else None, 0

    def check(columns: Sequence[Any]) -> Sequence[Any]:
        nonlocal done
        refuse_nonsense(table.names, columns)
        if meter:
            done += len(columns[0])
            meter.report(done)
        return columns

    return table.through(check)


def refuse_nonsense(names: Iterable[str], columns: Iterable[Any], endless: bool = False) -> None:
    """Raise ArithmeticError for columns, lists or arrays, with a NaN or a misplaced infinity.

    Such a number is always a fault of this program, and a file with it misleads. Infinity is a
    valid radius of a straight line, a valid value of a check without a bound, and valid as motion
    over dwell without a dwell; of ``endless`` columns it means no value.
    """
    plain = {type(None), str, int, bool}
    for name, column in zip(names, columns, strict=True):
        allowed = endless or name.rpartition(".")[2] in {"curvature_radius_mm", "value", "k"}
        wrong = False
        if isinstance(column, (list, tuple)):
            is_plain = column.count(None) == len(column) or plain.issuperset(map(type, column))
            for value in () if is_plain else column:
                if isinstance(value, float):
                    wrong = wrong or value != value or not (allowed or math.isfinite(value))
                elif isinstance(value, Table):
                    refuse_nonsense(value.names, value.columns)
                elif isinstance(value, (tuple, list)):
                    refuse_nonsense((name,), (value,), allowed)
        elif allowed:
            wrong = (column != column).any()
        elif len(column) and column.dtype.kind == "f":
            wrong = not all(map(math.isfinite, (column.min(), column.max())))
        if wrong:
            raise ArithmeticError(f"{name}: a value is not a number")


def only(table: Table, names: Sequence[str]) -> Table:
    """The columns with these names, in order; for a record its values and its tables' columns.

    Raises GenevaError for an unknown name.
    """
    inner = [t for v in next(table.rows(), ()) for t in _tables(v)] if table.record else []
    known = dict.fromkeys([*table.names, *(name for one in inner for name in one.names)])
    for name in names:
        if name not in known:
            some = few(name, known)
            raise GenevaError(f"--columns {cut(name)}: no such column; there are {some}")
    if not table.record:
        at = [table.names.index(name) for name in names]
        return table.through(lambda columns: [columns[i] for i in at], names=tuple(names))
    values: dict[str, Any] = {}
    for name, value in zip(table.names, next(table.rows()), strict=True):
        parts = [t for t in _tables(value) if set(names) & set(t.names)]
        if name in names:
            values[name] = value
        elif parts:
            own = tuple(only(t, [n for n in names if n in t.names]) for t in parts)
            values[name] = own[0] if isinstance(value, Table) else own
    return table.replaced(names=tuple(values), columns=[(v,) for v in values.values()])


def _tables(value: Any) -> list[Table]:
    parts = value if type(value) is tuple else (value,)
    return [part for part in parts if isinstance(part, Table)]
