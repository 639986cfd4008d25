"""Default sizes under a load: thicknesses, pin, bores and hubs as large as the load needs.

``stressed`` has the dimensions of parts that their strength depends on. Default sizes are computed
one after the other: the wheel's thickness from its horns, then the pin, then for each thickness of
the arm the shafts, until the arm holds. Each is the first preferred number that keeps the allowable
stress, from the usual size on, or else the largest that fits, and a check fails. The first of two
wheels in series bears the greatest torque in the second's crank shaft.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kept import Known
from geneva_cli.loads.load_case import centrifugal_N
from geneva_cli.loads.strength import lock, pin_arm_key
from geneva_cli.loads.strength.part_loads import PartLoads, pin_forces_N, shear_MPa
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import of_each
from geneva_cli.numerics.arrays import Array, choose, choose_record, parameter, smaller, value_or
from geneva_cli.numerics.tolerances import keeps, trials_from
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.assembly import Assembly, gear_plane, is_bridged, links_at
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import wheel_hub_length
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import Sizes
from geneva_cli.spec.defaults import key, roller_material, wheel_material


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


@Known
def planes_below(machine: Mechanism) -> tuple[tuple[int, bool], ...]:
    """Return the planes of links, gears and a groove, in the way of the crank's shaft.

    With each goes True if it is below the arm.
    """
    planes = list[tuple[int, bool]]()
    for link in links_at(machine, np.zeros(1)):
        planes.append((link.plane, False))
    planes += [(gear_plane(machine), False)] if machine.spec.gears else []
    if machine.engagements[0].groove is not None:  # its plate has its base below the groove
        planes.append((3, False) if machine.spec.drive_before else (2, True))
    return tuple(planes)


def stressed(assembly: Assembly, sizes: Sizes, own: Spec | None = None) -> Stressed:
    """Return the dimensions of the stressed parts of m designs; numbers, or (m, 1).

    ``own`` is the spec of all designs, by default the assembly's.
    """
    spec = own or assembly.full.spec
    size = spec.size
    gap = size.allowances.pin_gap_mm
    thick, wide, hub_mm = sizes.arm_thickness, sizes.wheel_thickness, 0.0
    contact, armed = value_or(size.face_width_mm, wide), np.asarray(sizes.arm_bore) > 0.0
    if size.has_hub("wheel"):
        hub_mm = choose(sizes.wheel_hub > sizes.wheel_bore, wheel_hub_length(size, sizes), 0.0)
    # the lowest face of what is below the wheel
    lowest = smaller(-hub_mm, -gap - choose(armed, thick, 0.0))
    first = thick if spec.drive.ONE_ARM else sizes.link_thickness
    for plane, under_arm in planes_below(assembly.full):
        low, _ = rules.plane_span(plane, gap, first, sizes.link_thickness, size.washer_mm)
        lowest = smaller(lowest, low - thick if under_arm else low)
    # from the middle of the wheel's thickness to the frame's upper face
    on_wheel = on_crank = 0.5 * wide - lowest + size.washer_mm
    if is_bridged(assembly.full):
        over = rules.bridge_low(size, sizes) - 0.5 * wide
        on_crank = choose(sizes.crank_bore > 0.0, over, on_crank)
    long, hole = sizes.reaches[1], rules.hole_radius(size, sizes.pin)
    bored = reach_or_bore(size, "crank", sizes.arm_bore)
    standing = choose(is_whole(assembly, sizes), 0.0, sizes.lock)  # sectors stand on the hub
    hub = rules.arm_hub(size, bored, sizes.arm_bore, sizes.wall_min, standing)
    passing = sizes.passing_eye(assembly.L - long)
    eye = rules.arm_eye(size, hole, sizes.wall_min, passing)
    offset = 0.5 * (contact + thick) + gap
    rows = np.broadcast_arrays(long, hub, eye, bored, hole, thick, offset)
    arm = np.where(armed & (np.asarray(sizes.pin) > 0.0), rows, np.nan)
    shaft = choose(armed, sizes.arm_bore, sizes.crank_bore)
    return Stressed(
        contact,
        2.0 * sizes.pin,
        shaft_of(spec, "wheel", sizes.wheel_bore, on_wheel, thick),
        shaft_of(spec, "crank", shaft, on_crank, thick),
        pin_arm_key.ArmDimensions(*arm),
        key_of(size.wheel_keyway, sizes.wheel_bore, wide + hub_mm),
        key_of(size.crank_keyway, sizes.arm_bore, thick),
    )


def shaft_of(spec: Spec, part: str, bore: float, to_frame: float, thick: float) -> ShaftSize:
    """Return a shaft of the spec's dimensions, or else as it is in its bearing; NaN for none.

    That is a frame ``thick`` mm, whose upper face is ``to_frame`` mm from the contact's middle.
    """
    table, diameter = vars(spec.shaft), choose(bore > 0.0, 2.0 * bore, math.nan)
    own = table[f"{part}_diameter_mm"], table[f"{part}_overhang_mm"]
    return ShaftSize(value_or(own[0], diameter), value_or(own[1], to_frame + 0.5 * thick))


def key_of(standard: str | None, bore: float, length: float) -> pin_arm_key.KeyDimensions:
    """Return the dimensions of keys in bores; NaN without one, or where no key is as large."""
    if standard is None:
        return pin_arm_key.NO_KEY

    def fitted(radius: float) -> tuple[float, float]:
        try:
            own = key(standard, radius)
        except GenevaError:  # reported where the part is cut
            own = None
        return (own.width, own.height - own.in_shaft) if own else (math.nan, math.nan)

    width, stands = of_each(fitted, bore)
    known = np.where(np.isnan(width), np.nan, 1.0)
    return pin_arm_key.KeyDimensions(2.0 * bore * known, width, stands, length * known)


def needs_lock(spec: Spec) -> bool:
    """Return True if the sizes under a load depend on the lock, of a wheel that has one."""
    size = spec.size
    free = size.wheel_thickness_mm is size.face_width_mm is None
    return free or spec.load.dwell_torque_Nm is not None


def load_sizes(
    assembly: Assembly,
    sizes: Sizes,
    by: Lock | None,
    machine: Mechanism,
    loads: PartLoads,
    bent_MPa: Array | None = None,
) -> Sizes:
    """Return the sizes of m designs under their loads, numbers or (m, 1).

    ``sizes`` are those without loads, ``by`` their locks, ``bent_MPa`` the stress of ``horn_MPa``
    if computed already. Loads without a bound change no size.
    """
    spec, size, usual = machine.spec, machine.spec.size, sizes
    rows = np.zeros((machine.designs, 1)) + np.reshape(loads, (len(loads), -1, 1))
    bounded = np.isfinite(rows).all(axis=0)
    if not bounded.any():
        return sizes
    loads = PartLoads(*map(parameter, np.where(bounded, rows, 0.0)))
    if spec.load.dwell_torque_Nm is not None:
        # the force between disc and wheel in the dwell loads both shafts
        held = np.reshape(lock.held_force_N(machine, by), (-1, 1))
        carried = centrifugal_N(machine) if machine.frame else 0.0
        on_wheel = np.maximum(loads.wheel_shaft_N, held + carried)
        on_crank = np.maximum(loads.crank_N, held)
        loads = loads._replace(wheel_shaft_N=parameter(on_wheel), crank_N=parameter(on_crank))
    linked = machine.first_wheel or size.link_thickness_mm is not None  # links have their own
    allowed = wheel_material(spec).allowed_MPa
    if by and size.wheel_thickness_mm is size.face_width_mm is None:
        # a thicker wheel bends its pins more than its horns
        trials = trials_from(sizes.wheel_thickness, 2.0 * sizes.wheel_thickness)
        bent = lock.horn_MPa(machine, sizes.half_width, by) if bent_MPa is None else bent_MPa
        stress = parameter(np.reshape(bent, (-1, 1)) / trials)
        wide = _first(keeps(stress, "at most", allowed), trials)
        wide = choose(np.greater(sizes.lock, 0.0), wide, sizes.wheel_thickness)
        _, disc, arm, bar = size.thicknesses(wide)
        bar = sizes.link_thickness if linked else bar
        sizes = sizes._replace(
            wheel_thickness=wide, lock_thickness=disc, arm_thickness=arm, link_thickness=bar
        )
    wide, eye = sizes.wheel_thickness, math.inf
    if assembly.sign > 0.0:
        # about the pin, where it passes the largest hub
        hub = np.maximum(sizes.wheel_hub, rules.LARGEST_HUB * sizes.slot_end)
        passing = assembly.L - sizes.reaches[1] - hub - sizes.wall_min
        eye = choose(np.greater(sizes.arm_bore, 0.0), passing, eye)
    sizes = sizes._replace(pin=pin_that_holds(machine, sizes.pin, wide, sizes.roller, eye, loads))
    done = ~(np.greater(sizes.arm_bore, 0.0) & np.greater(sizes.pin, 0.0))  # without an arm
    if size.arm_thickness_mm is not None or done.all():
        out = _bored(assembly, _bored(assembly, sizes, spec, loads, "wheel"), spec, loads, "crank")
    else:
        # a thicker arm, up to twice the wheel, is better for a key than a thicker shaft
        thicknesses = [*trials_from(wide, 2.0 * wide).T[..., None]]
        count, out = len(thicknesses) if size.crank_keyway else 0, sizes
        for k, thick in enumerate(thicknesses + thicknesses[:count]):
            bar = sizes.link_thickness if linked else thick
            one = sizes._replace(arm_thickness=thick, link_thickness=bar)
            one = _bored(assembly, one, spec, loads, "wheel")
            one = _bored(assembly, one, spec, loads, "crank", k >= count)
            out = choose_record(done, out, one) if k else one
            parts = stressed(assembly, one, spec)
            arm_MPa = parameter(pin_arm_key.arm_stress_MPa(parts.arm, loads.wheel_N))
            holds = keeps(arm_MPa, "at most", allowed)
            done = done | (holds & key_holds(spec, parts.crank_key, loads.crank_Nm))
            if done.all():
                break
    return out if bounded.all() else choose_record(bounded, out, usual)


def _first(holds: bool, trials: Array) -> float:
    """Return the first of each design's trials (m, k) that holds, or else the last: (m, 1)."""
    fit = np.array(holds)
    fit[:, -1] = True
    every = np.broadcast_to(trials, fit.shape)
    return parameter(np.take_along_axis(every, fit.argmax(axis=1)[:, None], 1))


