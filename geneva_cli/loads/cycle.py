"""The whole cycle under load: states at any input angle, extremes, and what they warn of.

The cycle is a period of the machine from the first entry; with several wheels on a carrier it ends
at the entry of the next wheel. All loads are 0 in a dwell.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.kept import cached_property
from geneva_cli.loads import load_functions
from geneva_cli.loads.contact import NEGLIGIBLE, LoadCase, contact, plain_values
from geneva_cli.loads.impacts.reversal import arrival
from geneva_cli.loads.instant import QUANTITIES, Instant, bounded
from geneva_cli.loads.load_case import load_case, sources, weight_kg
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries, only
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import retraces
from geneva_cli.motion.peak_search import braking
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import ROUNDED


class Stretch(NamedTuple):
    """Input angles between which the loads are smooth, and the signs that they have there."""

    start: float
    end: float
    drives: float  # sign of the wheel's torque
    slides: float  # sign of the sliding
    feeds: float  # sign of the input's torque: 1 if it drives the machine, -1 if it is driven


class Cycle:
    """A machine under its load, over one period, to some units in the last place of a peak."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.machine, self.mechanism = mechanism, mechanism.under_load
        self.case: LoadCase = load_case(mechanism)

    @property
    def is_loaded(self) -> bool:
        """True if an inertia or a resisting torque is known."""
        return self.mechanism.spec.is_loaded

    @cached_property
    def sources(self) -> Mapping[str, tuple[str, float]]:
        """Each known quantity by name: the one that is computed for it, and its ratio to that."""
        return sources(self.mechanism)

    def states(self, input_deg: Array, names: Sequence[str]) -> Array:
        """Known quantities, (names, n), at ascending input angles of a period; 0 in the dwells."""
        from geneva_cli.motion.motion_table import spans

        out = np.zeros((len(names), len(input_deg)))
        for span in spans(self.mechanism, input_deg):
            if len(span.local):
                out[:, span.moves] = self.moving(span.engagement, span.local, names)
        return out

    def moving(
        self, engagement: Engagement, x: Array, names: Sequence[str], stretch: Stretch | None = None
    ) -> Array:
        """Known quantities, (names, n), at input angles x of an engagement from its mid-motion.

        The pin's force has the sign of the wall that bears. The signs are those of a ``stretch``,
        or of the stretch in which each angle is.
        """
        with np.errstate(all="ignore"):
            at = contact(engagement, x)
            here = Instant(self.case, at, *(stretch[2:] if stretch else self._signs(engagement, x)))
            each = [self.sources.get(name, (name, 1.0)) for name in names]  # or of a pinion
            signed = {"pin_force_N": "wall_force_N"}
            sought = [QUANTITIES[signed.get(source, source)] for source, _ in each]
            rows = [bounded(here, quantity) for quantity in sought]
            # the limits where the pin crosses the slot without a torque
            middle = np.flatnonzero(x == 0.0)
            crosses = engagement.slot.curved and not retraces(engagement)
            if len(middle) and crosses:
                for i, _, limit in load_functions.at_mid_motion(engagement, self.case, sought, 1):
                    if np.isfinite(limit[0]) and not np.isfinite(rows[i][middle[0]]):
                        rows[i][middle] = limit
        both = zip(rows, each, strict=True)
        values = [plain_values(row, source) * ratio for row, (source, ratio) in both]
        return np.array(np.broadcast_arrays(*values, x)[:-1])

    def _signs(self, engagement: Engagement, x: Array) -> Array:
        """The signs (3, n) at input angles x: at a change of sign those before it."""
        own = [stretch for owner, stretch in self.stretches if owner is engagement]
        rounding = NEGLIGIBLE * engagement.motion_deg
        number = np.searchsorted([stretch.end for stretch in own[:-1]], x - rounding)
        signs: Array = np.array(own)[number, 2:].T
        return signs

    @cached_property
    def extremes(self) -> Mapping[str, LoadSummary[float]]:
        """The summaries of all quantities that have a value."""
        every = load_summaries(self.machine, [*sources(self.machine)])
        load_functions.refuse_noise([one.rms for one in every.values()])
        return {name: only(one) for name, one in every.items()}

    @cached_property
    def ends(self) -> Mapping[str, LoadSummary[float]]:
        """The same without mean and rms, which take longest."""
        every = load_summaries(self.machine, [*sources(self.machine)], means=False)
        return {name: only(one) for name, one in every.items()}

    @cached_property
    def stretches(self) -> list[tuple[Engagement, Stretch]]:
        """The motions, divided at breaks and where torque, sliding or input torque change sign."""
        out = []
        for engagement in self.mechanism.engagements:
            kinds = "drives", "slides", "feeds"
            load = load_functions.LoadFunctions(engagement, self.case, kinds=kinds)
            found = load.stretches()
            ends = load_functions.on_breaks(found.x[1], engagement)
            cuts = [engagement.entry_deg, *ends[:-1].tolist(), engagement.exit_deg]
            signs = np.where(found.positive, 1.0, -1.0).T.tolist()
            for (start, end), own in zip(pairwise(cuts), signs, strict=True):
                if start < end:
                    out.append((engagement, Stretch(start, end, *own)))
        return out


# The cycle of a machine, cached for its loads, strength and warnings.
cycle_of = lru_cache(maxsize=16)(Cycle)


