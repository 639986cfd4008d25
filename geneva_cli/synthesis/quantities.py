"""Quantities that a requirement names, in its goal and its bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.progress import tracked
from geneva_cli.spec.load_named import load_named
from geneva_cli.study.batches import numbers
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import (
    Constraint,
    Objective,
    is_number,
    refuse_contradictions,
    refuse_words,
)
from geneva_cli.study.target import Target
from geneva_cli.synthesis.rows import MachineRow
from geneva_cli.verdict.quantities.names import in_batch

if TYPE_CHECKING:
    from geneva_cli.study.fields import Pick

Cells: TypeAlias = tuple[float | int | str | bool | None, ...]  # values of one machine


class QuantityRequest(NamedTuple):
    """The quantities that a requirement names, by whole names, and its bounds on them."""

    pick: Pick | None
    bounds: tuple[Constraint, ...]
    sort: Objective | None

    @property
    def names(self) -> tuple[str, ...]:
        """The columns besides those of every row."""
        return self.pick.names if self.pick else ()


def quantity_request(target: Target, spec: Spec) -> QuantityRequest:
    """The quantities that a requirement names; ``spec`` is a design that has them.

    Raises GenevaError, with the nearest name, for an unknown one.
    """
    bound_names = [b.name for b in target.bounds]
    machine = build(spec)
    # imports all that a report has: most requirements name no quantity
    pick = load_named("study.fields:pick")
    of_sort: tuple[str, ...] = pick([target.sort.name], "--sort").names if target.sort else ()
    of_bounds = pick(bound_names, "--subject-to").requested if bound_names else ()
    every = pick([*of_sort, *of_bounds])
    bounds = tuple(b._replace(name=n) for b, n in zip(target.bounds, of_bounds, strict=True))
    refuse_contradictions(bounds)  # two names of one quantity may contradict each other
    by = {b.name: "--subject-to" for b in bounds}
    refuse_words(by, "only numbers are bound")
    loads = [name for name in every.names if name.startswith("loads.")]
    if loads and not load_named("loads.cycle:cycle_of")(machine).is_loaded:
        raise GenevaError(
            f"{loads[0]}: nothing resists the wheel, so no machine has a value of it; give a load "
            "with --from SPEC and its [load]"
        )
    return QuantityRequest(every, bounds, target.sort and target.sort._replace(name=of_sort[0]))


def with_batch_values(names: Sequence[str], rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows with their quantities from batches; without them if a row needs its own machine."""
    if not (names and in_batch(names)):
        return list(rows)
    values = numbers([row.spec for row in rows], names)
    return [row._replace(extra=_cells(one)) for row, one in zip(rows, values, strict=True)]


def bounded(request: QuantityRequest, rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows that keep the bounds, with the requested quantities."""
    assert request.pick
    names = request.names
    alone = [row.spec for row in rows if not row.extra]
    rest = mapped(partial(_values, request.pick), alone, min(cores(), len(alone)), "machines")
    rest = tracked(rest, "machines computed", len(alone))
    values = [row.extra or next(rest) for row in rows]
    out = []
    nearest: dict[str, list[float]] = {b.name: [] for b in request.bounds}
    for row, cells in zip(rows, values, strict=True):
        if cells is None:
            continue
        by_name = dict(zip(names, cells, strict=True))
        for name, values_of_bound in nearest.items():
            cell = by_name[name]
            values_of_bound += [float(cell)] if is_number(cell) else []
        if all(b.kept(by_name[b.name]) for b in request.bounds):
            out.append(row._replace(extra=cells))
    if not out:
        raise GenevaError(f"--subject-to: {_how_near(request, nearest, len(rows))}")
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


def _how_near(request: QuantityRequest, nearest: dict[str, list[float]], count: int) -> str:
    """The bounds that none of the machines keeps, and how near one is; or that none keeps all."""
    phrases = []
    for b in request.bounds:
        values = nearest[b.name]
        if values and not any(map(b.kept, values)):
            phrases.append(f"{b} (nearest {(max if b.sign == '>=' else min)(values):.6g})")
        elif not values:
            phrases.append(f"{b} (not known)")
    if not phrases:
        phrases = [*map(str, request.bounds[:-1]), f"{request.bounds[-1]} at once"]
    return f"none of {count} machines that keep all other bounds keeps {' and '.join(phrases)}"
