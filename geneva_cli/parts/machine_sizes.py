"""The usual sizes of the parts, in millimetres: those of the spec, or defaults without a load.

The rim is where the roller enters: on a smaller wheel it would lose its slot, on a larger one touch
the rim. The locking disc reaches past the rim and leaves a horn next to the slot. With the sizes
goes the mass that they give the wheel.
"""

import math
from contextlib import suppress
from functools import lru_cache, reduce

import numpy as np

from geneva_cli.errors import GenevaError, marking, refuse_size
from geneva_cli.geometry import plates
from geneva_cli.motion.batch import taken
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.registry import thing
from geneva_cli.numerics.arrays import Mask, choose, larger, library, mapped, smaller, value_or
from geneva_cli.numerics.tolerances import SAME_LENGTH, bore_radius, rounded_below
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.outlines.crank_outline import arc_floor
from geneva_cli.parts.outlines.cut_outlines import cut_lock, turned_walls, wheel_contour
from geneva_cli.parts.outlines.outlines import wheel_hub, wheel_plate
from geneva_cli.parts.sizes import KeySizes, Layout, Sizes
from geneva_cli.parts.slots.roller_paths import mouth, roller_paths
from geneva_cli.spec.defaults import wall_min, wheel_material
from geneva_cli.spec.tables import Size

OF_AXLE = (  # keys that an internal wheel lacks, which is open in the middle
    *("wheel_bore_mm", "wheel_hub_mm", "wheel_hub_length_mm"),
    *("wheel_shaft_low_mm", "wheel_shaft_high_mm"),
)


def sized(mechanism: Mechanism, loaded: bool = True) -> Layout | None:
    """Return ``machine_sizes``, or those ``unloaded``; None where no flat parts can be cut."""
    sizes = machine_sizes if loaded else unloaded
    with suppress(GenevaError):  # the check of the parts reports the error
        return sizes(mechanism) if mechanism.spec.is_flat else None
    return None


@lru_cache(maxsize=16)
def machine_sizes(mechanism: Mechanism) -> Layout:
    """Return a machine's assembly and sizes. Raises GenevaError where they leave no parts."""
    where, sizes = unloaded(mechanism)
    if mechanism.spec.is_loaded:
        from geneva_cli.loads.strength.part_loads import single_loads
        from geneva_cli.parts.sized_by_load import load_sizes, needs_lock

        if mechanism.first_wheel:
            sizes = _with_first_wheel(mechanism, sizes)
        by = cut_lock(where, sizes) if sizes.lock and needs_lock(mechanism.spec) else None
        sizes = load_sizes(where, sizes, by, mechanism, single_loads(mechanism))
        sizes = mapped(np.ndarray.item, mapped(np.asarray, sizes))
    refuse_unfit(where, sizes)
    return where, sizes


@lru_cache(maxsize=16)
def unloaded(mechanism: Mechanism) -> Layout:
    """Return a machine's parts without its load. Raises GenevaError where a lock does not fit."""
    where = assembly(mechanism)
    return where, _usual_sizes(where)


def _with_first_wheel(mechanism: Mechanism, sizes: Sizes) -> Sizes:
    """Return the sizes with those that the load of the first of two wheels needs."""
    from geneva_cli.parts.first_wheel import first_spec
    from geneva_cli.parts.sized_by_load import stressed

    # the shaft ends in the first crank, below the plane of its locking disc
    first = first_spec(mechanism).with_("size.crank_bore_mm", 0.0)
    flat = sized(build(first)) if first.is_loaded else None
    parts = stressed(*flat) if flat else None
    if not parts or math.isnan(parts.arm.length):  # a crank without a pin has no arm
        return sizes
    link, shaft = max(parts.contact, float(parts.arm.thickness)), 0.5 * parts.crank_shaft.diameter
    return sizes._replace(link_thickness=link, first_pin=0.5 * parts.pin, first_shaft=shaft)


def unloaded_alike(machine: Mechanism) -> Layout | None:
    """Return the parts without a load of m designs that move alike, NaN where a lock does not fit.

    None if no design has parts.
    """
    where = of_batch(assembly(taken(machine, 0)), machine)
    with marking() as marks:
        sizes = _usual_sizes(where._replace(full=where.full._replace(spec=machine.spec)))
    wrong: Mask = reduce(np.logical_or, marks, np.zeros((1, 1), dtype=bool))
    sizes = mapped(lambda x: choose(wrong, math.nan, x), sizes) if marks else sizes
    return None if np.all(wrong) else (where, sizes)


