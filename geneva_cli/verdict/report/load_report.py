"""Loads of a period, the keys that strength needs, positive drive, vibration and tolerances."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.load_tables import reversals_deg
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.tables import Tolerance
from geneva_cli.verdict.quantities.batch_designs import Values
from geneva_cli.verdict.quantities.groups import own_names
from geneva_cli.verdict.strength import REASONS, strength

SAMPLES = 65536  # random machines, as ``geneva tolerance`` draws by default


def cycle(parts: Parts) -> Values:
    """Greatest and least over the motions, mean and rms over the period; None without a load."""
    of = cycle_of(parts.mechanism)
    values: Values = {}
    for name in ("input_torque_Nm", "power_W", "crank_bearing_N"):
        one = of.extremes.get(name)
        numbers = one._asdict() if one else {}
        for key in ("max", "min", "mean", "rms"):
            value = numbers.get(key)
            bounded = value is not None and math.isfinite(value)
            values[f"{name}.{key}"] = value if bounded else None
    values["reversals_deg"] = tuple(reversals_deg(of)) if of.is_loaded else None
    return values


def needs(parts: Parts) -> Values:
    """The keys that unknown values of strength and life need: a line for each set of keys."""
    return {"needs": tuple(strength(parts.mechanism).missing(tuple(REASONS)))}


def slot(parts: Parts) -> Values:
    """Whether a wall pushes throughout, which may be cut away; None for straight slots."""
    from geneva_cli.loads.positive_drive import positive_drives

    drive = positive_drives(parts.mechanism)
    return {"positively_driven": not drive.loose_deg if drive else None}


def vibration(parts: Parts) -> Values:
    """The load on its elastic shaft: what an index leaves swinging, and the speeds to avoid.

    None without a stiffness, and why where inertia is missing or its period is out of range.
    Bands, stations and warnings are those of ``geneva vibration``.
    """
    mechanism = parts.mechanism
    none: Values = {"speeds_to_avoid_rpm": None}
    if mechanism.spec.shaft.stiffness_Nm_rad is None:
        return none
    # only for elastic shafts: the modules of vibration take a twentieth of a short report
    from geneva_cli.loads.vibration.oscillator import required_oscillator
    from geneva_cli.loads.vibration.vibration_answers import values

    try:
        results = values(mechanism, required_oscillator(mechanism))
    except GenevaError as error:
        return none | {"none": str(error)}
    return {name: results[name] for name in results if name in (*own_names("vibration"), *none)}


def tolerances(parts: Parts) -> Values:
    """The first lines of ``geneva tolerance``, and its warnings; None without tolerances."""
    mechanism, tolerance = parts.mechanism, parts.mechanism.spec.tolerance
    if tolerance == Tolerance(distribution=tolerance.distribution):
        return {"warnings": None}
    from geneva_cli.verdict.tolerance.tolerance_tables import tolerance_table

    # micrometres need a radius
    L = mechanism.center_distance_mm
    answers = tolerance_table(mechanism, parts, SAMPLES, 0, L).to_dict()
    return {name: answers[name] for name in (*own_names("tolerance"), "warnings")}
