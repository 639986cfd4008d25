"""Figures of several designs, and of the columns of a CSV file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut, few
from geneva_cli.figure import JOINED, LINE, POINTS, Axis, Curve, Figure, Panel
from geneva_cli.loads.cycle_figures import AXIS_BY_NAME, LeftOut, figure
from geneva_cli.specfile.columns import read_columns
from geneva_cli.study.compare import designs_of
from geneva_cli.verdict.quantities.quantity_names import whole_name

POINTS_MARKED = 40  # marks of more points of a curve would touch


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
    """
    designs = designs_of(paths, tuple(settings), vary, reverse)
    names = []
    for name in pick:  # acceleration shows acceleration.max
        try:
            parts = whole_name(name).split(".")
        except GenevaError:
            parts = []
        names.append(next((part for part in (name, *parts) if part in AXIS_BY_NAME), name))
    curves, left_out = figure({name: design.cycle for name, design in designs.items()}, names)
    lacks = [(designs[name].spec.path, text) for name, text in left_out]
    return curves, list(designs.values()), lacks


def of_table(path: str, x: str, ys: Sequence[str]) -> Figure:
    """Columns of a CSV file over another column, one panel for each.

    Numbers that ascend make a curve, divided where a row has none; others are points.
    """
    table = read_columns(path)
    if not x or not ys:
        raise GenevaError(
            f"{cut(path, 300)}: --x COLUMN and --y COLUMN,... say what to plot; it has "
            f"{few('', table.names)}"
        )
    x, ys = table.named(x, "--x"), [table.named(y, "--y") for y in dict.fromkeys(ys)]
    at = table.numbers(x, "--x")
    places = [place for place in at if place is not None]
    ascends = all(a < b for a, b in pairwise(places))
    style = POINTS
    if ascends:
        style = LINE if len(places) > POINTS_MARKED else JOINED
    panels = []
    for y in ys:
        pieces: list[tuple[list[float], list[float]]] = [([], [])]
        for place, value in zip(at, table.numbers(y, "--y"), strict=True):
            if place is not None and value is not None:
                pieces[-1][0].append(place)
                pieces[-1][1].append(value)
            elif ascends:
                pieces.append(([], []))
        curve = Curve(0, "", tuple(piece for piece in pieces if piece[0]), style=style)
        if not curve.pieces:
            raise GenevaError(f"--y {cut(y)}: no row of {cut(path, 300)} has both it and {x}")
        panels.append(Panel(Axis(y, y), (curve,), None, from_zero=False))
    low, high = min(places), max(places)
    # points keep off the ends of the x axis
    margin = 0.0 if style == LINE else 0.02 * (high - low) or 0.5 * abs(low) or 0.5
    span = (low - margin, high + margin)
    return Figure(f"{', '.join(ys)} by {x}", Axis(x, x), tuple(panels), span)