def cycle_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about a loaded machine: loads without a bound, a wheel that drives or lags."""
    cycle = cycle_of(mechanism)
    case, force = cycle.case, cycle.ends["pin_force_N"]
    value, at_deg = np.reshape(force[:4], (2, 2)).T
    endless_deg = at_deg[np.isinf(value)].min(initial=math.inf)
    if case.all_friction and endless_deg < math.inf:
        held, of, more, less = "wheel", f"{case.friction:g}", "torque as the wall", "friction"
        if case.guide and case.guided:  # the slot's friction holds nothing: it is across the travel
            held, of = cycle.mechanism.output.noun, f"{case.guide.friction:g} in the guide"
            more, less = "force as the roller", "guide_friction"
        yield Notice(
            "friction-holds-the-wheel",
            f"friction of {of} holds the {held} at {endless_deg:.4g}°, however hard the roller "
            f"presses: it takes as much {more} gives. Use a smaller roller or less {less}",
        )
    stress = cycle.ends.get("contact_stress_MPa")
    if stress is not None and not math.isfinite(stress.max) and endless_deg == math.inf:
        yield Notice(
            "sharp-wall",
            f"the contact stress has no bound at {stress.max_at_deg:.4g}°: the roller bears on an "
            "edge there, where the undercut of the wall begins. A smaller roller bears on less of "
            'it; straight slots have none (kind = "cam" drives any law)',
        )
    yield from _driven(cycle)
    if mechanism.spec.unbalanced:
        yield from _unbalanced(cycle)


def _driven(cycle: Cycle) -> Iterator[Notice]:
    """Warnings about a wheel that drives the motor, or lags behind its roller."""
    mechanism, ends = cycle.mechanism, cycle.ends
    torque, noun = ends["input_torque_Nm"], mechanism.output.noun
    stop = arrival(mechanism) if mechanism.engagements[0].paired else None
    least, largest = torque.min, max(abs(torque.max), abs(torque.min))
    # a torque without a bound is no measure of the rounding of another
    if math.isinf(largest):
        largest = abs(ends["wheel_torque_Nm"].max) if "wheel_torque_Nm" in ends else 0.0
    fed = math.isfinite(least) and least < -ROUNDED * (largest or abs(least))
    driven = back_driven_deg(cycle) if fed else []
    if driven:
        each = [f"{round(a, 9):.4g} to {round(b, 9):.4g}°" for a, b in driven]
        where = ", ".join(each[:4])
        where += f" and in {len(each) - 4} other intervals" if len(each) > 4 else ""
        # what brakes the wheel alone at its greatest deceleration
        braked_Nm = max(cycle.case.inertia_Nm * braking(one) for one in mechanism.engagements)
        brake = f"a resisting torque of {braked_Nm:.4g} N m"
        if not mechanism.output.turns:
            brake = f"a resisting force of {braked_Nm / cycle.case.L:.4g} N"
        helps = f"or add a drag to the {noun} (with {brake} in all, the input always drives)"
        if stop or cycle.case.frame:
            helps = "as a drag on the wheel does not help here"
        yield Notice(
            "drives-the-motor",
            f"the {noun} drives the motor from {where}, with up to {-least:.4g} N m on "
            "the input. There the play of slot and reducer changes sides, and a self-locking worm "
            f"jams: use a brake or a motor that brakes, {helps}",
        )
    if stop and 0.0 < stop[0] <= stop[1]:
        yield Notice(
            "lags-behind",
            f"a torque of {stop[0]:.4g} N m takes the wheel off the roller that stops it: once the "
            "gears let go the wheel lags, and the roller strikes it. Less torque, more inertia or "
            "more speed reduces the lag",
        )


def _unbalanced(cycle: Cycle) -> Iterator[Notice]:
    """A warning about single bodies off the wheel's axis, whose force its shaft bears."""
    spec, bearing = cycle.mechanism.spec, cycle.ends.get("wheel_bearing_N")
    bodies = [one for one in spec.mass if one.to_one_side]
    # on a carrier the loads count that force; behind gears another shaft bears it
    held = bearing is not None and math.isfinite(bearing.max) and not cycle.case.frame
    if bearing and held and spec.support.gear_ratio == 1.0:
        from geneva_cli.motion.peaks import worst

        peaks = worst(cycle.mechanism)
        # at most: the peaks need not coincide, nor the bodies stand on one side
        most = math.hypot(peaks.velocity.max**2, peaks.acceleration.max)
        off_kgm = sum(weight_kg(one) * one.radius_mm * 1e-3 for one in bodies)
        force_N = omega(spec.drive.n_rpm) ** 2 * most * off_kgm
        names = " and ".join(one.name or one.shape for one in bodies)
        if force_N >= 0.01 * bearing.max:
            yield Notice(
                "unbalanced",
                f"{names} stand{'s' * (len(bodies) == 1)} off the wheel's axis. While the wheel "
                f"moves, bearing and shaft hold up to {force_N:.4g} N for that, which is not "
                "counted: balance it with another body (count = 2)",
            )


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
            grip = Instant(cycle.case, at, *stretch[2:]).grip
            driven = grip.derivatives()[0] > 0.0
        if driven and last == a:
            out[-1] = out[-1][0], shown(b)
        elif driven:
            out.append((shown(a), shown(b)))
        last = b if driven else None
    return out
