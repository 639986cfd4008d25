"""Certificates of loads: the wheel's torque, the input's torque, the pin force.

The formulas are the program's own (``instant``). They depend on three signs: of the wheel's torque,
of the sliding, and of the input's torque. Where an interval does not decide a sign, the load is
enclosed for either.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, TypeAlias, cast

from geneva_cli.loads.contact import contact
from geneva_cli.loads.cycle_quantities import FORCE, QUANTITIES, TORQUE
from geneva_cli.loads.forces import Contact, LoadCase
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import load_case
from geneva_cli.numerics.arrays import Undecided, enclosed
from geneva_cli.numerics.jet import Jet, Number

if TYPE_CHECKING:
    from geneva_cli.motion.engagement import Engagement
    from geneva_cli.motion.mechanism import Mechanism

    Signs: TypeAlias = tuple[float, float, float]  # of wheel torque, sliding and input torque

WHEEL_TORQUE = "wheel_torque_Nm"
LOADS = (WHEEL_TORQUE, FORCE, TORQUE)


def not_proved(mechanism: Mechanism, quantity: str) -> str:
    """The reason why a load has no certificate; empty if it has one."""
    if not mechanism.spec.is_loaded:
        return f"no load: set {mechanism.spec.load_keys}"
    if quantity != WHEEL_TORQUE and load_case(mechanism).guided:
        return "friction in a rack's guide"
    if quantity == WHEEL_TORQUE or mechanism.engagements[0].slot.walls_flat:
        return ""
    return "the slot is curved, or gears drive for part of the motion"


def load_formula(
    mechanism: Mechanism, engagement: Engagement, quantity: str
) -> Callable[[Number, int], Jet]:
    """A load as a jet by the input angle, at one angle in degrees from mid-motion."""
    case = load_case(mechanism)

    def torque(input_deg: Number, order: int) -> Jet:
        rates = engagement.motion.rate(input_deg, order + 1)
        return rates.derivative() * case.inertia_Nm + case.resists_Nm

    def load(input_deg: Number, order: int) -> Jet:
        at = contact(engagement, input_deg, order, reactions=False)
        own = enclosed(input_deg, case)
        found: list[Jet] = []
        for signs in _signs(own, at):
            one = QUANTITIES[quantity](Instant(own, at, *signs))
            if one.margin is not None and not one.margin.c[0] > 0.0:
                raise Undecided("friction alone may hold the wheel: the pin force has no bound")
            found.append(one.value)
        return _joined(found)

    return torque if quantity == WHEEL_TORQUE else load


def _signs(case: LoadCase, at: Contact[Jet]) -> Iterator[Signs]:
    """Yield the signs that are possible; signs that no quantity depends on are 1."""
    for drives in _signs_of(Instant(case, at).wheel_torque_Nm):
        rubs = _signs_of(Instant(case, at, drives).slip) if case.rubs else (1.0,)
        for slides in rubs:
            lossless = case.efficiency == 1.0
            feeds = (1.0,) if lossless else _signs_of(Instant(case, at, drives, slides).feeding)
            yield from ((drives, slides, fed) for fed in feeds)


def _signs_of(jet: Jet) -> tuple[float, ...]:
    from geneva_cli.extras.certify.balls import ball_of

    sign = ball_of(jet.c[0]).sign
    return (float(sign),) if sign else (1.0, -1.0)


def _joined(loads: Sequence[Jet]) -> Jet:
    """Return one load, or a jet without derivatives whose value holds those of several."""
    first, *others = loads
    if not others:
        return first
    from geneva_cli.extras.certify.balls import NOWHERE, ball_of

    value = ball_of(first.c[0])
    for other in others:
        value = value.join(ball_of(other.c[0]))
    return Jet(cast("list[Number]", [value, *[NOWHERE] * first.order]))
