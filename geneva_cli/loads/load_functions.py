"""Loads of a batch of one engagement, as functions for searches and sums.

The formulas are in ``contact``, ``forces`` and ``instant``. This file defines the wanted
quantities, the signs that matter, and how widely samples are spread about mid-motion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import column, contact, rows
from geneva_cli.loads.cycle_quantities import PV, QUANTITIES
from geneva_cli.loads.forces import (
    NEGLIGIBLE,
    Contact,
    LoadCase,
    QuantityValue,
    feeding,
    sliding,
    wheel_torque,
)
from geneva_cli.loads.instant import Instant
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Number, Whole, all_true, array
from geneva_cli.numerics.jet import Array, Jet

if TYPE_CHECKING:
    from geneva_cli.loads.mid_motion import MidMotionValues
    from geneva_cli.numerics.stretch_search import Stretches


MARGINS = ("grip", "edge")  # where one of them is not above 0, a quantity is unbounded


class LoadQuantity(Protocol):
    """A quantity as a function of an instant of jets.

    The function is a tuple whose numbers may be arrays (m, 1), or holds no numbers.
    """

    def __call__(self, i: Instant[Jet], /) -> QuantityValue[Jet]:
        """The quantity, and the margin that bounds it."""


NO_MORE: Mapping[str, LoadQuantity] = MappingProxyType({})  # no quantities besides the named ones


class LoadBatch(NamedTuple):
    """Designs of one engagement under their load, and the wanted quantities."""

    engagement: Engagement
    case: LoadCase
    names: tuple[str, ...]
    quantities: tuple[LoadQuantity, ...]


class ContactState(NamedTuple):
    """All that the loads are computed from, at places of some designs."""

    case: LoadCase
    contact: Contact[Jet]
    shape: tuple[int, ...]  # of the places: (m, k)
    quantities: Sequence[LoadQuantity]


def load_batch(
    engagement: Engagement,
    case: LoadCase,
    names: Iterable[str],
    own: Mapping[str, LoadQuantity] = NO_MORE,
) -> LoadBatch:
    """A batch of one engagement, with quantities by name: from ``own``, or else of the cycle."""
    every = tuple(names)
    wanted = [own[name] if name in own else QUANTITIES[name] for name in every]
    return LoadBatch(engagement, case, every, tuple(wanted))


class LoadFunctions:
    """Designs of one engagement under their load, with the functions that ``search`` takes.

    ``kinds`` are the signs that matter: those at which quantities jump, and those in ``more``.
    """

    def __init__(self, batch: LoadBatch, more: Sequence[str] = ()) -> None:
        self.batch, self.n = batch, batch.case.designs
        self.engagement, case, self.names, _ = batch
        engagement, names = self.engagement, self.names
        # p v is 0 where the sliding is, in a notch that may be near a pole
        self.kinds = kinds(engagement, case, (*more, "slides") if PV in names else more)
        self.signs, self.wanted = len(self.kinds), len(names)
        self.poled: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind == "edge"]
        self.margins: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind in MARGINS]
        own = any(name not in QUANTITIES for name in names)
        # where links carry the roller, bearings and guide need the reactions of joints
        joints = own or "crank_bearing_N" in names or "guide_force_N" in names
        self.reactions = joints and engagement.reactions is not None

    @cached_property
    def spread(self) -> Array:
        """Width of the loads' features about mid-motion, from ``_spread_deg``: (n, 1)."""
        return np.broadcast_to(_spread_deg(self.engagement, self.batch.case), (self.n, 1))

    @property
    def repeats(self) -> bool:
        """Return True if the second half of the motion has no greater sizes than the first.

        It is so without friction, and without a torque or without an inertia. Forces are then equal
        in both halves, and the input gives at least as much as it gets back. In a curved slot a
        torque alone presses on one wall throughout, whose two halves differ in curvature.
        """
        case, engagement = self.batch.case, self.engagement
        radial = all_true(engagement.slot.offset == 0.0)
        alone = all_true(case.inertia_Nm == 0.0) and not engagement.slot.curved
        alone = alone or all_true(case.resists_Nm == 0.0)
        alone = alone and not (case.rubs or case.guided or self.reactions)
        return radial and engagement.mirrored and alone

    def at(self, x: Array, which: Whole, order: int) -> ContactState:
        """The state of some designs at places (m, k), degrees, with derivatives up to an order."""
        engagement, case, _, wanted = self.batch if self.n == 1 else taken(self.batch, which)
        at = contact(engagement, x, order, self.reactions)
        return ContactState(case, at, x.shape, wanted)

    def at_mid_motion(self, n: int) -> list[MidMotionValues]:
        """The quantities of n designs at mid-motion, which no span of curved slots reaches."""
        engagement, case, _, wanted = self.batch
        if not engagement.slot.curved:
            return []
        from geneva_cli.loads.mid_motion import at_mid_motion

        def rows(
            at: Contact[Jet], drives: Number, slides: Number, feeds: Number
        ) -> list[QuantityValue[Jet]]:
            instant = Instant(case, at, drives, slides, feeds)
            return [quantity(instant) for quantity in wanted]

        return at_mid_motion(engagement, case, rows, n)

    def bounded(self, pieces: Stretches, n: int) -> Mask:
        """Masks of the bounded quantities of n designs: (names, n).

        ``pieces`` are all pieces of their motion, with known signs.
        """
        out = np.full((self.wanted, n), True)
        for k, _, value in self.at_mid_motion(n):
            out[k] &= ~np.isinf(value)
        margins = [kind in MARGINS for kind in self.kinds]
        some = np.flatnonzero(~pieces.positive[margins].all(axis=0))
        design, middle = pieces.design[some], pieces.x[:, some].mean(axis=0)[:, None]
        forced = np.where(pieces.positive[:, some, None], 1.0, -1.0)
        value = self.evaluate(self.at(middle, design, 0), forced)[1][0][self.signs :, :, 0]
        for own, endless in zip(out, np.isinf(value), strict=True):
            own[design[endless]] = False
        return out

    def column(self, at: ContactState, number: int) -> ContactState:
        """The part of ``at`` for one place of each design: (m, 1)."""
        one = column(at.contact, number)
        return at._replace(contact=one, shape=(*at.shape[:-1], 1))

    def rows(self, at: ContactState, which: Whole) -> ContactState:
        """The part of ``at`` for some designs, by their numbers in it."""
        case, contact, shape, wanted = at
        if self.n > 1:
            case, wanted = taken((case, wanted), which)
        return ContactState(case, rows(contact, which), (len(which), *shape[1:]), wanted)

    def evaluate(
        self, at: ContactState, forced: Array | None = None, requested: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Signs, and Taylor coefficients of the functions that have them and of the quantities."""
        case, contact, shape, every = at
        wanted = every if requested is None else [every[k] for k in requested]
        signed = signed_instant(self.kinds, case, contact, forced, every[0])
        orders = range(contact.velocity.order + 1)
        # designs lie side by side in memory
        shape_in = (self.signs + len(wanted), *shape[::-1])
        values = [np.empty(shape_in).swapaxes(1, 2) for _ in orders]
        for i, jet in enumerate(signed.jets):
            for k in orders:
                values[k][i] = jet.c[k]
        positive = np.empty((self.signs, *shape[::-1]), dtype=bool).swapaxes(1, 2)
        for i, sign in enumerate(signed.signs):
            positive[i] = sign > 0.0
        for i, quantity in enumerate(wanted, self.signs):
            row = quantity(signed.instant)
            for k in orders:
                values[k][i] = row.value.c[k]
            if row.margin is not None:
                margin = row.margin.c[0]
                # without friction a lever has all its digits, however short
                whole = row.margin is signed.instant.grip and not (case.rubs or case.guided)
                lost = margin <= (0.0 if whole else NEGLIGIBLE)
                # a margin that is known to be negative may have a rounding error above 0
                for kind in self.margins:
                    own = margin == signed.jets[kind].c[0]
                    lost = lost | ((signed.signs[kind] < 0.0) & own)
                lost = np.broadcast_to(lost, shape)
                if lost.any():
                    values[0][i] = np.where(lost, np.inf * row.sign, values[0][i])
                    for k in orders[1:]:
                        values[k][i][lost] = 0.0
        return positive, values


class SignFunctions:
    """The functions of designs under load whose signs matter; it has no wanted quantities."""

    wanted = 0
    margins: Sequence[int] = ()

    def __init__(self, load: LoadFunctions) -> None:
        self.load, self.signs = load, load.signs
        self.at, self.column, self.rows = load.at, load.column, load.rows
        self.poled = load.poled

    def evaluate(
        self, at: ContactState, forced: Array | None = None, requested: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Signs, and Taylor coefficients of the functions that have them."""
        return self.load.evaluate(at, forced, ())


class SignedInstant(NamedTuple):
    """An instant, the signs that matter, and the functions that have them."""

    signs: list[Array]
    jets: list[Jet]
    instant: Instant[Jet]


def kinds(engagement: Engagement, case: LoadCase, more: Sequence[str] = ()) -> list[str]:
    """The signs that matter for these loads, and those requested in ``more``.

    ``wanted`` is the sign of the first wanted quantity.
    """
    out = []
    if not all_true(case.inertia_Nm == 0.0):
        out.append("drives")
    if case.rubs or "slides" in more:
        out.append("slides")
    if not all_true(case.efficiency == 1.0) or "feeds" in more:
        out.append("feeds")
    if case.rubs or case.guided:
        out.append("grip")
    if case.guided:
        out.append("leans")
    if engagement.slot.curved and case.hertz is not None:
        out.append("edge")
    if "along" in more:
        out.append("along")
    if "wanted" in more:
        out.append("wanted")
    return out


def signed_instant(
    kinds: Sequence[str],
    case: LoadCase,
    at: Contact[Jet],
    forced: Array | None,
    wanted: LoadQuantity | None = None,
) -> SignedInstant:
    """The instant of a contact, and the signs of ``kinds``.

    ``forced`` are known signs, NaN where unknown. ``wanted`` is a quantity whose sign may matter
    too.
    """
    signs: list[Array] = []
    jets: list[Jet] = []

    def sign(kind: str, jet: Jet) -> Array:
        here = np.copysign(1.0, jet.c[0])
        if kind in kinds:
            if forced is not None:
                own = forced[len(signs)]
                here = np.where(np.isnan(own), here, own)
            signs.append(here)
            jets.append(jet)
        return here

    torque, rubs = wheel_torque(case, at), None
    drives = sign("drives", torque)
    slides: Number = 1.0
    if "slides" in kinds:
        rubs = sliding(at, drives, case.radius)
        slides = sign("slides", rubs)
    feeds: Number = 1.0
    if "feeds" in kinds:
        feeds = sign("feeds", feeding(case, at, drives, slides))
    instant = Instant(case, at, drives, slides, feeds)
    instant.wheel_torque_Nm = torque  # known already
    if rubs is not None:
        instant.slip = rubs
    guide = case.guide
    others: dict[str, Callable[[], Jet | None]] = {
        "grip": lambda: instant.grip,
        "leans": lambda: guide.leaning(case, at, drives, slides) if guide else None,
        "edge": lambda: instant.edge,
        "along": lambda: at.along,
        "wanted": lambda: wanted(instant).value if wanted else None,
    }
    for kind, function in others.items():
        jet = function() if kind in kinds else None
        if jet is not None:
            sign(kind, jet)
    return SignedInstant(signs, jets, instant)


def _spread_deg(engagement: Engagement, case: LoadCase) -> Array:
    """Approximate distance from mid-motion of the nearest pole of velocity and forces, degrees.

    It follows from their behaviour near mid-motion: a velocity as v / (1 + x²/w²), a wall's lever
    as l sqrt(1 + x²/w²). Where friction holds a lever that vanishes there, w is the distance from
    mid-motion at which it no longer does.
    """
    # not at mid-motion itself, where a curved slot may have no slopes
    x = 0.01 * array(engagement.exit_deg)
    _, _, lever, offset, *_ = at = contact(engagement, x, 2, reactions=False)
    velocity = at.velocity
    with np.errstate(all="ignore"):
        # arrays, as the quotient of a jet's floats by 0 is an error
        squares = [array(velocity.c[0]) / velocity.c[2], 0.5 * array(lever.c[0]) / lever.c[2]]
        w = np.sqrt(np.fmin(*map(np.abs, squares))) / DEGREE
        if case.rubs:
            grip = np.abs(lever.c[0]) + case.friction * np.abs(offset.c[0])
            w = np.fmin(w, array(grip) / np.abs(lever.c[1]) / DEGREE)
    # ten half motions: samples of a function without poles are not spread
    return np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * engagement.exit_deg)
