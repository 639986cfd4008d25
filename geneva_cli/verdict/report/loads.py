"""The greatest loads of a period."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.analysis.carried import inertia_kgm2
from geneva_cli.analysis.peaks import worst
from geneva_cli.analysis.quantities import REPORTED_PEAKS, sources
from geneva_cli.drawings.model import PartsModel
from geneva_cli.loads import loads

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def greatest_loads(model: PartsModel) -> Values:
    """The greatest loads and their input angles; None without a load, and for an unbounded one."""
    mechanism = model.mechanism
    loaded, known = mechanism.spec.is_loaded, sources(mechanism)
    values: Values = {}
    for name, source in REPORTED_PEAKS.items():
        peak = loads.greatest(mechanism, source) if loaded and source in known else None
        bounded = peak is not None and math.isfinite(peak.max)
        values[f"loads.{name}.max"] = peak.max if peak and bounded else None
        values[f"loads.{name}.at_deg"] = peak.at_deg if peak else None
    power = worst(mechanism).power.max if inertia_kgm2(mechanism.spec) else math.inf
    kinetic = None if math.isinf(power) else loads.kinetic_power_W(mechanism, power)
    return values | {"loads.kinetic_power_W": kinetic}
