"""Default sizes under a load: thicknesses, pin, bores and hubs as large as the load needs.

``stressed`` has the dimensions of parts that their strength depends on. Default sizes are computed
one after the other: the wheel's thickness from its horns, then the pin, then for each thickness of
the arm the shafts, until the arm holds. Each is the first preferred number that keeps the allowable
stress, from the usual size on, or else the largest that fits, and a check fails. The first of two
wheels in series bears the greatest torque in the second's crank shaft.
"""

from __future__ import annotations

import math
from contextlib import suppress
from functools import lru_cache
from itertools import product, repeat
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.load_case import centrifugal_N
from geneva_cli.loads.strength import lock, pin_arm_key
from geneva_cli.loads.strength.part_loads import PartLoads, shear_MPa
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import half_or, value_or
from geneva_cli.numerics.tolerances import keeps, sizes_from
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.assembly import Assembly, gear_plane, is_bridged, links_at
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import wheel_hub_length
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import Sizes, Unloaded
from geneva_cli.spec.defaults import eye_about, key, roller_material, wheel_material


class ShaftSize(NamedTuple):
    """Diameter of a shaft, and overhang from its bearing to the wheel's mid-plane; or NaN."""

    diameter: float
    overhang: float


class Stressed(NamedTuple):
    """Dimensions of stressed parts, mm; NaN where a part does not exist."""

    contact: float  # length of the contact line, by default the wheel's thickness
    pin: float  # diameter; 0 for a roller that is its own pin
    wheel_shaft: ShaftSize
    crank_shaft: ShaftSize
    arm: pin_arm_key.ArmDimensions
    wheel_key: pin_arm_key.KeyDimensions
    crank_key: pin_arm_key.KeyDimensions


@lru_cache(maxsize=64)  # the designs of a sweep of loads have few different sizes
def stressed(assembly: Assembly, sizes: Sizes) -> Stressed:
    """Return the dimensions of a machine's parts, for parts of these sizes."""
    spec, machine, size = assembly.full.spec, assembly.full, assembly.full.spec.size
    thick, wide, gap = sizes.arm_thickness, sizes.wheel_thickness, size.allowances.pin_gap_mm
    contact, hub_mm = value_or(size.face_width_mm, wide), 0.0
    if size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore:
        hub_mm = wheel_hub_length(size, sizes)
    # the lowest face of what is below the wheel; a groove's plate has its base below the groove
    lowest, planes = min(-hub_mm, -gap - (thick if sizes.arm_bore else 0.0)), []
    for link in links_at(machine, np.zeros(1)):
        planes.append((link.plane, 0.0))
    planes += [(gear_plane(machine), 0.0)] if spec.gears else []
    if machine.engagements[0].groove is not None:
        planes.append((3, 0.0) if spec.drive_before else (2, thick))
    first = thick if spec.drive.ONE_ARM else sizes.link_thickness
    for plane, base in planes:
        low, _ = rules.plane_span(plane, gap, first, sizes.link_thickness, size.washer_mm)
        lowest = min(lowest, low - base)
    # from the middle of the wheel's thickness to the frame's upper face
    on_wheel = on_crank = 0.5 * wide - lowest + size.washer_mm, thick
    if sizes.crank_bore and is_bridged(machine):
        on_crank = rules.bridge_low(size, sizes) - 0.5 * wide, thick
    arm = pin_arm_key.NO_ARM
    if sizes.arm_bore and sizes.pin:
        _, long = sizes.reaches
        hole = rules.hole_radius(size, sizes.pin)
        bored = reach_or_bore(size, "crank", sizes.arm_bore)
        standing = 0.0 if is_whole(assembly, sizes) else sizes.lock
        hub = rules.arm_hub(size, bored, sizes.arm_bore, sizes.wall_min, standing)
        passing = sizes.passing_eye(assembly.L - long)
        eye = half_or(size.arm_eye_mm, eye_about(hole, sizes.wall_min, passing))
        offset = 0.5 * (contact + thick) + gap
        arm = pin_arm_key.ArmDimensions(long, hub, eye, bored, hole, thick, offset)
    wheel_shaft = shaft_of(spec, "wheel", sizes.wheel_bore, *on_wheel)
    crank_shaft = shaft_of(spec, "crank", sizes.arm_bore or sizes.crank_bore, *on_crank)
    wheel_key = key_of(size.wheel_keyway, sizes.wheel_bore, wide + hub_mm)
    crank_key = key_of(size.crank_keyway, sizes.arm_bore, thick)
    return Stressed(contact, 2.0 * sizes.pin, wheel_shaft, crank_shaft, arm, wheel_key, crank_key)


