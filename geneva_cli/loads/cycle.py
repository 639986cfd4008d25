"""The whole cycle under load: states at any input angle, extremes and integrals.

The cycle is a period of the machine from the first entry: every engagement, and the dwells between.
With several wheels on a carrier it ends at the entry of the next wheel.
All loads are 0 in a dwell: nothing moves, the lock holds the wheel, and resistance to motion does
not act at rest.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import contact, contacts
from geneva_cli.loads.cycle_quantities import (
    KINETIC,
    known_quantities,
    multiples,
    plain_of,
    sources,
)
from geneva_cli.loads.forces import Contact, LoadCase, is_loaded, wheel_torque
from geneva_cli.loads.instant import INSTANT_QUANTITIES, Instant, bounded, bounded_loads, values
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions
from geneva_cli.loads.load_peaks import search_loads, shown_deg, sums_of
from geneva_cli.loads.load_summary import EngagementExtremes, LoadSummary, summaries_from
from geneva_cli.loads.stretches import Stretch, refuse_noise, refuse_rounding, to_mid_motion, whole
from geneva_cli.motion.engagement import Engagement, Peak
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Whole, array
from geneva_cli.numerics.extremes import SearchResult, first_greatest
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.quadrature import Integrands, span_integrals

Integrand: TypeAlias = "Callable[[Instant[Array]], Array]"  # of values, at many angles


class Cycle:
    """A machine under its load, over one period.

    ``case`` are the data that the loads depend on besides the motion. All values are exact to some
    units in the last place of a quantity's peak; none is taken from samples.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism.under_load
        self.case: LoadCase = load_case(mechanism)

    @property
    def is_loaded(self) -> bool:
        """Return True if an inertia or a resisting torque is known."""
        return self.mechanism.spec.is_loaded

    @property
    def period(self) -> float:
        """Input angle of the period, radians."""
        return self.mechanism.period_deg * DEGREE

    def states(self, input_deg: Array) -> Instant[Array]:
        """Arrays at ascending input angles of a period from the first entry; 0 in the dwells.

        A force without a bound is infinite. It is so where friction alone holds the wheel, and at
        mid-motion of a curved slot that lies across the roller's path.
        """
        from geneva_cli.motion.motion_table import local_deg, spans

        out: dict[str, Array | None] = {
            name: np.zeros(len(input_deg)) for name in INSTANT_QUANTITIES
        }
        for span in spans(self.mechanism, input_deg):
            local = local_deg(span, input_deg)
            if not len(local):
                continue
            for name, row in self.moving(span.engagement, local).quantities().items():
                total = out[name]
                if row is None or total is None:
                    out[name] = None
                else:
                    total[span.moves] = row
        return Instant.known(out)

    def moving(self, engagement: Engagement, input_deg: Array) -> Instant[Array]:
        """Arrays (n,) at input angles of an engagement, degrees from its own mid-motion."""
        from geneva_cli.loads.mid_motion import at_crossing

        at = contacts(engagement, input_deg)
        moving_values = bounded_loads(self.case, at, self._drives(engagement, input_deg, at))
        middle = input_deg == 0.0
        limits = at_crossing(engagement, self.case) if middle.any() else None
        if limits is None:
            return moving_values
        every = dict[str, object](moving_values.quantities())
        for name, limit in limits.items():
            every[name] = np.where(middle, limit, getattr(moving_values, name))
        return Instant.known(every)

    def _drives(self, engagement: Engagement, input_deg: Array, at: Contact[Array]) -> Array:
        """Signs of the wheel's torque; where it is 0, that before, or at entry that after."""
        torque = array(wheel_torque(self.case, at))
        drives = np.copysign(1.0, torque)
        none = np.flatnonzero(~is_loaded(self.case, engagement, torque))
        if len(none):
            x, step = input_deg[none], 1e-6 * engagement.motion_deg
            near = np.where(x - step < engagement.entry_deg, x + step, x - step)
            drives[none] = np.copysign(1.0, wheel_torque(self.case, contacts(engagement, near)))
        return drives

    def along(self, engagement: Engagement, stretch: Stretch, input_deg: Array) -> Instant[Array]:
        """Arrays (n,) at input angles of a stretch, degrees from its engagement's mid-motion.

        The signs are the stretch's, so that its ends have the limits from inside.
        """
        with np.errstate(all="ignore"):
            at = contacts(engagement, input_deg)
            return bounded(Instant(self.case, at, stretch.drives, stretch.slides, stretch.feeds))

    def plain(self, states: Instant[Array], name: str) -> Array:
        """Return a quantity of ``known``, or a multiple of one, at states of the cycle."""
        source, factor, _ = multiples(self.mechanism).get(name, (name, 1.0, ""))
        assert factor is not None  # known quantities have a factor
        return plain_of(states, source) * factor

    @cached_property
    def _searches(self) -> list[tuple[LoadFunctions, SearchResult]]:
        """For each engagement, the search for the extremes of known quantities, and its cuts."""
        refuse_rounding(self.mechanism.engagements)
        names, out = [*known_quantities(self.mechanism), KINETIC], []
        for engagement in self.mechanism.engagements:
            load = LoadFunctions(engagement, self.case, names, more=("slides", "feeds"))
            out.append((load, search_loads(load)))
        return out

    @cached_property
    def known(self) -> Mapping[str, LoadSummary[Array]]:
        """The summaries of all quantities that have a value, (1,) each."""
        searched, known = known_quantities(self.mechanism), sources(self.mechanism)
        names = [*searched, KINETIC, *known]
        each = [
            EngagementExtremes(
                result.most,
                shown_deg(self.mechanism, load.engagement, result.x),
                sums_of(load, result, plain=True),
            )
            for load, result in self._searches
        ]
        refuse_noise([one.total for one in each])
        every = summaries_from(self.mechanism, names, each, plain=True)
        return {name: every[name] for name in (*known, KINETIC)}

    @cached_property
    def peaks(self) -> list[tuple[float, float, float]]:
        """Each engagement's greatest velocity, acceleration and product of both, as invariants."""
        w, out = self.case.speed_rad_s, []
        for load, result in self._searches:
            most = result.most.reshape(2, -1).max(axis=0)
            places = [load.names.index(n) for n in ("omega_rad_s", "alpha_rad_s2", KINETIC)]
            v, a, p = (float(most[place]) / w**k for k, place in enumerate(places, 1))
            out.append((v, a, p))
        return out

    @cached_property
    def extremes(self) -> Mapping[str, LoadSummary[float]]:
        """The summaries of all quantities that have a value, as numbers."""
        return {
            name: LoadSummary._make(row if row is None else row.item() for row in one)
            for name, one in self.known.items()
        }

    def integrals(self, *of: Integrand) -> list[float]:
        """The integral of each function over a period by the input angle in radians.

        For a torque it is work in joules; divided by ``period``, it is a mean over the cycle. The
        integral of an unbounded function is infinite.
        """
        total = np.zeros((len(of), 1))
        for engagement in self.mechanism.engagements:
            pieces = [piece for owner, piece in self.stretches if owner is engagement]
            start, end, *signs = np.array(pieces).T

            def rows(
                x: Array,
                which: Whole,
                engagement: Engagement = engagement,
                signs: list[Array] = signs,
            ) -> Array:
                at = contact(engagement, x)
                here = values(Instant(self.case, at, *(sign[which, None] for sign in signs)))
                return np.stack([np.broadcast_to(f(here), x.shape) for f in of])

            one = np.zeros(len(pieces), dtype=int)
            needed = np.full(total.shape, True)
            with np.errstate(all="ignore"):
                total += span_integrals(Integrands(rows, start, end, ends=True), one, needed)
        refuse_noise([total])
        return [float(x) for x in total[:, 0] * DEGREE]

    @cached_property
    def stretches(self) -> list[tuple[Engagement, Stretch]]:
        """The motions, divided at breaks and where torque, sliding or input torque change sign."""
        out = []
        for load, result in self._searches:
            engagement = load.engagement
            pieces = to_mid_motion(engagement, result.stretches, 1)
            out += [(engagement, one) for one in whole(engagement, self.case, load.kinds, pieces)]
        return out


@lru_cache(maxsize=16)
def cycle_of(mechanism: Mechanism) -> Cycle:
    """The cycle of a machine, cached for its loads, strength and warnings."""
    return Cycle(mechanism)


def greatest(mechanism: Mechanism, name: str) -> Peak[float]:
    """The greatest size of a quantity of the cycle, and its first input angle in degrees.

    Without a load it is 0.
    """
    one = cycle_of(mechanism).extremes.get(name)
    if one is None:
        return Peak(0.0, 0.0)
    first = mechanism.engagements[0]
    whole = mechanism.under_load.whole_deg
    start = first.mid_deg + first.entry_deg - 1e-9  # less the rounding of an input angle
    ends = [(one.max, one.max_at_deg), (-one.min, one.min_at_deg)]
    ends.sort(key=lambda end: (end[1] - start) % whole)
    value, place = np.array(ends).T[..., None]
    most, at_deg = first_greatest(value, place, np.zeros(1))
    return Peak(float(most[0]), float(at_deg[0]))
