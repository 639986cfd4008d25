"""Designs side by side: a column a design, a row a quantity, the same rows for every machine."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.parts.proof import Proof
from geneva_cli.study.beside import beside
from geneva_cli.study.fields import Cell, pick, values
from geneva_cli.study.sweep.constraints import is_number
from geneva_cli.table import Reading, Table, rows_table

OWN = ("quantity", "differs")  # columns of the table itself: no design's name
LEFT_OUT = "inputs."  # a spec's keys are not shown: they are in the spec, or in the columns' names


def compare(
    paths: Sequence[str],
    given: Sequence[str] = (),
    vary: Sequence[str] = (),
    picks: Sequence[str] = (),
    ratio: bool = False,
    alike: bool = True,
) -> Table:
    """Columns ``quantity``, one for each design, and ``differs``; ``ratio``: over the first design.

    Numbers differ where they do by more than rounding.

    One design is varied through values of keys (``vary``, ``KEY=VALUES``), or several are set side
    by side. ``picks`` are the quantities to show, without them all for which no parts are made;
    ``alike`` shows those that do not differ too. Raises GenevaError for a design that cannot be
    read or built.
    """
    names, machines = _columns(paths, given, vary)
    if picks:
        wanted = pick(picks)
        each = [dict(zip(wanted.names, wanted.of(m), strict=True)) for m in machines]
    else:
        each = [values(Proof(m)) for m in machines]
    rows = []
    for quantity in dict.fromkeys(name for found in each for name in found):
        if quantity.startswith(LEFT_OUT) and not picks:
            continue
        cells = [found.get(quantity) for found in each]
        differs = not all(_same(c, cells[0]) for c in cells[1:])
        if any(c is not None for c in cells) and (differs or alike):
            rows.append((quantity, *(_ratios(cells) if ratio else cells), differs))
    table = rows_table(("quantity", *names, "differs"), rows, mixed=True)
    return table.replaced(reading=Reading(designs=True))


def _same(cell: Cell, first: Cell) -> bool:
    """Whether two cells are equal, numbers but for rounding."""
    if isinstance(cell, float) and isinstance(first, float):
        return math.isclose(cell, first, rel_tol=ROUNDED)
    return cell == first


def _ratios(cells: Sequence[Cell]) -> list[Cell]:
    """The first cell as it is, and the others over it: words as they are, None over none or 0."""
    first, *others = cells
    return [first, *(_over(c, first) for c in others)]


def _over(cell: Cell, first: Cell) -> Cell:
    if isinstance(cell, bool) or not is_number(cell):
        return cell
    return cell / first if is_number(first) and first else None


def _columns(
    paths: Sequence[str], given: Sequence[str], vary: Sequence[str]
) -> tuple[list[str], list[Mechanism]]:
    """The names of the columns, and their machines."""
    texts = beside(paths, given, vary, OWN)
    machines = []
    for text in texts.values():
        spec = text.spec()
        with text.located():
            machines.append(build(spec))
    return list(texts), machines