def shaft_of(spec: Spec, part: str, bore: float, to_frame: float, thick: float) -> ShaftSize:
    """Return a shaft of the spec's dimensions, or else as it is in its bearing; NaN for none.

    That is a frame ``thick`` mm, whose upper face is ``to_frame`` mm from the contact's middle.
    """
    table = vars(spec.shaft)
    diameter, overhang = 2.0 * bore or math.nan, to_frame + 0.5 * thick
    own = table[f"{part}_diameter_mm"], table[f"{part}_overhang_mm"]
    return ShaftSize(value_or(own[0], diameter), value_or(own[1], overhang))


def key_of(standard: str | None, bore: float, length: float) -> pin_arm_key.KeyDimensions:
    """Return the dimensions of a key in a bore; NaN without one."""
    with suppress(GenevaError):  # reported where the part is cut
        if bore and (fitted := key(standard, bore)):
            stands = fitted.height - fitted.in_shaft
            return pin_arm_key.KeyDimensions(2.0 * bore, fitted.width, stands, length)
    return pin_arm_key.NO_KEY


def load_sizes(
    of: Unloaded, machine: Mechanism, loads: PartLoads, bent_MPa: float | None, link: float
) -> Sizes:
    """Return the sizes of a machine under its loads, from those without them.

    ``bent_MPa`` is the stress of ``horn_MPa``, if computed already; ``link`` is the thickness that
    the loads need of a first wheel, 0 without one. A load without a bound leaves all sizes.
    """
    spec, size, sizes = machine.spec, machine.spec.size, of.sizes
    if not all(map(math.isfinite, loads)):
        return sizes
    if link:
        sizes = sizes._replace(link_thickness=link)
    linked = machine.first_wheel or size.link_thickness_mm is not None  # links have their own
    # the force between disc and wheel in the dwell loads both shafts
    held = 0.0
    if spec.load.dwell_torque_Nm:
        held = lock.held_force_N(machine, of.cut_lock() if sizes.lock else None).item()
    carried = float(np.max(centrifugal_N(machine))) if machine.frame else 0.0
    wheel_N, crank_N = max(loads.wheel_shaft_N, held + carried), max(loads.crank_N, held)
    loads = loads._replace(wheel_shaft_N=wheel_N, crank_N=crank_N)
    allowed = wheel_material(spec).allowed_MPa
    if sizes.lock and size.wheel_thickness_mm is size.face_width_mm is None:
        if bent_MPa is None:
            bent_MPa = float(lock.horn_MPa(machine, sizes.half_width, of.cut_lock())[0])
        # a thicker wheel bends its pins more than its horns
        for wide in sizes_from(sizes.wheel_thickness, 2.0 * sizes.wheel_thickness):
            if keeps(bent_MPa / wide, "at most", allowed):
                break
        _, disc, arm, bar = size.thicknesses(wide)
        bar = sizes.link_thickness if linked else bar
        sizes = sizes._replace(
            wheel_thickness=wide, lock_thickness=disc, arm_thickness=arm, link_thickness=bar
        )
    wide, eye = sizes.wheel_thickness, math.inf
    if of.assembly.sign > 0.0 and sizes.arm_bore:  # about the pin, where it passes the largest hub
        hub = max(sizes.wheel_hub, rules.LARGEST_HUB * sizes.slot_end)
        eye = of.assembly.L - sizes.reaches[1] - hub - sizes.wall_min
    sizes = sizes._replace(pin=pin_that_holds(machine, sizes.pin, wide, sizes.roller, eye, loads))
    if not (sizes.arm_bore and sizes.pin) or size.arm_thickness_mm is not None:
        return _crank_bored(of, spec, loads, _wheel_bored(of, spec, loads, sizes), keyed=True)
    # a thicker arm, up to twice the wheel, is better for a key than a thicker shaft
    keys = (False, True) if size.crank_keyway else (True,)
    for keyed, thick in product(keys, sizes_from(wide, 2.0 * wide)):
        bar = sizes.link_thickness if linked else thick
        trial = sizes._replace(arm_thickness=thick, link_thickness=bar)
        trial = _crank_bored(of, spec, loads, _wheel_bored(of, spec, loads, trial), keyed)
        parts = stressed(of.assembly, trial)
        arm_MPa = float(pin_arm_key.arm_stress_MPa(parts.arm, loads.wheel_N))
        key_lasts = key_holds(spec, parts.crank_key, loads.crank_Nm)
        if key_lasts and keeps(arm_MPa, "at most", allowed):
            break
    return trial


def _wheel_bored(of: Unloaded, spec: Spec, loads: PartLoads, sizes: Sizes) -> Sizes:
    """Return the sizes with a bore of the wheel whose shaft and key hold."""
    end, wall = sizes.slot_end, sizes.wall_min
    fixed = spec.size.wheel_bore_mm is not None or spec.shaft.wheel_diameter_mm is not None
    if fixed or not sizes.wheel_bore:
        return sizes
    # a third of the wheel up to its slots is left as a wall
    most = min(end * 2.0 / 3.0, end - wall, rules.within_hub(spec.size, "wheel"))
    for d in sizes_from(2.0 * sizes.wheel_bore, 2.0 * most, bores=True):
        reach, hub = rules.reach_and_hub(spec.size, "wheel", 0.5 * d, wall, end)
        sizes = sizes._replace(wheel_bore=0.5 * d, wheel_reach=reach, wheel_hub=hub)
        parts = stressed(of.assembly, sizes)
        if _shaft_holds(spec, "wheel", parts, loads.wheel_shaft_N, loads.wheel_Nm):
            break
    return sizes


