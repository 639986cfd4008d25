"""The wheel's motion and its limits, gears in front of it, and the slots or groove of a law."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.spec.tables import LIMITED
from geneva_cli.verdict.checks import Check, compared
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT, turns_back

# A steeper groove wedges its roller on the crank, which friction of 0.58 would hold.
GROOVE_MAX_DEG = 60.0
# Of the input's speed: real parts of a machine as derived do not enter more gently.
ENTRY_VELOCITY = 0.01


def motion(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """Dwells, convex gears, a law that turns back, and the groove of a cam."""
    spec, own = mechanism.spec, mechanism.engagements
    # the shortest dwell, degrees of the input: below 0 a roller enters before another has left
    least = min(map(mechanism.dwell_deg, range(len(own))))
    yield compared("dwell_deg", least, "at least", 0.0)
    if spec.gears:
        from geneva_cli.parts.gears.gear_curves import convexity

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
        from geneva_cli.verdict.quantities.batch_designs import number_of, single
        from geneva_cli.verdict.quantities.load_quantities import pressure

        peak = single(mechanism).columns(pressure)
        most = value_or(spec.limits.pressure_angle_max_deg, 90.0)
        value, at_deg = number_of(peak["max_deg"], 0), number_of(peak["at_deg"], 0)
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


def limits(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """Peaks, as derivatives by the input's radians, times, and loads that ``[limits]`` bounds."""
    bounds = mechanism.spec.limits.as_dict()
    for name in names:
        limit = bounds[name]
        # a crank as built has a limit of its velocity at entry without one in the spec
        if name == "entry_velocity_max" and (limit is not None or mechanism.engagements[0].built):
            yield _entry_velocity(name, mechanism)
        elif limit is None:
            continue
        elif name in ("velocity_max", "acceleration_max", "acceleration_entry_max", "jerk_max"):
            from geneva_cli.motion.peaks import worst, worst_of

            if name == "acceleration_entry_max":
                most = worst(mechanism).ends.acceleration_entry
            elif name == "jerk_max":
                most = worst(mechanism).jerk.max
            else:
                most = worst_of(mechanism, name.removesuffix("_max")).max
            yield compared(name, most, "at most", limit)
        elif name.endswith("_s"):
            from geneva_cli.motion.timing import timings

            key, is_least = name.replace("_max", "").replace("_min", ""), "_min" in name
            times = [getattr(one, key) for one in timings(mechanism)]
            value, must_be = (min(times), "at least") if is_least else (max(times), "at most")
            yield compared(name, value, must_be, limit)
        else:
            from geneva_cli.verdict.quantities.batch_designs import number_of, single
            from geneva_cli.verdict.quantities.load_quantities import greatest

            peaks, load = single(mechanism).columns(greatest), LIMITED[name].split(".")[1]
            most, at_deg = number_of(peaks[f"{load}.max"], 0), number_of(peaks[f"{load}.at_deg"], 0)
            yield compared(name, most, "at most", limit, at_deg)


def entry_velocity_limit(mechanism: Mechanism) -> float:
    """Return the greatest jump of velocity at entry, over the input's speed, or its default.

    >>> entry_velocity_limit(Design(External(6)).mechanism)
    0.01
    """
    return value_or(mechanism.spec.limits.entry_velocity_max, ENTRY_VELOCITY)


def _entry_velocity(name: str, mechanism: Mechanism) -> Check:
    """The greatest jump of the wheel's velocity at entry and exit, over the input's speed.

    It fails where the roller never crosses the axis of the slot at rest.
    """
    from geneva_cli.motion.peaks import greatest_jumps

    own = mechanism.engagements
    limit, jumps = entry_velocity_limit(mechanism), greatest_jumps(own)
    sizes = [abs(jump) for jump in jumps if jump is not None]
    if len(sizes) < len(jumps):
        why = (
            "the roller's centre does not cross the axis of the slot at rest inside the rim: it "
            "meets the wheel beside its slot, or misses it"
        )
        return Check(name, None, "at most", limit, False, why)
    end = own[0].entry_deg if sizes[0] >= sizes[1] else own[0].exit_deg
    at_deg = mechanism.shown_deg(own[0].mid_deg + end) if own[0].built else None
    return compared(name, max(sizes), "at most", limit, at_deg)
