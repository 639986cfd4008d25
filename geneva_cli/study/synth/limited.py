"""The limits of a requirement's frame as bounds, and the rows that break them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geneva_cli.spec.load_limits import LIMITED
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.machine_rows import MachineRow
from geneva_cli.study.target import Target


def frame_limits(target: Target) -> tuple[Constraint, ...]:
    """The frame's limits as bounds; the lock's load is equal in all machines of a wheel."""
    values = target.frame.limits.as_dict() if target.frame else {}
    return tuple(
        Constraint(name, ">=" if "_min" in key else "<=", float(values[key]))
        for key, name in LIMITED.items()
        if values.get(key) is not None
    )


def _kind(row: MachineRow) -> tuple[object, ...]:
    """A key that is equal for all machines of one wheel, drive, law and number of rollers."""
    one = row.candidate
    return one.gearing, one.z, one.drive, one.law, one.fixed, one.rollers


def first_of_each(rows: Sequence[MachineRow], linkages: bool = False) -> list[MachineRow]:
    """The first row of every kind, or the first that may be built if that one cannot.

    With ``linkages`` every linkage counts as a kind, as several rows stand for those searched.
    """
    kept: list[MachineRow] = []
    can_be: dict[Any, bool] = {}  # by kind, whether one of the kept rows may be built
    for i, row in enumerate(rows):
        apart = linkages and row.candidate.crank_mm is None
        own = i if apart else _kind(row)
        if own not in can_be or (not can_be[own] and not row.is_impossible):
            kept.append(row)
            can_be[own] = not row.is_impossible
    return kept


def with_replacements(rows: Sequence[MachineRow], kept: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows, with those that break a limit replaced by rows ``kept`` of their kind."""
    broken = {_kind(row) for row in rows if row.breaks_limit}
    instead = [row for row in kept if _kind(row) in broken and not row.breaks_limit]
    mended = {_kind(row) for row in instead}
    return [*(row for row in rows if _kind(row) not in mended), *instead]
