"""Quantities that a requirement names, in its goal and its bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.progress import tracked
from geneva_cli.study.batches import numbers
from geneva_cli.study.fields import Cell, Pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import is_number
from geneva_cli.study.target import Target
from geneva_cli.synthesis.rows import MachineRow
from geneva_cli.verdict.quantities.names import in_batch

Cells: TypeAlias = tuple[Cell, ...]  # values of one machine


def with_batch_values(names: Sequence[str], rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows with their quantities from batches; without them if a row needs its own machine."""
    if not (names and in_batch(names)):
        return list(rows)
    values = numbers([row.spec for row in rows], names)
    return [row._replace(extra=_cells(one)) for row, one in zip(rows, values, strict=True)]


def bounded(target: Target, rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows that keep the bounds, with the quantities that the requirement names."""
    names = target.names
    alone = [row.spec for row in rows if not row.extra]
    rest = mapped(partial(_values, Pick(names)), alone, min(cores(), len(alone)), "machines")
    rest = tracked(rest, "machines computed", len(alone))
    values = [row.extra or next(rest) for row in rows]
    out = []
    nearest: dict[str, list[float]] = {b.name: [] for b in target.bounds}
    for row, cells in zip(rows, values, strict=True):
        if cells is None:
            continue
        by_name = dict(zip(names, cells, strict=True))
        for name, values_of_bound in nearest.items():
            cell = by_name[name]
            values_of_bound += [float(cell)] if is_number(cell) else []
        if all(b.kept(by_name[b.name]) for b in target.bounds):
            out.append(row._replace(extra=cells))
    if not out:
        raise GenevaError(f"--subject-to: {_how_near(target, nearest, len(rows))}")
    return out


def _cells(row: Sequence[float] | None) -> Cells:
    """The cells of a machine, None for unbounded values; no cells if a value is unknown."""
    if row is None or any(map(math.isnan, row)):
        return ()
    return tuple(None if math.isinf(value) else value for value in row)


def _values(of: Pick, spec: Spec) -> Cells | None:
    try:
        return tuple(of.of(build(spec)))
    except GenevaError:  # parts that cannot be drawn have no quantities
        return None


def _how_near(target: Target, nearest: dict[str, list[float]], count: int) -> str:
    """The bounds that none of the machines keeps, and how near one is; or that none keeps all."""
    phrases = []
    for b in target.bounds:
        values = nearest[b.name]
        if values and not any(map(b.kept, values)):
            phrases.append(f"{b} (nearest {(max if b.sign == '>=' else min)(values):.6g})")
        elif not values:
            phrases.append(f"{b} (not known)")
    if not phrases:
        phrases = [*map(str, target.bounds[:-1]), f"{target.bounds[-1]} at once"]
    return f"none of {count} machines that keep all other bounds keeps {' and '.join(phrases)}"
