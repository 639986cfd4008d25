"""Strength and life of designs: pin, horn, lock, shafts, arm, keys, and the roller's life."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from geneva_cli.loads.impacts.reversal import reversal_impacts
from geneva_cli.loads.impacts.shock_force import least_pin_mm
from geneva_cli.loads.load_case import centrifugal_N, load_case
from geneva_cli.loads.strength import pin_arm_key
from geneva_cli.loads.strength.lock import dwell_torque_Nm, held_force_N
from geneva_cli.loads.strength.part_loads import shaft_squares, shear_MPa
from geneva_cli.loads.strength.pin_arm_key import key_stress, shear_allowed_MPa
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Array, Number, array
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.tables import Material
from geneva_cli.spec.workshops import Stock
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs
from geneva_cli.verdict.quantities.under_load import UnderLoad, as_numbers


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
    load, allowed = of.once(UnderLoad), _allowed(of, of.spec.material_roller, roller_material)
    width, out = load.contact_mm, {"allowed_MPa": allowed}
    if width is None:
        return out
    size, d = of.spec.size, load.pin_mm
    own = pin_arm_key.PinSize(d, width)
    bending, shear, equivalent = pin_arm_key.pin_stress_MPa(size, width, d, load.pin_N(own))
    stress = np.ravel(equivalent)
    out |= {
        "diameter_mm": d,
        "bending_MPa": bending,
        "shear_MPa": shear,
        "stress_MPa": stress,
        "margin": margin(stress, allowed),
    }
    if allowed is not None:
        roller_N = load.force_N[:, None] * load.rubbed
        bending, shear, _ = pin_arm_key.pin_stress_MPa(size, width, d, roller_N)
        least = np.ravel(pin_arm_key.least_diameter_mm(bending, shear, d, allowed))
        jump = reversal_impacts(of.machine).jump
        if not np.isnan(jump).all():
            rubbed = pin_arm_key.pin_stress_MPa(size, width, d, load.rubbed)[:2]
            struck = least_pin_mm(of.machine, jump[:, None], own, rubbed, allowed)
            least = np.maximum(least, np.nan_to_num(struck))
        out["least_diameter_mm"] = np.where(np.isfinite(np.ravel(allowed)), least, np.inf)
    return out


def _allowed(of: Designs, own: Material, material: Callable[[Spec], Stock]) -> Number | None:
    """The allowable stress of a part's material; without a load only that of the spec."""
    return material(of.spec).allowed_MPa if of.spec.is_loaded else own.stress_max_MPa


def horn(of: Designs) -> Columns:
    """The horn at the place where the roller bends it most; it needs a width of the contact."""
    allowed, load = _allowed(of, of.spec.material_wheel, wheel_material), of.once(UnderLoad)
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    width = load.contact_mm
    if width is None or not load.has_horns:
        return out
    force = load.force_N
    for name, row in load.horn_stress(width)._asdict().items():
        column = np.where(np.isfinite(force), _known(row), force)
        out[name] = column
        if name == "stress_MPa":
            out["margin"] = margin(column, allowed)
    return out


def lock(of: Designs) -> Columns:
    """The lock under the torque in the dwell; ``greatest_MPa``: between disc and recess."""
    state, allowed = of.once(UnderLoad).lock, of.spec.limits.lock_stress_max_MPa
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    if state is None:
        return out
    for name, row in state._asdict().items():
        if name != "on":
            out[name] = _known(row)
    most = np.fmax(state.contact_stress_MPa, state.pressure_MPa)
    out["greatest_MPa"] = most = _known(np.where(np.isnan(state.approach_deg), np.inf, most))
    out["margin"] = margin(most, allowed)
    return out


def _known(row: Number | None) -> Array:
    """The row, infinite for designs without a value."""
    values = np.asarray(row)
    return np.where(np.isnan(values), np.inf, values)


def _shaft(of: Designs, part: str) -> Columns:
    """The shaft of wheel or crank."""
    return of.once(shafts)[part]


wheel_shaft, crank_shaft = partial(_shaft, part="wheel"), partial(_shaft, part="crank")


