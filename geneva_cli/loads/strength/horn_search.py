"""The search for the greatest stress in a wheel's horns: over the roller's places and sections."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP, contact, contact_values
from geneva_cli.loads.instant import bounded_loads
from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Number, Whole, array, blocks, joined, parameter
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import TIE


class HornStress(NamedTuple):
    """The greatest stress in a horn, with the roller's place and the section.

    (m,) each for m designs, NaN for those without a horn or a load.
    """

    stress_MPa: float
    at_deg: float  # input angle from the engagement's mid-motion
    inwards_mm: float  # of the section, from the mouth
    thickness_mm: float

    @property
    def single(self) -> HornStress | None:
        """The stress of a single design as numbers; None without a horn or a load."""
        one = HornStress(*(float(array(row)[0]) for row in self))
        return None if math.isnan(one.stress_MPa) else one


class SlotEnd(NamedTuple):
    """An end of a slot, entry or exit, and so the horn beside it that bears on that side.

    ``engagement`` is that of the roller in its slot. ``whole`` is the engagement of the motion,
    which has the load, at an input angle smaller by ``ahead_deg``.
    """

    engagement: Engagement
    end: float  # -1: between the slot and where the crank's axis is before the motion; 1: after it
    whole: Engagement
    ahead_deg: float

    @property
    def mouth_deg(self) -> float:
        """Input angle at which the roller is at this end's mouth."""
        return self.engagement.entry_deg if self.end < 0.0 else self.engagement.exit_deg


def slot_ends(mechanism: Mechanism) -> Iterator[SlotEnd]:
    """Yield both ends of each kind of slot under its load."""
    for whole in mechanism.under_load.engagements:
        for end, (engagement, ahead) in ((-1.0, whole.passages[0]), (1.0, whole.passages[-1])):
            yield SlotEnd(engagement, end, whole, ahead)


if TYPE_CHECKING:

    class HornSide(Protocol):
        """A horn: the wall on one side of a slot."""

        @property
        def at(self) -> SlotEnd:
            """The end of the slot where this horn bears."""

        @property
        def recess_mm(self) -> Number:
            """The recess's radius, (m, 1) of a batch."""

        @property
        def stoutness(self) -> Array:
            """Thickness at the mouth over the recess's radius, (m,)."""

        def unit_stress(
            self, roller: Array, rub: Array, sections: Array, width_mm: float
        ) -> tuple[Array, Array, Array]:
            """Stresses under 1 N, MPa (m, places, sections), and of sections place and thickness.

            The roller's places and the sections are input angles (m, k). ``rub`` is the friction on
            the wall under 1 N across it, positive towards the mouth. A section's place is its
            distance from the mouth, mm; its thickness, mm, is infinite beyond the horn.
            """


Sides: TypeAlias = "Callable[..., Sequence[HornSide]]"  # horns of a mechanism and its sizes
Sizes: TypeAlias = "tuple[float, ...]"  # half the slot's width, the recess, and what else differs


def squeezed(input_deg: Number) -> Array:
    """Input angles (m, k); (k,) if m is 1, which takes half the time."""
    x = np.atleast_2d(input_deg)
    return x[0] if len(x) == 1 else x


@lru_cache(maxsize=64)
def single_stress(
    sides: Sides, mechanism: Mechanism, sizes: Sizes, width: float = 1.0
) -> HornStress:
    """Greatest stress of a single design, cached for its sizes and its checks."""
    return greatest_stress(sides, mechanism, sizes, width)


def greatest_stress(
    sides: Sides, mechanism: Mechanism, sizes: Sizes, width: float = 1.0
) -> HornStress:
    """Greatest stress of m designs, for a width of the contact, mm; sizes may be (m, 1).

    NaN for a recess of 0, or without a load.
    """
    every, m = (mechanism, sizes, width), mechanism.designs
    if m == 1:
        return _greatest(sides, *every)
    # the stresses of 16 designs stay in the cache
    return joined([_greatest(sides, *taken(every, block)) for block in blocks(m, 16)])


