"""Loads of a batch of one engagement, as functions for searches and sums.

They have a kink or a jump where a sign changes, and at breaks of the motion itself. At mid-motion
of curved slots, where the pin reverses in a cusp of its pitch curve or crosses the radius, slopes
are lost to rounding: there the loads are known by themselves.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from typing import TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.contact import NEAR_CUSP, NEGLIGIBLE, LoadCase, contact
from geneva_cli.loads.instant import NO_FUNCTIONS, QUANTITIES, Instant, LoadQuantity, sign_of
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.path_and_slot import retraces
from geneva_cli.motion.peak_search import pole_deg, spans
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Which, Whole, all_true, array
from geneva_cli.numerics.cuts import Asked, Held
from geneva_cli.numerics.extremes import Known, SearchResult, Stretches, cuts, search
from geneva_cli.numerics.jet import Array, Jet, Number

# The functions whose signs matter, in order: each is smooth while those before it keep their signs.
SIGN_FUNCTIONS = {
    "drives": attrgetter("wheel_torque_Nm"),
    "slides": attrgetter("slip"),
    "feeds": attrgetter("feeding"),
    "grip": attrgetter("grip"),
    "leans": attrgetter("leaning"),
    "edge": attrgetter("edge"),
    "along": attrgetter("at.along"),
}
MARGINS = ("grip", "edge")  # where one of them is not above 0, a quantity is unbounded
# values at an instant, whose quantities are those of ``LoadFunctions``
Integrands: TypeAlias = Callable[[Instant, Sequence[LoadQuantity]], Sequence[Array]]


class LoadFunctions:
    """Designs of one engagement under their load, with the functions that ``search`` takes."""

    def __init__(
        self,
        engagement: Engagement,
        case: LoadCase,
        names: Sequence[str] = (),
        own: Mapping[str, LoadQuantity] = NO_FUNCTIONS,
        more: Sequence[str] = (),
        kinds: Sequence[str] = (),
    ) -> None:
        """Of known quantities by their names, and of functions, which may hold numbers of designs.

        Signs that matter are those of ``kinds``; or else those of the load, and ``more``.
        """
        self.engagement, self.case, self.names = engagement, case, (*names, *own)
        self.n = np.size(case.design)
        matters = {
            "drives": not all_true(case.inertia_Nm == 0.0),
            # p v is 0 where the sliding is, in a notch that may be near a pole
            "slides": case.rubs or "pv_W_m2" in names,
            "feeds": not all_true(case.efficiency == 1.0),
            "grip": case.rubs or case.guided,
            "leans": case.guided,
            "edge": engagement.slot.curved and case.hertz is not None,
        }
        every = *SIGN_FUNCTIONS, "wanted"
        own_kinds = [kind for kind in every if matters.get(kind) or kind in more]
        self.kinds = [*kinds] or own_kinds
        self.signs, self.wanted = len(self.kinds), len(self.names)
        self.poled: Sequence[int] = (self.kinds.index("edge"),) if "edge" in self.kinds else ()
        # where links carry the roller, bearings and guide need the reactions of joints
        joints = bool(own) or "crank_bearing_N" in names or "guide_force_N" in names
        self.reactions = joints and engagement.reactions is not None
        self.quantities = [*map(QUANTITIES.__getitem__, names), *own.values()]
        self._every = engagement, case, self.quantities
        self._some = selection(self._every) if self.n > 1 else None

        # Ends of the smooth parts of the motion, one after the other: (n, 1) each
        self.spans: list[tuple[Array, Array]] = []
        for start, end in spans(engagement.motion, self.n):
            if engagement.slot.curved:  # those next to mid-motion begin at the least double
                start = np.where(abs(start) <= 1e-300, NEAR_CUSP * engagement.exit_deg, start)
                end = np.where(end == 0.0, NEAR_CUSP * engagement.entry_deg, end)
            self.spans.append((start, end))

        # Approximate distance from mid-motion of the nearest pole of the loads, degrees: (n, 1).
        # Near mid-motion a velocity is as v / (1 + x²/w²), a wall's lever as l sqrt(1 + x²/w²).
        # Where friction holds a lever that vanishes there, w is the distance at which it no longer
        # does. Not at mid-motion itself, where a curved slot may have no slopes:
        x = 0.01 * array(engagement.exit_deg)
        _, _, lever, offset, *_ = at = contact(engagement, x, 2, reactions=False)
        with np.errstate(all="ignore"):
            w = np.fmin(pole_deg(at.velocity), math.sqrt(0.5) * pole_deg(lever))
            if case.rubs:
                grip = np.abs(lever.c[0]) + case.friction * np.abs(offset.c[0])
                w = np.fmin(w, array(grip) / np.abs(lever.c[1]) / DEGREE)
        # ten half motions: samples of a function without poles are not spread
        w = np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * engagement.exit_deg)
        self.spread: Array = np.broadcast_to(w, (self.n, 1))

    def search(self, sized: bool = False) -> SearchResult:
        """The greatest values of the quantities and of their negatives, or their greatest sizes."""
        known = list[Known]()
        if self.engagement.slot.curved:  # no span reaches mid-motion
            known = at_mid_motion(self.engagement, self.case, self.quantities, self.n)
        return search(self, self.spans, sized, known, self.spread)

    def stretches(self, result: SearchResult | None = None) -> Stretches:
        """The motion, divided where signs change: as in a search, or without one."""
        pieces = result.stretches if result else cuts(self, self.spans)
        if not self.engagement.slot.curved:
            return pieces
        x = pieces.x
        for end in (self.engagement.entry_deg, self.engagement.exit_deg):
            near = np.broadcast_to(np.ravel(NEAR_CUSP * end), self.n)[pieces.design]
            x = np.where(x == near, 0.0, x)
        return pieces._replace(x=x)

    def integrals(self, pieces: Stretches, functions: Integrands, needed: Mask) -> Array:
        """The integrals of functions by the angle in radians over stretches: (functions, m).

        They may behave as a root at the ends of a stretch. ``needed`` (functions, n) selects those
        of designs; of noise they are NaN.
        """
        from geneva_cli.numerics.quadrature import span_integrals  # a check has no integrals

        signs = np.where(pieces.positive, 1.0, -1.0)

        def rows(x: Array, which: Whole) -> Array:
            instant, every, _ = self.at(x, pieces.design[which], 0, signs[:, which, None])
            return np.stack(np.broadcast_arrays(*functions(instant, every), x)[:-1])

        ends = pieces.x[0], pieces.x[1]
        with np.errstate(all="ignore"):
            return DEGREE * span_integrals(rows, ends, pieces.design, needed)

    def at(
        self, x: Array, which: Which, order: int = 0, held: Array | None = None
    ) -> tuple[Instant, list[LoadQuantity], list[tuple[Array, Jet]]]:
        """The instants of some designs at places (m, k), degrees, and the quantities there.

        With them the signs that matter, known ones as ``held``, and the functions that have them.
        """
        engagement, case, quantities = self._some(which) if self._some else self._every
        known: dict[str, Array] = {} if held is None else dict(zip(self.kinds, held, strict=True))
        others = dict.fromkeys({"slides", "feeds"} - {*self.kinds}, 1.0)  # which do not matter
        signs = map((known | others).get, ("drives", "slides", "feeds"))
        instant = Instant(case, contact(engagement, x, order, self.reactions), *signs)
        found: list[tuple[Array, Jet]] = []
        for kind in self.kinds:
            of = SIGN_FUNCTIONS.get(kind)
            jet: Jet = of(instant) if of else quantities[0](instant).value
            found.append((array(sign_of(jet, known.get(kind))), jet))
        return instant, quantities, found

    def __call__(
        self, x: Array, which: Which, order: int, held: Held = None, requested: Asked = None
    ) -> tuple[Mask, Array]:
        """Signs, and Taylor coefficients of the functions that have them and of the quantities."""
        instant, every, signs = self.at(x, which, order, held)
        numbers = range(len(every)) if requested is None else requested
        count = self.signs + len(numbers)
        # designs lie side by side in memory
        shape = (order + 1, count, *x.shape[::-1])
        values = np.empty(shape).swapaxes(2, 3)
        positive = np.empty((self.signs, *x.shape[::-1]), dtype=bool).swapaxes(1, 2)
        for i in range(count):
            if i < self.signs:
                known, jet = signs[i]
                positive[i], margin = known > 0.0, None
            else:
                jet, margin, sign = every[numbers[i - self.signs]](instant)
            for k, c in enumerate(jet.c):
                values[k, i] = c * DEGREE**k if k else c
            if margin is None:
                continue
            bar = array(margin.c[0])
            unbounded: Mask = bar <= NEGLIGIBLE
            if margin is instant.grip:
                # without friction a lever has all its digits, however short
                free = instant.case.all_friction == 0.0
                unbounded = bar <= np.where(free, 0.0, NEGLIGIBLE)
            # a margin that is known to be negative may have a rounding error above 0
            for kind, (known, other) in zip(self.kinds, signs, strict=True):
                if kind in MARGINS:
                    unbounded = unbounded | ((known < 0.0) & (bar == other.c[0]))
            if unbounded.any():
                unbounded = np.broadcast_to(unbounded, x.shape)
                values[0, i] = np.where(unbounded, np.inf * sign, values[0, i])
                values[1:, i, unbounded] = 0.0
        return positive, values


def at_mid_motion(
    engagement: Engagement, case: LoadCase, quantities: Sequence[LoadQuantity], n: int
) -> list[Known]:
    """The quantities of n designs at mid-motion, which no stretch reaches.

    They are numbers of quantities, with places and values (n,); NaN where undefined.

    Where the pin crosses the radius, its lever is 0 and a torque takes an unbounded force; instead
    of 0/0 the limits from both sides are returned. At a cusp the wall turns away from the roller on
    one side. A law that jumps at its middle has another acceleration after it: the slot then has a
    corner there, whose two sides are mirror images.
    """
    out: list[Known] = []
    middle = np.zeros((n, 1))

    def add(number: int, known: Number, where: Mask) -> None:
        out.append((number, middle[:, 0], np.where(where, known, np.full((n, 1), np.nan))[:, 0]))

    with np.errstate(all="ignore"):
        near = np.broadcast_to(NEAR_CUSP * np.reshape(engagement.entry_deg, (-1, 1)), (n, 1))
        at = contact(engagement, middle)
        before = array(at.acceleration.c[0])
        # just after mid-motion: 0 is exact, and a smaller number might become 0
        after = array(engagement.motion(middle + 1e-300, 2).derivatives()[2])
        # the two halves of a law are equal there to some roundings, or its acceleration jumps
        jumps = np.abs(after - before) > 1e-6 * (np.abs(after) + engagement.usual_acceleration)
        limits: list[list[Array]] = []
        for x in (near, -near):  # the limits of 0/0, from values near mid-motion
            instant, h = Instant(case, contact(engagement, x, 2)), np.radians(x)
            jets = [of(instant).value.c for of in quantities]
            limits.append([array(c[0] - h * (c[1] - h * c[2])) for c in jets])
        # The tangent points away from the axis at entry and exit; at a cusp both are one.
        crosses = ~np.asarray(retraces(engagement))
        for sense, acceleration in ((1.0, at.acceleration), (-1.0, Jet([after]))):
            turned = {name: getattr(at, name) * sense for name in ("along", "offset", "curvature")}
            instant = Instant(case, at._replace(acceleration=acceleration, **turned))
            usual = case.inertia_Nm * engagement.usual_acceleration + case.resists_Nm
            loaded = np.abs(instant.wheel_torque_Nm.c[0]) > NEGLIGIBLE * usual  # than rounding
            for k, of in enumerate(quantities):
                row, margin, sign = of(instant)
                known, bar = row.c[0], np.inf if margin is None else margin.c[0]
                finite = np.isfinite(known)
                add(k, known, np.isinf(bar) & finite)
                for limit in limits:
                    # on this side friction alone holds the wheel, whatever the torque
                    none = np.where(bar < -NEGLIGIBLE, np.nan, limit[k])
                    none = np.where(loaded, np.inf * sign, none)
                    limited = np.where((bar > NEGLIGIBLE) & finite, known, none)
                    add(k, limited, crosses | jumps | (sense > 0.0))
    return out


def on_breaks(x: Array, engagement: Engagement) -> Array:
    """Places of designs, replaced by the breaks that they equal apart from rounding: (..., n)."""
    near = NEGLIGIBLE * np.ravel(engagement.motion_deg)
    for place in engagement.motion.breaks_deg:
        at = np.ravel(place)
        x = np.where(np.abs(x - at) <= near, at, x)
    return x


def refuse_noise(integrals: Sequence[Array | None]) -> None:
    """Raise GenevaError for integrals of noise, which ``span_integrals`` returns as NaN."""
    if any(total is not None and np.isnan(total).any() for total in integrals):
        raise GenevaError(
            "the loads change within the last digits of the input angle, so that their means would "
            "be rounding: make the drive more even",
            ("drive", "kind"),
        )
