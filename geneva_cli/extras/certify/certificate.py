"""Certificates: proved bounds of the greatest velocity, acceleration, jerk, power, force, torque.

The program's own formulas are evaluated in balls over every whole motion (``enclosures.greatest``).
Those of a load (``instant``) depend on three signs: of the wheel's torque, of the sliding, and of
the input's torque. Where an interval does not decide a sign, the load is enclosed for either.
"""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from functools import reduce
from importlib.util import find_spec
from typing import TYPE_CHECKING, NamedTuple, cast

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.loads.contact import contact
from geneva_cli.loads.instant import QUANTITIES as LOAD_QUANTITIES
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import QUANTITIES, curves
from geneva_cli.numerics.arrays import Array, enclosed
from geneva_cli.numerics.intervals import Undecided
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.tolerances import TIE
from geneva_cli.table import Table, rows_table

if TYPE_CHECKING:
    from geneva_cli.extras.certify.enclosures import BoundedSpan, Formula

LIMIT = 2000  # intervals a motion: 12 times what any design here takes, some seconds
DIGITS = 15  # that are printed: as many as every double keeps
NARROW_DEG = 1e-6  # a narrower place is one angle for people
COLUMNS = ("quantity", "low", "high", "at_deg", "places", "proved", "intervals", "open")
LOADS = ("wheel_torque_Nm", "pin_force_N", "input_torque_Nm")


class Place(NamedTuple):
    """Input angles in degrees between which the greatest size may be, rounded outwards."""

    from_deg: float
    to_deg: float


class Open(NamedTuple):
    """An interval of input angles that was not settled, and what is known of the size there.

    ``below`` is a proved bound of it, None if there is none.
    """

    from_deg: float
    to_deg: float
    below: float | None


class Certificate(NamedTuple):
    """Bounds of a peak, and all places where it may be.

    If it is ``proved``, the greatest size lies from ``low`` to ``high``. Else ``low`` is reached,
    ``high`` is None, and ``open`` is the interval that was left over.
    """

    quantity: str
    low: float
    high: float | None
    places: tuple[Place, ...]
    mirrored: bool  # True for two places that mirror each other
    intervals: int
    open: Open | None

    @property
    def proved(self) -> bool:
        """True if no interval is left over."""
        return self.open is None

    @property
    def at_deg(self) -> float | None:
        """Middle of the first place, degrees; None if it is not proved."""
        first = self.places[0] if self.places else None
        return None if first is None else 0.5 * (first.from_deg + first.to_deg)

    @property
    def where(self) -> str:
        """The places in words.

        >>> Design(External(6)).certificate("acceleration").where
        'at two mirrored places'
        """
        if not self.places:
            return "not proved"
        if len(self.places) > 1:
            return "at two mirrored places" if self.mirrored else f"at {len(self.places)} places"
        ((a, b),) = self.places
        return "unique" if b - a < NARROW_DEG else f"between {a:.9g} and {b:.9g}°"

    @property
    def text(self) -> str:
        """The certificate in a line.

        >>> Design(External(6)).certificate("velocity").text
        'velocity.max in [0.999999999999999, 1.00000000000001], unique, proved'
        """
        low = _outwards(self.low, ROUND_FLOOR)
        if self.open is None:
            high = _outwards(cast(float, self.high), ROUND_CEILING)
            return f"{self.quantity}.max in [{low}, {high}], {self.where}, proved"
        a, b, below = self.open
        known = "no bound is known" if below is None else f"below {below:.6g}"
        return (
            f"{self.quantity}.max at least {low}, not proved: open from {a:.15g} to {b:.15g}°, "
            f"{known} there, after {self.intervals} intervals"
        )

    def confirms(self, size: float, at_deg: float) -> bool:
        """True if it is proved and a peak in doubles agrees with it, up to the share ``TIE``.

        >>> certificate = Design(External(6)).certificate("velocity")
        >>> certificate.confirms(1.0, 0.0), certificate.confirms(1.0 + 1e-12, 0.0)
        (True, False)
        """
        if self.high is None:
            return False
        near = any(a - NARROW_DEG <= at_deg <= b + NARROW_DEG for a, b in self.places)
        return near and self.low * (1.0 - TIE) <= size <= self.high * (1.0 + TIE)


def not_proved(mechanism: Mechanism, quantity: str) -> str:
    """The reason why a load has no certificate; empty if it has one."""
    if not mechanism.spec.is_loaded:
        return f"no load: set {mechanism.spec.output.load_keys}"
    if quantity == "wheel_torque_Nm":
        return ""
    if load_case(mechanism).guided:
        return "friction in a rack's guide"
    flat = mechanism.engagements[0].slot.walls_flat
    return "" if flat else "the slot is curved, or gears drive for part of the motion"


