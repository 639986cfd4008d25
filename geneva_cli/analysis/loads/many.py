"""Greatest and least loads of many designs at once: straight slots, without friction.

There the pin force T / (lever L) and the input's torque T dpsi/dtheta are smooth wherever the
motion is, so that one scan finds all their stationary points, as for the peaks of a motion. With
friction they jump where the sliding turns round, and a curved slot has places without a bound:
those designs are asked one by one (``Cycle``).

    >>> import numpy as np
    >>> from geneva_cli import External, Load, SideCrank
    >>> from geneva_cli.machine.many import many
    >>> from geneva_cli.machine.spec import Spec
    >>> spec = Spec(External(6), SideCrank(A=0.0), load=Load(inertia_kgm2=2.0))
    >>> found = many(spec, {"drive.A": np.array([0.0, 0.6])})
    >>> extremes_of_many(found.machine)["input_torque_Nm"].max.round(6)
    array([78.193325, 18.780341])
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.analysis.loads.forces import Setting, setting
from geneva_cli.analysis.peaks_many import PeakOfMany
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.roots import TIE
from geneva_cli.numerics.roots_many import GROUP, extrema_many

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array
    from geneva_cli.numerics.roots_many import Which


class ExtremesOfMany(NamedTuple):
    """Greatest and least value in each of m designs, and the first input angles that have them."""

    max: Array
    max_at_deg: Array
    min: Array
    min_at_deg: Array


def are_smooth(mechanism: Mechanism) -> bool:
    """Whether ``extremes_of_many`` answers for these designs."""
    straight = not any(e.slot.curved for e in mechanism.engagements)
    return straight and all_true(mechanism.spec.load.friction == 0.0)


def extremes_of_many(
    mechanism: Mechanism, names: Sequence[str] | None = None
) -> dict[str, ExtremesOfMany]:
    """The extremes of some of ``LOADS`` over the motions of m designs, at the machine's angles.

    The wheel's torque in newton metres, positive where it drives the wheel on; the pin force in
    newtons, positive on the wall that drives; the input's torque, positive where the input drives,
    and there divided by the efficiency. Raises ValueError unless ``are_smooth``.
    """
    if not are_smooth(mechanism):
        raise ValueError("loads of curved slots, or with friction, are found one by one")
    given = setting(mechanism)
    best: dict[str, ExtremesOfMany] = {}
    for engagement in mechanism.engagements:
        for name, found in _extremes(engagement, given, names or LOADS).items():
            places = [
                np.ravel(mechanism.shown_deg(cast("float", engagement.mid_deg + at[:, None])))
                for at in (found.max_at_deg, found.min_at_deg)
            ]
            here = ExtremesOfMany(found.max, places[0], found.min, places[1])
            best[name] = _outer(best[name], here) if name in best else here
    if "input_torque_Nm" in best:
        shaft, eta = best["input_torque_Nm"], np.ravel(given.efficiency)
        most, least = (np.where(v > 0.0, v / eta, v) for v in (shaft.max, shaft.min))
        best["input_torque_Nm"] = shaft._replace(max=most, min=least)
    return best


Machine: TypeAlias = "tuple[Engagement, Setting]"
Rates: TypeAlias = "tuple[Jet, Jet]"  # of the wheel, and the torque that it needs


def _rates(machine: Machine, x: Array, order: int) -> Rates:
    engagement, given = machine
    rates = engagement.motion(x, order + 2).derivative()
    torque = rates.derivative() * given.inertia_Nm + given.resists_Nm
    return Jet(rates.c[: order + 1]), torque


def _force(machine: Machine, x: Array, rates: Rates) -> Jet:
    engagement, given = machine
    axis = engagement.slot.axis(x, rates[1].order)
    assert axis is not None  # the slot is straight
    force: Jet = rates[1] / (axis.lever * given.L)
    return force


FORMULAS: dict[str, Callable[[Machine, Array, Rates], Jet]] = {
    "wheel_torque_Nm": lambda machine, x, rates: rates[1],
    "pin_force_N": _force,
    "input_torque_Nm": lambda machine, x, rates: rates[1] * rates[0],
}
LOADS = tuple(FORMULAS)


class _Curve(NamedTuple):
    """One of the loads over the input angle in degrees, as ``roots_many`` asks for it.

    All are scanned at the same places, a block of designs after the other: ``kept`` has what the
    motion says there.
    """

    machine: Machine
    load: str
    kept: dict[int, tuple[Machine, Rates]]

    def __call__(self, x: Array, which: Which, order: int) -> list[Array]:
        # Designs lie side by side in memory: each operation runs along all of them.
        angles = np.asfortranarray(x)
        if not isinstance(which, slice):
            some = taken(self.machine, which)
            rates = _rates(some, angles, order)
        else:
            if which.start not in self.kept:
                some = taken(self.machine, which)
                self.kept[which.start] = some, _rates(some, angles, order)
            some, rates = self.kept[which.start]
        values = FORMULAS[self.load](some, angles, rates).derivatives()
        return [np.broadcast_to(v * DEGREE**k, x.shape) for k, v in enumerate(values)]


def greatest_of_many(mechanism: Mechanism, names: Sequence[str] = LOADS) -> dict[str, PeakOfMany]:
    """The greatest sizes of some of ``LOADS``, and the first input angles that have them: (m,).

    As ``loads.greatest`` gives them for one design; its ``torque_Nm`` is the wheel's.
    """
    out = {}
    for name, found in extremes_of_many(mechanism, names).items():
        least = -found.min > found.max * (1.0 + TIE)
        even = np.abs(found.min) >= found.max / (1.0 + TIE)
        first = np.where(even, np.fmin(found.max_at_deg, found.min_at_deg), found.max_at_deg)
        at_deg = np.where(least, found.min_at_deg, first)
        out[name] = PeakOfMany(np.maximum(found.max, -found.min), at_deg)
    return out


def _extremes(
    engagement: Engagement, given: Setting, names: Sequence[str]
) -> dict[str, ExtremesOfMany]:
    """Of one engagement, at its own input angles."""
    motion = engagement.motion
    known = (motion(motion.entry_deg, 1).c[1], motion.entry_deg, *given)
    m = max(np.size(value) for value in known if value is not None)
    places = np.hstack([np.broadcast_to(x, (m, 1)) for x in motion.breaks_deg])
    starts = range(0, m, GROUP)
    parts = [_part(engagement, given, places[i : i + GROUP], i, names) for i in starts]
    return {
        name: ExtremesOfMany(
            *(np.concatenate(v) for v in zip(*[p[name] for p in parts], strict=True))
        )
        for name in names
    }


def _part(
    engagement: Engagement, given: Setting, places: Array, start: int, names: Sequence[str]
) -> dict[str, ExtremesOfMany]:
    """Of some of the designs, between their breaks one after the other."""
    best: dict[str, ExtremesOfMany] = {}
    some = taken((engagement, given), slice(start, start + GROUP))
    for i in range(places.shape[1] - 1):
        a, b = places[:, i : i + 1], places[:, i + 1 : i + 2]
        if i:  # a break belongs to the piece before it; the piece after begins one double later
            a = np.minimum(np.nextafter(a, np.inf), b)
        kept: dict[int, tuple[Machine, Rates]] = {}
        for name in names:
            here = _between(_Curve(some, name, kept), a, b)
            best[name] = _outer(best[name], here) if name in best else here
    return best


def _between(curve: _Curve, a: Array, b: Array) -> ExtremesOfMany:
    tops = extrema_many(curve, a, b)
    every = np.arange(len(a))
    ends = [curve(x, every, 0)[0][:, 0] for x in (a, b)]
    found = []
    for sign in (1.0, -1.0):
        first, last, value = sign * ends[0], sign * ends[1], sign * tops.value
        most = np.maximum(first, last)
        np.maximum.at(most, tops.which, value)
        bar = most - TIE * np.abs(most)
        at = np.where(last >= bar, b[:, 0], np.nan)
        near = value >= bar[tops.which]
        np.fmin.at(at, tops.which[near], tops.x[near])
        found += [sign * most, np.where(first >= bar, a[:, 0], at)]
    return ExtremesOfMany(*found)


def _outer(one: ExtremesOfMany, other: ExtremesOfMany) -> ExtremesOfMany:
    """The greater maximum and the lesser minimum; of two that are one the first."""
    more = other.max > one.max + TIE * np.abs(one.max)
    less = other.min < one.min - TIE * np.abs(one.min)
    return ExtremesOfMany(
        np.where(more, other.max, one.max),
        np.where(more, other.max_at_deg, one.max_at_deg),
        np.where(less, other.min, one.min),
        np.where(less, other.min_at_deg, one.min_at_deg),
    )
