"""Integrals of functions of designs by Gauss-Legendre rules, halved where a series has not ended.

The last of the n terms from n nodes bound the rule's error, which has the size of term 2 n. A kink
between an end and the node next to it shows as a difference from the series at that end.
"""

from collections.abc import Callable
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from geneva_cli.numerics.arrays import Array, Mask, Whole, blocks, joined, matrix_product

Integrands: TypeAlias = Callable[[Array, Whole], Array]
NODES = 20  # nodes of a rule that suffice for most loads between two cuts
# Fraction of a design's integral that the last terms may have; the error is a tenth at most.
LAST_TERMS = 2e-12


def span_integrals(
    functions: Integrands,
    spans: tuple[Array, Array],
    design: Whole,
    needed: Mask,
) -> Array:
    """The integral of each function over each span: (functions, spans).

    ``functions(x, which)`` returns the functions (functions, m, k) of the spans ``which``, numbers
    (m,), at places (m, k). They may behave as the root of the distance from a span's ends.
    ``design`` (spans,) is the design of each span. ``needed`` (functions, n) selects the integrals
    that are needed; it loses those that are unbounded. Others are infinite. Those of noise are NaN,
    since halving their spans does not help.
    """
    n, count = needed.shape[1], len(design)
    total, size = np.zeros((len(needed), count)), np.zeros(needed.shape)
    of, low, high = np.arange(count), np.zeros(count), np.ones(count)
    for halved in range(40):  # the narrowest spans are 1e-12 of their design's
        whole, last, sizes = _parts(functions, spans, of, np.stack((low, high)))
        lost = ~np.isfinite(sizes)  # spans of an unbounded function are not halved further
        for row, endless in zip(needed, lost, strict=True):
            row[design[of[endless]]] = False
        if not halved:
            for own, row in zip(size, sizes, strict=True):
                own += np.bincount(design[of], row, n)
        open_ = (~(last <= LAST_TERMS * size[:, design[of]]) & needed[:, design[of]]).any(axis=0)
        for own, row in zip(total, whole, strict=True):
            own += np.bincount(of[~open_], row[~open_], count)
        parts = np.bincount(design[of[open_]], minlength=n)
        # a kink or a pole leaves some open parts at each depth, noise twice as many as before
        lost_in_noise = (parts > 20_000)[design[of]]
        total[:, of[open_ & lost_in_noise]] = np.nan
        open_ &= ~lost_in_noise
        if not open_.any():
            return np.where(needed[:, design], total, np.inf)
        middle = 0.5 * (low + high)[open_]
        low, high = np.concatenate((low[open_], middle)), np.concatenate((middle, high[open_]))
        of = np.concatenate((of[open_], of[open_]))
    total[:, of] = np.inf
    return np.where(needed[:, design], total, np.inf)


def _parts(
    functions: Integrands, spans: tuple[Array, Array], of: Whole, fractions: Array
) -> tuple[Array, Array, Array]:
    """Integrals between two fractions of spans, their last terms, and integrals of the sizes.

    Places are at the fraction t² (3 - 2 t) of the span, so that a root at its ends is smooth.
    """
    (a, b), (node, terms, at_ends), rows = spans, _rule(), []
    for here in blocks(len(of), 1024):  # whose nodes fit in the processor's cache
        own, (low, high) = of[here], fractions[:, here]
        half = 0.5 * (high - low)[:, None]
        # designs lie side by side in memory
        t = np.asfortranarray((0.5 * (low + high))[:, None] + half * node)
        # at the ends of a span itself a function may have no value
        inner = np.stack((low > 0.0, high < 1.0), axis=-1)
        t[:, NODES:] = np.where(inner, t[:, NODES:], t[:, [0, NODES - 1]])
        width = (b - a)[own, None]
        rate = width * half * (6.0 * t * (1.0 - t))
        t = t * t * (3.0 - 2.0 * t)
        every = functions(a[own, None] + width * t, own) * rate
        value, apart = every[..., :NODES], every[..., NODES:]
        sums = matrix_product(value, terms)
        apart = np.where(inner, apart - matrix_product(value, at_ends), 0.0)
        last = np.abs(np.concatenate((sums[..., 1:], (1.0 + node[0]) * apart), axis=-1))
        last = last.max(axis=-1)
        rows.append((sums[..., 0], last, matrix_product(np.abs(value), terms[:, 0])))
    return joined(rows)


@cache
def _rule() -> tuple[Array, ...]:
    """Nodes in [-1, 1] and the ends; weights for the sum and the last terms, and for the ends."""
    node, weight = leggauss(NODES)
    *_, before, last = legvander(node, NODES - 1).T
    # The last two terms together: every other term of an even or odd function is 0.
    terms = np.ones(NODES), (NODES - 1.5) * before, (NODES - 0.5) * last
    # the series at an end, by the sum of Christoffel and Darboux
    at_ends = [0.5 * NODES * last / (s - node) for s in (-1.0, 1.0)]
    ends = weight[:, None] * np.column_stack(at_ends)
    return np.append(node, [-1.0, 1.0]), weight[:, None] * np.column_stack(terms), ends
