"""Strength and life of designs: pin, horn, lock, shafts, the roller and the walls of its slot."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis import pin as pins
from geneva_cli.loads.strength import roller, shafts
from geneva_cli.loads.strength.horn import horn_stresses
from geneva_cli.verdict.quantities.under_load import under_load

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array
    from geneva_cli.verdict.quantities.designs import Columns, Designs


def margin(stress: Number, allowed: Number | None) -> Array | None:
    """The relative margin of a stress: 0 if it equals the allowable stress.

    None without an allowable stress; infinite for a stress that is 0 or unbounded.

    >>> margin(np.array([80.0, 0.0]), 120.0)
    array([0.5, inf])
    """
    if allowed is None:
        return None
    stress = np.asarray(stress)
    known = (stress > 0.0) & np.isfinite(stress)
    with np.errstate(all="ignore"):
        return np.where(known, np.ravel(allowed) / stress - 1.0, stress + np.inf)


def pin(of: Designs) -> Columns:
    """The roller's pin under the greatest force; it needs a face width."""
    section, allowed = pins.pin(of.machine), of.spec.material_roller.stress_max_MPa
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    if section is None:
        return out
    force = under_load(of).force_N[:, None]
    under = section.under(force)
    stress = np.ravel(under.equivalent)
    out |= {
        "diameter_mm": section.diameter_mm,
        "bending_MPa": under.bending,
        "shear_MPa": under.shear,
        "stress_MPa": stress,
        "margin": margin(stress, allowed),
    }
    if allowed is not None:
        out["least_diameter_mm"] = pins.least_diameter_mm(section, force, allowed)
    return out


def horn(of: Designs) -> Columns:
    """The horn at the place where the roller bends it most; it needs a face width."""
    width, allowed = of.spec.size.face_width_mm, of.spec.material_wheel.stress_max_MPa
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    sizes = None if width is None else under_load(of).lock_sizes
    if width is None or sizes is None:
        return out
    force = under_load(of).force_N
    if not np.isfinite(force).any():
        return out | dict.fromkeys(("stress_MPa", "at_deg", "inwards_mm", "thickness_mm"), force)
    stresses = horn_stresses(of.machine, sizes.half_width, sizes.lock.recess, width)
    rows = {name: _known(row) for name, row in stresses._asdict().items()}
    stress = np.where(np.isfinite(force), rows["stress_MPa"], force)
    out["margin"] = margin(stress, allowed)
    return out | {name: np.where(np.isfinite(force), row, force) for name, row in rows.items()}


def lock(of: Designs) -> Columns:
    """The lock under the torque in the dwell; it needs a face width.

    ``greatest_MPa`` is the stress between disc and recess, on an end or between the arcs.
    """
    state, allowed = under_load(of).lock, of.spec.limits.lock_stress_max_MPa
    if state is None:
        return {"allowed_MPa": allowed}
    _, *names = state._fields  # the first is a word
    out: dict[str, Number | None] = {name: _known(state._asdict()[name]) for name in names}
    contact, approach = (np.asarray(row) for row in (state.contact_stress_MPa, state.approach_deg))
    most = np.where(np.isnan(approach), np.inf, np.fmax(contact, state.pressure_MPa))
    return out | {
        "deflection_deg": _known(state.deflection_deg),
        "greatest_MPa": _known(most),
        "allowed_MPa": allowed,
        "margin": margin(_known(most), allowed),
    }


def _known(row: Number | None) -> Array:
    """The row, infinite for designs without a value."""
    values = np.asarray(row)
    return np.where(np.isnan(values), np.inf, values)


def wheel_shaft(of: Designs) -> Columns:
    """The wheel's shaft, if it is parallel to the crank's."""
    return _shaft(of, shafts.wheel_shaft(of.spec.shaft), shafts.on_wheel)


def crank_shaft(of: Designs) -> Columns:
    """The crank's shaft, if it is parallel to the wheel's."""
    on = shafts.on_driven_crank if of.spec.drive.CRANKED else shafts.on_crank
    return _shaft(of, shafts.crank_shaft(of.spec.shaft), on)


def _shaft(of: Designs, ends: shafts.ShaftDimensions, on: shafts.ShaftForces) -> Columns:
    """A shaft; without results on a sphere, where an overhang does not determine the moment."""
    out: dict[str, Number | None] = {"diameter_mm": ends.diameter_mm}
    turned = under_load(of).shaft(ends, on) if of.spec.wheel.FLAT else None
    if turned is None:
        return out
    moment = np.asarray(turned.moment_Nm) * of.loaded
    rows = {name: value for name, value in turned._asdict().items() if value is not None}
    allowed = of.spec.shaft.shear_stress_max_MPa
    if allowed is not None:
        rows["allowed_MPa"] = np.ravel(allowed)
    if turned.stress_MPa is not None and allowed is not None:
        rows["margin"] = margin(turned.stress_MPa, allowed)
    return out | {name: np.where(np.isfinite(moment), row, moment) for name, row in rows.items()}


def pressure_speed(of: Designs) -> Columns:
    """The greatest contact pressure times sliding speed; it needs a face width."""
    return {} if of.spec.size.face_width_mm is None else {"pv_max_W_m2": under_load(of).pv_W_m2}


def bending(of: Designs) -> Columns:
    """The stresses of pin and horn."""
    parts = {"pin_stress_MPa": pin, "horn_stress_MPa": horn}
    return {name: of.once(part).get("stress_MPa") for name, part in parts.items()}


def wear(of: Designs) -> Columns:
    """The roller as a bearing, the work of friction, and the slot's walls."""
    load, friction = under_load(of), np.ravel(of.load_case.friction)
    passages, lasts = load.passages, roller.lives(of.machine, load.roller_passages)
    force = np.ravel(lasts.equivalent_force_N)
    with np.errstate(invalid="ignore"):  # without friction, of a force without a bound
        work = friction * sum(passage.work for passage in passages) / len(passages)
    under: dict[str, Number | None] = {
        "roller_turns_per_motion": lasts.turns_per_motion,
        "equivalent_force_N": force,
        "friction_work_J": np.where(friction > 0.0, work, np.inf),
        "roller_life_turns": lasts.turns,
        "roller_life_motions": lasts.motions,
        "roller_life_h": lasts.hours,
        # a roller that turns on its pin does not rub in the slot
        "slot_wear_mm_per_million": (
            roller.wears_mm(of.machine, passages) if of.spec.load.rubs_in_slot else None
        ),
    }
    bound = np.where(np.isfinite(force), of.loaded, np.inf * of.loaded)
    out: dict[str, Number | None] = {
        name: np.where(np.isfinite(bound), value, bound)
        for name, value in under.items()
        if value is not None
    }
    return out | {"slot_travel_m": sum(passage.travel_m for passage in passages) / len(passages)}
