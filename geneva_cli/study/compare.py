"""Comparison of designs: one column for each design, one row for each quantity."""

from __future__ import annotations

from collections.abc import Sequence

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.tolerances import same
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.study.fields import pick, values
from geneva_cli.study.rows import Cell
from geneva_cli.study.spec_texts import designs_of, spec_texts
from geneva_cli.study.sweep.constraints import is_number
from geneva_cli.table import Reading, Table, rows_table
from geneva_cli.verdict.quantities.groups import INPUTS, MACHINE
from geneva_cli.verdict.quantities.quantity_names import group_of


def compare(
    paths: Sequence[str],
    settings: Sequence[str] = (),
    vary: Sequence[str] = (),
    picks: Sequence[str] = (),
    ratio: bool = False,
    reverse: bool = False,
) -> Table:
    """Return the comparison: ``quantity``, one column for each design, and ``differs`` for several.

    Either one design is varied through values of keys (``vary``, texts ``KEY=VALUES``), or several
    specs are compared. ``picks`` are the quantities to show. Without them all that need no parts
    are shown, and the keys of wheel, drives and motion in which the specs differ. ``ratio`` divides
    numbers by those of the first design. Numbers differ if they do so by more than rounding.
    ``reverse`` adds a column for each design turning the other way.

    Raises GenevaError for a design that cannot be read or built.
    """
    texts = spec_texts(paths, settings, vary, ("quantity", "differs"))  # the table's own columns
    designs = designs_of(texts, reverse)
    machines = [design.mechanism for design in designs.values()]
    if picks:
        picked = pick(picks)
        each = [dict(zip(picked.names, picked.of(m), strict=True)) for m in machines]
    else:
        first = dict.fromkeys(MACHINE.names)
        each = [{**first, **_shape(m.spec), **values(parts_of(m))} for m in machines]
    rows = []
    for quantity in dict.fromkeys(name for own in each for name in own):
        if quantity.startswith(INPUTS) and not picks:  # the spec or the columns' names show these
            continue
        cells = [own.get(quantity) for own in each]
        differs = not all(same(c, cells[0]) for c in cells[1:])
        if quantity not in group_of() and (vary or not differs):
            continue  # a key that the designs share, or that the columns' names show
        if any(c is not None for c in cells):
            if ratio:
                cells[1:] = [over(cell, cells[0]) for cell in cells[1:]]
            rows.append((quantity, *cells, differs))
    names = ("quantity", *designs, "differs")
    if len(designs) == 1:  # nothing to differ from
        names, rows = names[:-1], [row[:-1] for row in rows]
    table = rows_table(names, rows, mixed=True)
    return table.replaced(reading=Reading(designs=True))


def _shape(spec: Spec) -> dict[str, Cell]:
    shape: dict[str, Cell] = {}
    for table, keys in keys_in(spec).items():
        for own in values_of(spec, table) if table not in PLAIN else ():
            shape |= {f"{table}.{key.key}": own[key.key] for key in keys}
    return {key: value for key, value in shape.items() if isinstance(value, (str, float, int))}


def differing(table: Table) -> Table:
    """The rows of a comparison whose cells differ; none of a single design."""
    rows = [row for row in table.rows() if row[-1]] if "differs" in table.names else []
    return rows_table(table.names, rows, mixed=True).replaced(reading=table.reading)


def over(cell: Cell, first: Cell) -> Cell:
    """A number divided by another; words as they are, and None where there is no quotient."""
    if isinstance(cell, bool) or not is_number(cell):
        return cell
    return cell / first if is_number(first) and first else None
