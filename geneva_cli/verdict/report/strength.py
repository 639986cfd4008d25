"""Whether the parts hold, and how long: value, what is allowed, and the margin between them."""

from __future__ import annotations

from geneva_cli.analysis.strength import pin as pins
from geneva_cli.analysis.strength import shafts
from geneva_cli.parts.proof import Proof
from geneva_cli.verdict.report.values import Values
from geneva_cli.verdict.strength import Strength, margin, strength


def strength_values(proof: Proof) -> Values:
    """None without a load and a face width; ``strength.needs`` says which keys are missing."""
    of = strength(proof.mechanism)
    given = of.spec.shaft
    values: Values = {}
    for part, found in (
        ("pin", _pin(of)),
        ("horn", _horn(of)),
        ("lock", _lock(of)),
        ("wheel_shaft", _shaft(of, of.wheel_shaft, shafts.wheel_shaft(given))),
        ("crank_shaft", _shaft(of, of.crank_shaft, shafts.crank_shaft(given))),
    ):
        values |= {f"strength.{part}.{name}": value for name, value in found.items()}
    values |= {f"life.{name}": value for name, value in of.values.items()}
    return values | {"strength.needs": tuple(of.missing(tuple(of.needs)))}


def _pin(of: Strength) -> Values:
    allowed = of.spec.material_roller.stress_max_MPa
    stress, pin, force = of.pin_stress_MPa, of.pin, of.force_N
    under = pin.under(force) if pin and force is not None else None
    return {
        "diameter_mm": float(pin.diameter_mm) if pin else None,
        "bending_MPa": float(under.bending) if under else None,
        "shear_MPa": float(under.shear) if under else None,
        "stress_MPa": stress,
        "allowed_MPa": allowed,
        "margin": margin(stress, allowed),
        "least_diameter_mm": (
            float(pins.least_diameter_mm(pin, force, allowed))
            if allowed and pin and force
            else None
        ),
    }


def _horn(of: Strength) -> Values:
    allowed, found = of.spec.material_wheel.stress_max_MPa, of.horn
    return {
        "stress_MPa": found and found.stress_MPa,
        "at_deg": found and found.at_deg,
        "inwards_mm": found and found.inwards_mm,
        "thickness_mm": found and found.thickness_mm,
        "allowed_MPa": allowed,
        "margin": margin(found and found.stress_MPa, allowed),
    }


def _lock(of: Strength) -> Values:
    found, allowed = of.lock, of.spec.limits.lock_stress_max_MPa
    return {
        "torque_Nm": found and found.torque_Nm,
        "force_N": found and found.force_N,
        "contact_stress_MPa": found and found.contact_stress_MPa,
        "pressure_MPa": found and found.pressure_MPa,
        "allowed_MPa": allowed,
        "margin": margin(of.lock_stress_max_MPa, allowed),
        "horn_stress_MPa": found and found.horn_stress_MPa,
        "play_deg": found and found.play_deg,
        "approach_deg": found and found.approach_deg,
        "bending_deg": found and found.bending_deg,
        "deflection_deg": found and found.deflection_deg,
    }


def _shaft(of: Strength, found: shafts.Turned | None, ends: shafts.GivenShaft) -> Values:
    allowed = of.spec.shaft.shear_stress_max_MPa
    return {
        "diameter_mm": ends.diameter_mm,
        "moment_Nm": found and found.moment_Nm,
        "at_deg": found and found.at_deg,
        "stress_MPa": found and found.stress_MPa,
        "allowed_MPa": allowed if found else None,
        "margin": margin(found and found.stress_MPa, allowed),
        "least_diameter_mm": found and found.least_diameter_mm,
        "twist_deg": found and found.twist_deg,
    }
