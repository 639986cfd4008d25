"""The roller as a bearing, and the slot that it runs in: work, turns, life and wear.

Over a motion the roller rolls along its wall, v_s being the speed at which it would rub if it did
not turn in the body that carries it, and N the force on it. A bearing that carries N while it
turns by |v_s|/r per second lives as under the constant force (ISO 281, roller bearings)

    P = (∫ N^p |v_s| dt / ∫ |v_s| dt)^(1/p),  p = 10/3,  L10 = 10^6 (C/P)^p revolutions.

Motions are cut where torque, sliding or the way along the slot change their signs, or the motion
breaks, and integrated between to the last digits.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.contact import contact, is_straight
from geneva_cli.analysis.loads.forces import Forces, setting, sliding
from geneva_cli.analysis.loads.groups_many import of_groups
from geneva_cli.analysis.loads.loaded_many import NONE, Loaded, Machine, Signs, machine
from geneva_cli.analysis.loads.stretches import spans_of, to_mid_motion
from geneva_cli.machine.many import taken
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import all_true, array, only_of, parameter
from geneva_cli.numerics.quadrature_many import integrals_many
from geneva_cli.numerics.search import search

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.analysis.loads.contact import Contact
    from geneva_cli.analysis.loads.forces import Setting
    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array, Jet, Number

EXPONENT = 10.0 / 3.0  # p, of line contact
RATED = 1e6  # revolutions that C is rated for
FORCE = ("pin_force_N",)  # whose bound says whether there is one of the integrals


class Passage(NamedTuple):
    """One roller's way through one slot, in SI units; infinite where the force has no bound.

    Of m designs (m,) each.
    """

    travel_m: float  # of the contact along the walls, in and out
    rolled_m: float  # ∫ |v_s| dt
    work: float  # ∫ N |v_s| dt, joules: friction's for a coefficient of 1
    load: float  # ∫ N^p |v_s| dt


class Life(NamedTuple):
    """The most loaded roller's life; None without a capacity, infinite where nothing loads it."""

    equivalent_force_N: float  # P
    turns_per_motion: float
    turns: float | None  # L10
    motions: float | None  # of this roller
    hours: float | None


@lru_cache(maxsize=256)
def passage(engagement: Engagement, given: Setting, half: float = 0.0) -> Passage:
    """The integrals over one motion; before mid-motion alone for a ``half`` of -1, after it for 1.

    >>> from geneva_cli import External, Load, Size
    >>> from geneva_cli.machine.mechanism import build
    >>> from geneva_cli.machine.spec import Spec
    >>> m = build(Spec(External(6), size=Size(200.0, 8.0), load=Load(torque_Nm=15.0)))
    >>> round(passage(m.engagements[0], setting(m)).travel_m, 12)  # 2 L (cos b - (1 - l))
    0.146410161514
    """
    return Passage(*(array(x).item() for x in passage_of_many(engagement, given, half)))


def passage_of_many(engagement: Engagement, given: Setting, half: float = 0.0) -> Passage:
    """The same integrals of m designs: (m,) each."""
    every = machine(engagement, given, FORCE, NONE)
    (rows,) = of_groups(every, lambda some, n: (_integrals(some, n, half),))
    return Passage(*map(parameter, rows))


def _integrals(every: Machine, n: int, half: float) -> Array:
    """The integrals of n designs, a row each; infinite where the force has no bound."""
    engagement = every[0]
    load = Loaded(every, FORCE, ("slides", "along") if turns_back(engagement) else ("slides",))
    pieces = search(Signs(load), spans_of(engagement, n), n, False, w=load.spread).stretches
    design, _, (a, b), positive = to_mid_motion(engagement, pieces, n)
    own = np.flatnonzero(half * (a + b) >= 0.0)
    design, a, b, positive = design[own], a[own], b[own], positive[:, own]
    signs = dict(zip(load.kinds, np.where(positive, 1.0, -1.0)[..., None], strict=True))

    def rows(x: Array, which: Whole) -> Array:
        some, given, _ = taken(every, design[which]) if n > 1 else every
        drives, slides = (
            signs[kind][which] if kind in signs else 1.0 for kind in ("drives", "slides")
        )
        found = passing(given, contact(some, x, reactions=False), drives, slides)
        return np.stack(np.broadcast_arrays(*found))

    with np.errstate(all="ignore"):
        (bounded,) = load.bounded(pieces, n)
    every_one = np.full(n, True)
    asked = np.stack((every_one, every_one, bounded, bounded))
    with np.errstate(all="ignore"):
        total = integrals_many(rows, a, b, design, asked, ends=True) * DEGREE
    return np.where(asked, total, np.inf)


def turns_back(engagement: Engagement) -> bool:
    """Whether a roller may turn back in its slot elsewhere than at mid-motion.

    One on a crank's arm does not, unless its motion is tilted: it turns on the line of centres. Of
    a curved slot both ways begin at mid-motion.
    """
    on_arm = all_true(engagement.crank_sense == 0.0)
    return is_straight(engagement) and not (on_arm and engagement.motion.symmetric)


