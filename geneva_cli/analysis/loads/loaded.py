"""Loads of a batch of one engagement, as functions for searches and sums.

The formulas are in ``contact``, ``forces`` and ``instant``. This file defines the wanted
quantities, and the signs that matter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.contact import Contact, column, contact, mirrored, rows
from geneva_cli.analysis.loads.forces import ZERO, Row, Setting, Worked, gain, sliding, wheel_torque
from geneva_cli.analysis.loads.instant import Instant
from geneva_cli.analysis.loads.mid_motion import Known, at_mid_motion
from geneva_cli.analysis.loads.quantities import PV, QUANTITIES, Quantity
from geneva_cli.analysis.loads.spread import spread_deg
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.many import taken
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Jet

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array, Number
    from geneva_cli.numerics.pieces import Which
    from geneva_cli.numerics.search import Stretches

# Quantities that need the reactions of joints where links carry the roller.
REACTIONS = ("crank_bearing_N", "guide_force_N")
ROOMS = ("grip", "edge")  # margins without which a quantity is unbounded
SLIDING = ("sliding_m_s", PV)  # quantities that depend on sliding even without friction
# The setting, the contact, the shape of the places, and the wanted quantities there.
At: TypeAlias = "tuple[Setting, Contact[Jet], tuple[int, ...], Sequence[Wanted]]"


class Wanted(Protocol):
    """A quantity of an instant and its contact.

    It is a tuple whose numbers may be arrays (m, 1), or holds no numbers.
    """

    def __call__(self, i: Instant[Jet], at: Contact[Jet], /) -> Row[Jet]:
        """The quantity, and the margin that bounds it."""


class Named(NamedTuple):
    """One of ``QUANTITIES``."""

    quantity: Quantity

    def __call__(self, i: Instant[Jet], at: Contact[Jet]) -> Row[Jet]:
        """The quantity, and the margin that bounds it."""
        return self.quantity(i)


NONE: Mapping[str, Wanted] = MappingProxyType({})  # no quantities besides the named ones

# a batch: its engagement and setting, and the wanted quantities
Machine: TypeAlias = "tuple[Engagement, Setting, tuple[Wanted, ...]]"


def machine(
    engagement: Engagement, given: Setting, names: Sequence[str], own: Mapping[str, Wanted]
) -> Machine:
    """A batch of one engagement and its wanted quantities, from ``own`` or from the cycle."""
    wanted = [own[name] if name in own else Named(QUANTITIES[name]) for name in names]
    return engagement, given, tuple(wanted)


class Loaded:
    """Designs of one engagement under their load, with the functions that ``search`` takes.

    ``kinds`` are the signs that matter: those at which quantities jump, and those in ``more``.
    """

    def __init__(self, machine: Machine, names: Sequence[str], more: Sequence[str] = ()) -> None:
        self.machine = engagement, given, _ = machine
        self.names = names
        self.n = machine[1].designs
        # p v is 0 where the sliding is, in a notch that may be near a pole
        self.kinds = kinds(engagement, given, (*more, "slides") if PV in names else more)
        self.signs, self.wanted = len(self.kinds), len(names)
        self.poled: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind == "edge"]
        self.rooms: Sequence[int] = [i for i, kind in enumerate(self.kinds) if kind in ROOMS]
        own = any(name not in QUANTITIES for name in names)
        held = own or any(name in REACTIONS for name in names)
        self.reactions = held and engagement.reactions is not None
        self.spins = own or "slides" in self.kinds or any(name in SLIDING for name in names)
        radial = all_true(engagement.slot.offset == 0.0)
        self.mirrored = radial and engagement.mirrored and not self.reactions
        # of the current block of designs: its slice, its machine, and the places with their contact
        self.kept: tuple[slice | None, Any] = (None, None)
        self.last: list[tuple[Array, Contact[Jet]]] = []

    @cached_property
    def spread(self) -> Array:
        """Width of the loads' features about mid-motion, from ``spread_deg``: (n, 1)."""
        return np.broadcast_to(spread_deg(*self.machine[:2]), (self.n, 1))

    @property
    def repeats(self) -> bool:
        """Return True if the second half of the motion has no greater sizes than the first.

        It is so without friction, and without a torque or without an inertia. Forces are then equal
        in both halves, and the input gives at least as much as it gets back. In a curved slot a
        torque alone presses on one wall throughout, whose two halves differ in curvature.
        """
        engagement, given, _ = self.machine
        alone = all_true(given.inertia_Nm == 0.0) and not engagement.slot.curved
        alone = alone or all_true(given.resists_Nm == 0.0)
        return self.mirrored and alone and not given.rubs

    def at(self, x: Array, which: Which, order: int) -> At:
        """Setting, contact, shape and wanted quantities of some designs."""
        if self.n == 1:
            engagement, given, wanted = self.machine
            return given, self._contact(engagement, x, order), x.shape, wanted
        if not isinstance(which, slice):
            engagement, given, wanted = taken(self.machine, which)
            return given, self._contact(engagement, x, order), x.shape, wanted
        if which != self.kept[0]:
            self.kept, self.last = (which, taken(self.machine, which)), []
        engagement, given, wanted = self.kept[1]
        if not self.mirrored:
            return given, self._contact(engagement, x, order), x.shape, wanted
        for other, found in self.last if order == 0 else ():
            if np.array_equal(other, -x[:, ::-1]):
                return given, mirrored(found), x.shape, wanted
        self.last.append((x, self._contact(engagement, x, order)))
        return given, self.last[-1][1], x.shape, wanted

    def _contact(self, engagement: Engagement, x: Array, order: int) -> Contact[Jet]:
        return contact(engagement, x, order, self.reactions, self.spins)

    def at_mid_motion(self, n: int) -> list[Known]:
        """The quantities of n designs at mid-motion, which no span of curved slots reaches."""
        engagement, given, wanted = self.machine

        def rows(at: Contact[Jet], drives: Number, slides: Number, feeds: Number) -> list[Row[Jet]]:
            found = Instant(given, at, drives, slides, feeds)
            return [quantity(found, at) for quantity in wanted]

        return at_mid_motion(engagement, given, rows, n) if engagement.slot.curved else []

    def bounded(self, pieces: Stretches, n: int) -> Mask:
        """Masks of the bounded quantities of n designs: (names, n).

        ``pieces`` are all pieces of their motion, with known signs.
        """
        out = np.full((self.wanted, n), True)
        for k, _, value in self.at_mid_motion(n):
            out[k] &= ~np.isinf(value)
        room = [kind in ROOMS for kind in self.kinds]
        some = np.flatnonzero(~pieces.positive[room].all(axis=0))
        design, middle = pieces.design[some], pieces.x[:, some].mean(axis=0)[:, None]
        forced = np.where(pieces.positive[:, some, None], 1.0, -1.0)
        value = self.look(self.at(middle, design, 0), forced)[1][0][self.signs :, :, 0]
        for own, endless in zip(out, np.isinf(value), strict=True):
            own[design[endless]] = False
        return out

    def column(self, at: At, number: int) -> At:
        """The part of ``at`` for one place of each design: (m, 1)."""
        given, found, shape, wanted = at
        return given, column(found, number), (*shape[:-1], 1), wanted

    def rows(self, at: At, which: Whole) -> At:
        """The part of ``at`` for some designs, by their numbers in it."""
        given, found, shape, wanted = at
        if self.n > 1:
            given, wanted = taken((given, wanted), which)
        return given, rows(found, which), (len(which), *shape[1:]), wanted

    def look(
        self, at: At, forced: Array | None = None, asked: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Signs, and Taylor coefficients of the functions that have them and of the quantities."""
        given, contact, shape, every = at
        wanted = every if asked is None else [every[k] for k in asked]
        found = look(self.kinds, given, contact, forced, every[0])
        orders = range(contact.velocity.order + 1)
        shape_in = (self.signs + len(wanted), *shape[::-1])
        values = [np.empty(shape_in).swapaxes(1, 2) for _ in orders]
        for i, jet in enumerate(found.jets):
            for k in orders:
                values[k][i] = jet.c[k]
        positive = np.empty((self.signs, *shape[::-1]), dtype=bool).swapaxes(1, 2)
        for i, sign in enumerate(found.signs):
            positive[i] = sign > 0.0
        for i, quantity in enumerate(wanted, self.signs):
            row = quantity(found.instant, contact)
            for k in orders:
                values[k][i] = row.value.c[k]
            if row.room is not None:
                room = row.room.c[0]
                # without friction a lever has all its digits, however short
                whole = row.room is found.instant.grip and not given.rubs
                lost = room <= (0.0 if whole else ZERO)
                for kind in self.rooms:  # a margin that is known to end may leave a rounding error
                    lost = lost | ((found.signs[kind] < 0.0) & (room == found.jets[kind].c[0]))
                lost = np.broadcast_to(lost, shape)
                if lost.any():
                    values[0][i] = np.where(lost, np.inf * row.way, values[0][i])
                    for k in orders[1:]:
                        values[k][i][lost] = 0.0
        return positive, values


class Signs:
    """The functions of designs under load whose signs matter, without wanted quantities."""

    wanted = 0
    rooms: Sequence[int] = ()

    def __init__(self, load: Loaded) -> None:
        self.load, self.signs = load, load.signs
        self.at, self.column, self.rows = load.at, load.column, load.rows
        self.poled = load.poled

    def look(
        self, at: At, forced: Array | None = None, asked: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """The result of ``Loaded.look`` without quantities."""
        return self.load.look(at, forced, ())


class Look(NamedTuple):
    """Signs that matter, the functions that have them, and the instant."""

    signs: list[Array]
    jets: list[Jet]
    instant: Instant[Jet]


def kinds(engagement: Engagement, given: Setting, more: Sequence[str] = ()) -> list[str]:
    """The signs that matter for these loads, and those requested in ``more``.

    ``wanted`` is the sign of the first wanted quantity.
    """
    out = []
    if not all_true(given.inertia_Nm == 0.0):
        out.append("drives")
    if given.rubs or "slides" in more:
        out.append("slides")
    if not all_true(given.efficiency == 1.0) or "feeds" in more:
        out.append("feeds")
    if given.rubs:
        out.append("grip")
    if engagement.slot.curved and given.hertz is not None:
        out.append("edge")
    if "along" in more:
        out.append("along")
    if "wanted" in more:
        out.append("wanted")
    return out


def look(
    kinds: Sequence[str],
    given: Setting,
    at: Contact[Jet],
    forced: Array | None,
    wanted: Wanted | None = None,
) -> Look:
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

    torque, rubs = wheel_torque(given, at), None
    drives = sign("drives", torque)
    slides: Number = 1.0
    if "slides" in kinds:
        rubs = sliding(at, drives, given.radius)
        slides = sign("slides", rubs)
    feeds: Number = 1.0
    if "feeds" in kinds:
        feeds = sign("feeds", gain(given, at, drives, slides) * drives)
    found = Instant(given, at, drives, slides, feeds, worked=Worked(torque, rubs))
    if "grip" in kinds:
        sign("grip", found.grip)
    if "edge" in kinds and found.edge is not None:
        sign("edge", found.edge)
    if "along" in kinds:
        sign("along", at.along)
    if wanted is not None and "wanted" in kinds:
        sign("wanted", wanted(found, at).value)
    return Look(signs, jets, found)
