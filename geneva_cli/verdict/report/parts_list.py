"""The list of parts, pivots and dimensions, as ``--part parts`` writes it, in three tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.drawings.parts_list import FIRST, KINDS, parts_list
from geneva_cli.table import Reading, rows_table

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def parts_list_tables(model: PartsModel) -> Values:
    """The three tables; None for one without rows, such as the pivots of a spherical wheel."""
    rows = parts_list(model).to_rows()
    values: Values = {}
    for kind, names in KINDS.items():
        own = [[row[name] for name in names] for row in rows if row["row"] == kind]
        table = rows_table(names, own, mixed=True).replaced(reading=Reading(FIRST))
        values[f"parts_list.{kind}"] = table if own else None
    return values
