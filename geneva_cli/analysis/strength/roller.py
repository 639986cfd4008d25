"""The roller as a bearing, and the slot that it runs in: work, turns, life and wear.

Over a motion the roller rolls along its wall, v_s being the speed at which it would rub if it did
not turn in the body that carries it, and N the force on it. A bearing that carries N while it
turns by |v_s|/r per second lives as under the constant force (ISO 281, roller bearings)

    P = (∫ N^p |v_s| dt / ∫ |v_s| dt)^(1/p),  p = 10/3,  L10 = 10^6 (C/P)^p revolutions.

Integrals are cut where torque, sliding or the motion change, and so to the last digits.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.contact import contact, is_straight
from geneva_cli.analysis.loads.forces import forces, setting, sliding
from geneva_cli.analysis.loads.stretches import Signs, whole
from geneva_cli.numerics.quadrature import integrals

if TYPE_CHECKING:
    from geneva_cli.analysis.loads.forces import Setting
    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

EXPONENT = 10.0 / 3.0  # p, of line contact
RATED = 1e6  # revolutions that C is rated for


class Passage(NamedTuple):
    """One roller's way through one slot, in SI units; infinite where the force has no bound."""

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
def passage(engagement: Engagement, given: Setting) -> Passage:
    """The integrals over one motion.

    >>> from geneva_cli import External, Load, Size
    >>> from geneva_cli.machine.mechanism import build
    >>> from geneva_cli.machine.spec import Spec
    >>> m = build(Spec(External(6), size=Size(200.0, 8.0), load=Load(torque_Nm=15.0)))
    >>> round(passage(m.engagements[0], setting(m)).travel_m, 12)  # 2 L (cos b - (1 - l))
    0.146410161514
    """
    pieces = whole(engagement, given)
    if not engagement.motion.symmetric and is_straight(engagement):  # else it turns at mid-motion
        signs = Signs(engagement, [piece[:2] for piece in pieces], [lambda at: at.along])
        pieces = signs.cut(pieces, lambda piece: 0, "pays")
    drives, slides = (np.array(s) for s in list(zip(*pieces, strict=True))[2:4])

    def rows(x: Array, span: Whole) -> list[Array]:
        at = contact(engagement, x, reactions=False)
        found = forces(given, at, drives[span], slides[span])
        rubs = abs(sliding(at, drives[span], given.radius).arrays()[0]) * given.L
        with np.errstate(all="ignore"):
            force = np.where(found.grip.c[0] > 0.0, found.force.c[0], np.inf) * at.touches.c[0]
            # nothing presses on a wall where nothing is to be turned
            force = np.where(found.torque.c[0] == 0.0, 0.0, force)
            along = abs(at.along.arrays()[0]) * given.L * at.touches.c[0]
            return [along, rubs, force * rubs, force**EXPONENT * rubs]

    radian = math.radians(1.0)  # the integrals are by degrees
    return Passage(*(radian * sum_ for sum_ in integrals(rows, [(p.start, p.end) for p in pieces])))


def passages(mechanism: Mechanism) -> list[Passage]:
    """The passage of each engagement of a period."""
    given = setting(mechanism)
    return [passage(engagement, given) for engagement in mechanism.engagements]


def rollers(mechanism: Mechanism) -> int:
    """How many rollers there are on the crank."""
    spec = mechanism.spec
    return len(spec.wheel.steps or spec.drive.roller_angles_deg or ()) or spec.drive.rollers


def life(mechanism: Mechanism) -> Life | None:
    """The life of the roller that wears out first; None where nothing is known to load it.

    Each roller moves the wheel in its turn: of several, each makes its own share of the motions.
    """
    spec = mechanism.spec
    if not spec.is_loaded:
        return None
    each, m = passages(mechanism), rollers(mechanism)
    own = [each[i::m] for i in range(min(m, len(each)))]
    radius_m = mechanism.roller_radius_mm / 1000.0
    found = []
    for ways in own:
        rolled = math.fsum(way.rolled_m for way in ways)
        force = (math.fsum(way.load for way in ways) / rolled) ** (1.0 / EXPONENT)
        turns = rolled / len(ways) / (2.0 * math.pi * radius_m)
        found.append((force, turns, _motions_per_h(mechanism, len(ways))))
    force, turns, often = max(found, key=lambda f: f[0] ** EXPONENT * f[1] * f[2])
    capacity = spec.material_roller.dynamic_capacity_N
    if capacity is None:
        return Life(force, turns, None, None, None)
    lasts = RATED * (capacity / force) ** EXPONENT if force else math.inf
    return Life(force, turns, lasts, lasts / turns, lasts / turns / often)


def _motions_per_h(mechanism: Mechanism, ways: int) -> float:
    """Motions that one roller makes in an hour, ``ways`` of a period's being its own."""
    periods = 60.0 * mechanism.spec.drive.n_rpm * 360.0 / mechanism.period_deg
    share = ways if len(mechanism.engagements) >= rollers(mechanism) else 1.0 / rollers(mechanism)
    return periods * share


def wear_mm(mechanism: Mechanism) -> float | None:
    """Mean depth worn off a slot's walls by a million passages of a pin that does not turn, mm.

    Archard: a volume of k ∫ N |v_s| dt a passage, over the face that the contact sweeps. Of the
    slot that wears most; None without ``wear_mm3_Nm`` or ``face_width_mm``.
    """
    spec = mechanism.spec
    k, width = spec.material_wheel.wear_mm3_Nm, spec.size.face_width_mm
    if k is None or width is None or not spec.is_loaded:
        return None
    return max(1e6 * k * way.work / (width * 1000.0 * way.travel_m) for way in passages(mechanism))
