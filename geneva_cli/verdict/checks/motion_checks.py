"""Checks of a machine's motion, and of its parts in a whole turn."""

import math
from collections.abc import Collection, Iterator
from operator import attrgetter

from geneva_cli.errors import GenevaError
from geneva_cli.kept import load_extra
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.full_turn import IDLE
from geneva_cli.parts.turn.turn_certificate import UNKNOWN, certificate
from geneva_cli.spec.tables import LIMITED
from geneva_cli.verdict.checks import Check, compared, unknown
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT, turns_back
from geneva_cli.verdict.quantities.groups import value_of

# A steeper groove wedges its roller on the crank, which friction of 0.58 would hold.
GROOVE_MAX_DEG = 60.0
# Of the input's speed: real parts of a machine as derived do not enter more gently.
ENTRY_VELOCITY = 0.01


def motion(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Dwells, convex gears, a law that turns back, and the groove of a cam."""
    mechanism = parts.mechanism
    spec, own = mechanism.spec, mechanism.engagements
    # the shortest dwell, degrees of the input: below 0 a roller enters before another has left
    least = min(map(mechanism.dwell_deg, range(len(own))))
    yield compared("dwell_deg", least, "at least", 0.0)
    if spec.gears:
        from geneva_cli.parts.gears.gear_pair import convexity

        driver, driven = convexity(spec.gears)  # the least curvatures
        yield compared("driver_gear_convexity", driver, "above", 0.0)
        yield compared("driven_gear_convexity", driven, "above", 0.0)
    if mechanism.law is not None and "velocity_min" in names:
        velocity, at_deg = turns_back(mechanism) or (0.0, None)
        yield compared("velocity_min", velocity, "at least", 0.0, at_deg)
    if own[0].groove is not None:
        from geneva_cli.parts.slots.groove import greatest_pressure

        value, crank_deg = greatest_pressure(own[0].groove)
        limit = value_or(spec.limits.pressure_angle_max_deg, GROOVE_MAX_DEG)
        at_deg = mechanism.shown_deg(spec.input_deg(crank_deg))  # it is cut by the crank's angle
        yield compared("groove_pressure_deg", value, "at most", limit, at_deg)
    if own[0].slot.curved or spec.limits.pressure_angle_max_deg is not None:
        yield from _slots(names, mechanism)


def _slots(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """The pressure angle; of curved slots, the walls that carry the load, and the undercut."""
    spec, curved = mechanism.spec, mechanism.engagements[0].slot.curved
    if "pressure_angle_deg" in names:
        from geneva_cli.loads import load_peaks

        peak = load_peaks.greatest_pressure(mechanism)
        most = value_or(spec.limits.pressure_angle_max_deg, 90.0)
        value, at_deg = peak.max.item(), peak.at_deg.item()
        # At 90 degrees nothing turns the wheel, whatever the limit.
        passes = keeps(value, "at most", most) and value < 90.0
        yield Check("pressure_angle_deg", value, "at most", most, passes, at_deg=at_deg)
    if spec.is_loaded and curved and "driven_fraction" in names:
        from geneva_cli.loads.positive_drive import positive_drives

        # of the motion, in which a wall of the slot carries the load
        if (drives := positive_drives(mechanism)) is not None:
            yield compared("driven_fraction", 1.0 - drives.fraction.item(), "above", 0.5)
    if curved and "undercut_mm" in names:
        from geneva_cli.motion.undercut import undercut

        place = undercut(mechanism)
        depth, where = (place.depth_mm, place.at_deg) if place else (0.0, None)
        yield compared("undercut_mm", depth, "at most", SHOWN_UNDERCUT, where)


# Keys that bound the product's motion, by the names of their checks, and what they bound.
PRODUCT = {
    "product_acceleration_max_m_s2": "product.acceleration_m_s2.max",
    "product_slip": "product.friction_needed",
}


def limits(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Peaks, as derivatives by the input's radians, times, loads, and the product, if bounded."""
    mechanism, spec = parts.mechanism, parts.mechanism.spec
    held_by = spec.product.friction if spec.support.axis == "vertical" else None
    bounds = spec.limits.as_dict() | {"product_slip": held_by}
    for name in names:
        limit, quantity = bounds[name], (LIMITED | PRODUCT).get(name, "")
        # a crank as built has a limit of its velocity at entry without one in the spec
        if name == "entry_velocity_max" and (limit is not None or mechanism.engagements[0].built):
            yield _entry_velocity(name, mechanism)
        elif limit is None:
            continue
        elif name.endswith("_s"):
            from geneva_cli.motion.timing import timings

            key, is_least = name.replace("_max", "").replace("_min", ""), "_min" in name
            times = [getattr(one, key) for one in timings(mechanism)]
            value, must_be = (min(times), "at least") if is_least else (max(times), "at most")
            yield compared(name, value, must_be, limit)
        else:
            place = quantity.replace(".max", ".at_deg") if quantity.startswith("loads.") else ""
            place = "product.acceleration_m_s2.at_deg" if name in PRODUCT else place
            at_deg = value_of(mechanism, place) if place else None
            yield compared(name, value_of(mechanism, quantity), "at most", limit, at_deg)


def entry_velocity_limit(mechanism: Mechanism) -> float:
    """Return the greatest jump of velocity at entry, over the input's speed, or its default.

    >>> entry_velocity_limit(Design(External(6)).mechanism)
    0.01
    """
    return value_or(mechanism.spec.limits.entry_velocity_max, ENTRY_VELOCITY)


def _entry_velocity(name: str, mechanism: Mechanism) -> Check:
    """The greatest jump of the wheel's velocity at entry and exit, over the input's speed."""
    from geneva_cli.motion.peaks import greatest_jumps

    own = mechanism.engagements
    limit, jumps = entry_velocity_limit(mechanism), greatest_jumps(own)
    sizes = [abs(jump) for jump in jumps if jump is not None]
    if len(sizes) < len(jumps):
        why = "the roller's centre does not cross the axis of the slot at rest inside the rim: it "
        why += "meets the wheel beside its slot, or misses it"
        return unknown(name, why, "at most", limit, True)
    end = own[0].entry_deg if sizes[0] >= sizes[1] else own[0].exit_deg
    at_deg = mechanism.shown_deg(own[0].mid_deg + end) if own[0].built else None
    return compared(name, max(sizes), "at most", limit, at_deg)


DRY_FRICTION = 0.3  # of a sliding pair that nobody greases: steel on steel or PLA on PLA


def slips_deg(friction: float) -> float:
    """The pressure angle from which friction alone holds a roller on a corner, degrees.

    Without a coefficient it is that of dry steel or plastic.

    >>> round(slips_deg(0.0), 2), slips_deg(1.0)
    (73.3, 45.0)
    """
    return 90.0 - math.degrees(math.atan(friction or DRY_FRICTION))


def motion_play_max(parts: Parts) -> float:
    """The play, degrees to either side, up to which a slot determines the wheel's motion."""
    # Where the driving wall changes, the wheel falls behind by twice the play, a tenth of its step,
    # and strikes the other wall: such a slot does not determine the motion.
    half = min(map(attrgetter("half_step"), parts.assembly.kinds))
    return 0.05 * (2.0 * math.degrees(half))


def turning(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """What holds the wheel, gaps between wheel and crank, and how far the wheel is free."""
    machine, turn, touch = parts.assembly.full, parts.turn, parts.contact
    output, unit = machine.output, machine.output.unit
    holds = machine.spec.wheel.held_by is not None or turn.holds
    yield Check("dwell_hold", float(holds), "at least", 1.0, holds)
    # negative where they overlap; of a roller that does not drive the wheel
    for name, gap in (("gap_mm", turn.smallest), ("idle_roller_mm", turn.gaps.get(IDLE))):
        if gap is not None:
            mm = 0.0 if abs(gap.mm) <= touch else gap.mm
            yield compared(name, mm, "at least", 0.0, gap.at_deg, touch)
    # values with their places, and limits; the offset is that from the slot's middle, beyond its
    # clearance, of a roller that first touches: not 0 where the mouth does not reach it
    rows = dict[str, tuple[tuple[float, float], float]]()
    rows[f"motion_play_{unit}"] = turn.motion, motion_play_max(parts)
    rows["hand_over_offset_mm"] = turn.contact, 0.0
    if parts.locked:
        # the play with which the roller would just meet the mouth of its slot
        sizes, moves = parts.sizes, parts.assembly.plane_motion
        finds = math.degrees(moves.half_span(sizes.half_width, sizes.rim))
        rows[f"dwell_play_{unit}"] = turn.dwell, finds
        rows[f"hand_over_play_{unit}"] = turn.hand_over, finds
        # at which the roller meets a wheel that has turned through that play
        rows["hand_over_pressure_deg"] = turn.push, slips_deg(machine.spec.load.friction)
    for name in filter(rows.__contains__, names):
        (value, at_deg), limit = rows[name]
        if "_play_" in name:
            value, limit = output.from_deg(value), output.from_deg(limit)
        yield compared(name, value, "at most", limit, at_deg if value else None)


def within_tolerances(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Plays that ``[limits]`` bounds, and the clearances per side that ``[tolerance]`` needs."""
    machine, own = parts.assembly.full, parts.assembly.full.spec.size.allowances
    limits, turn = machine.spec.limits.as_dict(), parts.turn
    unlocked = "not computed, because no drawn locking disc holds the wheel at rest"
    for name, play in (("index_play_max_deg", turn.motion), ("dwell_play_max_deg", turn.dwell)):
        if (limit := limits[name]) is not None:
            deg = play.deg if parts.locked or play is turn.motion else None
            at_deg = play.at_deg if play.deg else None
            yield compared(name, deg, "at most", limit, at_deg, why=unlocked)
    name = "dwell_position_max_deg"
    if (limit := limits[name]) is not None and name in names:
        from geneva_cli.verdict.tolerance import worst_dwell_deg

        try:  # the greatest error of the resting wheel
            worst, why = worst_dwell_deg(machine, parts), unlocked
        except GenevaError as error:
            worst, why = None, str(error)
        yield compared(name, worst, "at most", limit, why=why)
    if machine.spec.tolerance.is_given and machine.output.turns:
        # a spec without tolerances is checked without their modules
        from geneva_cli.loads.tolerance.locking import used
        from geneva_cli.verdict.tolerance import needed_mm

        slot_mm, lock_mm = needed_mm(machine, parts, used(machine.spec))
        yield compared("tolerance_slot_mm", own.slot_clearance_mm, "at least", slot_mm)
        if lock_mm is not None:  # a disc holds the wheel
            yield compared("tolerance_lock_mm", own.lock_clearance_mm, "at least", lock_mm)


def pushed_round(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Whether parts turn that do not follow the formulas, and how hard they are struck."""
    try:
        yield from load_extra("outline", "as_built")(parts.mechanism)
    except GenevaError:
        yield unknown("full_turn", parts.mechanism.no_turn)


def proof(names: Collection[str], parts: Parts, to_mm: float | None = None) -> Iterator[Check]:
    """The proved lower bound of the gap, mm; none where parts overlap, or cannot be turned.

    ``to_mm`` is how far below the smallest gap the bound may be: by default 1 um, or twice the
    overlap that counts as touching, if that is more.
    """
    if not parts.mechanism.spec.is_turned or parts.mechanism.no_turn:
        return
    try:
        gap, name = parts.built.turn.smallest.mm, "gap_proved_mm"
        if gap < -parts.contact:
            return
        to_mm = to_mm or max(1e-3, 2.0 * parts.contact)
        found = certificate(parts, gap, to_mm)
    except GenevaError:  # the checks of the parts report the error
        return
    if not found.open:
        why = f"collision-free, proved to {1e3 * to_mm:.3g} µm ({found.intervals:,} intervals)"
        yield compared(name, found.least_mm, "at least", -to_mm)._replace(why=why)
        return
    start, end, known, least = found.open
    bound = "no bound is known" if least <= -0.5 * UNKNOWN else f"at least {least:.4g} mm"
    why = f"sampled collision check; the proof is open from {start:.9g} to {end:.9g}° between "
    why += f"{found.between}, after {found.intervals:,} intervals. There the gap is {known:.4g} mm "
    why += f"in the middle and {bound} throughout"
    check = unknown(name, why, "at least", -to_mm)
    if known < -max(to_mm, parts.contact):
        check = check._replace(value=known, at_deg=0.5 * (start + end), passes=False)
    yield check