def _crank_bored(of: Unloaded, spec: Spec, loads: PartLoads, usual: Sizes, keyed: bool) -> Sizes:
    """Return the sizes with the crank's bore, through the disc if a shaft that holds fits there.

    Otherwise the shaft ends in the arm, whose bore may be larger, unless links are in its way.
    """
    size, sizes = spec.size, usual
    if size.crank_bore_mm or not (size.arm_bore_mm is spec.shaft.crank_diameter_mm is None):
        return sizes
    trials = list[tuple[float, bool]]()  # diameters, and whether they are bored through the disc
    if sizes.crank_bore:
        # a larger bore leaves no space for its default hub, of 1.5 bores
        most = min(0.6 * of.space, rules.within_hub(size, "crank"))
        trials += zip(sizes_from(2.0 * sizes.crank_bore, 2.0 * most, bores=True), repeat(True))
    # past links and gears the shaft may have no other way out
    if sizes.arm_bore and not (links_at(of.assembly.full, np.zeros(1)) or spec.gears):
        left = sizes.reaches[0] - rules.hole_radius(size, sizes.pin)  # half of it stays as a wall
        trials += zip(sizes_from(2.0 * sizes.arm_bore, left, bores=True), repeat(False))
    for d, through in trials:
        bore, arm = 0.5 * d * through, 0.5 * d if usual.arm_bore else 0.0
        reach, hub = rules.reach_and_hub(size, "crank", bore, sizes.wall_min)
        sizes = usual._replace(crank_bore=bore, crank_reach=reach, crank_hub=hub, arm_bore=arm)
        parts = stressed(of.assembly, sizes)
        if _shaft_holds(spec, "crank", parts, loads.crank_N, loads.crank_Nm, keyed):
            break
    return sizes


def pin_that_holds(
    mechanism: Mechanism, usual: float, wide: float, roller: float, eye: float, loads: PartLoads
) -> float:
    """Return the radius of the first pin from the usual one on that holds, or the largest.

    It holds the cycle and the impact at a change of sides, within roller and ``eye``.
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
    trials, struck_N = np.array(sizes_from(2.0 * usual, 2.0 * most))[:, None], np.zeros(1)
    if jump:
        struck_N = forces_N(mechanism, jump, pin_arm_key.PinSize(trials, contact))[:, None]
    whole_N = np.fmax(loads.pin_N, struck_N) * rubbed  # with friction along the wall
    stresses = pin_arm_key.pin_stress_MPa(size, contact, trials, whole_N)[2]
    for d, stress in zip(trials.ravel().tolist(), np.ravel(stresses).tolist(), strict=True):
        if keeps(stress, "at most", allowed):
            return 0.5 * d
    return 0.5 * d


def _shaft_holds(
    spec: Spec, part: str, parts: Stressed, force_N: float, torque_Nm: float, keyed: bool = True
) -> bool:
    """Return True if a shaft and its key hold a force and a torque, both greatest at once."""
    overhang: float = getattr(parts, f"{part}_shaft").overhang
    bent = spec.shaft.bending_factor * force_N * overhang / 1000.0
    moment = math.hypot(bent, spec.shaft.torsion_factor * torque_Nm)
    return shaft_and_key_hold(spec, part, parts, moment, torque_Nm, keyed)


def shaft_and_key_hold(
    spec: Spec, part: str, parts: Stressed, moment_Nm: float, torque_Nm: float, keyed: bool = True
) -> bool:
    """Return True if a shaft holds an equivalent torque, and if ``keyed`` its key a torque."""
    shaft: ShaftSize = getattr(parts, f"{part}_shaft")
    keyway = vars(spec.size)[f"{part}_keyway"] is not None
    allowed = float(pin_arm_key.shear_allowed_MPa(spec.shaft, keyway))
    if not keeps(shear_MPa(moment_Nm, shaft.diameter), "at most", allowed):
        return False
    return not keyed or key_holds(spec, getattr(parts, f"{part}_key"), torque_Nm)


def key_holds(spec: Spec, key: pin_arm_key.KeyDimensions, torque_Nm: float) -> bool:
    """Return True if a key holds a torque, or for no key."""
    if key is pin_arm_key.NO_KEY:
        return True
    sides, shear = wheel_material(spec).allowed_MPa, pin_arm_key.shear_allowed_MPa(spec.shaft)
    torque = spec.shaft.torsion_factor * torque_Nm
    least = float(pin_arm_key.key_stress(key, torque, sides, shear)[2])
    return keeps(float(key.length), "at least", least)
