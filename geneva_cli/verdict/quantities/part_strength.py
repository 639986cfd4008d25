"""Strength and life of designs: pin, horn, lock, shafts, arm, keys, and the roller's life."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import numpy as np

from geneva_cli.loads.load_case import centrifugal_N, load_case
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.loads.strength import pin_arm_key
from geneva_cli.loads.strength.lock import dwell_torque_Nm, held_force_N, loaded_locks
from geneva_cli.loads.strength.part_loads import shaft_squares, shear_MPa
from geneva_cli.loads.strength.pin_arm_key import key_stress, shear_allowed_MPa
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Array, Number, Truth, array, mapped
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.tables import Material
from geneva_cli.spec.workshops import Stock
from geneva_cli.verdict.quantities.groups import Columns, Designs
from geneva_cli.verdict.quantities.under_load import UnderLoad, as_numbers


def judged(stress: Number, allowed: Number | None) -> dict[str, Number | None]:
    """The allowable stress of a part, and the relative margin: 0 if the stress equals it.

    There is no margin without an allowable stress, or for a stress that is 0 or unbounded.

    >>> judged(np.array([80.0, 0.0]), 120.0)["margin"]
    array([0.5, nan])
    """
    stress, margin = np.ravel(stress), None
    if allowed is not None:
        known = (stress > 0.0) & np.isfinite(stress)
        margin = np.ravel(allowed) / np.where(known, stress, np.nan) - 1.0
    return {"allowed_MPa": allowed, "margin": margin}


def _allowed(of: Designs, own: Material, material: Callable[[Spec], Stock]) -> Number | None:
    """The allowable stress of a part's material; without a load only that of the spec."""
    return material(of.spec).allowed_MPa if of.spec.is_loaded else own.stress_max_MPa


def pin(of: Designs) -> Columns:
    """The roller's pin under the greatest force or impact; it needs a width of the contact."""
    load, allowed = of.once(UnderLoad), _allowed(of, of.spec.material_roller, roller_material)
    if load.pin is None:
        return {"allowed_MPa": allowed}
    bending, shear, stress = load.pin_stresses(load.pin)
    rows = {"diameter_mm": load.pin.diameter_mm, "bending_MPa": bending, "shear_MPa": shear}
    return rows | {"stress_MPa": stress} | judged(stress, allowed)


def pin_diameter(of: Designs) -> Columns:
    """The diameter at which the roller's pin just holds; a thicker one is struck harder."""
    load, allowed = of.once(UnderLoad), _allowed(of, of.spec.material_roller, roller_material)
    if (usual := load.pin) is None or allowed is None:
        return {}

    def holds(d: Array) -> Truth:
        return np.asarray(load.pin_stresses(usual._replace(diameter_mm=d))[2] <= allowed)

    return {"least_diameter_mm": pin_arm_key.least_size_mm(holds, usual.diameter_mm).ravel()}


def horn(of: Designs) -> Columns:
    """The horn at the place where the roller bends it most; it needs a width of the contact."""
    allowed, load = _allowed(of, of.spec.material_wheel, wheel_material), of.once(UnderLoad)
    if load.contact_mm is None or not load.has_horns:
        return {"allowed_MPa": allowed}
    known = np.where(np.isfinite(load.force_N), 1.0, np.nan)
    bent = mapped(known.__mul__, load.horn_stress(load.contact_mm))
    return bent._asdict() | judged(bent.stress_MPa, allowed)


def lock(of: Designs) -> Columns:
    """The lock under the torque in the dwell; ``margin`` is that of the greater contact stress."""
    load, allowed = of.once(UnderLoad), of.spec.limits.lock_stress_max_MPa
    sizes, width = load.lock_sizes, load.contact_mm
    state = loaded_locks(of.machine, *sizes, width) if sizes and width is not None else None
    if state is None:
        return {"allowed_MPa": allowed}
    most = np.fmax(state["contact_stress_MPa"], state["pressure_MPa"])
    most = most * np.where(np.isfinite(state["approach_deg"]), 1.0, np.nan)
    return state | judged(most, allowed)


