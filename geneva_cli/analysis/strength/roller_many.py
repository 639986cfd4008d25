"""The passages of many designs' rollers: the integrals of ``roller.passage``, all found together.

Motions are cut where torque, sliding or the way along the slot change their signs, as for the means
of the loads, and integrated between to the last digits.

    >>> import numpy as np
    >>> from geneva_cli import External, Load
    >>> from geneva_cli.machine.many import many
    >>> from geneva_cli.machine.spec import Spec
    >>> found = many(Spec(External(6), load=Load(torque_Nm=15.0)), {"wheel.z": np.array([4, 6])})
    >>> passages_of_many(found.machine)[0].travel_m  # 2 L (cos b - (1 - l))
    array([0.08284271, 0.07320508])
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.contact import contact
from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.groups_many import of_groups
from geneva_cli.analysis.loads.loaded_many import (
    NONE,
    Loaded,
    Machine,
    machine,
)
from geneva_cli.analysis.loads.stretches_many import spans_of, to_mid_motion
from geneva_cli.analysis.strength.roller import Passage, halves, passing, turns_back
from geneva_cli.machine.many import taken
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import parameter
from geneva_cli.numerics.quadrature_many import integrals_many
from geneva_cli.numerics.search import search

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

FORCE = ("pin_force_N",)  # whose bound says whether there is one of the integrals


def passages_of_many(mechanism: Mechanism) -> list[Passage]:
    """The passage of each engagement of a period: its integrals are (m,)."""
    return [_passage(mechanism, engagement, 0.0) for engagement in mechanism.engagements]


def by_roller_of_many(mechanism: Mechanism, ways: list[Passage]) -> list[Passage]:
    """Likewise of each roller, as ``roller.by_roller``; ``ways`` are those of the engagements."""
    each = [(one, half) for one in mechanism.engagements for half in halves(one)]
    return [_passage(mechanism, *of) for of in each] if len(each) > len(ways) else ways


def _passage(mechanism: Mechanism, engagement: Engagement, half: float) -> Passage:
    every = machine(engagement, setting(mechanism), FORCE, NONE)
    (rows,) = of_groups(every, lambda some, n: (_group(some, n, half),))
    return Passage(*map(parameter, rows))


def _group(every: Machine, n: int, half: float) -> Array:
    """The integrals of n designs, a row each; of a half of the motion, as of ``roller.passage``."""
    engagement = every[0]
    load = Loaded(every, FORCE, ("slides", "along") if turns_back(engagement) else ("slides",))
    spans = spans_of(engagement, n)
    found = search(load, spans, n, True, load.at_mid_motion(n))
    whole = to_mid_motion(engagement, found.stretches, n)
    design, _, (a, b), positive = whole
    own = np.flatnonzero(half * (a + b) >= 0.0)
    design, a, b, positive = design[own], a[own], b[own], positive[:, own]
    signs = dict(zip(load.kinds, np.where(positive, 1.0, -1.0)[..., None], strict=True))

    def rows(x: Array, which: Whole) -> Array:
        some, given, _ = taken(every, design[which])
        drives, slides = (
            signs[kind][which] if kind in signs else 1.0 for kind in ("drives", "slides")
        )
        found = passing(given, contact(some, x, reactions=False), drives, slides)
        return np.stack(np.broadcast_arrays(*found))

    bounded = np.isfinite(found.most[0])
    every_one = np.full(n, True)
    asked = np.stack((every_one, every_one, bounded, bounded))
    with np.errstate(all="ignore"):
        # a law of points has knots at which its higher derivatives jump
        total = integrals_many(rows, a, b, design, asked, ends=True, analytic=False) * DEGREE
    return np.where(asked, total, np.inf)
