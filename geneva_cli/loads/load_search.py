"""Searches of one engagement's loads for extremes, and their integrals over its stretches."""

from __future__ import annotations

from typing import cast

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle_quantities import SQUARED, plain_values
from geneva_cli.loads.load_functions import ContactState, LoadFunctions, signed_instant
from geneva_cli.loads.stretches import on_breaks, spans_of
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Number, Whole, array, matrix_product
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.quadrature import Integrands, span_integrals
from geneva_cli.numerics.smooth_pieces import gathered, spread
from geneva_cli.numerics.stretch_search import SearchResult, search


def search_loads(load: LoadFunctions, n: int, sized: bool = False) -> SearchResult:
    """The extremes of n designs' loads over a motion, and its stretches."""
    spans = spans_of(load.engagement, n)
    if sized and load.repeats:
        spans = spans[: len(spans) // 2]
    return search(load, spans, n, sized, load.at_mid_motion(n), load.spread)


def shown_deg(mechanism: Mechanism, engagement: Engagement, x: Array) -> Array:
    """Input angles of an engagement, (rows, m), as they are shown."""
    places = np.reshape(engagement.mid_deg, (-1, 1)) + on_breaks(x, engagement).T
    rows = [_shown(mechanism, places[:, i : i + 1]) for i in range(len(x))]
    return np.hstack([np.broadcast_to(row, (x.shape[1], 1)) for row in rows]).T


def _shown(mechanism: Mechanism, places: Array) -> Number:
    return mechanism.shown_deg(cast("float", places))


def sums_of(load: LoadFunctions, result: SearchResult, n: int, plain: bool) -> Array:
    """The integrals by the angle in radians of the squares and, with ``plain``, of the quantities.

    They are over the stretches of a search, (names, n) for each, and infinite for quantities
    without a bound. Only quantities that are searched by their squares behave as a root at the ends
    of their stretches.
    """
    pieces = result.stretches
    bounded = np.asarray(np.isfinite(result.most).reshape(2, -1, n).all(axis=0))
    # pieces of one span together: a motion of several pieces is evaluated in one of them at a time
    order = np.argsort(pieces.span, kind="stable")
    design, (a, b) = pieces.design[order], pieces.x[:, order]
    signs = np.where(pieces.positive, 1.0, -1.0)[:, order]
    w = load.spread[design, 0]

    def rows(u: Array, which: Whole) -> Array:
        x, rate = gathered(u, w[which, None])
        state = load.at(np.clip(x, a[which, None], b[which, None]), design[which], 0)
        return powers(load, state, signs[:, which, None], plain) * rate

    rooted = plain and any(name in SQUARED for name in load.names)
    needed = np.tile(bounded, (2 if plain else 1, 1))
    with np.errstate(all="ignore"):
        spans = Integrands(rows, spread(a, w), spread(b, w), rooted)
        total = span_integrals(spans, design, needed)
        if load.engagement.slot.curved:
            total += _to_mid_motion(load, n, plain)
    total[~needed] = np.inf
    return total * DEGREE


def _to_mid_motion(load: LoadFunctions, n: int, plain: bool) -> Array:
    """The integrals of ``sums_of`` next to mid-motion of curved slots, by the angle in degrees.

    No stretch reaches there. The integral of a cubic from 0 to 1 follows from its values at 1, 2
    and 3 (Adams and Bashforth).
    """
    places, weights = np.array([1.0, 2.0, 3.0]), np.array([23.0, -16.0, 5.0]) / 12.0
    total = np.zeros(1)
    for end in (load.engagement.entry_deg, load.engagement.exit_deg):
        near = np.broadcast_to(np.reshape(NEAR_CUSP * end, (-1, 1)), (n, 1))
        values = powers(load, load.at(near * places, np.arange(n), 0), None, plain)
        total = total + matrix_product(values, weights) * np.abs(near[:, 0])
    return total


def powers(load: LoadFunctions, state: ContactState, signs: Array | None, plain: bool) -> Array:
    """The squares of the quantities and, with ``plain``, the quantities themselves after them."""
    case, at, shape, wanted = state
    here = signed_instant(load.kinds, case, at, signs).instant
    count = len(load.names)
    out = np.empty((2 * count if plain else count, *shape[::-1])).swapaxes(1, 2)
    for i, (name, quantity) in enumerate(zip(load.names, wanted, strict=True)):
        value = array(quantity(here).value.c[0])
        out[i] = value if name in SQUARED else value * value
        if plain:
            out[count + i] = plain_values(value, name)
    return out
