"""Numbers for people in inches and pounds. Everything below computes and names in SI units.

Only what people read changes: tables, md, summaries, documents and plots.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from typing import Any

from geneva_cli.figure import Axis, Figure
from geneva_cli.names import UNITS, unit_end, unit_of
from geneva_cli.output.document.blocks import Block, Curves, Document, Facts, Grid, TextList
from geneva_cli.spec.units import ratio
from geneva_cli.table import Table

INSTEAD = {
    "mm": "in",
    "µm": "thou",
    "m": "ft",
    "m/s": "in/s",
    "m/s²": "in/s²",
    "m/s³": "in/s³",
    "mm/1e6": "in/1e6",
    "N": "lbf",
    "N m": "lbf in",
    "J": "lbf in",
    "N m/rad": "lbf in/rad",
    "MPa": "ksi",
    "GPa": "ksi",
    "kg": "lb",
    "kg m²": "lb in²",
    "kg/m³": "lb/in³",
}


@cache
def _other(unit: str) -> tuple[str, float]:
    """The unit that is shown instead of an SI unit, and how many SI units it is; or unit and 1."""
    instead = INSTEAD.get(unit)
    if instead is None:
        return unit, 1.0
    return instead, ratio(instead.removesuffix("/1e6"), unit.removesuffix("/1e6"))


def value_in_inches(value: Any, unit: str) -> tuple[Any, str]:
    """A value and its unit in inches and pounds; unchanged without a length, force or mass in it.

    >>> value_in_inches(25.4, "mm"), value_in_inches(1.0, "s")
    ((1.0, 'in'), (1.0, 's'))
    """
    other, size = _other(unit)
    return _over(value, size), other


def text_in_inches(text: str) -> str:
    """A sentence with its lengths, forces and masses in inches and pounds, to 4 digits.

    Keys keep their values, as their names have the unit.

    >>> text_in_inches("the rim is 25.4 to 50.8 mm off at 30°: wheel_radius_mm = 254")
    'the rim is 1 to 2 in off at 30°: wheel_radius_mm = 254'
    """
    number = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
    units = "|".join(sorted(INSTEAD, key=len, reverse=True))

    def other(match: re.Match[str]) -> str:
        unit, size = _other(match[2])
        return f"{re.sub(number, lambda one: f'{float(one[0]) / size:.4g}', match[1])} {unit}"

    each = rf"{number}(?:(?: to |, | and ){number})*"
    return re.sub(rf"(?<![\w.-])(?<!= )({each}) ({units})(?![\w/²³])", other, text)


def _over(value: Any, size: float) -> Any:
    """A number, or each of several, over the size of its unit; anything else unchanged."""
    if isinstance(value, (tuple, list)):
        over = [_over(one, size) for one in value]
        return over if isinstance(value, list) else tuple(over)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return value / size if is_number and size != 1.0 else value


def _named(name: str) -> tuple[str, float]:
    """A name with the other units at the end of its parts, and the size of its value's unit."""
    parts, size = [], 1.0
    for part in name.split("."):
        end = unit_end(f"_{part}")
        unit = UNITS.get(end, "")
        other, own = _other(unit)
        size = own if unit else size
        if other != unit:
            instead = next(e for e, u in UNITS.items() if u == other)
            part = f"_{part}".removesuffix(end)[1:] + instead
        parts.append(part.lstrip("_"))
    return ".".join(parts), size


def table_in_inches(table: Table) -> Table:
    """The table with its lengths, forces, torques, stresses and masses in inches and pounds."""
    if table.record:
        values = {}
        for name, value in zip(table.names, next(table.rows()), strict=True):
            new, size = _named(name)
            is_table = isinstance(value, Table)
            values[new] = table_in_inches(value) if is_table else _over(value, size)
        return table.replaced(names=tuple(values), columns=[(v,) for v in values.values()])
    if {"quantity", "check", "unit"} & set(table.names):
        table = table.replaced(columns=_by_row(table))
    else:
        sizes = [_named(name)[1] for name in table.names]
        table = table.changed(
            lambda columns: [
                _over(one if isinstance(one, (list, tuple)) else one.tolist(), size)
                for one, size in zip(columns, sizes, strict=True)
            ]
        )
    names, first, in_title = (
        tuple(_named(name)[0] for name in some)
        for some in (table.names, table.reading.first, table.reading.in_title)
    )
    return table.replaced(
        names=names, reading=table.reading._replace(first=first, in_title=in_title)
    )


