"""Values of a spec that were written with a unit, and the numbers that were read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.machine.spec import Spec
from geneva_cli.spec.units import unit_key
from geneva_cli.table import in_digits


def texts_with_units(tree: dict[str, Any], spec: Spec) -> list[str]:
    """Each value of a file's tables that has a unit, and its number in the unit of its key.

    >>> tree = {"wheel": {"z": 6}, "size": {"center_distance_mm": "8 in"}}
    >>> texts_with_units(tree, Spec(External(6), size=Size(center_distance_mm="8 in")))
    ['size.center_distance_mm = 203.2, from "8 in"']
    """
    return [
        f"{table}.{key} = {_shown(number)}, from {_typed(value)}"
        for table, key, value in _values(tree)
        if unit_key(key) and (number := spec.table(table).get(key)) is not None
    ]


def _values(tree: dict[str, Any], table: str = "") -> Iterator[tuple[str, str, Any]]:
    """Table, key and value of each value that is a text or has texts in its list."""
    for key, value in tree.items():
        name = f"{table}.{key}" if table else key
        if isinstance(value, dict):
            yield from _values(value, name)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for i, one in enumerate(value):
                yield from _values(one, f"{name}.{i}")
        elif any(isinstance(one, str) for one in (value if isinstance(value, list) else [value])):
            yield table, key, value


def _shown(number: Any) -> str:
    if isinstance(number, tuple):
        return f"[{', '.join(map(_shown, number))}]"
    return in_digits(number, 7)


def _typed(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_typed, value))}]"
    return f'"{value}"' if isinstance(value, str) else str(value)