def certificate(mechanism: Mechanism, quantity: str, limit: int = LIMIT) -> Certificate:
    """The certificate of a machine's peak, with at most so many intervals for each engagement.

    It is about the spec's numbers as doubles.

    Raises GenevaError without python-flint, and for a quantity that has no certificate.
    """
    names = (*QUANTITIES, *LOADS)
    if quantity not in names:
        hint = nearest(quantity, names)
        raise GenevaError(
            f'no certificate of "{cut(quantity)}"{hint}; there are those of {", ".join(names)}'
        )
    reason = not_proved(mechanism, quantity) if quantity in LOADS else ""
    if reason:
        raise GenevaError(f"{quantity}.max is not proved: {reason}")
    if find_spec("flint") is None:
        raise GenevaError('certificates need python-flint: pip install "geneva-cli[certify]"')
    from flint import ctx

    from geneva_cli.extras.certify.enclosures import greatest

    formula_of, each = _load if quantity in LOADS else _invariant, mechanism.engagements
    # middles of 128 bits, 75 more than a double has, against cancellation in high derivatives
    with ctx.workprec(128):
        motions = [
            (formula_of(mechanism, one, quantity), {*one.motion.seams_deg, *one.slot.seams_deg})
            for one in each
        ]
        found = greatest(motions, limit * len(each))

    def shown(span: BoundedSpan) -> Place:
        """An interval of an engagement as the machine's; longer by the rounding of both ends."""
        start = mechanism.shown_deg(each[span.motion].mid_deg + span.start)
        # rounding of an angle that is counted from another mid-motion
        slack = 0.0 if start == span.start else 2.0**-42
        return Place(start - slack, span.end + (start - span.start) + slack)

    low, high, spans, intervals, left = found
    if left:
        open_ = Open(*shown(left), left.high if math.isfinite(left.high) else None)
        return Certificate(quantity, low, None, (), False, intervals, open_)
    first, last = spans[0], spans[-1]
    alike = len(spans) == 2 and first.motion == last.motion and each[first.motion].motion.symmetric
    mirrored = alike and abs(first.start + last.end) < NARROW_DEG
    places = tuple(sorted(map(shown, spans)))
    return Certificate(quantity, low, high, places, mirrored, intervals, None)


def _invariant(_: Mechanism, engagement: Engagement, quantity: str) -> Formula:
    """An invariant of the motion as a jet by the input angle, at degrees from mid-motion."""
    jets = curves(engagement.motion, [quantity]).jets
    return lambda x, order: jets(cast("Array", x), slice(None), order, [0])[0]


def _load(mechanism: Mechanism, engagement: Engagement, quantity: str) -> Formula:
    """A load as a jet by the input angle, at one angle in degrees from mid-motion."""
    from flint import arb

    from geneva_cli.extras.certify.balls import Ball, arb_of

    case = load_case(mechanism)

    def signs_of(jet: Jet) -> tuple[float, ...]:
        value = arb_of(jet.c[0])
        return (1.0,) if value > 0 else (-1.0,) if value < 0 else (1.0, -1.0)

    def torque(input_deg: Number, order: int) -> Jet:
        rates = engagement.motion.rate(input_deg, order + 1)
        return rates.derivative() * case.inertia_Nm + case.resists_Nm

    def load(input_deg: Number, order: int) -> Jet:
        at = contact(engagement, input_deg, order, reactions=False)
        own = enclosed(input_deg, case)
        found: list[Jet] = []
        # the signs that are possible; those that no quantity depends on are 1
        for drives in signs_of(Instant(own, at, 1.0, 1.0, 1.0).wheel_torque_Nm):
            slip = Instant(own, at, drives, 1.0, 1.0).slip
            for slides in signs_of(slip) if own.rubs else (1.0,):
                here = Instant(own, at, drives, slides, 1.0)
                for fed in (1.0,) if own.efficiency == 1.0 else signs_of(here.feeding):
                    one = LOAD_QUANTITIES[quantity](Instant(own, at, drives, slides, fed))
                    if one.margin is not None and not one.margin.c[0] > 0.0:
                        raise Undecided  # friction alone may hold the wheel: no bound of the force
                    found.append(one.value)
        first = found[0]
        if len(found) == 1:
            return first
        # several loads: a jet without derivatives whose value holds them all
        value = reduce(arb.union, [arb_of(one.c[0]) for one in found])
        return Jet(cast("list[Number]", [*map(Ball, (value, *[arb.nan()] * first.order))]))

    return torque if quantity == "wheel_torque_Nm" else load


def _outwards(x: float, rounding: str) -> str:
    """A number with ``DIGITS`` digits, rounded as given.

    >>> _outwards(1 / 3, ROUND_CEILING)
    '0.333333333333334'
    """
    digits = Context(prec=DIGITS, rounding=rounding).create_decimal(Decimal(x))
    exponent = digits.adjusted() - DIGITS + 1
    return f"{digits.quantize(Decimal((0, (1,), exponent)))}"


def with_certificates(peaks: Table, mechanism: Mechanism, for_people: bool) -> Table:
    """A record of peaks with the certificates of all: a table of them, or a text each."""
    proofs = [certificate(mechanism, quantity) for quantity in QUANTITIES]
    texts = tuple(one.text for one in proofs)
    value = texts if for_people else rows_table(COLUMNS, [*map(_row, proofs)])
    return peaks.replaced(names=(*peaks.names, "certificate"), columns=[*peaks.columns, (value,)])


def load_certificates(mechanism: Mechanism, for_people: bool) -> Table | tuple[str, ...]:
    """The loads' certificates: a table of them, or a text each."""
    lacks = mechanism.output.lacks
    reasons = {name: not_proved(mechanism, name) for name in LOADS if name not in lacks}
    proofs = {name: certificate(mechanism, name) for name, why in reasons.items() if not why}
    if for_people:
        refused = [f"{name}.max not proved: {why}" for name, why in reasons.items() if why]
        return (*[one.text for one in proofs.values()], *refused)
    rows: list[tuple[object, ...]] = []
    for name, why in reasons.items():
        none = (name, None, None, None, (), False, 0, None)
        rows.append((*(none if why else _row(proofs[name])), why or None))
    return rows_table((*COLUMNS, "why"), rows)


def _row(one: Certificate) -> tuple[object, ...]:
    places, open_ = tuple(map(tuple, one.places)), one.open and one.open._asdict()
    bounds = one.quantity, one.low, one.high, one.at_deg
    return (*bounds, places, one.proved, one.intervals, open_)
