"""The greatest, least and mean loads of designs; a single design is a batch of one.

Every machine is supported: friction, curved slots, linkages, several rollers. All stretches of the
designs are searched together, one block of designs after the other.

    >>> import numpy as np
    >>> from geneva_cli import External, Load, SideCrank
    >>> from geneva_cli.motion.many import many
    >>> from geneva_cli.motion.machine_spec import Spec
    >>> spec = Spec(External(6), SideCrank(A=0.0), load=Load(inertia_kgm2=2.0, friction=0.1))
    >>> batch = many(spec, {"drive.A": np.array([0.0, 0.6])})
    >>> load_peaks(batch.machine, ["pin_force_N"])["pin_force_N"].max.round(4)
    array([1905.0702,  731.1404])
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from geneva_cli.loads.cycle_quantities import (
    FORCE,
    SQUARED,
    STRESS,
)
from geneva_cli.loads.forces import LoadCase
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import (
    NO_MORE,
    LoadBatch,
    LoadFunctions,
    LoadQuantity,
    load_batch,
)
from geneva_cli.loads.load_groups import of_groups
from geneva_cli.loads.load_search import search_loads, shown_deg, sums_of
from geneva_cli.loads.load_summary import (
    EngagementExtremes,
    LoadSummary,
    sources_of,
    summaries_from,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.jet import Array


def load_peaks(
    mechanism: Mechanism,
    names: Sequence[str],
    own: Mapping[str, LoadQuantity] = NO_MORE,
    case: LoadCase | None = None,
) -> dict[str, PeakArray]:
    """The greatest sizes of quantities, and the first input angles that have them: (m,).

    ``own`` are further quantities by name; ``case`` replaces the machine's own load case.
    """
    mechanism = mechanism.under_load
    case, best = case or load_case(mechanism), dict[str, PeakArray]()
    flat = all(e.slot.walls_flat for e in mechanism.engagements)
    source_of = {n: FORCE if flat and n == STRESS and case.hertz is not None else n for n in names}
    sought = list(dict.fromkeys(source_of.values()))
    for engagement in mechanism.engagements:
        every = load_batch(engagement, case, sought, own)
        sizes, at_deg, _ = _engagement_extremes(mechanism, every, sized=True)
        for name, most, at in zip(sought, sizes, at_deg, strict=True):
            here = PeakArray(most, at)
            best[name] = greater(best[name], here) if name in best else here
    out = {}
    for name, source in source_of.items():
        one = best[source]
        if source != name:  # the square of the stress on a flat wall is proportional to the force
            assert case.hertz is not None
            one = one._replace(max=one.max * np.ravel(case.hertz))
        out[name] = one._replace(max=np.sqrt(one.max)) if name in SQUARED else one
    return out


def load_summaries(
    mechanism: Mechanism, names: Sequence[str], requested: Collection[str] = ("mean", "rms")
) -> dict[str, LoadSummary[Array]]:
    """The summaries of quantities over a period, by their names; signs kept.

    Extremes are exact to some units in the last place of a quantity's greatest size. Means and root
    mean squares are within 1e-12 of that size: quadrature errors of 2e-13 add up over stretches
    that may cancel. ``requested`` selects mean and rms; the other is None.
    """
    mechanism = mechanism.under_load
    _, sources = sources_of(mechanism, names)
    case = load_case(mechanism)
    every = [load_batch(engagement, case, sources) for engagement in mechanism.engagements]
    each = [_engagement_extremes(mechanism, one, requested=requested) for one in every]
    return summaries_from(mechanism, names, each, "mean" in requested)


def _engagement_extremes(
    mechanism: Mechanism,
    every: LoadBatch,
    sized: bool = False,
    requested: Collection[str] = (),
) -> EngagementExtremes:
    """The results of one engagement of m designs, computed in groups."""

    def extremes(some: LoadBatch, n: int) -> Sequence[Array]:
        load = LoadFunctions(some)
        here = search_loads(load, n, sized)
        rows = here.most, here.x
        return (*rows, sums_of(load, here, n, "mean" in requested)) if requested else rows

    most, x, *total = of_groups(every, extremes)
    return EngagementExtremes(most, shown_deg(mechanism, every.engagement, x), *(total or (None,)))