def _by_row(table: Table) -> Sequence[Any]:
    """The columns of a table whose rows have units: by a column with them, or by their names."""
    rows = []
    for row in table.rows():
        values, size = dict(zip(table.names, row, strict=True)), 1.0
        key = next((key for key in ("quantity", "check") if key in values), None)
        if key:
            values[key], size = _named(str(values[key]))
        elif values["unit"]:
            values["unit"], size = _other(values["unit"])
        sizes = {name: _named(name)[1] if unit_of(name) else size for name in values}
        rows.append([_over(value, sizes[name]) for name, value in values.items()])
    return list(zip(*rows, strict=True)) if rows else table.columns


def document_in_inches(document: Document) -> Document:
    """The document with its facts, tables and curves in inches and pounds.

    Keys of the spec, which have their unit in their names, keep it.
    """
    return document._replace(blocks=tuple(map(_block, document.blocks)))


def figure_in_inches(figure: Figure) -> Figure:
    """The figure with its curves and axes in inches and pounds."""
    (x, size_x), panels = _axis(figure.x), []
    title = figure.title.replace(figure.x.label, x.label)
    for panel in figure.panels:
        y, size = _axis(panel.y)
        title = title.replace(panel.y.label, y.label)
        curves = tuple(
            curve._replace(
                pieces=tuple((_over(u, size_x), _over(v, size)) for u, v in curve.pieces),
                marks=tuple(
                    m._replace(x=_over(m.x, size_x), y=_over(m.y, size)) for m in curve.marks
                ),
            )
            for curve in panel.curves
        )
        bounds = panel.bounds and _over(panel.bounds, size)
        panels.append(panel._replace(y=y, curves=curves, bounds=bounds))
    window, shaded = (_over(span, size_x) for span in (figure.window, figure.shaded))
    return Figure(title, x, tuple(panels), window, shaded)


def _block(block: Block) -> Block:
    if isinstance(block, TextList):
        return block._replace(texts=tuple(map(text_in_inches, block.texts)))
    if isinstance(block, Facts):
        # a key of the spec keeps its unit
        facts = (
            fact
            if unit_of(fact.name)
            else fact._replace(
                value=_over(fact.value, _other(fact.unit)[1]), unit=_other(fact.unit)[0]
            )
            for fact in block.facts
        )
        return block._replace(facts=tuple(facts))
    if isinstance(block, Grid) and "Key" not in block.heads:
        return _grid(block)
    if isinstance(block, Curves):
        return Curves(figure_in_inches(block.figure))
    return block


def _grid(grid: Grid) -> Grid:
    """A table whose units stand in a column, or in the heads of its columns."""
    at = next(
        (grid.heads.index(head) for head in ("Unit", "Unit at speed") if head in grid.heads), None
    )
    heads, sizes = [], []
    for head in grid.heads:
        words, comma, unit = head.rpartition(", ")
        other, size = _other(unit) if comma else (unit, 1.0)
        heads.append(words + comma + other)
        sizes.append(size if comma and (other != unit or unit == "°") else None)
    rows = []
    for row in grid.rows:
        unit, of_row = _other(str(row[at])) if at is not None else ("", 1.0)
        cells = [
            _over(cell, of_row if f is None else f) for cell, f in zip(row, sizes, strict=True)
        ]
        if at is not None:
            cells[at] = unit
        rows.append(tuple(cells))
    return grid._replace(heads=tuple(heads), rows=tuple(rows))


def _axis(axis: Axis) -> tuple[Axis, float]:
    """An axis with its other unit, and the unit's size; a csv's column has it in its name."""
    if axis.label == axis.name:
        name, size = _named(axis.name)
        return axis._replace(label=name), size
    unit, size = _other(axis.unit)
    return axis._replace(unit=unit), size
