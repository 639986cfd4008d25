"""Default sizes under a load: thicknesses, pin, bores and hubs as large as the load needs.

``stressed`` has the dimensions of parts that their strength depends on. Default sizes are computed
one after the other: the wheel's thickness from its horns, then the pin, then for each thickness of
the arm the shafts, until the arm holds. Each is the first preferred number that keeps the allowable
stress, from the usual size on, or else the largest that fits, and a check fails. The first of two
wheels in series bears the greatest torque in the second's crank shaft.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.load_case import centrifugal_N
from geneva_cli.loads.strength import lock, pin_arm_key
from geneva_cli.loads.strength.part_loads import PartLoads, shear_MPa
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.batch import taken
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import of_each
from geneva_cli.numerics.arrays import (
    Array,
    Number,
    Whole,
    choose,
    half_or,
    mapped,
    parameter,
    rising,
    smaller,
    value_or,
)
from geneva_cli.numerics.tolerances import keeps, trials_from
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.assembly import Assembly, gear_plane, is_bridged, links_at
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


class Sizing(NamedTuple):
    """Sizes of m designs, and what they must hold; numbers, or (m, 1)."""

    sizes: Sizes
    spec: Spec
    L: float
    sign: float  # +1 external, -1 internal
    planes: tuple[tuple[int, bool], ...]  # of links, gears and a groove; True below the arm
    bridged: bool
    linked: bool  # links or gears are in the way of the crank's shaft
    space: float = 0.0  # radius about the crank's axis inside the relief
    loads: PartLoads = PartLoads(*[0.0] * len(PartLoads._fields))


def sizing(assembly: Assembly, sizes: Sizes) -> Sizing:
    """Return the sizes of an assembly with what the dimensions of its parts depend on."""
    machine, spec, planes = assembly.full, assembly.full.spec, list[tuple[int, bool]]()
    for link in links_at(machine, np.zeros(1)):
        planes.append((link.plane, False))
    if spec.gears:
        planes.append((gear_plane(machine), False))
    linked = bool(planes)
    if machine.engagements[0].groove is not None:  # its plate has its base below the groove
        planes.append((3, False) if spec.drive_before else (2, True))
    kind = tuple(planes), is_bridged(machine), linked
    return Sizing(sizes, spec, assembly.L, assembly.sign, *kind)


def stressed(assembly: Assembly, sizes: Sizes) -> Stressed:
    """Return the dimensions of a machine's stressed parts, for parts of these sizes."""
    return dimensions(sizing(assembly, sizes))


def dimensions(of: Sizing) -> Stressed:
    """Return the dimensions of stressed parts of m designs; numbers, or (m, 1)."""
    sizes, spec, size = of.sizes, of.spec, of.spec.size
    gap = size.allowances.pin_gap_mm
    thick, wide, hub_mm = sizes.arm_thickness, sizes.wheel_thickness, 0.0
    contact, armed = value_or(size.face_width_mm, wide), np.asarray(sizes.arm_bore) > 0.0
    if size.has_hub("wheel"):
        hub_mm = choose(sizes.wheel_hub > sizes.wheel_bore, wheel_hub_length(size, sizes), 0.0)
    # the lowest face of what is below the wheel
    lowest = smaller(-hub_mm, -gap - choose(armed, thick, 0.0))
    first = thick if spec.drive.ONE_ARM else sizes.link_thickness
    for plane, under_arm in of.planes:
        low, _ = rules.plane_span(plane, gap, first, sizes.link_thickness, size.washer_mm)
        lowest = smaller(lowest, low - thick if under_arm else low)
    # from the middle of the wheel's thickness to the frame's upper face
    on_wheel = on_crank = 0.5 * wide - lowest + size.washer_mm
    if of.bridged:
        over = rules.bridge_low(size, sizes) - 0.5 * wide
        on_crank = choose(sizes.crank_bore > 0.0, over, on_crank)
    long, hole = sizes.reaches[1], rules.hole_radius(size, sizes.pin)
    bored = reach_or_bore(size, "crank", sizes.arm_bore)
    # some of the disc is left at the axis, or else its sectors stand on the hub
    whole = np.logical_and(of.sign > 0.0, of.L - sizes.rim > sizes.relief)
    standing = choose(whole, 0.0, sizes.lock)
    hub = rules.arm_hub(size, bored, sizes.arm_bore, sizes.wall_min, standing)
    passing = sizes.passing_eye(of.L - long)
    eye = half_or(size.arm_eye_mm, eye_about(hole, sizes.wall_min, passing))
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