def _bored(
    assembly: Assembly, sizes: Sizes, spec: Spec, loads: PartLoads, part: str, keyed: bool = True
) -> Sizes:
    """Return the sizes with the first bore of a part whose shaft holds, and if ``keyed`` its key.

    The crank's goes through the disc if a shaft that holds fits there. Otherwise the shaft ends in
    the arm, whose bore may be larger, unless links are in its way.
    """
    size, through = spec.size, getattr(sizes, f"{part}_bore")
    own = vars(size)[f"{part}_bore_mm"]
    if part == "wheel":
        fixed = own is not None or spec.shaft.wheel_diameter_mm is not None
        # a third of the wheel up to its slots is left as a wall
        space = smaller(sizes.slot_end * 2.0 / 3.0, sizes.slot_end - sizes.wall_min)
        force, torque = loads.wheel_shaft_N, loads.wheel_Nm
    else:
        fixed = not (size.arm_bore_mm is spec.shaft.crank_diameter_mm is None)
        space = 0.6 * sizes.space  # a larger bore leaves no space for its default hub, of 1.5 bores
        force, torque = loads.crank_N, loads.crank_Nm
    if fixed:
        return sizes
    known = np.greater(value_or(own, 0.0), 0.0)
    most = choose(known, through, smaller(space, rules.within_hub(size, part)))
    d = trials_from(2.0 * through, 2.0 * most, bores=True)
    goes_on = d > 0.0
    # past links and gears the shaft may have no other way out
    if part != "wheel" and not planes_below(assembly.full):
        left = sizes.reaches[0] - rules.hole_radius(size, sizes.pin)  # half of it stays as a wall
        ends = trials_from(2.0 * sizes.arm_bore, left, bores=True)
        ends = np.where(known, 0.0, ends)
        rows = np.zeros((max(len(d), len(ends)), 1))
        first, last = np.where(goes_on, d, ends[:, :1]), np.where(ends > 0.0, ends, d[:, -1:])
        goes_on = np.hstack((goes_on | (rows > 0.0), (ends <= 0.0) & goes_on[:, -1:]))
        d = np.hstack((first, last))
    bore = parameter(np.where(goes_on, 0.5 * d, 0.0))
    reach, hub = rules.reach_and_hub(size, part, bore, sizes.wall_min, sizes.slot_end)
    trial: dict[str, Any] = {f"{part}_bore": bore, f"{part}_reach": reach, f"{part}_hub": hub}
    if part != "wheel":
        changes = np.greater(sizes.arm_bore, 0.0) & (d > 0.0)
        trial["arm_bore"] = np.where(changes, 0.5 * d, sizes.arm_bore)
    parts = stressed(assembly, sizes._replace(**trial), spec)
    lever = getattr(parts, f"{part}_shaft").overhang / 1000.0
    bent, turned = spec.shaft.bending_factor * force * lever, spec.shaft.torsion_factor * torque
    moment = parameter(np.hypot(bent, turned))  # both are greatest at once
    holds = shaft_and_key_hold(spec, part, parts, moment, torque, keyed)
    for name, values in trial.items():
        trial[name] = _first(holds, values)
    return sizes._replace(**trial)


