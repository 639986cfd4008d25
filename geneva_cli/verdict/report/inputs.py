"""Inputs that the numbers of a report depend on: speed, clearances, load and limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.verdict.quantities.groups import ECHOED, INPUTS

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def inputs(model: PartsModel) -> Values:
    """The values of these keys."""
    spec = model.mechanism.spec
    known = {  # if a key is left out
        "wheel": {"held_by": spec.wheel.held_by},
        "size": spec.size.allowances._asdict(),
    }
    values: Values = {}
    for table, names in ECHOED.items():
        keys = spec.table(table) | known.get(table, {})
        values |= {f"{INPUTS}{table}.{key}": keys[key] for key in names}
    return values
