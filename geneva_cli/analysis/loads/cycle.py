"""The whole cycle under load: its states at any input angle, its extremes, and its integrals.

It is a period of the machine, from the first entry: every engagement, and the dwells between. In a
dwell all loads are 0: nothing moves, the lock holds the wheel, and resistance to motion does not
act at rest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.contact import contact, contacts
from geneva_cli.analysis.loads.forces import Row, Setting, gain, setting, sliding
from geneva_cli.analysis.loads.instant import NAMES, Instant, bounded, values
from geneva_cli.analysis.loads.mid_motion import at_crossing
from geneva_cli.analysis.loads.peaks import looked
from geneva_cli.analysis.loads.stretches import Stretch, cusps, stretches, whole
from geneva_cli.analysis.motion import local_deg, spans
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Jet, Number, V
from geneva_cli.numerics.quadrature import integrals

if TYPE_CHECKING:
    from geneva_cli.analysis.loads.contact import Contact
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array
    from geneva_cli.numerics.scan import Scan

Integrand: TypeAlias = "Callable[[Instant[Array]], Array]"  # of values, at many angles

# The integral of a cubic from 0 to 1 by its values at AHEAD (Adams and Bashforth), next to a cusp.
AHEAD, SHARES = np.array([1.0, 2.0, 3.0]), np.array([23.0, -16.0, 5.0]) / 12.0


class Quantity(Protocol):
    """A quantity as a function of an instant, of jets or of their values."""

    def __call__(self, i: Instant[V], /) -> Row[V]:
        """The quantity, and what bounds it."""


class Extremes(NamedTuple):
    """The greatest and least value over the motions, and their input angles as they are shown.

    A value is infinite where nothing bounds it.
    """

    max: float
    max_at_deg: float
    min: float
    min_at_deg: float


class Cycle:
    """A machine under its load, over one period.

    ``given`` is what the loads depend on besides the motion. All values are exact to some units in
    the last place of a quantity's peak; none is taken from samples.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.given: Setting = setting(mechanism)
        # of each engagement, by name, as ``ends_of`` looks for them; and the samples for it
        self.found: dict[str, list[Extremes]] = {}
        self.samples: dict[str, list[Scan]] = {}

    @property
    def is_loaded(self) -> bool:
        """Whether an inertia or a resisting torque is known."""
        return not all_true((self.given.inertia_Nm == 0.0) & (self.given.resists_Nm == 0.0))

    @property
    def period(self) -> float:
        """Input angle of the period, radians."""
        return self.mechanism.period_deg * DEGREE

    def states(self, input_deg: Array) -> Instant[Array]:
        """Arrays at ascending input angles of a period from the first entry; 0 in the dwells.

        Infinite where nothing bounds a force: where friction alone holds the wheel, and at
        mid-motion of a curved slot that lies across the roller's path.
        """
        out: dict[str, Array | None] = {name: np.zeros(len(input_deg)) for name in NAMES}
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
        given, at = self.given, contacts(engagement, input_deg)
        torque = at.acceleration * given.inertia_Nm + given.resists_Nm
        drives = np.copysign(1.0, torque)
        slides = np.copysign(1.0, sliding(at, drives, given.radius))
        feeds = np.copysign(1.0, drives * gain(given, at, drives, slides))
        with np.errstate(all="ignore"):
            found = bounded(Instant(given, at, drives, slides, feeds))
        middle = input_deg == 0.0
        limits = at_crossing(engagement, given) if middle.any() else None
        if limits is None:
            return found
        every = dict[str, object](found.quantities())
        for name, limit in limits.items():
            every[name] = np.where(middle, limit, getattr(found, name))
        return Instant.known(every)

    def along(self, engagement: Engagement, stretch: Stretch, input_deg: Array) -> Instant[Array]:
        """Arrays (n,) at input angles of a stretch, degrees from its engagement's mid-motion.

        The signs are the stretch's, so that its ends have the limits from inside.
        """
        with np.errstate(all="ignore"):
            at = contacts(engagement, input_deg)
            return bounded(Instant(self.given, at, stretch.drives, stretch.slides, stretch.feeds))

    def look(self, quantities: Mapping[str, Quantity]) -> None:
        """Search the extremes of each quantity over each motion, without the dwells."""
        every: list[list[Extremes]] = [[] for _ in quantities]
        scans = []
        for engagement in self.mechanism.engagements:
            both = self._both_ways(list(quantities.values()))
            found, scan = looked(engagement, self.given, both, -math.inf)
            scans.append(scan)
            for most, least, of in zip(found[::2], found[1::2], every, strict=True):
                at, bt = (
                    self.mechanism.shown_deg(engagement.mid_deg + one.at_deg)
                    for one in (most, least)
                )
                of.append(Extremes(most.max, at, -least.max, bt))
        for row, (name, ends) in enumerate(zip(quantities, every, strict=True)):
            self.found[name] = ends
            self.samples[name] = [scan.row(2 * row) for scan in scans]

    def _both_ways(
        self, quantities: Sequence[Quantity]
    ) -> Callable[[Contact[Jet], Number, Number, Number], list[Row[Jet]]]:
        """Two rows a quantity: it and its negative, whose maxima are its two extremes."""

        def rows(at: Contact[Jet], drives: Number, slides: Number, feeds: Number) -> list[Row[Jet]]:
            found = Instant(self.given, at, drives, slides, feeds)
            out = []
            for quantity in quantities:
                row = quantity(found)
                out += [row, Row(-row.value, row.room, -row.way)]
            return out

        return rows

    def integrals(self, *of: Integrand) -> list[float]:
        """The integral of each function over a period by the input angle in radians.

        Of a torque it is a work in joules; divided by ``period``, a mean over the cycle. Infinite
        where the function is too near to a place without a bound.
        """
        total = [0.0] * len(of)
        for engagement in self.mechanism.engagements:
            pieces = stretches(engagement, self.given)
            signs = np.array([piece[2:] for piece in pieces]).T

            def rows(
                x: Array, span: Whole, engagement: Engagement = engagement, signs: Array = signs
            ) -> list[Array]:
                here = values(Instant(self.given, contact(engagement, x), *signs[:, span]))
                return [f(here) for f in of]

            found = integrals(rows, [(p.start, p.end) for p in pieces])
            for number, near in cusps(engagement, pieces):
                beside = rows(near * AHEAD, np.full(len(AHEAD), number))
                gap = [abs(near) * float(np.dot(SHARES, row)) for row in beside]
                found = [a + b for a, b in zip(found, gap, strict=True)]
            total = [a + b * DEGREE for a, b in zip(total, found, strict=True)]
        return total

    @cached_property
    def stretches(self) -> list[tuple[Engagement, Stretch]]:
        """The motions cut where torque, sliding or the input's torque change sign, or break."""
        return [
            (engagement, stretch)
            for engagement in self.mechanism.engagements
            for stretch in whole(engagement, self.given)
        ]


@lru_cache(maxsize=16)
def cycle_of(mechanism: Mechanism) -> Cycle:
    """The cycle of a machine, cached for its loads, strength and cautions."""
    return Cycle(mechanism)