def passing(given: Setting, at: Contact[Jet], drives: Number, slides: Number) -> list[Array]:
    """What is integrated over a passage, at places where torque and sliding have these signs."""
    found = Forces(given, at, drives, slides)
    rubs = abs(sliding(at, drives, given.radius).arrays()[0]) * given.L
    with np.errstate(all="ignore"):
        # beside the torque's change of sign the force of one sign may be a rounding below 0
        force = np.maximum(found.force.c[0], 0.0)
        force = np.where(found.grip.c[0] > 0.0, force, np.inf) * at.touches.c[0]
        # nothing presses on a wall where nothing is to be turned
        force = np.where(found.torque.c[0] == 0.0, 0.0, force)
        along = abs(at.along.arrays()[0]) * given.L * at.touches.c[0]
        return [along, rubs, force * rubs, force**EXPONENT * rubs]


def passages(mechanism: Mechanism) -> list[Passage]:
    """The passage of each engagement of a period: of m designs (m,) each."""
    return [_passage(mechanism, engagement, 0.0) for engagement in mechanism.engagements]


def by_roller(mechanism: Mechanism) -> list[Passage]:
    """The same of each roller: an engagement takes two where one starts the wheel, one stops it."""
    each = [(one, half) for one in mechanism.engagements for half in halves(one)]
    return [_passage(mechanism, *of) for of in each]


def _passage(mechanism: Mechanism, engagement: Engagement, half: float) -> Passage:
    """The passage of a machine's engagement; of a single design it is kept."""
    single = isinstance(mechanism.design, int)
    return (passage if single else passage_of_many)(engagement, setting(mechanism), half)


def halves(engagement: Engagement) -> tuple[float, ...]:
    """Which half of a motion each of its rollers makes; 0 is the whole."""
    return (-1.0, 1.0) if engagement.paired else (0.0,)


def rollers(mechanism: Mechanism) -> int:
    """How many rollers there are on the crank."""
    spec = mechanism.spec
    count = len(spec.wheel.steps or spec.drive.roller_angles_deg or ()) or spec.drive.rollers
    return count * len(mechanism.engagements[0].ahead_deg)


def life(mechanism: Mechanism) -> Life | None:
    """The life of the roller that wears out first; None where nothing is known to load it.

    Each roller moves the wheel in its turn: of several, each makes its own share of the motions.
    """
    if not mechanism.spec.is_loaded:
        return None
    force, turns, *lasts = only_of(lives(mechanism, by_roller(mechanism)))
    assert force is not None and turns is not None
    return Life(force, turns, *lasts)


def lives(mechanism: Mechanism, each: Sequence[Passage]) -> Life:
    """The same of m designs, (m,) each, or of one, from the passages of their rollers."""
    spec, m = mechanism.spec, rollers(mechanism)
    radius_m = np.ravel(mechanism.roller_radius_mm / 1000.0)
    found = []
    for ways in (each[i::m] for i in range(min(m, len(each)))):
        rolled = sum(way.rolled_m for way in ways)
        force = (sum(way.load for way in ways) / rolled) ** (1.0 / EXPONENT)
        turns = rolled / len(ways) / (2.0 * math.pi * radius_m)
        often = np.ravel(_periods_per_h(mechanism) * (len(ways) if len(each) >= m else 1.0 / m))
        found.append(np.stack(np.broadcast_arrays(force, turns, often)))
    with np.errstate(all="ignore"):
        every = np.stack(found)
        worst = np.argmax(every[:, 0] ** EXPONENT * every[:, 1] * every[:, 2], axis=0)
        force, turns, often = every[worst, :, np.arange(every.shape[2])].T
        lasts: list[float | None] = [None] * 3
        capacity = spec.material_roller.dynamic_capacity_N
        if capacity is not None:  # without a force it lasts for ever
            rated = RATED * (np.ravel(capacity) / force) ** EXPONENT
            lasts = [parameter(x) for x in (rated, rated / turns, rated / turns / often)]
    return Life(parameter(force), parameter(turns), *lasts)


def _periods_per_h(mechanism: Mechanism) -> float:
    return 60.0 * mechanism.spec.drive.n_rpm * 360.0 / mechanism.period_deg


def wear_mm(mechanism: Mechanism) -> float | None:
    """Mean depth worn off a slot's walls by a million passages of a pin that does not turn, mm.

    Archard: a volume of k ∫ N |v_s| dt a passage, over the face that the contact sweeps. Of the
    slot that wears most; None without ``wear_mm3_Nm`` or ``face_width_mm``.
    """
    if not mechanism.spec.is_loaded:
        return None
    return only_of([wears_mm(mechanism, passages(mechanism))])[0]


def wears_mm(mechanism: Mechanism, each: Sequence[Passage]) -> Array | None:
    """The same of m designs, (m,), or of one, from the passages of their engagements."""
    spec = mechanism.spec
    k, width = spec.material_wheel.wear_mm3_Nm, spec.size.face_width_mm
    if k is None or width is None:
        return None
    rate = np.ravel(1e6 * k / (width * 1000.0))
    worn: Array = np.asarray([rate * way.work / way.travel_m for way in each])
    most: Array = worn.max(axis=0)
    return most
