"""Strength of many designs at once: pin, horn, lock and shafts, as their reports name it.

NaN is what must be asked of the design alone; infinite what the design alone has no value of.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, cast

import numpy as np

from geneva_cli.analysis.strength import pin as pins
from geneva_cli.analysis.strength import shafts
from geneva_cli.analysis.strength.horn import HornStress, horn_of_many
from geneva_cli.analysis.strength.lock import LockUnderTorque, lock_of_many
from geneva_cli.study.sweep.quantity_group import Columns, Designs, QuantityGroup

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array


def _margin(stress: Number, allowed: Number) -> Array:
    """As ``verdict.strength.margin``: none of a stress of 0, or where there is no stress."""
    stress = np.asarray(stress)
    known = (stress > 0.0) & np.isfinite(stress)
    with np.errstate(all="ignore"):
        return np.where(known, np.ravel(allowed) / stress - 1.0, stress + np.inf)


def pin(of: Designs, asked: Collection[str]) -> Columns:
    """Under the greatest force, where a face width is known."""
    found = pins.pin(of.machine)
    if found is None:
        return {}
    force = of.force_N[:, None]
    under, allowed = found.under(force), of.machine.spec.material_roller.stress_max_MPa
    stress = np.ravel(under.equivalent)
    out: dict[str, Number | None] = {
        "diameter_mm": found.diameter_mm,
        "bending_MPa": under.bending,
        "shear_MPa": under.shear,
        "stress_MPa": stress,
    }
    if allowed is not None:
        out["least_diameter_mm"] = pins.least_diameter_mm(found, force, allowed)
        out["margin"] = _margin(stress, allowed)
    return out


def horn(of: Designs, asked: Collection[str]) -> Columns:
    """Under the roller, where a face width is known; none where nothing bounds the force."""
    spec = of.machine.spec
    width, allowed = spec.size.face_width_mm, spec.material_wheel.stress_max_MPa
    sizes = None if width is None else of.lock_sizes
    if width is None or sizes is None:
        return {}
    force = of.force_N
    found = horn_of_many(of.machine, sizes.half_width, sizes.lock.recess, width)
    rows = {name: _known(row) for name, row in found._asdict().items()}
    if allowed is not None:
        rows["margin"] = _margin(rows["stress_MPa"], allowed)
    return {name: np.where(np.isfinite(force), row, force) for name, row in rows.items()}


def _lock(of: Designs, asked: Collection[str]) -> Columns:
    """Under the torque in the dwell, where a face width is known."""
    sizes = of.lock_sizes
    found = sizes and lock_of_many(of.machine, sizes.half_width, sizes.lock)
    if found is None:
        return {}
    _, *names = found._fields  # the first is a word
    rows = {name: _known(found._asdict()[name]) for name in names}
    rows["deflection_deg"] = _known(found.deflection_deg)
    contact, approach = (np.asarray(row) for row in (found.contact_stress_MPa, found.approach_deg))
    allowed = of.machine.spec.limits.lock_stress_max_MPa
    if allowed is not None:
        most = np.where(np.isnan(approach), np.inf, np.fmax(contact, found.pressure_MPa))
        rows["margin"] = _margin(_known(most), allowed)
    return rows


def _known(row: Number | None) -> Array:
    """Of designs that have no value NaN becomes infinite."""
    found = np.asarray(row)
    return np.where(np.isnan(found), np.inf, found)


def _wheel_shaft(of: Designs, asked: Collection[str]) -> Columns:
    return _shaft(of, shafts.wheel_shaft(of.machine.spec.shaft), shafts.on_wheel)


def _crank_shaft(of: Designs, asked: Collection[str]) -> Columns:
    spec = of.machine.spec
    on = shafts.on_driven_crank if spec.drive.CRANKED else shafts.on_crank
    return _shaft(of, shafts.crank_shaft(spec.shaft), on)


def _shaft(of: Designs, ends: shafts.GivenShaft, on: shafts.On) -> Columns:
    """Of shafts that are parallel, as ``verdict.strength`` has it."""
    if not of.machine.spec.wheel.FLAT:
        return {}
    found = shafts.shaft_of_many(of.machine, ends, on)
    if found is None:
        return {}
    moment = cast("Array", found.moment_Nm) * of.loaded
    rows = {k: v for k, v in found._asdict().items() if v is not None}
    allowed = of.machine.spec.shaft.shear_stress_max_MPa
    if found.stress_MPa is not None and allowed is not None:
        rows["margin"] = _margin(found.stress_MPa, allowed)
    return {k: np.where(np.isfinite(moment), v, moment) for k, v in rows.items()}


PIN = ("diameter_mm", "bending_MPa", "shear_MPa", "stress_MPa", "least_diameter_mm", "margin")
SHAFT = ("moment_Nm", "at_deg", "stress_MPa", "least_diameter_mm", "twist_deg", "margin")
GROUPS = {
    "strength.pin": QuantityGroup(PIN, pin),
    "strength.horn": QuantityGroup((*HornStress._fields, "margin"), horn),
    "strength.lock": QuantityGroup(
        (*LockUnderTorque._fields[1:], "deflection_deg", "margin"), _lock
    ),
    "strength.wheel_shaft": QuantityGroup(SHAFT, _wheel_shaft),
    "strength.crank_shaft": QuantityGroup(SHAFT, _crank_shaft),
}