def shafts(of: Designs) -> dict[str, Columns]:
    """The columns of the shafts of wheel and crank, which are searched together."""
    overhangs, each = dict[str, float | None](), dict[str, Columns]()
    for part in ("wheel", "crank"):
        # of the spec, or else as the parts have them
        table = vars(of.spec.shaft)
        overhang, diameter = table[f"{part}_overhang_mm"], table[f"{part}_diameter_mm"]
        parts = of.once(UnderLoad).parts if diameter is None or overhang is None else None
        if parts is not None:
            own = getattr(parts, f"{part}_shaft")
            if diameter is None and not np.isnan(own.diameter).all():
                diameter = as_numbers(np.asarray(own.diameter))
            if overhang is None and not np.isnan(own.overhang).all():
                # a design without parts has no diameter either, and so no stress
                overhang = as_numbers(np.nan_to_num(own.overhang))
        overhangs[part], each[part] = overhang, {"diameter_mm": diameter}
    held = dict[str, tuple[Array, Array]]()
    if of.spec.load.dwell_torque_Nm is not None:
        # without a disc something else holds it, by a couple
        torque_Nm, sizes = dwell_torque_Nm(of.machine), of.once(UnderLoad).lock_sizes
        force = held_force_N(of.machine, sizes and sizes[1])
        carried = np.ravel(centrifugal_N(of.machine)) if of.machine.frame else 0.0
        # the force passes through the crank's axis
        held = {"wheel": (force + carried, torque_Nm), "crank": (force, 0.0 * force)}
    for part, peak in shaft_squares(of.machine, overhangs, held).items():
        most, diameter = np.sqrt(peak.max) * of.loaded, each[part]["diameter_mm"]
        keyway = vars(of.spec.size)[f"{part}_keyway"] is not None
        allowed = np.ravel(shear_allowed_MPa(of.spec.shaft, keyway))
        least = np.cbrt(16e3 * most / (math.pi * allowed))
        rows: dict[str, Number | None] = {
            "moment_Nm": most,
            "at_deg": peak.at_deg,
            "allowed_MPa": allowed,
            "least_diameter_mm": np.where(np.isfinite(allowed), least, np.inf),
        }
        if diameter is not None:
            rows["stress_MPa"] = stress = shear_MPa(most, np.ravel(diameter))
            rows["margin"] = margin(stress, allowed)
        for name, row in rows.items():
            rows[name] = None if row is None else np.where(np.isfinite(most), row, most)
        each[part] = {**each[part], **rows}
    return each


def arm(of: Designs) -> Columns:
    """The crank arm under the greatest force of the wheel on the roller."""
    parts, allowed = of.once(UnderLoad).parts, _allowed(of, of.spec.material_wheel, wheel_material)
    out: dict[str, Number | None] = {"allowed_MPa": allowed}
    if parts is None or np.isnan(parts.arm.length).all():
        return out
    force = of.once(UnderLoad).part_loads.wheel_N * of.loaded
    stress = _known(pin_arm_key.arm_stress_MPa(parts.arm, force))
    return out | {
        "thickness_mm": _known(parts.arm.thickness),
        "stress_MPa": stress,
        "margin": margin(stress, allowed),
    }


def arm_thickness(of: Designs) -> Columns:
    """The thickness at which the crank arm just holds."""
    parts, steel = of.once(UnderLoad).parts, array(wheel_material(of.spec).allowed_MPa)
    if parts is None or np.isnan(parts.arm.length).all():
        return {}
    force = of.once(UnderLoad).part_loads.wheel_N * of.loaded
    least = pin_arm_key.least_thickness_mm(parts.arm, force, steel.ravel())
    return {"least_thickness_mm": _known(np.where(np.isfinite(force), least, force))}


def _key(of: Designs, part: str) -> Columns:
    """The key of wheel or arm under a shaft's torque; the pressure allowed keeps the shear, too."""
    parts = of.once(UnderLoad).parts
    if parts is None:
        return {}
    key = getattr(parts, f"{part}_key")
    if np.isnan(key.shaft).all():
        return {}
    most = getattr(of.once(UnderLoad).part_loads, f"{part}_Nm") * of.loaded
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


wheel_key, crank_key = partial(_key, part="wheel"), partial(_key, part="crank")


def pressure_speed(of: Designs) -> Columns:
    """The greatest contact pressure times sliding speed; it needs a face width."""
    return {} if of.spec.size.face_width_mm is None else {"pv_max_W_m2": of.once(UnderLoad).pv_W_m2}


def bending(of: Designs) -> Columns:
    """The stresses of pin and horn."""
    parts = {"pin_stress_MPa": pin, "horn_stress_MPa": horn}
    return {name: of.once(part).get("stress_MPa") for name, part in parts.items()}


def wear(of: Designs) -> Columns:
    """The roller as a bearing, and the work of friction."""
    from geneva_cli.loads.strength import roller

    friction = np.ravel(load_case(of.machine).friction)
    passages = roller.passages(of.machine)
    paired = any(one.paired for one in of.machine.engagements)
    # an engagement has two of its own if one roller starts and one stops it
    by_roller = roller.passages(of.machine, by_roller=True) if paired else passages
    lasts = roller.lives(of.machine, by_roller)
    force = lasts["equivalent_force_N"]
    with np.errstate(invalid="ignore"):  # without friction, of a force without a bound
        work = friction * sum(passage.work for passage in passages) / len(passages)
    under = lasts | {"friction_work_J": np.where(friction > 0.0, work, np.inf)}
    bound = np.where(np.isfinite(force), of.loaded, np.inf * of.loaded)
    out = {name: np.where(np.isfinite(bound), value, bound) for name, value in under.items()}
    return out | {"slot_travel_m": sum(passage.travel_m for passage in passages) / len(passages)}
