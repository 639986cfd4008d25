"""Comparison of designs: one column for each design, one row for each quantity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.tolerances import same
from geneva_cli.parts.chosen import OF_SIZES, ByLoad, Chosen, by_load
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
    ``reverse`` adds a column for each design turning the other way. The table's prose says which
    sizes the loads of varied designs choose anew.

    Raises GenevaError for a design that cannot be read or built.
    """
    texts = spec_texts(paths, settings, vary, ("quantity", "differs"))  # the table's own columns
    designs = designs_of(texts, reverse)
    for design in designs.values():
        _refuse_drawings(design.spec)
    picked = pick(picks) if picks else None
    has_sizes = not picks or any(name.startswith(OF_SIZES) for name in picks)
    each: list[dict[str, Cell]] = []
    sizes: list[Mapping[str, Chosen]] = []
    for design in designs.values():
        machine = design.mechanism
        if picked:
            each.append(dict(zip(picked.names, picked.of(machine), strict=True)))
        else:
            first = dict.fromkeys(MACHINE.names)
            each.append({**first, **_shape(machine.spec), **values(parts_of(machine))})
        # while the loads of this machine are known
        sizes.append(by_load(machine) if vary and has_sizes else {})
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
    return table.replaced(prose=_chosen_anew([*designs], sizes), reading=Reading(designs=True))


def _chosen_anew(names: Sequence[str], sizes: Sequence[Mapping[str, Chosen]]) -> str:
    """The sizes that the loads of varied designs choose other than that of the first, in words."""
    changes = [ByLoad(own, sizes[0]).changes for own in sizes]
    texts = [f"{name}: {text}" for name, text in zip(names, changes, strict=True) if text]
    return f"sizes chosen anew, against {names[0]}: {'; '.join(texts)}" if texts else ""


def _refuse_drawings(spec: Spec) -> None:
    if spec.outline.is_given:
        raise GenevaError(
            f"{spec.path}: [outline]: a comparison is of formulas, and turns no drawings; "
            "`geneva check` and `geneva peaks` take each"
        )


def _shape(spec: Spec) -> dict[str, Cell]:
    shape: dict[str, Cell] = {}
    for table, keys in keys_in(spec).items():
        for own in values_of(spec, table) if table not in PLAIN else ():
            shape |= {f"{table}.{key.key}": own[key.key] for key in keys}
    return {key: value for key, value in shape.items() if isinstance(value, (str, float, int))}


def differing(table: Table) -> Table:
    """The rows of a comparison whose cells differ; none of a single design."""
    rows = [row for row in table.rows() if row[-1]] if "differs" in table.names else []
    kept = rows_table(table.names, rows, mixed=True)
    return kept.replaced(prose=table.prose, reading=table.reading)


def over(cell: Cell, first: Cell) -> Cell:
    """A number divided by another; words as they are, and None where there is no quotient."""
    if isinstance(cell, bool) or not is_number(cell):
        return cell
    return cell / first if is_number(first) and first else None