def pin_that_holds(
    mechanism: Mechanism, usual: float, wide: float, roller: float, eye: float, loads: PartLoads
) -> float:
    """Return the radius of the first pin from the usual one on that holds, or the largest: (m, 1).

    It holds the cycle and the impact at a change of sides, within roller and ``eye``.
    """
    spec, size, load = mechanism.spec, mechanism.spec.size, mechanism.spec.load
    if size.pin_mm is not None or not np.any(np.greater(usual, 0.0)):
        return usual
    contact = value_or(size.face_width_mm, wide)
    # the roller keeps three tenths of its radius as a wall about the hole for its pin
    most = np.minimum(0.7 * roller - 0.5 * size.allowances.shaft_fit_mm, eye)
    trials = trials_from(2.0 * usual, 2.0 * most)
    force_N = pin_forces_N(mechanism, loads, pin_arm_key.PinSize(trials, contact))
    stress = pin_arm_key.pin_stress_MPa(size, contact, trials, force_N)[2]
    allowed = roller_material(spec).allowed_MPa
    held = 0.5 * _first(keeps(parameter(stress), "at most", allowed), trials)
    if load.friction_at == "pin":  # loads with friction there depend on the usual one
        held = parameter(np.where(np.asarray(load.friction) > 0.0, usual, held))
    return held


