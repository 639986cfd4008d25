"""The greatest loads of a period; torque and power of the input over it, with their signs."""

from __future__ import annotations

import math

from geneva_cli.analysis.carried import inertia_kgm2
from geneva_cli.analysis.peaks import worst
from geneva_cli.analysis.quantities import REPORTED_PEAKS, sources
from geneva_cli.drawings.model import PartsModel
from geneva_cli.loads import loads
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.summary import reversals_deg, summaries
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


def cycle(model: PartsModel) -> Values:
    """Greatest and least over the motions, mean and rms over the period; None without a load."""
    of = cycle_of(model.mechanism)
    rows = summaries(of)
    values: Values = {}
    for name in ("input_torque_Nm", "power_W", "crank_bearing_N"):
        numbers = rows[name]._asdict()
        values |= {f"cycle.{name}.{key}": numbers[key] for key in ("max", "min", "mean", "rms")}
    values["cycle.reversals_deg"] = tuple(reversals_deg(of)) if of.is_loaded else None
    return values
