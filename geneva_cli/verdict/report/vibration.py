"""The load on its elastic shaft: what an index leaves swinging, and the speeds to avoid."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.verdict.quantities.groups import own_names

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def vibration(model: PartsModel) -> Values:
    """None without a stiffness, and why where inertia is missing or its period is out of range.

    Bands, stations and warnings are those of ``geneva vibration``.
    """
    mechanism = model.mechanism
    out: Values = dict.fromkeys((*own_names("vibration"), "vibration.speeds_to_avoid_rpm"))
    if mechanism.spec.shaft.stiffness_Nm_rad is None:
        return out
    # only for elastic shafts: the modules of vibration take a twentieth of a short report
    from geneva_cli.analysis.vibration.answers import values
    from geneva_cli.analysis.vibration.oscillator import required_oscillator

    try:
        results = values(mechanism, required_oscillator(mechanism))
    except GenevaError as error:
        return out | {"vibration.none": str(error)}
    return out | {
        f"vibration.{name}": x for name, x in results.items() if f"vibration.{name}" in out
    }