# Tries the sizes of some designs with a number (n, 1) from a column of trials: the sizes, and which
# of the designs hold.
Attempt: TypeAlias = Callable[[Sizing, Array, int], "tuple[Sizes, bool]"]


def needs_lock(spec: Spec) -> bool:
    """Return True if the sizes under a load depend on the lock, of a wheel that has one."""
    size = spec.size
    free = size.wheel_thickness_mm is size.face_width_mm is None
    return free or spec.load.dwell_torque_Nm is not None


def batch_sizes(
    of: Unloaded, by: Lock | None, machine: Mechanism, loads: PartLoads, bent_MPa: Array | None
) -> Sizes:
    """Return ``load_sizes`` of any m designs: those that have the same parts are sized together."""
    kinds: Whole = np.array(np.isfinite(loads).all(axis=0), dtype=int)
    for part in ("lock", "wheel_bore", "crank_bore", "arm_bore", "pin"):
        kinds = 2 * kinds + np.ravel(np.greater(getattr(of.sizes, part), 0.0))
    if (kinds == kinds[0]).all():
        return load_sizes(of, by if np.max(of.sizes.lock) > 0.0 else None, machine, loads, bent_MPa)
    groups = list[tuple[Whole, Sizes]]()
    for kind in rising(kinds).tolist():
        which = np.flatnonzero(kinds == kind)
        every = of.assembly.L, of.sizes, of.space, by, machine
        L, sizes, space, lock_of, some = taken(every, which)
        own = of._replace(assembly=of.assembly._replace(L=L), sizes=sizes, space=space)
        lock_of = lock_of if np.max(sizes.lock) > 0.0 else None
        few = PartLoads(*np.asarray(loads)[:, which])
        bent = None if bent_MPa is None else bent_MPa[which]
        groups.append((which, load_sizes(own, lock_of, some, few, bent)))
    return _joined(groups)


def _joined(groups: Sequence[tuple[Whole, Sizes]]) -> Sizes:
    """Return the sizes of groups of designs, by the designs' numbers, as those of all designs."""
    order = np.argsort(np.concatenate([which for which, _ in groups]))

    def rows(*each: Number) -> Number:
        if all(one is each[0] for one in each):
            return each[0]
        own = [np.broadcast_to(x, (len(w), 1)) for x, (w, _) in zip(each, groups, strict=True)]
        return np.concatenate(own)[order]

    return mapped(rows, *(sizes for _, sizes in groups))


def _first(case: Sizing, trials: Array, attempt: Attempt) -> Sizes:
    """Return the sizes of each design's first trial that holds, or else of its last one."""
    m, count = np.size(case.loads.pin_N), trials.shape[1]
    trials, left = np.broadcast_to(trials, (m, count)), np.arange(m)
    groups = list[tuple[Whole, Sizes]]()
    for k in range(count):
        some = taken(case, left) if len(left) < m else case
        sizes, holds = attempt(some, trials[left, k, None], k)
        done = np.ravel(holds) | (k == count - 1)
        if done.all() and not groups:
            return sizes
        if done.any():
            groups.append((left[done], taken(sizes, done)))
            left = left[~done]
        if not len(left):
            break
    return _joined(groups)


