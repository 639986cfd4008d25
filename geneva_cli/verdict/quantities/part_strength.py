"""Strength and life of designs: pin, horn, lock, shafts, arm, keys, and the roller's life."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geneva_cli.loads.impacts.shock_force import least_pin_mm
from geneva_cli.loads.load_case import centrifugal_N
from geneva_cli.loads.strength import arm_and_key as arms
from geneva_cli.loads.strength import pin as pins
from geneva_cli.loads.strength import roller
from geneva_cli.loads.strength.arm_and_key import KeyDimensions, key_stress, shear_allowed_MPa
from geneva_cli.loads.strength.part_loads import (
    LoadedShaft,
    ShaftForces,
    crank_forces,
    shafts_under_load,
    wheel_forces,
)
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Array, Number, array, parameter
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.tables import Material
from geneva_cli.spec.workshops import Stock
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs
from geneva_cli.verdict.quantities.under_load import as_numbers, under_load


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
    """The roller's pin under the greatest force or impact; it needs a width of the contact."""
    load, allowed = under_load(of), _allowed(of, of.spec.material_roller, roller_material)
    width, out = load.contact_mm, {"allowed_MPa": allowed}
    if width is None:
        return out
    section = pins.pin(of.spec.size, width, load.pin_mm)
    under = section.under(load.pin_N(pins.PinSize(load.pin_mm, width)))
    stress = np.ravel(under.equivalent)
    out |= {
        "diameter_mm": section.diameter_mm,
        "bending_MPa": under.bending,
        "shear_MPa": under.shear,
        "stress_MPa": stress,
        "margin": margin(stress, allowed),
    }
    if allowed is not None:
        least = np.ravel(pins.least_diameter_mm(section, load.roller_N, allowed))
        jump = load.reversals.jump[:, None]
        rubbed = section.under(load.rubbed)
        struck = least_pin_mm(of.machine, jump, width, rubbed, allowed)
        least = np.maximum(least, np.nan_to_num(struck))
        out["least_diameter_mm"] = np.where(np.isfinite(np.ravel(allowed)), least, np.inf)
    return out


def _allowed(of: Designs, own: Material, material: Callable[[Spec], Stock]) -> Number | None:
    """The allowable stress of a part's material; without a load only that of the spec."""
    return material(of.spec).allowed_MPa if of.spec.is_loaded else own.stress_max_MPa


def horn(of: Designs) -> Columns:
    """The horn at the place where the roller bends it most; it needs a width of the contact."""
    allowed, load = _allowed(of, of.spec.material_wheel, wheel_material), under_load(of)
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    width = load.contact_mm
    if width is None or not load.has_horns:
        return out
    force = load.force_N
    if not np.isfinite(force).any():
        return out | dict.fromkeys(("stress_MPa", "at_deg", "inwards_mm", "thickness_mm"), force)
    rows = {name: _known(row) for name, row in load.horn_stress(width)._asdict().items()}
    stress = np.where(np.isfinite(force), rows["stress_MPa"], force)
    out["margin"] = margin(stress, allowed)
    return out | {name: np.where(np.isfinite(force), row, force) for name, row in rows.items()}


def lock(of: Designs) -> Columns:
    """The lock under the torque in the dwell; it needs a width of the contact.

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
    """The wheel's shaft."""
    return of.once(_shafts)[0]


def crank_shaft(of: Designs) -> Columns:
    """The crank's shaft."""
    return of.once(_shafts)[1]


def _shafts(of: Designs) -> list[Columns]:
    """The columns of the shafts of wheel and crank, which are searched together."""
    wheel = _drawn(of, "wheel", wheel_forces(of.machine))
    crank = _drawn(of, "crank", crank_forces(of.spec))
    if held := under_load(of).held:
        carried = np.ravel(centrifugal_N(of.machine)) if of.machine.frame else 0.0
        wheel = wheel._replace(held_N=held[0] + carried, held_Nm=held[1])
        crank = crank._replace(held_N=held[0])  # the force passes through the crank's axis
    each = shafts_under_load(of.machine, (wheel, crank))
    return [_shaft(of, one, rows) for one, rows in zip((wheel, crank), each, strict=True)]


def _drawn(of: Designs, part: str, forces: ShaftForces) -> LoadedShaft:
    """The shaft of wheel or crank, with the dimensions of its parts where the spec has none."""
    table = vars(of.spec.shaft)
    overhang, diameter, span = (
        table[f"{part}_{name}_mm"] for name in ("overhang", "diameter", "span")
    )
    own = LoadedShaft(forces, overhang, diameter, span, table["shear_stress_max_MPa"])
    if not of.spec.is_loaded:
        return own
    keyway = vars(of.spec.size)[f"{part}_keyway"] is not None
    own = own._replace(allowed_MPa=parameter(shear_allowed_MPa(of.spec.shaft, keyway)))
    complete = own.diameter_mm is not None and own.overhang_mm is not None
    parts = None if complete else under_load(of).parts
    if parts is None:
        return own
    diameter, overhang = parts.wheel_shaft if part == "wheel" else parts.crank_shaft
    if own.diameter_mm is None and not np.isnan(diameter).all():
        own = own._replace(diameter_mm=as_numbers(np.asarray(diameter)))
    if own.overhang_mm is None and not np.isnan(overhang).all():
        # a design without parts has no diameter either, and so no stress
        own = own._replace(overhang_mm=as_numbers(np.nan_to_num(overhang)))
    return own


