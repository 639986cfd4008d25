"""Default sizes under a load: thicknesses, pin, bores and hubs as large as the load needs.

The loads follow from the motion, the roller and what the wheel turns, never from these sizes, but
that a stiffer pin is struck harder where the roller changes sides. With friction on the pin all
loads depend on its diameter: then it stays the usual one. The sizes are
computed one after the other. The wheel's thickness follows from its horns, then the pin from that.
For one thickness of the arm after the other there are shafts, until the arm holds.

Each size is the first preferred number that keeps the allowable stress, from the usual size on.
If there is none, it is the largest that fits, and a check fails.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.loads.strength import lock
from geneva_cli.loads.strength.horn import horns
from geneva_cli.loads.strength.horn_search import single_stress
from geneva_cli.loads.strength.part_loads import PartLoads, greatest, single_loads
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.loads.unbalance import centrifugal_N
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import bores_from, rounded_from
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.links.link_positions import links_at
from geneva_cli.parts.sizes.arm_sizes import (
    crank_reach_and_hub,
    hole_radius,
    largest_hub,
    wheel_reach_and_hub,
    within_hub,
)
from geneva_cli.parts.sizes.holds import (
    PinSpace,
    arm_holds,
    arm_trials,
    key_holds,
    pin_that_holds,
    shaft_holds_both,
)
from geneva_cli.parts.sizes.plain_sizes import FirstSizes, Sizes, drawn_thicknesses
from geneva_cli.parts.sizes.stressed import stressed
from geneva_cli.parts.slots.roller_paths import roller_reaches
from geneva_cli.spec.materials import wheel_material


def load_sizes(
    assembly: Assembly,
    usual: Sizes,
    space: float,
    by: Lock | None,
    known: PartLoads | None = None,
    first: FirstSizes | None = None,
) -> Sizes:
    """Return the sizes of a machine under its load, from the usual ones.

    ``space`` is the radius about the crank's axis inside the relief, mm; ``by`` is the lock as it
    is cut, None without one; ``known`` are the loads, if computed already; ``first`` is what they
    need of a first wheel. A load without a bound leaves all sizes.
    """
    loads = known or single_loads(assembly.full)
    if not all(map(math.isfinite, loads)):
        return usual
    size = assembly.full.spec.size
    sizes = usual._replace(link_thickness=first.thickness) if first else usual
    loads = _with_held_force(assembly.full, by, loads)
    if size.wheel_thickness_mm is None and size.face_width_mm is None:
        sizes = _thick(assembly, sizes, wheel=_wheel_thickness(assembly, sizes, by))
    sizes = sizes._replace(pin=_pin(assembly, sizes, loads))
    has_arm = sizes.arm_bore > 0.0 and sizes.pin > 0.0
    if not has_arm or size.arm_thickness_mm is not None:
        return _bored(assembly, sizes, loads, space)
    for keyed, arm in arm_trials(size, sizes.wheel_thickness):
        trial = _bored(assembly, _thick(assembly, sizes, arm=arm), loads, space, keyed)
        if arm_holds(assembly.full.spec, stressed(assembly, trial), loads):
            break
    return trial


def _thick(
    assembly: Assembly, sizes: Sizes, wheel: float | None = None, arm: float | None = None
) -> Sizes:
    """Return the sizes with another thickness of the wheel, or of the arm."""
    size = assembly.full.spec.size.replace(
        wheel_thickness_mm=wheel or sizes.wheel_thickness,
        **({"arm_thickness_mm": arm} if arm else {}),
    )
    thick = drawn_thicknesses(size, assembly.L)
    # a first wheel's own thickness stays
    link = sizes.link_thickness if assembly.full.first_wheel else thick.link
    return sizes._replace(
        wheel_thickness=thick.wheel,
        lock_thickness=thick.lock,
        arm_thickness=thick.arm,
        link_thickness=link,
    )


def _wheel_thickness(assembly: Assembly, sizes: Sizes, by: Lock | None) -> float:
    """Return the wheel's thickness at which its horns hold, at most twice the usual one."""
    usual, machine = sizes.wheel_thickness, assembly.full
    if by is None:
        return usual
    held = lock.loaded_locks(machine, sizes.half_width, by, 1.0)

    def per_mm(way: Mechanism) -> float:
        bent = single_stress(horns, way, (sizes.half_width, sizes.recess)).stress_MPa
        every = (0.0, bent, held.horn_stress_MPa if held else 0.0)
        return float(np.nanmax(np.hstack([*map(np.ravel, every)])))

    most = greatest(per_mm, machine)
    allowed = wheel_material(machine.spec).allowed_MPa
    trials = rounded_from(usual, 2.0 * usual)  # a thicker wheel bends its pins more than its horns
    return next((b for b in trials if keeps(most / b, "at most", allowed)), trials[-1])