def shaft_and_key_hold(
    spec: Spec, part: str, parts: Stressed, moment_Nm: float, torque_Nm: float, keyed: bool = True
) -> bool:
    """Return which shafts hold an equivalent torque, and if ``keyed`` whose keys hold a torque."""
    shaft: ShaftSize = getattr(parts, f"{part}_shaft")
    keyway = vars(spec.size)[f"{part}_keyway"] is not None
    allowed = parameter(pin_arm_key.shear_allowed_MPa(spec.shaft, keyway))
    holds = keeps(shear_MPa(moment_Nm, shaft.diameter), "at most", allowed)
    return holds & key_holds(spec, getattr(parts, f"{part}_key"), torque_Nm) if keyed else holds


def key_holds(spec: Spec, key: pin_arm_key.KeyDimensions, torque_Nm: float) -> bool:
    """Return which keys hold a torque, True for no key."""
    if key is pin_arm_key.NO_KEY:
        return True
    sides, shear = wheel_material(spec).allowed_MPa, pin_arm_key.shear_allowed_MPa(spec.shaft)
    torque = spec.shaft.torsion_factor * torque_Nm
    least = parameter(pin_arm_key.key_stress(key, torque, sides, shear)[2])
    # to the type checker masks of machines are single, as their numbers are
    none: bool = key.shaft != key.shaft
    return none | keeps(parameter(key.length), "at least", least)
