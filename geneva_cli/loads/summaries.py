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
from typing import Generic, NamedTuple, TypeVar, cast

import numpy as np

from geneva_cli.loads.cycle_quantities import (
    FORCE,
    NEVER_NEGATIVE,
    PRESSED,
    SQUARED,
    STRESS,
    outermost,
)
from geneva_cli.loads.forces import LoadCase, load_case
from geneva_cli.loads.groups import of_groups
from geneva_cli.loads.load_functions import (
    NO_MORE,
    LoadBatch,
    LoadFunctions,
    LoadQuantity,
    load_batch,
)
from geneva_cli.loads.means import means_from, sources_of, sums
from geneva_cli.loads.stretches import on_breaks, spans_of
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.arrays import Number
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.search import SearchResult, search

S = TypeVar("S", float, "float | None", Array)  # of one design, as printed, of a batch


class LoadSummary(NamedTuple, Generic[S]):
    """Greatest and least over the motions, mean and root mean square over a period.

    Input angles are as shown; values are infinite if unbounded. Each is (m,) for m designs, or a
    number of one; as it is printed, None for a value that is not known.
    """

    max: S
    max_at_deg: S
    min: S
    min_at_deg: S
    mean: S | None = None  # None if not requested
    rms: S | None = None


class EngagementExtremes(NamedTuple):
    """Greatest values over one engagement, their places, and the sums; one row for each quantity.

    For signed extremes, the greatest values of the quantities' negatives follow.
    """

    most: Array
    at_deg: Array  # as shown
    total: Array | None  # the result of ``sums``


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


def summaries_from(
    mechanism: Mechanism, names: Sequence[str], each: Sequence[EngagementExtremes], plain: bool
) -> dict[str, LoadSummary[Array]]:
    """The summaries of quantities, from the results of their sources in each engagement.

    With ``plain`` the sums include those of the quantities, besides those of their squares.
    """
    multiple_of, sources = sources_of(mechanism, names)
    totals = [one.total for one in each if one.total is not None]
    means = means_from(mechanism, sources, totals, plain) if totals else {}
    best: dict[str, LoadSummary[Array]] = {}
    for i, name in enumerate(sources):
        k = i + len(sources)
        rows = [(one.most[i], one.at_deg[i], -one.most[k], one.at_deg[k]) for one in each]
        most, most_at, least, least_at = outermost(np.array(rows))
        most, least = _ends_of(name, most, least)
        mean, rms = means.get(name, (None, None))
        best[name] = LoadSummary(most, most_at, least, least_at, mean, rms)
    return {name: _multiple(best[source], factor) for name, (source, factor) in multiple_of.items()}


def _multiple(one: LoadSummary[Array], factor: Array) -> LoadSummary[Array]:
    """The summary of a multiple of the quantity."""
    mean, rms = (None if v is None else v * factor for v in one[4:])
    return LoadSummary(
        one.max * factor, one.max_at_deg, one.min * factor, one.min_at_deg, mean, rms
    )


def _ends_of(name: str, most: Array, least: Array) -> list[Array]:
    """Greatest and least of a quantity, from those of its square or of itself.

    Where the torque changes sign, rounding may leave a size below 0. Either value is replaced by 0
    if it is rounding compared with the other.
    """
    ends = [np.maximum(x, 0.0) if name in NEVER_NEGATIVE else np.asarray(x) for x in (most, least)]
    if name in PRESSED:  # the square goes with the force, and has its rounding
        return [np.sqrt(x) for x in _without_rounding(ends)]
    return _without_rounding([np.sqrt(x) if name in SQUARED else x for x in ends])


def _without_rounding(ends: Sequence[Array]) -> list[Array]:
    """Greatest and least, 0 for one that is below 1e-14 of the other: that is rounding."""
    level = 1e-14 * np.maximum(*[np.where(np.isfinite(x), np.abs(x), 0.0) for x in ends])
    return [np.where(np.abs(x) > level, x, 0.0) for x in ends]


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


def search_loads(load: LoadFunctions, n: int, sized: bool = False) -> SearchResult:
    """The extremes of n designs' loads over a motion, and its stretches."""
    spans = spans_of(load.engagement, n)
    if sized and load.repeats:
        spans = spans[: len(spans) // 2]
    return search(load, spans, n, sized, load.at_mid_motion(n), load.spread)


def sums_of(load: LoadFunctions, result: SearchResult, n: int, plain: bool) -> Array:
    """The integrals of n designs' quantities over the stretches of a search: (rows, n)."""
    bounded = np.asarray(np.isfinite(result.most).reshape(2, -1, n).all(axis=0))
    return sums(load, result.stretches, bounded, n, plain)


def shown_deg(mechanism: Mechanism, engagement: Engagement, x: Array) -> Array:
    """Input angles of an engagement, (rows, m), as they are shown."""
    places = np.reshape(engagement.mid_deg, (-1, 1)) + on_breaks(x, engagement).T
    rows = [_shown(mechanism, places[:, i : i + 1]) for i in range(len(x))]
    return np.hstack([np.broadcast_to(row, (x.shape[1], 1)) for row in rows]).T


def _shown(mechanism: Mechanism, places: Array) -> Number:
    return mechanism.shown_deg(cast("float", places))
