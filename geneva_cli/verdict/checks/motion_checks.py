"""The wheel's motion and its limits, gears in front of it, and the slots or groove of a law."""

from __future__ import annotations

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import greatest_jumps, worst, worst_of
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.arrays import value_or
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.verdict.checks.check import Check, compared
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT, turns_back


def shortest_dwell(name: str, mechanism: Mechanism) -> Check:
    """The shortest dwell, degrees of the input: below 0 a roller enters before another has left."""
    least = min(mechanism.dwell_deg(i) for i in range(len(mechanism.engagements)))
    return compared(name, least, "at least", 0.0)


def least_velocity(name: str, mechanism: Mechanism) -> Check | None:
    """The least velocity of a wheel that follows a law, 0 if it never turns back."""
    if mechanism.law is None:
        return None
    value, at_deg = turns_back(mechanism) or (0.0, None)
    return compared(name, value, "at least", 0.0, at_deg)


def limited_peak(name: str, mechanism: Mechanism) -> Check | None:
    """The peak, a derivative by the input's radians, that a key of ``[limits]`` bounds."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    if name == "acceleration_entry_max":
        value = worst(mechanism).ends.acceleration_entry
    elif name == "jerk_max":
        value = worst(mechanism).jerk.max
    else:
        value = worst_of(mechanism, name.removesuffix("_max")).max
    return compared(name, value, "at most", limit)


# Of the input's speed: real parts of a machine as derived do not enter more gently.
ENTRY_VELOCITY = 0.01


def entry_velocity_limit(mechanism: Mechanism) -> float:
    """Return the greatest jump of velocity at entry, over the input's speed, or its default.

    >>> entry_velocity_limit(Design(External(6)).mechanism)
    0.01
    """
    return value_or(mechanism.spec.limits.entry_velocity_max, ENTRY_VELOCITY)


def entry_velocity(name: str, mechanism: Mechanism) -> Check | None:
    """The greatest jump of the wheel's velocity at entry and exit, over the input's speed.

    A crank as built has a limit without one in the spec. It fails where the roller never crosses
    the axis of the slot at rest.
    """
    own = mechanism.engagements
    if mechanism.spec.limits.entry_velocity_max is None and not own[0].built:
        return None
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


def limited_time(name: str, mechanism: Mechanism) -> Check | None:
    """The shortest dwell, or the longest motion or cycle, seconds, that ``[limits]`` bounds."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    times = timings(mechanism)
    if name == "dwell_min_s":
        return compared(name, min(one.dwell_s for one in times), "at least", limit)
    longest = max(one.motion_s if name == "motion_max_s" else one.cycle_s for one in times)
    return compared(name, longest, "at most", limit)


def gear_convexity(name: str, mechanism: Mechanism) -> Check | None:
    """The least curvature of the driving or the driven gear."""
    gears = mechanism.spec.gears
    if not gears:
        return None
    from geneva_cli.parts.gears.gear_curves import convexity

    least = convexity(gears)[int(name.startswith("driven"))]
    return compared(name, least, "above", 0.0)


def pressure_angle(name: str, mechanism: Mechanism) -> Check | None:
    """The pressure angle of slots, below 90 degrees for curved ones if the spec sets no limit."""
    limit = mechanism.spec.limits.pressure_angle_max_deg
    if limit is None and not mechanism.engagements[0].slot.curved:
        return None
    from geneva_cli.verdict.quantities.batch_designs import number_of, single
    from geneva_cli.verdict.quantities.load_quantities import pressure

    peak, most = single(mechanism).columns(pressure), value_or(limit, 90.0)
    value, at_deg = number_of(peak["max_deg"], 0), number_of(peak["at_deg"], 0)
    # At 90 degrees nothing turns the wheel, whatever the limit.
    passes = keeps(value, "at most", most) and value < 90.0
    return Check(name, value, "at most", most, passes, at_deg=at_deg)


def driven_fraction(name: str, mechanism: Mechanism) -> Check | None:
    """The fraction of the motion in which a wall of a curved slot carries the load."""
    if not mechanism.spec.is_loaded:
        return None
    from geneva_cli.loads.positive_drive import positive_drives

    drives = positive_drives(mechanism)
    if drives is None:
        return None
    return compared(name, 1.0 - drives.fraction.item(), "above", 0.5)


def undercut_depth(name: str, mechanism: Mechanism) -> Check | None:
    """The depth of the undercut, mm; 0 if there is none."""
    if not mechanism.engagements[0].slot.curved:
        return None
    from geneva_cli.motion.undercut import undercut

    place = undercut(mechanism)
    depth, at_deg = (place.depth_mm, place.at_deg) if place else (0.0, None)
    return compared(name, depth, "at most", SHOWN_UNDERCUT, at_deg)


# A steeper groove wedges its roller on the crank, which friction of 0.58 would hold.
GROOVE_MAX_DEG = 60.0


def groove_pressure(name: str, mechanism: Mechanism) -> Check | None:
    """The greatest pressure angle in the groove."""
    groove = mechanism.engagements[0].groove
    if groove is None:
        return None
    from geneva_cli.parts.slots.groove import greatest_pressure

    value, at_deg = greatest_pressure(groove)
    limit = value_or(mechanism.spec.limits.pressure_angle_max_deg, GROOVE_MAX_DEG)
    input_deg = mechanism.spec.input_deg(at_deg)  # the groove is cut by the crank's angle
    return compared(name, value, "at most", limit, mechanism.shown_deg(input_deg))
