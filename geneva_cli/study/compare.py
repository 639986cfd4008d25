"""Designs side by side, as a table or a figure; and a figure of the columns of a CSV file."""

import math
import os
from collections.abc import Mapping, Sequence
from itertools import groupby, pairwise, product
from typing import Any

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut, few
from geneva_cli.figure import JOINED, LINE, POINTS, Axis, Curve, Figure, Panel
from geneva_cli.loads.cycle_figures import QUANTITIES, LeftOut, figure
from geneva_cli.numerics.tolerances import same
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.columns import read_columns
from geneva_cli.specfile.reader import Text, read, setting
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.study.fields import Cell, pick, values
from geneva_cli.study.sweep.constraints import is_number
from geneva_cli.study.sweep.values import axis, refuse_twice
from geneva_cli.table import Reading, Table, rows_table
from geneva_cli.verdict.quantities.groups import GROUP_OF, MACHINE, REPORT
from geneva_cli.verdict.quantities.quantity_rows import INPUTS

DESIGNS_MAX = 100  # in one comparison
COLUMNS = ("quantity", "differs")  # of a comparison, besides the designs


def compare(
    designs: Mapping[str, Design],
    picks: Sequence[str] = (),
    ratio: bool = False,
    varied: bool = False,
    differing: bool = False,
) -> Table:
    """Return the comparison: ``quantity``, one column for each design, and ``differs`` for several.

    ``picks`` are the quantities to show. Without them all that need no parts are shown, and the
    keys of wheel, drives and motion in which the specs differ, unless their names say what is
    ``varied``. ``ratio`` divides numbers by those of the first design. With ``differing`` there are
    only rows whose cells differ, numbers by more than rounding.
    """
    picked = pick(picks) if picks else None
    each: list[dict[str, Cell]] = []
    for design in designs.values():
        spec, machine = design.spec, design.mechanism
        design.refuse_drawn("a comparison is")
        if picked:
            each.append(dict(zip(picked.names, picked.of(machine), strict=True)))
            continue
        own: dict[str, Cell] = dict.fromkeys(MACHINE.names)
        for table, keys in keys_in(spec).items():
            for row in values_of(spec, table) if table not in PLAIN else ():
                shape = {f"{table}.{key.key}": row[key.key] for key in keys}
                own |= {k: x for k, x in shape.items() if isinstance(x, (str, float, int))}
        groups = (MACHINE, *(group for group in REPORT if not group.makes_parts))
        each.append({**own, **values(parts_of(machine), groups)})
    rows = []
    for quantity in dict.fromkeys(name for own in each for name in own):
        if quantity.startswith(INPUTS) and not picks:  # the spec or the columns' names show these
            continue
        cells = [own.get(quantity) for own in each]
        differs = not all(same(c, cells[0]) for c in cells[1:])
        if quantity not in GROUP_OF and (varied or not differs):
            continue  # a key that the designs share, or that the columns' names show
        if any(c is not None for c in cells) and (differs or not differing):
            if ratio:
                cells[1:] = [over(cell, cells[0]) for cell in cells[1:]]
            rows.append((quantity, *cells, differs))
    names = ("quantity", *designs, "differs")
    if len(designs) == 1:  # nothing to differ from
        names, rows = names[:-1], [row[:-1] for row in rows]
    return rows_table(names, rows, mixed=True).replaced(reading=Reading(designs=True))


def over(cell: Cell, first: Cell) -> Cell:
    """A number divided by another; words as they are, and None where there is no quotient."""
    if isinstance(cell, bool) or not is_number(cell):
        return cell
    return cell / first if is_number(first) and first else None