def shafts(of: Designs) -> Columns:
    """The shafts of wheel and crank, which are searched together."""
    spec, load = of.spec, of.once(UnderLoad)
    sizes: dict[str, dict[str, float | None]] = {"overhang": {}, "diameter": {}}
    for name, part in product(sizes, ("wheel", "crank")):
        # of the spec, or else as the parts have them
        size = vars(spec.shaft)[f"{part}_{name}_mm"]
        if size is None and load.parts is not None:
            own = np.asarray(getattr(getattr(load.parts, f"{part}_shaft"), name))
            # a design without parts has no diameter either, and so no stress
            drawn = np.nan_to_num(own) if name == "overhang" else own
            size = None if np.isnan(own).all() else as_numbers(drawn)
        sizes[name][part] = size
    held = dict[str, tuple[Array, Array]]()
    if spec.load.dwell_torque_Nm is not None:
        # without a disc something else holds it, by a couple
        torque_Nm, lock_sizes = dwell_torque_Nm(of.machine), load.lock_sizes
        force = held_force_N(of.machine, lock_sizes and lock_sizes[1])
        carried = np.ravel(centrifugal_N(of.machine)) if of.machine.frame else 0.0
        # the force passes through the crank's axis
        held = {"wheel": (force + carried, torque_Nm), "crank": (force, 0.0 * force)}
    squares = shaft_squares(of.machine, sizes["overhang"], held)
    out: dict[str, Number | None] = {}
    for part, diameter in sizes["diameter"].items():
        rows: dict[str, Number | None] = {"diameter_mm": diameter}
        if peak := squares.get(part):
            most = np.sqrt(peak.max) * of.loaded
            known = np.where(np.isfinite(most), 1.0, np.nan)
            keyway = vars(spec.size)[f"{part}_keyway"] is not None
            allowed = np.ravel(shear_allowed_MPa(spec.shaft, keyway)) * known
            stress = shear_MPa(most, np.ravel(np.nan if diameter is None else diameter))
            least = np.cbrt(16e3 * most / (math.pi * allowed))
            rows |= {"moment_Nm": most, "at_deg": peak.at_deg * known, "stress_MPa": stress}
            rows |= {"least_diameter_mm": least, **judged(stress, allowed)}
        for name, row in rows.items():
            out[f"{part}_shaft.{name}"] = row
    return out


def arm(of: Designs) -> Columns:
    """The crank arm under the greatest force of the wheel on the roller."""
    load, allowed = of.once(UnderLoad), _allowed(of, of.spec.material_wheel, wheel_material)
    if load.parts is None:
        return {"allowed_MPa": allowed}
    stress = pin_arm_key.arm_stress_MPa(load.parts.arm, load.part_loads.wheel_N * of.loaded)
    thickness = load.parts.arm.thickness
    return {"thickness_mm": thickness, "stress_MPa": stress, **judged(stress, allowed)}


def arm_thickness(of: Designs) -> Columns:
    """The thickness at which the crank arm just holds."""
    load, steel = of.once(UnderLoad), array(wheel_material(of.spec).allowed_MPa).ravel()
    if load.parts is None:
        return {}
    own, force = load.parts.arm, load.part_loads.wheel_N * of.loaded

    def holds(h: Array) -> Truth:
        thick = pin_arm_key.thick(own, h)
        return np.asarray(pin_arm_key.arm_stress_MPa(thick, force) <= steel)

    return {"least_thickness_mm": pin_arm_key.least_size_mm(holds, own.thickness)}


def keys(of: Designs) -> Columns:
    """The keys of wheel and arm under a shaft's torque; the allowable pressure keeps the shear."""
    load, shaft = of.once(UnderLoad), of.spec.shaft
    out: dict[str, Number | None] = {}
    sides = np.ravel(wheel_material(of.spec).allowed_MPa)
    shear = np.ravel(shear_allowed_MPa(shaft))
    for part in ("wheel", "crank") if load.parts else ():
        key = getattr(load.parts, f"{part}_key")
        most = getattr(load.part_loads, f"{part}_Nm") * of.loaded * np.ravel(shaft.torsion_factor)
        pressure, sheared, least = key_stress(key, most, sides, shear)
        rows = judged(pressure, np.minimum(sides, shear * key.width / key.bearing))
        rows |= {"length_mm": key.length, "pressure_MPa": pressure, "shear_MPa": sheared}
        for name, row in rows.items():
            out[f"{part}_key.{name}"] = row
        out[f"{part}_key.least_length_mm"] = least
    return out


def pressure_speed(of: Designs) -> Columns:
    """The greatest contact pressure times sliding speed; it needs a face width."""
    if of.spec.size.face_width_mm is None or np.isnan(of.loaded).all():
        return {}
    return {"pv_max_W_m2": load_peaks(of.machine, ["pv_W_m2"])["pv_W_m2"].max * of.loaded}


def bending(of: Designs) -> Columns:
    """The stresses of pin and horn."""
    return {f"{one.__name__}_stress_MPa": of.once(one).get("stress_MPa") for one in (pin, horn)}


def wear(of: Designs) -> Columns:
    """The roller as a bearing, and the work of friction."""
    return of.once(_wear)


def _wear(of: Designs) -> Columns:
    from geneva_cli.loads.strength import roller

    friction = np.ravel(load_case(of.machine).friction)
    passages = roller.passages(of.machine)
    paired = any(one.paired for one in of.machine.engagements)
    # an engagement has two of its own if one roller starts and one stops it
    by_roller = roller.passages(of.machine, by_roller=True) if paired else passages
    lasts = roller.lives(of.machine, by_roller)
    with np.errstate(invalid="ignore"):  # without friction, of a force without a bound
        work = friction * sum(passage.work for passage in passages) / len(passages)
    lasts["friction_work_J"] = work * np.where(friction > 0.0, 1.0, np.nan)
    bound = of.loaded * np.where(np.isfinite(lasts["equivalent_force_N"]), 1.0, np.nan)
    out = {name: value * bound for name, value in lasts.items()}
    return out | {"slot_travel_m": sum(passage.travel_m for passage in passages) / len(passages)}
