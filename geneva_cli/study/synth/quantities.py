"""Quantities that a requirement names, in its goal and its bounds."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.progress import tracked
from geneva_cli.study.batches import cells_of, numbers
from geneva_cli.study.fields import Cell, Pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Nearness
from geneva_cli.study.synth.machine_rows import MachineRow
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch


def with_batch_values(names: Sequence[str], rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows with their quantities from batches; without them if a row needs its own machine."""
    if not (names and in_batch(names)):
        return list(rows)
    values = numbers([row.spec for row in rows], names)
    return [
        row._replace(extra=tuple(cells_of(one or ())))
        for row, one in zip(rows, values, strict=True)
    ]


def bounded(target: Target, rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows that keep the bounds, with the quantities that the requirement names."""
    names = target.names
    alone = [row.spec for row in rows if not row.extra]
    rest = mapped(partial(_values, Pick(names)), alone, min(cores(), len(alone)), "machines")
    rest = tracked(rest, "machines computed", len(alone))
    values = [row.extra or next(rest) for row in rows]
    known = [(row, cells) for row, cells in zip(rows, values, strict=True) if cells is not None]
    nearness = Nearness([(names.index(b.name), b) for b in target.bounds])
    nearness.add([cells for _, cells in known])
    kept = [
        row._replace(extra=cells)
        for row, cells in known
        if all(b.kept(cells[i]) for i, b in nearness.bounds)
    ]
    if not kept:
        raise GenevaError(f"--subject-to: {_how_near(nearness, len(rows))}")
    return kept


def _values(of: Pick, spec: Spec) -> tuple[Cell, ...] | None:
    try:
        return tuple(of.of(build(spec)))
    except GenevaError:  # parts that cannot be drawn have no quantities
        return None


def _how_near(nearness: Nearness, count: int) -> str:
    """The bounds that none of the machines keeps, and how near one is; or that none keeps all."""
    each = [*zip(nearness.bounds, nearness.kept, nearness.nearest, strict=True)]
    phrases = [
        f"{b} (not known)" if nearest is None else f"{b} (nearest {nearest:.6g})"
        for (_, b), kept, nearest in each
        if not kept
    ]
    if not phrases:
        *others, last = [str(b) for _, b in nearness.bounds]
        phrases = [*others, f"{last} at once"]
    return f"none of {count} machines that keep all other bounds keeps {' and '.join(phrases)}"