def of_batch(first: Assembly, machine: Mechanism) -> Assembly:
    """Return the assembly of one of m designs with the sizes of all."""
    L = machine.center_distance_mm
    with marking():  # they are checked
        spec = first.mechanism.spec.replace(size=machine.spec.size)
    one = first.mechanism._replace(spec=spec, center_distance_mm=L)
    return first._replace(mechanism=one, L=L)


def fits(where: Assembly, sizes: Sizes) -> Mask:
    """Return for which designs sizes under a load leave a wheel and a lock, (m, 1) or (1, 1)."""
    fit = np.atleast_2d(np.isfinite(sizes.rim))  # not that of a design without parts
    with marking() as marks:
        try:
            refuse_unfit(where, sizes)
        except GenevaError:  # the check of the parts reports the error
            return fit & False
    return fit & ~reduce(np.logical_or, marks, ~fit)


def key_sizes(mechanism: Mechanism) -> KeySizes:
    """Return the known sizes of a machine by keys of ``[size]``, and which its load chose."""
    known: dict[str, float] = {
        "center_distance_mm": mechanism.center_distance_mm,
        "roller_radius_mm": mechanism.roller_radius_mm,
        **mechanism.spec.size.allowances._asdict(),
    }
    del known["source"]
    of_kind = None if mechanism.spec.no_parts else thing(mechanism.spec.wheel.NAME, "sizes")
    if of_kind:
        values, by_load = of_kind(mechanism)
        return known | values, by_load
    flat = sized(mechanism)
    if not flat:
        return known, ()
    own = flat[1]
    known |= {"wheel_radius_mm": own.rim, "lock_radius_mm": own.lock, "wall_min_mm": own.wall_min}
    known |= {"slot_bottom_clearance_mm": own.slot_bottom, "relief_clearance_mm": own.relief}
    for part in ("wheel", "lock", "arm", "link"):
        known[f"{part}_thickness_mm"] = getattr(own, f"{part}_thickness")
    for radius in ("wheel_bore", "wheel_hub", "crank_bore", "crank_hub", "pin"):
        known[f"{radius}_mm"] = 2.0 * getattr(own, radius)
    if own.outer:
        known["wheel_outer_radius_mm"] = own.outer
    if own.arm_bore:
        known["arm_bore_mm"] = 2.0 * own.arm_bore
    return known, keys_by_load(mechanism, bool(own.lock))


def built(mechanism: Mechanism) -> Size:
    """Return the spec's sizes with the machine's values for the keys left out, mm and diameters."""
    known, values = key_sizes(mechanism)[0], mechanism.spec.size.as_dict()
    return mechanism.spec.size.replace(**{k: x for k, x in known.items() if values[k] is None})


def keys_by_load(mechanism: Mechanism, locked: bool) -> tuple[str, ...]:
    """Return the keys of sizes that a load with a bound chooses, of a wheel that is ``locked``."""
    spec, size, load = mechanism.spec, mechanism.spec.size, mechanism.spec.load
    if not spec.is_loaded:
        return ()
    from geneva_cli.loads.strength.part_loads import single_loads

    if not all(map(math.isfinite, single_loads(mechanism))):
        return ()
    crank = size.arm_bore_mm is spec.shaft.crank_diameter_mm is None and not size.crank_bore_mm
    chosen = {
        "crank_bore_mm": crank and size.crank_bore_mm is None,
        "arm_bore_mm": crank,
        "wheel_bore_mm": size.wheel_bore_mm is spec.shaft.wheel_diameter_mm is None,
        # loads with friction on the pin depend on the usual one
        "pin_mm": size.pin_mm is None and not (load.friction and load.friction_at == "pin"),
        "arm_thickness_mm": size.arm_thickness_mm is None,
        "wheel_thickness_mm": locked and size.wheel_thickness_mm is size.face_width_mm is None,
        "link_thickness_mm": mechanism.first_wheel and size.link_thickness_mm is None,
    }
    return tuple(filter(chosen.get, chosen))


@lru_cache(maxsize=16)
def wheel_body(mechanism: Mechanism) -> plates.MassProperties | None:
    """Return mass and inertia of wheel and hub; None without a thickness or parts."""
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    with suppress(GenevaError):
        if own := thing(spec.wheel.NAME, "wheel_body"):
            return own(mechanism)
        where, sizes = machine_sizes(mechanism)
        contour, _ = wheel_contour(where, sizes, turned_walls(where, sizes), spec.wheel.stopped)
        both = wheel_plate(where, sizes, contour), wheel_hub(where, sizes)
        return plates.mass_properties(filter(None, both), wheel_material(spec).density_kgm3)
    return None