def load_sizes(
    of: Unloaded,
    by: Lock | None,
    machine: Mechanism,
    loads: PartLoads,
    bent_MPa: Array | None = None,
    link: float = 0.0,
) -> Sizes:
    """Return the sizes of m designs with the same parts under their loads, numbers or (m, 1).

    ``of`` are those without loads, ``by`` their locks, ``bent_MPa`` the stress of ``horn_MPa`` if
    computed already, ``link`` the thickness that a first wheel needs. Either all loads have bounds,
    or no design's have, and then none changes.
    """
    spec, size, sizes = machine.spec, machine.spec.size, of.sizes
    zero = np.zeros((machine.designs, 1))
    loads = PartLoads(*(zero + np.reshape(loads, (len(loads), -1, 1))))
    if not np.isfinite(loads).all():
        return sizes
    if spec.load.dwell_torque_Nm is not None:
        # the force between disc and wheel in the dwell loads both shafts
        held = np.reshape(lock.held_force_N(machine, by), (-1, 1))
        carried = centrifugal_N(machine) if machine.frame else zero
        on_wheel = np.maximum(loads.wheel_shaft_N, held + carried)
        on_crank = np.maximum(loads.crank_N, held)
        loads = loads._replace(wheel_shaft_N=parameter(on_wheel), crank_N=parameter(on_crank))
    sizes = sizes._replace(link_thickness=link or sizes.link_thickness)
    linked = machine.first_wheel or size.link_thickness_mm is not None  # links have their own
    allowed = wheel_material(spec).allowed_MPa
    if by and size.wheel_thickness_mm is size.face_width_mm is None:
        # a thicker wheel bends its pins more than its horns
        trials = trials_from(sizes.wheel_thickness, 2.0 * sizes.wheel_thickness)
        bent = lock.horn_MPa(machine, sizes.half_width, by) if bent_MPa is None else bent_MPa
        wide = parameter(_holding(trials, np.reshape(bent, (-1, 1)) / trials, allowed))
        _, disc, arm, bar = size.thicknesses(wide)
        bar = sizes.link_thickness if linked else bar
        sizes = sizes._replace(
            wheel_thickness=wide, lock_thickness=disc, arm_thickness=arm, link_thickness=bar
        )
    wide, eye = sizes.wheel_thickness, math.inf
    if of.assembly.sign > 0.0 and np.max(sizes.arm_bore) > 0.0:
        # about the pin, where it passes the largest hub
        hub = np.maximum(sizes.wheel_hub, rules.LARGEST_HUB * sizes.slot_end)
        eye = of.assembly.L - sizes.reaches[1] - hub - sizes.wall_min
    sizes = sizes._replace(pin=pin_that_holds(machine, sizes.pin, wide, sizes.roller, eye, loads))
    case = sizing(of.assembly, sizes)._replace(spec=spec, space=of.space, loads=loads)
    armed = np.max(sizes.arm_bore) > 0.0 and np.max(sizes.pin) > 0.0
    if not armed or size.arm_thickness_mm is not None:
        return _bored(case._replace(sizes=_bored(case, "wheel")), "crank")
    # a thicker arm, up to twice the wheel, is better for a key than a thicker shaft
    trials = trials_from(wide, 2.0 * wide)
    count = trials.shape[1] if size.crank_keyway else 0

    def attempt(some: Sizing, thick: Array, k: int) -> tuple[Sizes, bool]:
        bar = some.sizes.link_thickness if linked else thick
        trial = some.sizes._replace(arm_thickness=parameter(thick), link_thickness=parameter(bar))
        some = some._replace(sizes=trial)
        trial = _bored(some._replace(sizes=_bored(some, "wheel")), "crank", k >= count)
        parts, loads, spec = dimensions(some._replace(sizes=trial)), some.loads, some.spec
        arm_MPa = parameter(pin_arm_key.arm_stress_MPa(parts.arm, loads.wheel_N))
        holds = keeps(arm_MPa, "at most", wheel_material(spec).allowed_MPa)
        return trial, holds & key_holds(spec, parts.crank_key, loads.crank_Nm)

    return _first(case, np.hstack((trials, trials)) if count else trials, attempt)


def _holding(trials: Array, stress: Number, allowed: float) -> Array:
    """Return the first of each design's trials (m, k) that holds, or else the last: (m, 1)."""
    holds = np.array(keeps(parameter(stress), "at most", allowed))
    holds[:, -1] = True
    return np.take_along_axis(
        np.broadcast_to(trials, holds.shape), holds.argmax(axis=1)[:, None], 1
    )


