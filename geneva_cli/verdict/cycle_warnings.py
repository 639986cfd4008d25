"""Warnings about a cycle: a wheel that drives the motor, lags or is unbalanced; unbounded loads."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from geneva_cli.errors import Notice
from geneva_cli.loads import highest_speed
from geneva_cli.loads.carried import weight_kg
from geneva_cli.loads.contact import contact
from geneva_cli.loads.cycle import Cycle, cycle_of
from geneva_cli.loads.cycle_quantities import FORCE, STRESS
from geneva_cli.loads.impacts.reversal import arrival
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_peaks import LoadSummary
from geneva_cli.loads.load_tables import summaries
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import braking
from geneva_cli.motion.peaks import worst
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.load_limits import limits_by_key, load_limits


def cycle_warnings(mechanism: Mechanism) -> list[Notice]:
    """Warnings about a loaded machine: loads without a bound, a wheel that drives or lags."""
    cycle = cycle_of(mechanism)
    sums = summaries(cycle)
    return [
        *_jammed(cycle),
        *_on_an_edge(cycle),
        *_no_speed(cycle),
        *_back_driven(cycle, sums),
        *_lags(mechanism),
        *_unbalanced(cycle, sums),
    ]


def back_driven_deg(cycle: Cycle) -> list[tuple[float, float]]:
    """The intervals of input angle, as shown, in which the wheel drives the input."""
    shown, out = cycle.mechanism.shown_deg, list[tuple[float, float]]()
    last = None
    for engagement, stretch in cycle.stretches:
        a, b = (engagement.mid_deg + x for x in stretch[:2])
        # Over less than 1e-4 of a motion, next to a rest, the sign is rounding.
        driven = stretch.feeds < 0.0 and b - a > 1e-4 * engagement.motion_deg
        if driven:  # where friction alone holds the wheel, it drives nothing
            at = contact(engagement, 0.5 * (stretch.start + stretch.end), 1, reactions=False)
            grip = Instant(cycle.case, at, stretch.drives, stretch.slides).grip
            driven = grip.scalars()[0] > 0.0
        if driven and last == a:
            out[-1] = out[-1][0], shown(b)
        elif driven:
            out.append((shown(a), shown(b)))
        last = b if driven else None
    return out


def _back_driven(cycle: Cycle, sums: Mapping[str, LoadSummary[float | None]]) -> Iterator[Notice]:
    torque, noun = sums["input_torque_Nm"], cycle.mechanism.output.noun
    # a torque without a bound is no measure of the rounding of another
    largest = sums["wheel_torque_Nm"].max if torque.max is None else torque.max
    least = torque.min
    if least is None or not least < -ROUNDED * abs(largest or least):
        return
    driven = back_driven_deg(cycle)
    if not driven:
        return
    each = [f"{round(a, 9):.4g} to {round(b, 9):.4g}" for a, b in driven]
    more = len(each) - 6  # a line or two; a carousel may have many
    where = ", ".join(each if more <= 0 else each[:6])
    rest = f" and in {more} other intervals" if more > 0 else ""
    # what brakes the wheel alone at its greatest deceleration
    braked_Nm = max(cycle.case.inertia_Nm * braking(one) for one in cycle.mechanism.engagements)
    brake = f"a resisting torque of {braked_Nm:.4g} N m"
    if not cycle.mechanism.output.turns:
        brake = f"a resisting force of {braked_Nm / cycle.case.L:.4g} N"
    helps = f"or add a drag to the {noun} (with {brake} in all, the input always drives)"
    if arrival(cycle.mechanism):
        helps = "but no drag on the wheel, which would take it off the roller that stops it"
    if cycle.case.frame:
        helps = "as no drag on the wheel stops it from pushing the carrier"
    yield Notice(
        "drives-the-motor",
        f"the {noun} drives the motor from {where}°{rest}, with up to {-least:.4g} N m on "
        "the input. There the play of slot and reducer changes sides, and a self-locking worm "
        f"jams: use a brake or a motor that brakes, {helps}",
    )


def _lags(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning if the wheel leaves the roller that stops it, and meets it again."""
    stop = arrival(mechanism)
    if stop is None or stop.lag is None:
        return
    lag, at_deg, struck = stop.lag
    yield Notice(
        "lags-behind",
        f"a torque of {stop.torque_Nm:.4g} N m takes the wheel off the roller that stops it. "
        f"Once the gears let go the wheel lags, by up to {lag:.4g}° at {at_deg:.4g}°, "
        f"and the roller strikes it at {struck:.4g}°. Less torque, more inertia or more "
        "speed reduces the lag",
    )


