"""The number wheels of a counter, and when each of them moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.table import rows_table

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def number_wheels(model: PartsModel) -> Values:
    """A row for each number wheel: turns of the input in one of its turns, and between its steps.

    The first is the driver's and never rests: its steps follow each other.
    """
    mechanism = model.mechanism
    pinions = mechanism.spec.wheel.pinions
    if not pinions:
        return {"number_wheels": None}
    step_deg = mechanism.engagements[0].motion_deg
    digits, turn_s = 360.0 / step_deg, 60.0 / mechanism.spec.drive.n_rpm
    names = ("number_wheel", "turns_per_turn", "turns_per_step", "step_s", "moving_s")
    moving_s = turn_s / digits
    rows = [
        (k + 1, digits**k, digits ** (k - 1), turn_s * digits ** (k - 1), moving_s)
        for k in range(pinions + 1)
    ]
    return {"number_wheels": rows_table(names, rows)}
