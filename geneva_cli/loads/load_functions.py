"""Loads of a batch of one engagement, as functions for searches and sums.

They have a kink or a jump where a sign changes, and at breaks of the motion itself: where the
roller bears on the other wall, where friction reverses, where the wheel drives the input.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import NEAR_CUSP, contact
from geneva_cli.loads.cycle_quantities import PV, QUANTITIES
from geneva_cli.loads.forces import NEGLIGIBLE, LoadCase, QuantityValue
from geneva_cli.loads.instant import Instant, LoadQuantity
from geneva_cli.loads.mid_motion import at_mid_motion
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.peak_search import breaks, motion_peaks, pole_deg, spans
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Number, Which, all_true, array
from geneva_cli.numerics.extremes import SearchResult, Stretches, cuts, search
from geneva_cli.numerics.jet import Array, Jet

# The functions whose signs matter, in order: each is smooth while those before it keep their signs.
SIGN_FUNCTIONS: dict[str, Callable[[Instant[Jet]], Jet | None]] = {
    "drives": lambda i: i.wheel_torque_Nm,
    "slides": lambda i: i.slip,
    "feeds": lambda i: i.feeding,
    "grip": lambda i: i.grip,
    "leans": lambda i: i.leaning,
    "edge": lambda i: i.edge,
    "along": lambda i: i.at.along,
}
MARGINS = ("grip", "edge")  # where one of them is not above 0, a quantity is unbounded
# The greatest fraction of the step between two adjacent angles: the loads then keep six digits.
FEWEST_DIGITS = 1e-10


NO_MORE: Mapping[str, LoadQuantity] = MappingProxyType({})  # no quantities besides the named ones


class SignedInstant(NamedTuple):
    """An instant, the signs that matter, and the functions that have them."""

    instant: Instant[Jet]
    signs: list[Array]
    jets: list[Jet]


class LoadFunctions:
    """Designs of one engagement under their load, with the functions that ``search`` takes.

    Quantities are named: those in ``own``, or else of the cycle. ``kinds`` are the signs that
    matter: those at which quantities jump, those in ``more``, and with ``wanted`` that of the first
    quantity.
    """

    def __init__(
        self,
        engagement: Engagement,
        case: LoadCase,
        names: Sequence[str],
        own: Mapping[str, LoadQuantity] = NO_MORE,
        more: Sequence[str] = (),
    ) -> None:
        self.engagement, self.case, self.names, self.n = engagement, case, names, case.designs
        self.quantities: list[LoadQuantity] = [own.get(name) or QUANTITIES[name] for name in names]
        matters = {
            "drives": not all_true(case.inertia_Nm == 0.0),
            # p v is 0 where the sliding is, in a notch that may be near a pole
            "slides": case.rubs or PV in names,
            "feeds": not all_true(case.efficiency == 1.0),
            "grip": case.rubs or case.guided,
            "leans": case.guided,
            "edge": engagement.slot.curved and case.hertz is not None,
        }
        self.kinds = [k for k in (*SIGN_FUNCTIONS, "wanted") if matters.get(k) or k in more]
        self.signs, self.wanted = len(self.kinds), len(names)
        self.poled: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind == "edge"]
        # where links carry the roller, bearings and guide need the reactions of joints
        joints = bool(own) or "crank_bearing_N" in names or "guide_force_N" in names
        self.reactions = joints and engagement.reactions is not None
        self._some = selection((engagement, case, self.quantities))

    @cached_property
    def spread(self) -> Array:
        """Approximate distance from mid-motion of the nearest pole of the loads, degrees: (n, 1).

        It follows from their behaviour near mid-motion: a velocity as v / (1 + x²/w²), a wall's
        lever as l sqrt(1 + x²/w²). Where friction holds a lever that vanishes there, w is the
        distance from mid-motion at which it no longer does.
        """
        engagement = self.engagement
        # not at mid-motion itself, where a curved slot may have no slopes
        x = 0.01 * array(engagement.exit_deg)
        _, _, lever, offset, *_ = at = contact(engagement, x, 2, reactions=False)
        with np.errstate(all="ignore"):
            w = np.fmin(pole_deg(at.velocity), math.sqrt(0.5) * pole_deg(lever))
            if self.case.rubs:
                grip = np.abs(lever.c[0]) + self.case.friction * np.abs(offset.c[0])
                w = np.fmin(w, array(grip) / np.abs(lever.c[1]) / DEGREE)
        # ten half motions: samples of a function without poles are not spread
        w = np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * engagement.exit_deg)
        return np.broadcast_to(w, (self.n, 1))

    @property
    def spans(self) -> list[tuple[Array, Array]]:
        """Ends of the smooth parts of the motion, one after the other: (n, 1) each."""
        engagement, out = self.engagement, []
        motion, n = engagement.motion, self.n
        for (a, b), (start, end) in zip(pairwise(breaks(motion, n)), spans(motion, n), strict=True):
            if engagement.slot.curved:
                start = np.where(a == 0.0, NEAR_CUSP * engagement.exit_deg, start)
                end = np.where(b == 0.0, NEAR_CUSP * engagement.entry_deg, end)
            out.append((start, end))
        return out

    @property
    def repeats(self) -> bool:
        """Return True if the second half of the motion has no greater sizes than the first.

        It is so without friction, and without a torque or without an inertia. Forces are then equal
        in both halves, and the input gives at least as much as it gets back. In a curved slot a
        torque alone presses on one wall throughout, whose two halves differ in curvature.
        """
        case, engagement = self.case, self.engagement
        radial = all_true(engagement.slot.offset == 0.0)
        alone = all_true(case.inertia_Nm == 0.0) and not engagement.slot.curved
        alone = alone or all_true(case.resists_Nm == 0.0)
        alone = alone and not (case.rubs or case.guided or self.reactions)
        return radial and engagement.mirrored and alone

    def search(self, sized: bool = False) -> SearchResult:
        """The extremes of the quantities over the motion, and its stretches."""
        spans, known = self.spans, []
        if sized and self.repeats:
            spans = spans[: len(spans) // 2]
        if self.engagement.slot.curved:  # no span reaches mid-motion
            known = at_mid_motion(self.engagement, self.case, self.quantities, self.n)
        return search(self, spans, sized, known, self.spread)

    def stretches(self, result: SearchResult | None = None) -> Stretches:
        """The motion, divided where signs change: as in a search, or without one.

        In curved slots, where searches stop short of mid-motion, they reach it.
        """
        pieces = result.stretches if result else cuts(self, self.spans)
        if not self.engagement.slot.curved:
            return pieces
        x = pieces.x
        for end in (self.engagement.entry_deg, self.engagement.exit_deg):
            near = np.broadcast_to(np.ravel(NEAR_CUSP * end), self.n)[pieces.design]
            x = np.where(x == near, 0.0, x)
        return pieces._replace(x=x)

    def at(
        self, x: Array, which: Which, order: int = 0, held: Array | None = None
    ) -> tuple[SignedInstant, list[LoadQuantity]]:
        """The instants of some designs at places (m, k), degrees, and the quantities there.

        Signs are known where ``held`` is not NaN.
        """
        engagement, case, quantities = self._some(which)
        instant = Instant(case, contact(engagement, x, order, self.reactions))
        out = SignedInstant(instant, [], [])
        if "drives" not in self.kinds:
            instant.drives = np.copysign(1.0, instant.wheel_torque_Nm.c[0])
        for i, kind in enumerate(self.kinds):
            known = SIGN_FUNCTIONS.get(kind)
            jet = known(instant) if known else quantities[0](instant).value
            assert jet is not None  # the kind is not among those that matter
            sign = np.copysign(1.0, jet.c[0])
            if held is not None:
                sign = np.where(np.isnan(held[i]), sign, held[i])
            if kind in ("drives", "slides", "feeds"):
                setattr(instant, kind, sign)
            out.signs.append(sign)
            out.jets.append(jet)
        return out, quantities

    def __call__(
        self,
        x: Array,
        which: Which,
        order: int,
        held: Array | None = None,
        requested: Sequence[int] | None = None,
    ) -> tuple[Mask, list[Array]]:
        """Signs, and Taylor coefficients of the functions that have them and of the quantities."""
        signed, every = self.at(x, which, order, held)
        wanted = every if requested is None else [every[k] for k in requested]
        rows = [QuantityValue(jet) for jet in signed.jets]
        rows += [quantity(signed.instant) for quantity in wanted]
        # designs lie side by side in memory
        shape = (len(rows), *x.shape[::-1])
        values = [np.empty(shape).swapaxes(1, 2) for _ in range(order + 1)]
        for i, (jet, margin, sign) in enumerate(rows):
            for k, own in enumerate(values):
                own[i] = jet.c[k] * DEGREE**k if k else jet.c[0]
            unbounded = None if margin is None else self._lost(margin, signed)
            if unbounded is not None and unbounded.any():
                unbounded = np.broadcast_to(unbounded, x.shape)
                values[0][i] = np.where(unbounded, np.inf * sign, values[0][i])
                for own in values[1:]:
                    own[i][unbounded] = 0.0
        positive = np.empty((self.signs, *x.shape[::-1]), dtype=bool).swapaxes(1, 2)
        for i, sign in enumerate(signed.signs):
            positive[i] = sign > 0.0
        return positive, values

    def _lost(self, margin: Jet, signed: SignedInstant) -> Mask:
        """Masks of the places where a quantity with this margin is unbounded."""
        value = array(margin.c[0])
        level: Number = NEGLIGIBLE
        if margin is signed.instant.grip:
            # without friction a lever has all its digits, however short
            level = np.where(signed.instant.case.all_friction == 0.0, 0.0, NEGLIGIBLE)
        lost: Mask = value <= level
        # a margin that is known to be negative may have a rounding error above 0
        for kind, sign, jet in zip(self.kinds, signed.signs, signed.jets, strict=True):
            if kind in MARGINS:
                lost = lost | ((sign < 0.0) & (value == jet.c[0]))
        return lost


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


@lru_cache(maxsize=16)  # the cycle, the strength and the checks of a design need the same answer
def refuse_rounding(engagements: tuple[Engagement, ...]) -> None:
    """Raise GenevaError for a design that is too fast for the digits of its angles."""
    for engagement in engagements:
        (fastest,), (fraction,) = _digits(engagement)
        if fraction > FEWEST_DIGITS:
            raise GenevaError(
                f"the wheel moves {fastest:.2g} times as fast as the input. The last digit of the "
                f"input angle is {fraction:.1g} of its step, so the loads would be rounding. Make "
                "the drive more even (elliptical gears: an eccentricity up to 0.999999)",
                ("drive", "kind"),
            )


def too_fast(engagements: Sequence[Engagement]) -> Mask:
    """True for designs whose motion is too fast for the digits of its angles: (m,) or (1,)."""
    fractions = [_digits(engagement)[1] for engagement in engagements]
    return np.asarray(np.max(np.broadcast_arrays(*fractions), axis=0) > FEWEST_DIGITS)


def _digits(engagement: Engagement) -> tuple[Array, Array]:
    """The greatest velocity, and the step between two adjacent angles there over the whole step."""
    fastest = motion_peaks(engagement.motion, ["velocity"])["velocity"].max
    furthest = np.fmax(np.abs(engagement.entry_deg), np.abs(engagement.exit_deg))
    step = np.ravel(np.spacing(furthest) * DEGREE / (2.0 * np.asarray(engagement.half_step)))
    return fastest, fastest * step