def _unbalanced(cycle: Cycle, sums: Mapping[str, LoadSummary[float | None]]) -> Iterator[Notice]:
    """A warning about single bodies off the wheel's axis, whose force its shaft bears.

    Behind gears another shaft bears it.
    """
    spec = cycle.mechanism.spec
    bodies = [one for one in spec.mass if one.to_one_side]
    if not bodies or spec.support.gear_ratio != 1.0:
        return
    peaks = worst(cycle.mechanism)
    # at most: the peaks need not coincide, nor the bodies stand on one side
    most = omega(spec.drive.n_rpm) ** 2 * math.hypot(peaks.velocity.max**2, peaks.acceleration.max)
    force = most * sum(weight_kg(one) * one.radius_mm * 1e-3 for one in bodies)
    bearing = sums["wheel_bearing_N"].max
    if bearing is None or force < 0.01 * bearing:
        return
    names = " and ".join(one.name or one.shape for one in bodies)
    stand = "stands" if len(bodies) == 1 else "stand"
    yield Notice(
        "unbalanced",
        f"{names} {stand} off the wheel's axis. While the wheel moves, bearing and shaft hold up "
        f"to {force:.4g} N for that, which is not counted: balance it with another body "
        "(count = 2)",
    )


def _jammed(cycle: Cycle) -> Iterator[Notice]:
    force, case = cycle.extremes[FORCE], cycle.case
    endless = [
        at
        for at, value in ((force.max_at_deg, force.max), (force.min_at_deg, force.min))
        if math.isinf(value)
    ]
    if not case.all_friction or not endless:
        return
    when = f"at {min(endless):.4g}°, however hard the roller presses"
    text = (
        f"friction of {case.friction:g} holds the wheel {when}: it takes as much torque as the "
        "wall gives. Use a smaller roller or less friction"
    )
    if case.guided:  # the slot's friction is across the travel, and holds nothing
        held = cycle.mechanism.output.noun
        text = (
            f"friction of {case.guide_friction:g} in the guide holds the {held} {when}: it takes "
            "as much force as the roller gives. Use a smaller roller or less guide_friction"
        )
    yield Notice("friction-holds-the-wheel", text)


def _on_an_edge(cycle: Cycle) -> Iterator[Notice]:
    stress, force = cycle.extremes.get(STRESS), cycle.extremes[FORCE]
    if stress is None:
        return
    if math.isfinite(stress.max) or math.isinf(force.max) or math.isinf(force.min):
        return
    yield Notice(
        "sharp-wall",
        f"the contact stress has no bound at {stress.max_at_deg:.4g}°: the roller bears on an "
        "edge there, where the undercut of the wall begins. A smaller roller bears on less of "
        'it; straight slots have none (kind = "cam" drives any law)',
    )


def _no_speed(cycle: Cycle) -> Iterator[Notice]:
    """A warning if no speed keeps the limits on loads."""
    mechanism, limits = cycle.mechanism, cycle.mechanism.spec.limits
    bounds = load_limits(limits)
    keeps = bounds.keys() <= cycle.extremes.keys() and all(
        max(cycle.extremes[name].max, -cycle.extremes[name].min) <= limit
        for name, limit in bounds.items()
    )
    # the search for a speed is needed only if the present one breaks a limit
    if keeps or highest_speed.fastest_rpm(mechanism) is not None:
        return
    broken = " and ".join(f"{key} = {limit:g}" for key, limit in limits_by_key(limits).items())
    turns = mechanism.output.turns
    resisting, key = ("torque", "torque_Nm") if turns else ("force", "force_N")
    yield Notice(
        "no-speed",
        f"no speed keeps {broken}, so there is no shortest motion: the resisting {resisting} "
        f"alone exceeds it, or nothing bounds the load. Use a larger machine or less {key}",
    )
