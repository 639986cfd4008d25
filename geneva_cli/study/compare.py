"""Designs side by side: several files, or one spec with keys varied; a row for each quantity."""

from __future__ import annotations

import itertools
import os
from collections.abc import Collection, Sequence

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut
from geneva_cli.numerics.tolerances import same
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.reader import Text, read, setting
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.study.fields import pick, values
from geneva_cli.study.rows import Cell
from geneva_cli.study.sweep.constraints import is_number
from geneva_cli.study.sweep.values import axis, refuse_twice
from geneva_cli.table import Reading, Table, rows_table
from geneva_cli.verdict.quantities.groups import INPUTS, MACHINE
from geneva_cli.verdict.quantities.quantity_names import group_of

DESIGNS_MAX = 100  # in one comparison


def compare(
    paths: Sequence[str],
    settings: Sequence[str] = (),
    vary: Sequence[str] = (),
    picks: Sequence[str] = (),
    ratio: bool = False,
    reverse: bool = False,
) -> Table:
    """Return the comparison: ``quantity``, one column for each design, and ``differs`` for several.

    The designs are those of ``designs_of``. ``picks`` are the quantities to show. Without them all
    that need no parts are shown, and the keys of wheel, drives and motion in which the specs
    differ. ``ratio`` divides numbers by those of the first design. Numbers differ if they do so by
    more than rounding.
    """
    # the table's own columns
    designs = designs_of(paths, settings, vary, reverse, ("quantity", "differs"))
    picked = pick(picks) if picks else None
    each: list[dict[str, Cell]] = []
    for design in designs.values():
        spec, machine = design.spec, design.mechanism
        if spec.outline.files:
            raise GenevaError(
                f"{spec.path}: [outline]: a comparison is of formulas, and turns no drawings; "
                "`geneva check` and `geneva peaks` take each"
            )
        if picked:
            each.append(dict(zip(picked.names, picked.of(machine), strict=True)))
            continue
        own: dict[str, Cell] = dict.fromkeys(MACHINE.names)
        for table, keys in keys_in(spec).items():
            for row in values_of(spec, table) if table not in PLAIN else ():
                shape = {f"{table}.{key.key}": row[key.key] for key in keys}
                own |= {k: x for k, x in shape.items() if isinstance(x, (str, float, int))}
        each.append({**own, **values(parts_of(machine))})
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
    return rows_table(names, rows, mixed=True).replaced(reading=Reading(designs=True))


def differing(table: Table) -> Table:
    """The rows of a comparison whose cells differ; none of a single design."""
    rows = [row for row in table.rows() if row[-1]] if "differs" in table.names else []
    return rows_table(table.names, rows, mixed=True).replaced(reading=table.reading)


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
    taken: Collection[str] = (),
) -> dict[str, Design]:
    """The designs of specs, by a short name each that is not one of ``taken``.

    ``settings``, texts ``KEY=VALUE``, replace keys of each spec. With ``vary``, texts
    ``KEY=VALUES``, there is one spec, and a design for each combination of values. With ``reverse``
    each also turns the other way.
    """
    texts: dict[str, Text] = {}
    if vary and len(paths) > 1:
        raise GenevaError("--vary is for one SPEC; leave it out to compare several")
    if vary:
        text, axes = read(paths[0], settings), [axis(v) for v in vary]
        refuse_twice(axes, text.set_keys)
        for one in itertools.product(*[a.values for a in axes]):
            words = [f"{a.key}={v}" for a, v in zip(axes, one, strict=True)]
            changes = tuple(setting(s, "--vary") for s in words)
            texts[" ".join(words)] = text._replace(set_keys=(*text.set_keys, *changes))
            if len(texts) > DESIGNS_MAX:
                raise GenevaError(
                    f"--vary makes more than {DESIGNS_MAX} designs: `geneva sweep` has a row for "
                    "each"
                )
    else:
        paths = list(paths)
        twice = next((p for p in paths if paths.count(p) > 1), None)
        if twice:
            advice = "use --vary to compare changes of one spec"
            raise GenevaError(f"{'<stdin>' if twice == '-' else cut(twice)}: given twice; {advice}")
        if len(paths) > DESIGNS_MAX:
            raise GenevaError(f"{len(paths)} designs; at most {DESIGNS_MAX} can be compared")
        # a file's name without folder and ending, if no other file shares it
        stems = [os.path.splitext(os.path.basename(path))[0] for path in paths]
        for stem, path in zip(stems, paths, strict=True):
            is_short = stems.count(stem) == 1 and stem not in taken
            texts[stem if is_short else path] = read(path, settings)
    designs: dict[str, Design] = {}
    for name, text in texts.items():
        designs[name] = Design.of(text.spec(), text)
        if reverse:
            designs[f"{name} backwards"] = designs[name].backwards
    return designs
