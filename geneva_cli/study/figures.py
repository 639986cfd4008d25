"""Figures of several designs, and of the columns of a CSV file."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from itertools import pairwise

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut, few
from geneva_cli.figure import JOINED, LINE, POINTS, Axis, Curve, Figure, Panel, Piece
from geneva_cli.loads.cycle_figures import AXIS_BY_NAME, LeftOut, figure
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.specfile.columns import Columns, read_columns
from geneva_cli.study.spec_texts import designs_of, spec_texts
from geneva_cli.verdict.quantities.quantity_names import whole_name

QUANTITIES = tuple(AXIS_BY_NAME)  # quantities that can be plotted for a design
CURVES_MAX = 12  # curves of a panel that the eye can tell apart
RANDOM = "drawn at random"  # the name of rows that nearly all differ in their other keys


def of_specs(
    paths: Sequence[str],
    settings: Iterable[str] = (),
    pick: Sequence[str] = (),
    vary: Sequence[str] = (),
    reverse: bool = False,
) -> tuple[Figure, list[Design], list[LeftOut]]:
    """The cycles of some specs in one figure, the designs, and the quantities that it lacks.

    With ``vary``, texts ``KEY=VALUES``, there is one spec, drawn for each combination of values.
    With ``reverse`` each design also turns the other way.

    Raises GenevaError for a spec that cannot be read or built, and as ``figure`` does.

    >>> cycles, *_ = of_specs(["designs/internal-z6.toml", "designs/turret.toml"], (), ["jerk"])
    >>> [curve.name for curve in cycles.panels[0].curves]
    ['internal-z6', 'turret']
    """
    texts = spec_texts(paths, tuple(settings), vary)
    designs = designs_of(texts, reverse)
    cycles = {name: design.cycle for name, design in designs.items()}
    names = []
    for name in pick:  # acceleration shows acceleration.max
        parts = (_quantity(name) or "").split(".")
        names.append(next((part for part in (name, *parts) if part in AXIS_BY_NAME), name))
    curves, left_out = figure(cycles, names)
    lacks = [(designs[name].spec.path, text) for name, text in left_out]
    return curves, list(designs.values()), lacks


def of_table(path: str, x: str, ys: Sequence[str]) -> Figure:
    """Columns of a CSV file over another column, one panel for each.

    Over a varied key of a sweep, each combination of the other varied keys has its own curve. If
    nearly every design has its own combination, points are drawn. Over another column, ascending
    numbers make a curve, such as a spectrum. Otherwise points are drawn, joined if they rise or
    fall throughout, as on a Pareto front.

    Raises GenevaError for a file that cannot be read, and for a column without numbers.
    """
    table = read_columns(path)
    if not x or not ys:
        raise GenevaError(
            f"{cut(path, 300)}: --x COLUMN and --y COLUMN,... say what to plot; it has "
            f"{few('', table.names)}"
        )
    x, ys = _column(table, x, "--x"), [_column(table, y, "--y") for y in dict.fromkeys(ys)]
    at = table.numbers(x, "--x")
    families = _families(table, x)
    by_key = x in _keys(table) and RANDOM not in families
    panels = []
    for y in ys:
        values = table.numbers(y, "--y")
        curves = [
            curve
            for number, (name, rows) in enumerate(families.items())
            if (curve := _curve(number, name, [(at[i], values[i]) for i in rows], by_key))
        ]
        if not curves:
            raise GenevaError(f"--y {cut(y)}: no row of {cut(path, 300)} has both it and {x}")
        panels.append(Panel(Axis(y, y), tuple(curves), None, from_zero=False))
    places = [v for p in panels for c in p.curves for piece in c.pieces for v in piece[0]]
    low, high = min(places), max(places)
    lines = all(c.style == LINE for p in panels for c in p.curves)
    # points keep off the ends of the x axis
    margin = 0.0 if lines and high > low else 0.02 * (high - low) or 0.5 * abs(low) or 0.5
    title = f"{', '.join(ys)} by {x}"
    return Figure(title, Axis(x, x), tuple(panels), (low - margin, high + margin))


def _column(table: Columns, name: str, option: str) -> str:
    """A column's whole name, from any name of its quantity or from the nearest column name."""
    if name in table.names or not (quantity := _quantity(name)):
        return table.named(name, option)
    same = [column for column in table.names if _quantity(column) == quantity]
    return same[0] if len(same) == 1 else table.named(name, option)


def _quantity(name: str) -> str | None:
    """The whole name of a quantity; None for another column, such as a key."""
    try:
        return whole_name(name)
    except GenevaError:
        return None


def _keys(table: Columns) -> list[str]:
    """The varied keys: the first columns that are keys of a spec."""
    tables = {field.name.partition("_")[0] for field in dataclasses.fields(Spec)}
    out = []
    for name in table.names:
        if "." not in name or name.partition(".")[0] not in tables:
            break
        out.append(name)
    return out


def _families(table: Columns, x: str) -> dict[str, list[int]]:
    """The row numbers of each curve, by the values of the other varied keys."""
    keys = _keys(table)
    others = [key for key in keys if key != x]
    numbers = list(range(len(table.rows)))
    if x not in keys or not others:
        return {"": numbers}
    out: dict[str, list[int]] = {}
    for i, values in enumerate(zip(*[table.texts(key) for key in others], strict=True)):
        name = ", ".join(f"{key} = {value}" for key, value in zip(others, values, strict=True))
        out.setdefault(name, []).append(i)
    if 2 * len(out) > len(table.rows) and len(out) > CURVES_MAX:
        return {RANDOM: numbers}
    if len(out) > CURVES_MAX:
        raise GenevaError(
            f"{len(out)} curves, one for each combination of {', '.join(others)}; at most "
            f"{CURVES_MAX} can be distinguished: sweep fewer values, or plot over another key"
        )
    return out


def _curve(
    number: int, name: str, pairs: Iterable[tuple[float | None, float | None]], is_key: bool
) -> Curve | None:
    rows = list(pairs)
    points = [(x, y) for x, y in rows if x is not None and y is not None]
    if not points:
        return None
    ascends = all(a[0] < b[0] for a, b in pairwise(points))
    points.sort()
    steps = [*pairwise(points)]
    apart = all(a[0] < b[0] for a, b in steps)
    monotonic = all(a[1] > b[1] for a, b in steps) or all(a[1] < b[1] for a, b in steps)
    if not apart or not (ascends or is_key or monotonic):
        return Curve(number, name, (_piece(points),), style=POINTS)
    # marks of more points would touch, but for a front
    style = LINE if (ascends or is_key) and len(points) > 40 else JOINED
    pieces: list[list[tuple[float, float]]] = [[]]  # divided where a row has no value
    for x, y in sorted((r for r in rows if r[0] is not None), key=lambda r: r[0] or 0.0):
        if x is None or y is None:
            pieces.append([])
        else:
            pieces[-1].append((x, y))
    return Curve(number, name, tuple(_piece(one) for one in pieces if one), style=style)


def _piece(points: Sequence[tuple[float, float]]) -> Piece:
    x, y = zip(*points, strict=True)
    return list(x), list(y)