def _shaft(of: Designs, shaft: LoadedShaft, rows: dict[str, Array]) -> Columns:
    """The columns of a shaft under its load."""
    out: dict[str, Number | None] = {"diameter_mm": shaft.diameter_mm}
    if not rows:
        return out
    moment = rows["moment_Nm"] * of.loaded
    if shaft.allowed_MPa is not None:
        allowed = np.ravel(shaft.allowed_MPa)
        rows |= {
            "allowed_MPa": allowed,
            "least_diameter_mm": np.where(np.isfinite(allowed), rows["least_diameter_mm"], np.inf),
        }
        if "stress_MPa" in rows and (relative := margin(rows["stress_MPa"], allowed)) is not None:
            rows["margin"] = relative
    return out | {name: np.where(np.isfinite(moment), row, moment) for name, row in rows.items()}


def arm(of: Designs) -> Columns:
    """The crank arm under the greatest force of the wheel on the roller."""
    parts, allowed = under_load(of).parts, _allowed(of, of.spec.material_wheel, wheel_material)
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    if parts is None or np.isnan(parts.arm.length).all():
        return out
    force = under_load(of).part_loads.wheel_N * of.loaded
    stress = _known(arms.arm_stress_MPa(parts.arm, force))
    return out | {
        "thickness_mm": _known(parts.arm.thickness),
        "stress_MPa": stress,
        "margin": margin(stress, allowed),
    }


def arm_thickness(of: Designs) -> Columns:
    """The thickness at which the crank arm just holds."""
    parts, steel = under_load(of).parts, array(wheel_material(of.spec).allowed_MPa)
    if parts is None or np.isnan(parts.arm.length).all():
        return {}
    force = under_load(of).part_loads.wheel_N * of.loaded
    least = arms.least_thickness_mm(parts.arm, force, steel.ravel())
    return {"least_thickness_mm": _known(np.where(np.isfinite(force), least, force))}


def wheel_key(of: Designs) -> Columns:
    """The key in the wheel's bore."""
    parts = under_load(of).parts
    return _key(of, parts and parts.wheel_key, "wheel_Nm")


def crank_key(of: Designs) -> Columns:
    """The key in the arm's bore."""
    parts = under_load(of).parts
    return _key(of, parts and parts.crank_key, "crank_Nm")


def _key(of: Designs, key: KeyDimensions | None, torque: str) -> Columns:
    """A key under a shaft's greatest torque; the pressure allowed keeps the shear, too."""
    if key is None or np.isnan(key.shaft).all():
        return {}
    most = getattr(under_load(of).part_loads, torque) * of.loaded
    most = most * np.ravel(of.spec.shaft.torsion_factor)
    sides = np.ravel(wheel_material(of.spec).allowed_MPa)
    shear = np.ravel(shear_allowed_MPa(of.spec.shaft))
    pressed, sheared, least = key_stress(key, most, sides, shear)
    allowed = np.minimum(sides, shear * key.width / key.bearing)
    pressure = _known(pressed)
    return {
        "length_mm": _known(key.length),
        "pressure_MPa": pressure,
        "shear_MPa": _known(sheared),
        "allowed_MPa": _known(allowed),
        "margin": margin(pressure, _known(allowed)),
        "least_length_mm": _known(least),
    }


def pressure_speed(of: Designs) -> Columns:
    """The greatest contact pressure times sliding speed; it needs a face width."""
    return {} if of.spec.size.face_width_mm is None else {"pv_max_W_m2": under_load(of).pv_W_m2}


def bending(of: Designs) -> Columns:
    """The stresses of pin and horn."""
    parts = {"pin_stress_MPa": pin, "horn_stress_MPa": horn}
    return {name: of.once(part).get("stress_MPa") for name, part in parts.items()}


def wear(of: Designs) -> Columns:
    """The roller as a bearing, and the work of friction."""
    friction = np.ravel(of.load_case.friction)
    passages = roller.passages(of.machine)
    paired = any(one.paired for one in of.machine.engagements)
    # an engagement has two of its own if one roller starts and one stops it
    by_roller = roller.passages(of.machine, by_roller=True) if paired else passages
    lasts = roller.lives(of.machine, by_roller)
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
    }
    bound = np.where(np.isfinite(force), of.loaded, np.inf * of.loaded)
    out: dict[str, Number | None] = {
        name: np.where(np.isfinite(bound), value, bound)
        for name, value in under.items()
        if value is not None
    }
    return out | {"slot_travel_m": sum(passage.travel_m for passage in passages) / len(passages)}
