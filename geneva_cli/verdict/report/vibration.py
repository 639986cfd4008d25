"""The load on its elastic shaft: what an index leaves swinging, and the speeds to avoid."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.analysis.vibration.answers import NUMBERS, values
from geneva_cli.analysis.vibration.oscillator import required_oscillator
from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def vibration(model: PartsModel) -> Values:
    """None without a stiffness, and why where inertia is missing or its period is out of range.

    Bands, stations and warnings are those of ``geneva vibration``.
    """
    mechanism = model.mechanism
    out: Values = {"vibration.none": None} | dict.fromkeys(f"vibration.{n}" for n in NUMBERS)
    if mechanism.spec.shaft.stiffness_Nm_rad is None:
        return out
    try:
        results = values(mechanism, required_oscillator(mechanism))
    except GenevaError as error:
        return out | {"vibration.none": str(error)}
    return out | {f"vibration.{name}": results[name] for name in NUMBERS}
