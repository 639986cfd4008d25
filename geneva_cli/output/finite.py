"""The last check of all output: no NaN is written, and infinity only where it is meaningful."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from geneva_cli.progress import Meter
from geneva_cli.table import Table


def checked(table: Table, is_seen: bool = False) -> Table:
    """The table, checked; a table that is computed while it is written is checked then.

    Its progress is reported, unless the rows are seen as they come. Raises ArithmeticError as
    ``refuse_nonsense`` does.
    """
    meter, done = None if is_seen else Meter("rows", len(table)), 0

    def check(columns: Sequence[Any]) -> Sequence[Any]:
        nonlocal done
        refuse_nonsense(table.names, columns)
        if meter and columns:
            done += len(columns[0])
            meter.report(done)
        return columns

    return table.changed(check)


def refuse_nonsense(names: Iterable[str], columns: Iterable[Any]) -> None:
    """Raise ArithmeticError for columns, lists or arrays, with a NaN or a misplaced infinity.

    Such a number is always a fault of this program, and a file with it misleads.
    """
    for name, column in zip(names, columns, strict=True):
        # Infinity is a valid radius of a straight line, a valid value of a check without a bound,
        # and valid as motion over dwell without a dwell.
        boundless = name.rpartition(".")[2] in {"curvature_radius_mm", "value", "k"}
        if not isinstance(column, (list, tuple)):
            wrong = (column != column).any() if boundless else _any_endless(column)
        else:
            wrong = any(_wrong(v, boundless) for v in column)
        if wrong:
            raise ArithmeticError(f"{name}: a value is not a number")


def _any_endless(column: Any) -> bool:
    if column.dtype.kind != "f":
        return False
    low, high = (float(f()) if len(column) else 0.0 for f in (column.min, column.max))
    return not (math.isfinite(low) and math.isfinite(high))


def _wrong(value: Any, boundless: bool) -> bool:
    if isinstance(value, Table):
        refuse_nonsense(value.names, value.columns)
        return False
    if isinstance(value, (tuple, list)):
        return any(_wrong(v, boundless) for v in value)
    if not isinstance(value, float):
        return False
    return value != value if boundless else not math.isfinite(value)
