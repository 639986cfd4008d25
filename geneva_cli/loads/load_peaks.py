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
from typing import cast

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle_quantities import FORCE, SQUARED, STRESS, plain_values
from geneva_cli.loads.forces import LoadCase
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import NO_MORE, LoadFunctions, LoadQuantity
from geneva_cli.loads.load_summary import (
    EngagementExtremes,
    LoadSummary,
    sources_of,
    summaries_from,
)
from geneva_cli.loads.stretches import on_breaks, spans_of
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Number, Which, Whole, array, matrix_product
from geneva_cli.numerics.cuts import gathered, spread
from geneva_cli.numerics.extremes import SearchResult, search
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.quadrature import Integrands, span_integrals


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
        result = search_loads(LoadFunctions(engagement, case, sought, own), sized=True)
        at_deg = shown_deg(mechanism, engagement, result.x)
        for name, *row in zip(sought, result.most, at_deg, strict=True):
            here = PeakArray(*row)
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
    case, each = load_case(mechanism), []
    for engagement in mechanism.engagements:
        load = LoadFunctions(engagement, case, sources)
        result = search_loads(load)
        total = sums_of(load, result, "mean" in requested) if requested else None
        at_deg = shown_deg(mechanism, engagement, result.x)
        each.append(EngagementExtremes(result.most, at_deg, total))
    return summaries_from(mechanism, names, each, "mean" in requested)


def search_loads(load: LoadFunctions, sized: bool = False) -> SearchResult:
    """The extremes of designs' loads over a motion, and its stretches."""
    spans = spans_of(load.engagement, load.n)
    if sized and load.repeats:
        spans = spans[: len(spans) // 2]
    return search(load, spans, sized, load.at_mid_motion(), load.spread)


def shown_deg(mechanism: Mechanism, engagement: Engagement, x: Array) -> Array:
    """Input angles of an engagement, (rows, m), as they are shown."""
    places = np.reshape(engagement.mid_deg, (-1, 1)) + on_breaks(x, engagement).T
    rows = [_shown(mechanism, places[:, i : i + 1]) for i in range(len(x))]
    return np.hstack([np.broadcast_to(row, (x.shape[1], 1)) for row in rows]).T


def _shown(mechanism: Mechanism, places: Array) -> Number:
    return mechanism.shown_deg(cast("float", places))


def sums_of(load: LoadFunctions, result: SearchResult, plain: bool) -> Array:
    """The integrals by the angle in radians of the squares and, with ``plain``, of the quantities.

    They are over the stretches of a search, (names, n) for each, and infinite for quantities
    without a bound. Only quantities that are searched by their squares behave as a root at the ends
    of their stretches.
    """
    pieces, n = result.stretches, load.n
    bounded = np.asarray(np.isfinite(result.most).reshape(2, -1, n).all(axis=0))
    # pieces of one span together: a motion of several pieces is evaluated in one of them at a time
    order = np.argsort(pieces.span, kind="stable")
    design, (a, b) = pieces.design[order], pieces.x[:, order]
    signs = np.where(pieces.positive, 1.0, -1.0)[:, order]
    w = load.spread[design, 0]

    def rows(u: Array, which: Whole) -> Array:
        width = w[which, None]
        x, rate = gathered(u, width), np.hypot(1.0, np.sinh(u / width))
        x = np.clip(x, a[which, None], b[which, None])
        return powers(load, x, design[which], signs[:, which, None], plain) * rate

    rooted = plain and any(name in SQUARED for name in load.names)
    needed = np.tile(bounded, (2 if plain else 1, 1))
    with np.errstate(all="ignore"):
        spans = Integrands(rows, spread(a, w), spread(b, w), rooted)
        total = span_integrals(spans, design, needed)
        if load.engagement.slot.curved:
            total += _to_mid_motion(load, plain)
    total[~needed] = np.inf
    return total * DEGREE


def _to_mid_motion(load: LoadFunctions, plain: bool) -> Array:
    """The integrals of ``sums_of`` next to mid-motion of curved slots, by the angle in degrees.

    No stretch reaches there. The integral of a cubic from 0 to 1 follows from its values at 1, 2
    and 3 (Adams and Bashforth).
    """
    places, weights = np.array([1.0, 2.0, 3.0]), np.array([23.0, -16.0, 5.0]) / 12.0
    total = np.zeros(1)
    for end in (load.engagement.entry_deg, load.engagement.exit_deg):
        near = np.broadcast_to(np.reshape(NEAR_CUSP * end, (-1, 1)), (load.n, 1))
        values = powers(load, near * places, slice(0, load.n), None, plain)
        total = total + matrix_product(values, weights) * np.abs(near[:, 0])
    return total


def powers(load: LoadFunctions, x: Array, which: Which, signs: Array | None, plain: bool) -> Array:
    """The squares of the quantities and, with ``plain``, the quantities themselves after them."""
    (here, *_), wanted = load.at(x, which, 0, signs)
    count = len(load.names)
    out = np.empty((2 * count if plain else count, *x.shape[::-1])).swapaxes(1, 2)
    for i, (name, quantity) in enumerate(zip(load.names, wanted, strict=True)):
        value = array(quantity(here).value.c[0])
        out[i] = value if name in SQUARED else value * value
        if plain:
            out[count + i] = plain_values(value, name)
    return out