def designs_of(
    paths: Sequence[str],
    settings: Sequence[str] = (),
    vary: Sequence[str] = (),
    reverse: bool = False,
) -> dict[str, Design]:
    """The designs of specs, by a short name each that is no column of a comparison.

    ``settings``, texts ``KEY=VALUE``, replace keys of each spec. With ``vary``, texts
    ``KEY=VALUES``, there is one spec, and a design for each combination of values. With ``reverse``
    each also turns the other way.
    """
    texts: dict[str, Text] = {}
    if vary and len(paths) > 1:
        raise GenevaError("--vary is for one SPEC; leave it out to compare several")
    axes = [axis(v) for v in vary]
    count = math.prod(len(a.values) for a in axes) if vary else len(paths)
    if count > DESIGNS_MAX:
        why = f"{count:,} designs; at most {DESIGNS_MAX} can be compared: `geneva sweep` has a row "
        raise GenevaError(why + "for each")
    if vary:
        text = read(paths[0], settings)
        refuse_twice(axes, text.set_keys)
        for one in product(*[a.values for a in axes]):
            words = [f"{a.key}={v}" for a, v in zip(axes, one, strict=True)]
            changes = tuple(setting(s, "--vary") for s in words)
            texts[" ".join(words)] = text._replace(set_keys=(*text.set_keys, *changes))
    else:
        paths = list(paths)
        twice = next((p for p in paths if paths.count(p) > 1), None)
        if twice:
            advice = "use --vary to compare changes of one spec"
            raise GenevaError(f"{'<stdin>' if twice == '-' else cut(twice)}: given twice; {advice}")
        # a file's name without folder and ending, if no other file shares it
        stems = [os.path.splitext(os.path.basename(path))[0] for path in paths]
        for stem, path in zip(stems, paths, strict=True):
            is_short = stems.count(stem) == 1 and stem not in COLUMNS
            texts[stem if is_short else path] = read(path, settings)
    designs: dict[str, Design] = {}
    for name, text in texts.items():
        designs[name] = Design.of(text.spec(), text)
        if reverse:
            designs[f"{name} backwards"] = designs[name].backwards
    return designs


POINTS_MARKED = 40  # marks of more points of a curve would touch


def of_designs(
    designs: Mapping[str, Design], pick: Sequence[str] = ()
) -> tuple[Figure, list[LeftOut]]:
    """The cycles of designs in one figure, and the quantities that it lacks, by their paths."""
    # acceleration.max is a value of the curve of acceleration
    names = [next((x for x in name.split(".") if x in QUANTITIES), name) for name in pick]
    curves, left_out = figure({name: design.cycle for name, design in designs.items()}, names)
    return curves, [(designs[name].spec.path, text) for name, text in left_out]


def of_table(path: str, x: str, ys: Sequence[str]) -> Figure:
    """Columns of a CSV file over another column, one panel for each.

    Numbers that ascend make a curve, divided where a row has none; others are points.
    """
    table = read_columns(path)
    if not x or not ys:
        text = f"{cut(path, 300)}: --x COLUMN and --y COLUMN,... say what to plot; it has "
        raise GenevaError(text + few("", table.names))
    x, ys = table.named(x, "--x"), [table.named(y, "--y") for y in dict.fromkeys(ys)]
    at = table.numbers(x, "--x")
    places = [place for place in at if place is not None]
    ascends = all(a < b for a, b in pairwise(places))
    style = POINTS
    if ascends:
        style = LINE if len(places) > POINTS_MARKED else JOINED
    panels = []
    for y in ys:
        points = zip(at, table.numbers(y, "--y"), strict=True)
        runs = groupby(points, lambda point: None not in point)
        pieces: Any = [(*map(list, zip(*run, strict=True)),) for known, run in runs if known]
        curve = Curve(0, "", tuple(pieces), style=style)
        if not curve.pieces:
            raise GenevaError(f"--y {cut(y)}: no row of {cut(path, 300)} has both it and {x}")
        panels.append(Panel(Axis(y, y), (curve,), None, from_zero=False))
    low, high = min(places), max(places)
    # points keep off the ends of the x axis
    margin = 0.0 if style == LINE else 0.02 * (high - low) or 0.5 * abs(low) or 0.5
    span = (low - margin, high + margin)
    return Figure(f"{', '.join(ys)} by {x}", Axis(x, x), tuple(panels), span)