def _usual_sizes(assembly: Assembly) -> Sizes:
    """Return the sizes without a load.

    Of m designs that differ in size alone, they are numbers or (m, 1).
    """
    spec, full, L, sign = assembly.mechanism.spec, assembly.full.spec, assembly.L, assembly.sign
    size, r = spec.size, assembly.mechanism.roller_radius_mm
    deepest, arm, reaches = roller_paths(assembly)
    allowed, outside = size.allowances, sign > 0.0
    w = r + allowed.slot_clearance_mm
    bottom = value_or(size.slot_bottom_clearance_mm, larger(allowed.slot_clearance_mm, r / 20.0))
    mouths, ends, apart = list[float](), list[float](), False
    for s, far in zip(assembly.kinds, deepest, strict=True):
        mouths.append(mouth(assembly, s, r))
        # the gap below the deepest roller is along the slot, whose axis may miss the wheel's
        offset = L * s.through.slot.offset
        m = library(far, bottom)
        along = m.sqrt(larger(far * far - offset * offset, 0.0))
        along = along - (0.0 if s.slot.curved else sign * bottom)
        # beyond the wheel's axis the distance is negative
        ends.append(sign * m.copysign(m.hypot(along, offset), along))
        apart = apart or bool(s.apart)
    rim = value_or(size.wheel_radius_mm, reduce(larger, mouths))
    end, depth = (reduce(smaller, ends) - w) * sign, abs(L - rim)
    lock = 0.0
    if spec.has_lock:
        limit, least = arm - w - allowed.lock_clearance_mm, larger(L - rim, 0.0)
        text = "the locking disc does not fit: it must be above {least:.4g} mm to reach the rim, "
        text += "but roller and clearances limit it to {limit:.4g}; use lock_radius_mm = 0, a "
        text += "smaller roller, or no wheel_radius_mm"
        wrong = (limit <= least) & (size.lock_radius_mm != 0.0)  # as in some designs of a batch
        refuse_size(wrong, "lock_radius_mm", text, least=least, limit=limit)
        # a horn that is cut back may have no thickness where its tip would be
        spare = choose(size.horn_tip_mm > 0.0, limit * SAME_LENGTH, 0.0)
        lock = lock_between(size.lock_radius_mm, least, limit, r, spare)
    relief = value_or(size.relief_clearance_mm, smaller(L / 200.0, depth / 4.0))
    inner = library(rim, r).sqrt(larger(rim * rim - r * r, 0.0))
    space = choose(lock > 0.0, lock, rim) / arm * (L - inner) if outside else 0.0
    if apart:  # gears between rollers widen the relief
        floor = arc_floor(assembly, lock)
        space = choose(floor > 0.0, smaller(space, floor), math.inf)
    within = smaller(space, depth - relief)
    bore = _crank_bore(full, within, L) if spec.drive.LOCKS else 0.0
    wall = wall_min(size, L)
    open_ = not outside and size.wheel_bore_mm is None
    axle = 0.0 if open_ else rules.wheel_bore(full, end, wall, L)
    pin, near = rules.pin_radius(size, r), reduce(smaller, reaches)
    armed = 0.0
    if full.drive.ONE_ARM:  # without pins there is no arm
        armed = rules.arm_bore(full, bore, L, near - rules.hole_radius(size, pin))
        armed = choose(pin > 0.0, armed, 0.0)
    outer = 0.0 if outside else value_or(size.wheel_outer_radius_mm, end + larger(r, L / 20.0))
    recess = choose(lock > 0.0, lock + allowed.lock_clearance_mm, 0.0)
    # in the order of ``Sizes``
    slots = r, w, rim, outer, bottom, end, arm, (near, reduce(larger, reaches))
    locks = lock, recess, relief, wall, size.mouth_radius_mm, size.horn_tip_mm, within
    on_axle = axle, *rules.reach_and_hub(size, "wheel", axle, wall, end)
    on_crank = bore, *rules.reach_and_hub(size, "crank", bore, wall), pin, armed
    thick = size.thicknesses(rounded_below(L / 10.0))
    return Sizes(*slots, *locks, *on_axle, *on_crank, *thick)


def _crank_bore(spec: Spec, space: float, L: float) -> float:
    """Return the crank's bore: that of the arm, which has the same shaft, or half of ``space``."""
    size = spec.size
    if size.crank_bore_mm is not None:
        return 0.5 * size.crank_bore_mm
    shaft = size.arm_bore_mm if spec.drive.ONE_ARM else None
    shaft = spec.shaft.crank_diameter_mm if shaft is None else shaft
    if shaft is not None:
        # a larger bore leaves no space for its default hub, of 1.5 bores
        return choose(0.5 * shaft <= 0.6 * space, 0.5 * shaft, 0.0)
    most = bore_radius(smaller(0.45 * space, rules.within_hub(size, "crank")))
    return choose(0.45 * space >= L / 40.0, most, 0.0)