def _bored(case: Sizing, part: str, keyed: bool = True) -> Sizes:
    """Return the sizes with the first bore of a part whose shaft holds, and if ``keyed`` its key.

    The crank's goes through the disc if a shaft that holds fits there. Otherwise the shaft ends in
    the arm, whose bore may be larger, unless links are in its way.
    """
    sizes, spec, size = case.sizes, case.spec, case.spec.size
    own, through = vars(size)[f"{part}_bore_mm"], getattr(sizes, f"{part}_bore")
    armed, trials = part != "wheel" and np.max(sizes.arm_bore) > 0.0, list[Array]()
    rows = np.zeros((np.size(case.loads.pin_N), 1))
    if part == "wheel":
        fixed = own is not None or spec.shaft.wheel_diameter_mm is not None
        # a third of the wheel up to its slots is left as a wall
        space = smaller(sizes.slot_end * 2.0 / 3.0, sizes.slot_end - sizes.wall_min)
    else:
        free = size.arm_bore_mm is spec.shaft.crank_diameter_mm is None
        fixed = not free or np.max(value_or(own, 0.0)) > 0.0
        space = 0.6 * case.space  # a larger bore leaves no space for its default hub, of 1.5 bores
    if np.max(through) > 0.0:
        most = smaller(space, rules.within_hub(size, part))
        trials.append(rows + trials_from(2.0 * through, 2.0 * most, bores=True))
    count = len(trials) and trials[0].shape[1]
    # past links and gears the shaft may have no other way out
    if armed and not case.linked:
        left = sizes.reaches[0] - rules.hole_radius(size, sizes.pin)  # half of it stays as a wall
        trials.append(rows + trials_from(2.0 * sizes.arm_bore, left, bores=True))
    if fixed or not trials:
        return sizes

    def attempt(some: Sizing, d: Array, k: int) -> tuple[Sizes, bool]:
        own, loads, spec = some.sizes, some.loads, some.spec
        bore = parameter(0.5 * d if k < count else 0.0 * d)
        reach, hub = rules.reach_and_hub(spec.size, part, bore, own.wall_min, own.slot_end)
        arm = parameter(0.5 * d) if armed else own.arm_bore
        if part == "wheel":
            trial = own._replace(wheel_bore=bore, wheel_reach=reach, wheel_hub=hub)
            force, torque = loads.wheel_shaft_N, loads.wheel_Nm
        else:
            trial = own._replace(crank_bore=bore, crank_reach=reach, crank_hub=hub, arm_bore=arm)
            force, torque = loads.crank_N, loads.crank_Nm
        parts = dimensions(some._replace(sizes=trial))
        lever = getattr(parts, f"{part}_shaft").overhang / 1000.0
        bent, turned = spec.shaft.bending_factor * force * lever, spec.shaft.torsion_factor * torque
        moment = parameter(np.hypot(bent, turned))  # both are greatest at once
        return trial, shaft_and_key_hold(spec, part, parts, moment, torque, keyed)

    return _first(case, np.hstack(trials), attempt)


def pin_that_holds(
    mechanism: Mechanism, usual: float, wide: float, roller: float, eye: float, loads: PartLoads
) -> float:
    """Return the radius of the first pin from the usual one on that holds, or the largest: (m, 1).

    It holds the cycle and the impact at a change of sides, within roller and ``eye``.
    """
    spec, size, load = mechanism.spec, mechanism.spec.size, mechanism.spec.load
    if size.pin_mm is not None or not np.max(usual) > 0.0:
        return usual
    contact = value_or(size.face_width_mm, wide)
    # the roller keeps three tenths of its radius as a wall about the hole for its pin
    most = np.minimum(0.7 * roller - 0.5 * size.allowances.shaft_fit_mm, eye)
    trials, jump = trials_from(2.0 * usual, 2.0 * most), np.reshape(loads.pin_jump, (-1, 1))
    struck_N = 0.0 * jump
    if jump.any():
        pins = [pin_arm_key.PinSize(parameter(d[:, None]), contact) for d in trials.T]
        struck_N = np.column_stack([forces_N(mechanism, jump, pin) for pin in pins])
    # with friction along the wall
    whole_N = np.fmax(np.reshape(loads.pin_N, (-1, 1)), struck_N) * np.hypot(1.0, load.friction)
    stress = pin_arm_key.pin_stress_MPa(size, contact, trials, whole_N)[2]
    held = 0.5 * _holding(trials, stress, roller_material(spec).allowed_MPa)
    if load.friction_at == "pin":  # loads with friction there depend on the usual one
        held = np.where(np.asarray(load.friction) > 0.0, usual, held)
    return parameter(held)


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