def _greatest(sides: Sides, mechanism: Mechanism, sizes: Sizes, width: float) -> HornStress:
    """Greatest stress of designs that are searched together."""
    best = np.full((4, mechanism.designs), np.nan)
    for side in sides(mechanism, *sizes):
        # the roller runs along this horn's wall from its own end; in a straight slot from both
        slot = side.at.engagement
        flat = side.at.whole.slot.walls_flat
        for start in (slot.entry_deg, slot.exit_deg) if flat else (side.at.mouth_deg,):
            own = _over_a_half(mechanism, side, start, width)
            own[1] += np.ravel(side.at.whole.mid_deg - side.at.ahead_deg)
            better = ~(own[0] <= best[0] * (1.0 + TIE)) & ~np.isnan(own[0])
            best = np.where(better, own, best)
    at_deg = np.ravel(mechanism.under_load.shown_deg(parameter(best[1][:, None])))
    return HornStress(*map(parameter, (best[0], at_deg, *best[2:])))


def _over_a_half(mechanism: Mechanism, side: HornSide, start: float, width: float) -> Array:
    """The rows of ``HornStress``, (4, m), for the roller from ``start`` to mid-motion."""
    roller, section = (
        np.atleast_2d(end) * np.linspace(1.0, NEAR_CUSP, 61) for end in (start, side.at.mouth_deg)
    )
    best = np.full((4, mechanism.designs), np.nan)
    for _ in range(4):  # then between the neighbours of the best sample so far
        stress, inwards, thick = _stress(mechanism, side, width, roller, section)
        m, _, count = stress.shape
        stress = stress.reshape(m, -1)
        most, every = stress.max(axis=1), np.arange(m)
        first = np.argmax(stress >= most[:, None] * (1.0 - TIE), axis=1)
        i, j = np.divmod(first, count)
        # designs may differ in their loads or sizes alone, and share their slots
        roller, section, thick, inwards = (
            np.broadcast_to(of, (m, *of.shape[1:])) for of in (roller, section, thick, inwards)
        )
        rows = (stress[every, first], roller[every, i], inwards[every, j], thick[every, j])
        best = np.where(most > 0.0, rows, best)
        roller, section = _refined(roller, i), _refined(section, j)
    return best


def _refined(places: Array, i: Whole) -> Array:
    """Places between the neighbours of one of them, in each row."""
    every, last = np.arange(len(places)), places.shape[1] - 1
    before = places[every, np.maximum(i - 1, 0), None]
    after = places[every, np.minimum(i + 1, last), None]
    refined: Array = before + (after - before) * np.linspace(0.0, 1.0, 33)
    return refined


def _stress(
    mechanism: Mechanism, side: HornSide, width: float, x: Array, sections: Array
) -> tuple[Array, Array, Array]:
    """Stresses under the machine's load: 0 where the other horn bears."""
    at = contact_values(contact(side.at.whole, squeezed(x - side.at.ahead_deg), reactions=False))
    case = load_case(mechanism)
    loads = bounded_loads(case, at)
    bears = np.asarray(loads.wheel_torque_Nm) * side.at.end < 0.0
    force = np.where(bears, np.abs(loads.pin_force_N), 0.0)
    own = np.flatnonzero(bears.any(axis=0) if bears.ndim > 1 else bears)  # elsewhere it is 0
    # a mouth is away from the axis, but for internal wheels
    rub = case.friction * mechanism.spec.wheel.SIGN * loads.slides * at.touches
    # the force may be the same for all designs where they rub in different ways, and the reverse
    force, rub = map(np.atleast_2d, np.broadcast_arrays(force, rub))
    unit, inwards, thick = side.unit_stress(x[:, own], rub[:, own], sections, width)
    m = max(len(force), len(unit))
    stress = np.zeros((m, x.shape[1], sections.shape[1]))
    with np.errstate(invalid="ignore"):  # of a force without a bound
        loaded = force[:, own, None] * unit
    stress[:, own] = np.where(np.isfinite(loaded), loaded, 0.0)
    return stress, inwards, thick