def lock_between(
    own_mm: float | None, least: float, limit: float, roller: float, spare: float = 0.0
) -> float:
    """Return the reach of a lock, of the spec or by default: into the rim, and off the slot.

    By default the horn is as thick as the roller's radius, and at most a fifth of the available
    radius. Raises GenevaError where the spec's lock does not reach the rim, or leaves no horn.
    """
    if own_mm is None:
        return larger(limit - smaller(roller, limit / 5.0), 0.5 * (limit + least))
    text = "it must be above {least:.6g} to reach the rim, and below {most:.6g} to leave a horn; "
    text, most = f"{text}0 means no lock", limit + spare
    wrong = ((own_mm <= least) | (own_mm >= most)) & (own_mm != 0.0)  # as in some of a batch
    refuse_size(wrong, "lock_radius_mm", text, own_mm, least=least, most=most)
    return own_mm


def refuse_unfit(assembly: Assembly, sizes: Sizes) -> None:
    """Raise GenevaError for sizes that leave no wheel or no lock, and for keys of no such part."""
    size, outside, L = assembly.mechanism.spec.size, assembly.sign > 0.0, assembly.L
    lock, end, bored = sizes.lock, sizes.slot_end, 2.0 * sizes.crank_bore
    most, has_lock = L + sizes.recess, lock > 0.0
    text = "the rim lies beyond the locking disc's reach; it must be below {most:.6g}"
    wrong = has_lock & (abs(L - sizes.rim) >= sizes.recess)
    refuse_size(wrong, "wheel_radius_mm", text, sizes.rim, most=most)
    text = "the slots meet in the wheel's centre: reduce roller_radius_mm, slot_clearance_mm and "
    text += "slot_bottom_clearance_mm together by more than {lost:.4g} mm"
    refuse_size((end <= 0.0) & outside, "roller_radius_mm", text, lost=-end)
    text = "the slots reach down to {end:.6g} mm; it must be below {most:.6g}"
    axle, wrong = 2.0 * sizes.wheel_bore, (sizes.wheel_bore >= end) & outside
    refuse_size(wrong, "wheel_bore_mm", text, axle, end=end, most=2.0 * end)
    own = value_or(size.arm_bore_mm, 0.0)  # of one shaft with the crank's bore
    text = "the shaft runs through the arm and on, so crank_bore_mm = {bored:g} must be equal, or "
    stepped = (own > 0.0) & (bored > 0.0) & (abs(own - bored) > 2.0 * SAME_LENGTH * L)
    stepped &= assembly.full.spec.drive.ONE_ARM
    refuse_size(stepped, "arm_bore_mm", f"{text}0 to end it in the arm", own, bored=bored)
    text, wrong = "it must be below the locking disc's {most:.6g}", sizes.crank_bore >= lock
    refuse_size(wrong & has_lock, "crank_bore_mm", text, bored, most=2.0 * lock)
    thin = reduce(smaller, (sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness))
    rules.refuse_pin_and_edges(size, sizes.pin, sizes.roller, thin)
    unlike = any(kind.slot.curved or kind.apart for kind in assembly.kinds)
    for key, shaped in (("mouth_radius_mm", sizes.mouth_radius), ("horn_tip_mm", sizes.horn_tip)):
        text = f"{key} is for straight slots, each of which a roller enters and leaves: remove it"
        refuse_size((shaped > 0.0) & unlike, key, text)
    text = "horn_tip_mm blunts the horns between slots and recesses, and without a locking disc "
    wrong = (sizes.horn_tip > 0.0) & (lock <= 0.0)
    refuse_size(wrong, "horn_tip_mm", f"{text}there are none: remove it")
    text, wrong = "it must be larger: the slots reach {end:.6g} mm", sizes.outer <= end
    wrong = (wrong | (sizes.outer <= most)) & (not outside)
    refuse_size(wrong, "wheel_outer_radius_mm", text, sizes.outer, end=end)
    for key in ("wheel_outer_radius_mm",) if outside else OF_AXLE:
        text = f"{key}: an external wheel has no opening, an internal one no axle: remove it"
        refuse_size(value_or(vars(size)[key], 0.0) != 0.0, key, text)
    rules.refuse_bored_hub("wheel", sizes.wheel_hub, sizes.wheel_reach, sizes.wheel_bore)
    rules.refuse_bored_hub("crank", sizes.crank_hub, sizes.crank_reach, sizes.crank_bore)
