"""Torque and power of the input over a period, with their signs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.summary import reversals_deg, summaries

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def cycle(model: PartsModel) -> Values:
    """Greatest and least over the motions, mean and rms over the period; None without a load."""
    of = cycle_of(model.mechanism)
    loads = summaries(of)
    values: Values = {}
    for name in ("input_torque_Nm", "power_W", "crank_bearing_N"):
        numbers = loads[name]._asdict()
        values |= {f"cycle.{name}.{key}": numbers[key] for key in ("max", "min", "mean", "rms")}
    values["cycle.reversals_deg"] = tuple(reversals_deg(of)) if of.is_loaded else None
    return values
