"""Loads of a batch of one engagement, as functions for searches and sums.

The formulas are in ``contact``, ``forces`` and ``instant``. This file defines the wanted
quantities, the signs that matter, and how widely samples are spread about mid-motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import contact
from geneva_cli.loads.cycle_quantities import PV, QUANTITIES
from geneva_cli.loads.forces import NEGLIGIBLE, Contact, LoadCase, QuantityValue, feeding
from geneva_cli.loads.instant import Instant
from geneva_cli.motion.batch import selection
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.peak_search import pole_deg
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Number, Which, all_true, array
from geneva_cli.numerics.jet import Array, Jet

if TYPE_CHECKING:
    from geneva_cli.loads.mid_motion import MidMotionValues

# The functions whose signs matter, in order: each is smooth while those before it keep their signs.
SIGN_FUNCTIONS: dict[str, Callable[[Instant[Jet]], Jet | None]] = {
    "drives": lambda i: i.wheel_torque_Nm,
    "slides": lambda i: i.slip,
    "feeds": lambda i: feeding(i.case, i.at, i.drives, i.slides),
    "grip": lambda i: i.grip,
    "leans": lambda i: i.leaning,
    "edge": lambda i: i.edge,
    "along": lambda i: i.at.along,
}
MARGINS = ("grip", "edge")  # where one of them is not above 0, a quantity is unbounded


class LoadQuantity(Protocol):
    """A quantity as a function of an instant of jets.

    The function is a tuple whose numbers may be arrays (m, 1), or holds no numbers.
    """

    def __call__(self, i: Instant[Jet], /) -> QuantityValue[Jet]:
        """The quantity, and the margin that bounds it."""


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
        # p v is 0 where the sliding is, in a notch that may be near a pole
        self.kinds = kinds(engagement, case, (*more, "slides") if PV in names else more)
        self.signs, self.wanted = len(self.kinds), len(names)
        self.poled: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind == "edge"]
        # where links carry the roller, bearings and guide need the reactions of joints
        joints = bool(own) or "crank_bearing_N" in names or "guide_force_N" in names
        self.reactions = joints and engagement.reactions is not None
        self._some = selection((engagement, case, self.quantities))

    @cached_property
    def spread(self) -> Array:
        """Width of the loads' features about mid-motion, from ``_spread_deg``: (n, 1)."""
        return np.broadcast_to(_spread_deg(self.engagement, self.case), (self.n, 1))

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

    def at_mid_motion(self) -> list[MidMotionValues]:
        """The quantities at mid-motion, which no span of curved slots reaches."""
        if not self.engagement.slot.curved:
            return []
        from geneva_cli.loads.mid_motion import at_mid_motion

        def rows(
            at: Contact[Jet], drives: Number, slides: Number, feeds: Number
        ) -> list[QuantityValue[Jet]]:
            instant = Instant(self.case, at, drives, slides, feeds)
            return [quantity(instant) for quantity in self.quantities]

        return at_mid_motion(self.engagement, self.case, rows, self.n)

    def at(
        self, x: Array, which: Which, order: int = 0, held: Array | None = None
    ) -> tuple[SignedInstant, list[LoadQuantity]]:
        """The instants of some designs at places (m, k), degrees, and the quantities there."""
        engagement, case, quantities = self._some(which)
        at = contact(engagement, x, order, self.reactions)
        return signed_instant(self.kinds, Instant(case, at), held, quantities[:1]), quantities

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
        # designs lie side by side in memory
        shape = (self.signs + len(wanted), *x.shape[::-1])
        values = [np.empty(shape).swapaxes(1, 2) for _ in range(order + 1)]
        rows = [*signed.jets]
        lost: list[Mask | None] = [None] * self.signs
        signs_of: list[Number] = [1.0] * self.signs
        for quantity in wanted:
            row = quantity(signed.instant)
            rows.append(row.value)
            lost.append(None if row.margin is None else self._lost(row.margin, signed))
            signs_of.append(row.sign)
        for i, jet in enumerate(rows):
            for k, own in enumerate(values):
                own[i] = jet.c[k] * DEGREE**k if k else jet.c[0]
            unbounded = lost[i]
            if unbounded is not None and unbounded.any():
                unbounded = np.broadcast_to(unbounded, x.shape)
                values[0][i] = np.where(unbounded, np.inf * signs_of[i], values[0][i])
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


def kinds(engagement: Engagement, case: LoadCase, more: Sequence[str] = ()) -> list[str]:
    """The signs that matter for these loads, and those requested in ``more``.

    ``wanted`` is the sign of the first wanted quantity.
    """
    matters = {
        "drives": not all_true(case.inertia_Nm == 0.0),
        "slides": case.rubs,
        "feeds": not all_true(case.efficiency == 1.0),
        "grip": case.rubs or case.guided,
        "leans": case.guided,
        "edge": engagement.slot.curved and case.hertz is not None,
    }
    return [k for k in (*SIGN_FUNCTIONS, "wanted") if matters.get(k) or k in more]


def signed_instant(
    kinds: Sequence[str],
    instant: Instant[Jet],
    held: Array | None = None,
    wanted: Sequence[LoadQuantity] = (),
) -> SignedInstant:
    """An instant with the signs of ``kinds``, which are known where ``held`` is not NaN.

    ``wanted`` may have the quantity whose sign matters too.
    """
    out = SignedInstant(instant, [], [])
    if "drives" not in kinds:
        instant.drives = np.copysign(1.0, instant.wheel_torque_Nm.c[0])
    for i, kind in enumerate(kinds):
        jet = wanted[0](instant).value if kind == "wanted" else SIGN_FUNCTIONS[kind](instant)
        assert jet is not None  # the kind is not among those that matter
        sign = np.copysign(1.0, jet.c[0])
        if held is not None:
            sign = np.where(np.isnan(held[i]), sign, held[i])
        if kind in ("drives", "slides", "feeds"):
            setattr(instant, kind, sign)
        out.signs.append(sign)
        out.jets.append(jet)
    return out


def _spread_deg(engagement: Engagement, case: LoadCase) -> Array:
    """Approximate distance from mid-motion of the nearest pole of velocity and forces, degrees.

    It follows from their behaviour near mid-motion: a velocity as v / (1 + x²/w²), a wall's lever
    as l sqrt(1 + x²/w²). Where friction holds a lever that vanishes there, w is the distance from
    mid-motion at which it no longer does.
    """
    # not at mid-motion itself, where a curved slot may have no slopes
    x = 0.01 * array(engagement.exit_deg)
    _, _, lever, offset, *_ = at = contact(engagement, x, 2, reactions=False)
    with np.errstate(all="ignore"):
        w = np.fmin(pole_deg(at.velocity), math.sqrt(0.5) * pole_deg(lever))
        if case.rubs:
            grip = np.abs(lever.c[0]) + case.friction * np.abs(offset.c[0])
            w = np.fmin(w, array(grip) / np.abs(lever.c[1]) / DEGREE)
    # ten half motions: samples of a function without poles are not spread
    return np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * engagement.exit_deg)
