"""JSON: ``{"rows": [...]}`` for tables, one nested object for records; never NaN or Infinity."""

import json
import math
from collections.abc import Iterator
from typing import Any

from geneva_cli.table import Table


def chunks(table: Table) -> Iterator[str]:
    """The document, a block of rows at a time."""
    if table.record:
        yield json.dumps(_nested(table.names, next(table.rows())), indent=2) + "\n"
        return
    yield '{"rows": ['
    separator = "\n"
    names, encode = table.names, json.JSONEncoder(allow_nan=False).encode
    for block in table.blocks():
        if table.mixed or not any("." in name for name in names):
            trees = (dict(zip(names, map(_plain, row), strict=True)) for row in block)
        else:
            trees = (_nested(names, row) for row in block)
        yield separator + ",\n".join(map(encode, trees))
        separator = ",\n"
    yield "\n]}\n"


def _nested(names: tuple[str, ...], row: tuple[Any, ...]) -> dict[str, Any]:
    tree: dict[str, Any] = {}
    for name, value in zip(names, row, strict=True):
        *groups, last = name.split(".")
        node = tree
        for group in groups:
            node = node.setdefault(group, {})
        node[last] = _plain(value)
    return tree


def _plain(value: Any) -> Any:
    if isinstance(value, float):
        return value + 0.0 if math.isfinite(value) else None
    if isinstance(value, Table):
        return [_nested(value.names, row) for row in value.rows()]
    if isinstance(value, tuple):
        # tables of several kinds of rows are one list of objects
        lists = [_plain(v) if isinstance(v, Table) else [v] for v in value]
        return [one for part in lists for one in part]
    return value
