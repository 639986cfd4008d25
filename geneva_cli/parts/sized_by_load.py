"""Default sizes under a load: thicknesses, pin, bores and hubs as large as the load needs.

They are computed one after the other: the wheel's thickness from its horns, then the pin, then for
each thickness of the arm the shafts, until the arm holds. Each is the first preferred number that
keeps the allowable stress, from the usual size on, or else the largest that fits, and a check
fails. The first of two wheels in series bears the greatest torque in the second's crank shaft.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TypeVar

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.load_case import centrifugal_N
from geneva_cli.loads.strength import lock
from geneva_cli.loads.strength.arm_and_key import (
    KeyDimensions,
    arm_stress_MPa,
    key_stress,
    shear_allowed_MPa,
)
from geneva_cli.loads.strength.horn import horns
from geneva_cli.loads.strength.horn_search import HornStress, greatest_stress, single_stress
from geneva_cli.loads.strength.part_loads import PartLoads, shear_MPa, single_loads
from geneva_cli.loads.strength.pin import PinSize, pin
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.drive import FirstWheel
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.arrays import Array, value_or
from geneva_cli.numerics.preferred import bores_from, rounded_from
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.assembly import Assembly, links_at
from geneva_cli.parts.sizes import (
    FirstSizes,
    Sizes,
    drawn_thicknesses,
    hole_radius,
    largest_hub,
    reach_and_hub,
    within_hub,
)
from geneva_cli.parts.stressed import ShaftSize, Stressed, Unloaded, stressed
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.tables import Load, Size

T = TypeVar("T")


def first_that(trials: Iterable[T], holds: Callable[[T], bool], usual: T | None = None) -> T:
    """Return the first trial that holds, or the last one; without trials the usual."""
    trial = usual
    for trial in trials:
        if holds(trial):
            break
    assert trial is not None
    return trial


def load_sizes(
    of: Unloaded, loads: PartLoads, bent_MPa: float | None = None, first: FirstSizes | None = None
) -> Sizes:
    """Return the sizes of a machine under its loads, from those without them.

    ``bent_MPa`` is the stress of ``horn_MPa``, if computed already; ``first`` is what the loads
    need of a first wheel. A load without a bound leaves all sizes.
    """
    assembly, usual, space, by = of
    machine, spec = assembly.full, assembly.full.spec
    if not all(map(math.isfinite, loads)):
        return usual
    sizes = usual._replace(link_thickness=first.thickness) if first else usual
    # the force between disc and wheel in the dwell loads both shafts
    torque = lock.dwell_torque_Nm(machine)
    held = float(lock.held_force_N(torque, by).item()) if by and torque.any() else 0.0
    carried = float(np.max(centrifugal_N(machine))) if machine.frame else 0.0
    loads = loads._replace(
        wheel_shaft_N=max(loads.wheel_shaft_N, held + carried), crank_N=max(loads.crank_N, held)
    )
    if by and spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        bent = bent_MPa
        if bent is None:
            bent = float(horn_MPa(machine, sizes.half_width, by)[0])
        # a thicker wheel bends its pins more than its horns
        trials = rounded_from(sizes.wheel_thickness, 2.0 * sizes.wheel_thickness)
        allowed = wheel_material(spec).allowed_MPa
        wheel = first_that(trials, lambda b: keeps(bent / b, "at most", allowed))
        sizes = _thick(assembly, sizes, wheel=wheel)
    eye = math.inf
    if assembly.sign > 0.0 and sizes.arm_bore:  # about the pin, where it passes the largest hub
        hub = max(sizes.wheel_hub, largest_hub(sizes.slot_end))
        eye = assembly.L - sizes.reaches[1] - hub - sizes.wall_min
    wide = sizes.wheel_thickness
    sizes = sizes._replace(pin=pin_that_holds(machine, sizes.pin, wide, sizes.roller, eye, loads))

    def trial(keyed: bool, arm: float | None) -> Sizes:
        thick = _thick(assembly, sizes, arm=arm) if arm else sizes
        bored = _wheel_bored(assembly, thick, loads)
        return _crank_bored(assembly, bored, loads, space, keyed)

    has_arm = sizes.arm_bore > 0.0 and sizes.pin > 0.0
    if not has_arm or spec.size.arm_thickness_mm is not None:
        return trial(True, None)
    return arm_that_holds(spec, wide, trial, lambda one: stressed(assembly, one), loads)


def arm_that_holds(
    spec: Spec,
    wheel: float,
    trial: Callable[[bool, float], T],
    dimensions: Callable[[T], Stressed],
    loads: PartLoads,
) -> T:
    """Return the first trial whose arm and its key hold, from an arm as thick as the wheel on.

    A trial is asked whether the crank's bore is sized by its key, and for the arm's thickness: a
    thicker arm, up to twice the wheel, is better for a key than a thicker shaft.
    """

    def holds(one: T) -> bool:
        parts = dimensions(one)
        stress = float(arm_stress_MPa(parts.arm, loads.wheel_N))
        key = key_holds(spec, parts.crank_key, loads.crank_Nm)
        return key and keeps(stress, "at most", wheel_material(spec).allowed_MPa)

    thick = rounded_from(wheel, 2.0 * wheel)
    keyed = (False, True) if spec.size.crank_keyway else (True,)
    return first_that((trial(key, one) for key in keyed for one in thick), holds)


def _thick(
    assembly: Assembly, sizes: Sizes, wheel: float | None = None, arm: float | None = None
) -> Sizes:
    """Return the sizes with another thickness of the wheel, or of the arm."""
    size = assembly.full.spec.size.replace(
        wheel_thickness_mm=wheel or sizes.wheel_thickness,
        **({"arm_thickness_mm": arm} if arm else {}),
    )
    thick = drawn_thicknesses(size, assembly.L)
    out = sizes._replace(
        wheel_thickness=thick.wheel, lock_thickness=thick.lock, arm_thickness=thick.arm
    )
    # a first wheel's own thickness stays
    return out if assembly.full.first_wheel else out._replace(link_thickness=thick.link)


def horn_MPa(
    machine: Mechanism, half_width: float, by: Lock, known: HornStress | None = None
) -> Array:
    """Return the greatest stress in horns 1 mm thick, (m,), under the roller or the dwell's torque.

    ``known`` is that under the roller, if computed already.
    """
    search = single_stress if isinstance(machine.design, int) else greatest_stress
    own = known or search(horns, machine, (half_width, by.recess))
    held = lock.loaded_locks(machine, half_width, by, 1.0)
    rows = np.broadcast_arrays(own.stress_MPa, *([held.horn_stress_MPa] if held else []))
    return np.fmax(0.0, np.fmax.reduce(rows))


def _wheel_bored(assembly: Assembly, sizes: Sizes, loads: PartLoads) -> Sizes:
    """Return the sizes with a bore of the wheel whose shaft and key hold."""
    spec, end, wall = assembly.full.spec, sizes.slot_end, sizes.wall_min
    fixed = spec.size.wheel_bore_mm is not None or spec.shaft.wheel_diameter_mm is not None
    if fixed or not sizes.wheel_bore:
        return sizes

    def bored(d: float) -> Sizes:
        reach, hub = reach_and_hub(spec.size, "wheel", 0.5 * d, wall, end)
        return sizes._replace(wheel_bore=0.5 * d, wheel_reach=reach, wheel_hub=hub)

    def holds(trial: Sizes) -> bool:
        parts, force, torque = stressed(assembly, trial), loads.wheel_shaft_N, loads.wheel_Nm
        shaft = shaft_holds_both(spec, "wheel", parts.wheel_shaft, force, torque)
        return shaft and key_holds(spec, parts.wheel_key, torque)

    # a third of the wheel up to its slots is left as a wall
    most = min(end * 2.0 / 3.0, end - wall, within_hub(spec.size, "wheel"))
    return first_that(map(bored, bores_from(2.0 * sizes.wheel_bore, 2.0 * most)), holds)


def _crank_bored(
    assembly: Assembly, sizes: Sizes, loads: PartLoads, space: float, keyed: bool
) -> Sizes:
    """Return the sizes with the crank's bore, through the disc if a shaft that holds fits there.

    Otherwise the shaft ends in the arm, whose bore may be larger, unless links are in its way.
    Unless ``keyed``, the bore is not sized by its key.
    """
    spec = assembly.full.spec
    size = spec.size
    if not (size.crank_bore_mm is size.arm_bore_mm is spec.shaft.crank_diameter_mm is None):
        return sizes

    def bored(bore: float) -> Sizes:
        reach, hub = reach_and_hub(size, "crank", bore, sizes.wall_min)
        arm = bore if sizes.arm_bore else 0.0
        return sizes._replace(crank_bore=bore, crank_reach=reach, crank_hub=hub, arm_bore=arm)

    def holds(trial: Sizes) -> bool:
        parts = stressed(assembly, trial)
        shaft = shaft_holds_both(spec, "crank", parts.crank_shaft, loads.crank_N, loads.crank_Nm)
        return shaft and (not keyed or key_holds(spec, parts.crank_key, loads.crank_Nm))

    trial = sizes
    if sizes.crank_bore:
        # a larger bore leaves no space for its default hub, of 1.5 bores
        most = min(0.6 * space, within_hub(size, "crank"))
        for d in bores_from(2.0 * sizes.crank_bore, 2.0 * most):
            trial = bored(0.5 * d)
            if holds(trial):
                return trial
    # past links and gears the shaft may have no other way out
    if not sizes.arm_bore or links_at(assembly.full, np.zeros(1)) or spec.gears:
        return trial
    left = sizes.reaches[0] - hole_radius(size, sizes.pin)
    ending = bores_from(2.0 * sizes.arm_bore, left)  # half of it is left as a wall
    return first_that((bored(0.0)._replace(arm_bore=0.5 * d) for d in ending), holds)


def pin_that_holds(
    mechanism: Mechanism, usual: float, wide: float, roller: float, eye: float, loads: PartLoads
) -> float:
    """Return the radius of the first pin from the usual one on that holds, or the largest.

    It holds the greatest force of the cycle, and the impact at a change of sides. The largest
    leaves a wall of the roller, and fits an arm of the radius ``eye``. The wheel is ``wide`` mm
    thick.
    """
    spec, size = mechanism.spec, mechanism.spec.size
    on_pin = spec.load.friction and spec.load.friction_at == "pin"
    if size.pin_mm is not None or on_pin or not usual:
        return usual
    contact = value_or(size.face_width_mm, wide)
    # the roller keeps three tenths of its radius as a wall about the hole for its pin
    most = min(0.7 * roller - 0.5 * size.allowances.shaft_fit_mm, eye)
    allowed = roller_material(spec).allowed_MPa
    rubbed, jump = math.hypot(1.0, spec.load.friction), np.array([[loads.pin_jump]])

    def holds(d: float) -> bool:
        struck_N = forces_N(mechanism, jump, PinSize(d, contact)).item() if jump else 0.0
        whole_N = max(loads.pin_N, struck_N) * rubbed  # with friction along the wall
        stress = float(pin(size, contact, d).under(whole_N).equivalent)
        return keeps(stress, "at most", allowed)

    return 0.5 * first_that(rounded_from(2.0 * usual, 2.0 * most), holds)


def shaft_holds_both(
    spec: Spec, part: str, shaft: ShaftSize, force_N: float, torque_Nm: float
) -> bool:
    """Return True if the shaft of wheel or crank holds force and torque, greatest at once."""
    factors = spec.shaft
    bending = factors.bending_factor * force_N * shaft.overhang / 1000.0
    moment = math.hypot(bending, factors.torsion_factor * torque_Nm)
    return shaft_holds(spec, part, shaft.diameter, moment)


def shaft_holds(spec: Spec, part: str, diameter: float, moment_Nm: float) -> bool:
    """Return True if the shaft of wheel or crank holds an equivalent torque."""
    keyway = vars(spec.size)[f"{part}_keyway"] is not None
    allowed = float(shear_allowed_MPa(spec.shaft, keyway))
    return keeps(shear_MPa(moment_Nm, diameter), "at most", allowed)


def key_holds(spec: Spec, key: KeyDimensions, torque_Nm: float) -> bool:
    """Return True if a key holds a torque, or where there is none."""
    sides, shear = wheel_material(spec).allowed_MPa, shear_allowed_MPa(spec.shaft)
    torque = spec.shaft.torsion_factor * torque_Nm
    least = float(key_stress(key, torque, sides, shear)[2])
    return math.isnan(least) or keeps(float(key.length), "at least", least)


def first_spec(mechanism: Mechanism, first: FirstWheel) -> Spec:
    """Return the spec of the first wheel and its crank, with the sizes that it shares."""
    spec, size = mechanism.spec, mechanism.spec.size
    shared = ("process", "slot_clearance_mm", "lock_clearance_mm", "press_fit_mm", "shaft_fit_mm")
    own = Size(
        center_distance_mm=first.distance_mm,
        roller_radius_mm=mechanism.roller_radius_mm,
        wheel_thickness_mm=size.link_thickness_mm,
        arm_thickness_mm=size.link_thickness_mm,
        arm_bore_mm=size.link_bore_mm,
        lock_bolts=0,  # the link below its disc has no holes for them
        **{key: vars(size)[key] for key in (*shared, "pin_gap_mm", "pin_mm")},
    )
    torque = single_loads(mechanism).crank_Nm if spec.is_loaded else 0.0
    return Spec(
        External(first.z),
        Crank(n_rpm=spec.drive.n_rpm),
        size=own,
        load=Load(torque_Nm=torque if math.isfinite(torque) else 0.0),
        shaft=spec.shaft.replace(wheel_diameter_mm=None, crank_diameter_mm=None),
        material_wheel=spec.material_wheel,
        material_roller=spec.material_roller,
    )


@lru_cache(maxsize=16)
def first_sizes(
    mechanism: Mechanism, sized: Callable[[Mechanism, PartLoads], tuple[Assembly, Sizes] | None]
) -> FirstSizes | None:
    """Return what the load needs of a first wheel and its crank; None without either."""
    first = mechanism.first_wheel
    spec = None if first is None else first_spec(mechanism, first)
    if spec is None or not spec.is_loaded:
        return None
    try:
        loads = single_loads(build(spec))  # which no bore changes
    except GenevaError:
        return None  # the check of the parts reports the error

    def dimensions(size: Size) -> Stressed | None:
        try:
            flat = sized(build(spec.replace(size=size)), loads)
        except GenevaError:
            return None  # the check of the parts reports the error
        return stressed(*flat) if flat else None

    def holds(parts: Stressed) -> bool:
        shaft = parts.crank_shaft
        fixed = spec.size.arm_bore_mm is not None
        return fixed or shaft_holds_both(spec, "crank", shaft, loads.crank_N, loads.crank_Nm)

    size = spec.size.replace(crank_bore_mm=0.0)
    usual = dimensions(size)
    if usual is None or math.isnan(usual.arm.length):  # a crank without a pin has no arm
        return None
    reach = float(usual.arm.length - usual.arm.hole)
    size = size.replace(wheel_thickness_mm=usual.contact)  # no bore changes it either
    bores = bores_from(usual.crank_shaft.diameter, reach)  # half of it is left as a wall
    each = (dimensions(size.replace(arm_bore_mm=size.arm_bore_mm or d)) for d in bores)
    parts = first_that((one for one in each if one), holds, usual)
    thick = max(parts.contact, float(parts.arm.thickness))
    return FirstSizes(thick, 0.5 * parts.pin, 0.5 * parts.crank_shaft.diameter)