def _pin(assembly: Assembly, sizes: Sizes, loads: PartLoads) -> float:
    """Return the radius of a pin that holds; the arm's eye about it passes the largest hub."""
    eye = math.inf
    if assembly.sign > 0.0 and sizes.arm_bore:
        hub = max(sizes.wheel_hub, largest_hub(sizes.slot_end))
        eye = assembly.L - max(roller_reaches(assembly)) - hub - sizes.wall_min
    space = PinSpace(sizes.wheel_thickness, sizes.roller, eye)
    return pin_that_holds(assembly.full, sizes.pin, space, loads)


def _bored(
    assembly: Assembly, sizes: Sizes, loads: PartLoads, space: float, keyed: bool = True
) -> Sizes:
    """Return the sizes with bores of wheel and crank whose shafts and keys hold.

    Unless ``keyed``, the crank's bore is not sized by its key.
    """
    wheel = _wheel_bored(assembly, sizes, loads)
    return _crank_bored(assembly, wheel, loads, space, keyed)


def _wheel_bored(assembly: Assembly, sizes: Sizes, loads: PartLoads) -> Sizes:
    spec, end, wall = assembly.full.spec, sizes.slot_end, sizes.wall_min
    size = spec.size
    fixed = size.wheel_bore_mm is not None or spec.shaft.wheel_diameter_mm is not None
    if fixed or not sizes.wheel_bore:
        return sizes
    # a third of the wheel up to its slots is left as a wall
    most = min(end * 2.0 / 3.0, end - wall, within_hub(size, "wheel"))
    trial = sizes
    for d in bores_from(2.0 * sizes.wheel_bore, 2.0 * most):
        reach, hub = wheel_reach_and_hub(size, 0.5 * d, wall, end)
        trial = sizes._replace(wheel_bore=0.5 * d, wheel_reach=reach, wheel_hub=hub)
        parts = stressed(assembly, trial)
        shaft = shaft_holds_both(
            spec, "wheel", parts.wheel_shaft, loads.wheel_shaft_N, loads.wheel_Nm
        )
        if shaft and key_holds(spec, parts.wheel_key, loads.wheel_Nm):
            break
    return trial


def _with_held_force(machine: Mechanism, by: Lock | None, loads: PartLoads) -> PartLoads:
    """Return the loads with the force between disc and wheel in the dwell on both shafts."""
    torque = lock.dwell_torque_Nm(machine)
    held = float(lock.held_force_N(torque, by).item()) if by and torque.any() else 0.0
    carried = float(np.max(centrifugal_N(machine))) if machine.frame else 0.0
    return loads._replace(
        wheel_shaft_N=max(loads.wheel_shaft_N, held + carried), crank_N=max(loads.crank_N, held)
    )


def _crank_bored(
    assembly: Assembly, sizes: Sizes, loads: PartLoads, space: float, keyed: bool
) -> Sizes:
    """Return the sizes with the crank's bore, through the disc if a shaft that holds fits there.

    Otherwise the shaft ends in the arm, whose bore may be larger, unless links are in its way.
    """
    spec = assembly.full.spec
    size = spec.size
    own = (size.crank_bore_mm, size.arm_bore_mm, spec.shaft.crank_diameter_mm)
    if any(key is not None for key in own):
        return sizes
    trial = sizes
    if sizes.crank_bore:
        # a larger bore leaves no space for its default hub, of 1.5 bores
        most = min(0.6 * space, within_hub(size, "crank"))
        for d in bores_from(2.0 * sizes.crank_bore, 2.0 * most):
            trial = _with_crank_bore(assembly, sizes, 0.5 * d)
            if _crank_holds(assembly, trial, loads, keyed):
                return trial
    # past links and gears the shaft may have no other way out
    if not sizes.arm_bore or links_at(assembly.full, np.zeros(1)) or spec.gears:
        return trial
    space = min(roller_reaches(assembly)) - hole_radius(size, sizes.pin)
    for d in bores_from(2.0 * sizes.arm_bore, space):  # half of it is left as a wall
        other = _with_crank_bore(assembly, sizes, 0.0)._replace(arm_bore=0.5 * d)
        if _crank_holds(assembly, other, loads, keyed):
            break
    return other


def _with_crank_bore(assembly: Assembly, sizes: Sizes, bore: float) -> Sizes:
    size = assembly.full.spec.size
    reach, hub = crank_reach_and_hub(size, bore, sizes.wall_min)
    arm = bore if sizes.arm_bore else 0.0
    return sizes._replace(crank_bore=bore, crank_reach=reach, crank_hub=hub, arm_bore=arm)


def _crank_holds(assembly: Assembly, sizes: Sizes, loads: PartLoads, keyed: bool) -> bool:
    parts, spec = stressed(assembly, sizes), assembly.full.spec
    shaft = shaft_holds_both(spec, "crank", parts.crank_shaft, loads.crank_N, loads.crank_Nm)
    return shaft and (not keyed or key_holds(spec, parts.crank_key, loads.crank_Nm))
