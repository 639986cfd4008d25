"""Integrals of functions of designs: Gauss and Legendre, halved where a series says so.

The values at the rule's n places give the first n terms of a function's Legendre series. The rule
leaves about as much as the term 2 n has, so the last of the n terms bound it, and no second rule is
needed. How fast the terms fall until then does not tell how fast they fall from there: a narrow
feature's terms are hidden below the larger ones of the rest, which fall sooner.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import read_only
from geneva_cli.numerics.quadrature import lobatto, rule

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

DEEPEST = 40
BLOCK = 1024  # spans at a time: their places lie in the processor's cache
NODES = 20  # of a load between its cuts most are settled by so many
FEW = 12  # and by so many where the span is below a share of its design's widest
NARROW = 0.25
MANY = 28  # and by so many where the span is so many times as wide as poles are far
WIDE = 1.0
TERMS = 2  # taken together: of an even or odd function every other one is 0
LEFT = 2e-12  # share of a design's integral that the last terms may have; a tenth is left at most


class Integrands(NamedTuple):
    """Functions, and the spans from ``a`` to ``b`` over which each of them is integrated.

    ``functions(x, which)`` gives the functions (functions, m, k) of the spans ``which`` at places
    (m, k). With ``ends`` they may go with the root of the distance from a span's ends: places are
    then t² (3 - 2 t) of it.
    """

    functions: Callable[[Array, Whole], Array]
    a: Array
    b: Array
    ends: bool = False

    def parts(self, of: Whole, low: Array, high: Array, nodes: int) -> tuple[Array, Array, Array]:
        """Integrals over fractions of spans, their last terms, and integrals of the sizes."""
        node, terms = _rule(nodes, self.ends)
        half = 0.5 * (high - low)
        # designs lie side by side in memory
        t = np.asfortranarray((0.5 * (low + high))[:, None] + half[:, None] * node)
        width = (self.b - self.a)[of, None]
        rate = width * half[:, None]
        if self.ends:
            rate = rate * (6.0 * t * (1.0 - t))
            t = t * t * (3.0 - 2.0 * t)
        value = self.functions(self.a[of, None] + width * t, of) * rate
        found = value @ terms
        last = np.abs(found[..., 1:]).max(axis=-1)
        return found[..., 0], last, np.abs(value) @ terms[:, 0]


def integrals_many(
    integrands: Integrands,
    design: Whole,
    asked: Mask,
    apart: bool = False,
    poles: Array | None = None,
) -> Array:
    """The integral of each function over all spans of each design: (functions, n).

    ``asked`` says of which: others, as of functions without a bound, mean nothing; ``functions``
    may narrow it, where that is seen no sooner.

    With ``apart`` the result is the integral of each span, (functions, spans), to the same share of
    its design's. ``poles`` (spans,) is how far from the real axis the nearest are, if known.
    """
    n, width = asked.shape[1], integrands.b - integrands.a
    into = np.arange(len(width)) if apart else design
    total, size = np.zeros((0, len(width) if apart else n)), np.zeros((0, n))
    unbounded, widest = total != 0.0, np.zeros(n)
    np.maximum.at(widest, design, width)
    narrow = width <= NARROW * widest[design]
    wide = ~narrow & (width > WIDE * (np.inf if poles is None else poles))
    groups = [(FEW, narrow), (NODES, ~(narrow | wide)), (MANY, wide)]
    of = np.concatenate([np.flatnonzero(which) for _, which in groups])
    low, high = np.zeros(len(width)), np.ones(len(width))
    counts = [(nodes, int(which.sum())) for nodes, which in groups]
    for _ in range(DEEPEST):
        found, start = [], 0
        for nodes, count in counts:
            for i in range(start, start + count, BLOCK):
                part = slice(i, min(i + BLOCK, start + count))
                found.append(integrands.parts(of[part], low[part], high[part], nodes))
            start += count
        whole, last, sizes = (np.concatenate(v, axis=1) for v in zip(*found, strict=True))
        if not len(total):
            total, size = (np.zeros((len(whole), v.shape[1])) for v in (total, size))
            unbounded = np.zeros(total.shape, dtype=bool)
            _add(size, design[of], sizes)
        lost = ~np.isfinite(sizes)  # a function without a bound there is not halved for ever
        for own, gone, endless in zip(asked, lost, unbounded, strict=True):
            own[design[of[gone]]] = False
            endless[into[of[gone]]] = True
        open_ = (~(last <= LEFT * size[:, design[of]]) & asked[:, design[of]]).any(axis=0)
        _add(total, into[of[~open_]], whole[:, ~open_])
        if not open_.any():
            return np.where(unbounded, np.inf, total)
        middle = 0.5 * (low + high)[open_]
        low, high = np.concatenate((low[open_], middle)), np.concatenate((middle, high[open_]))
        of = np.concatenate((of[open_], of[open_]))
        counts = [(NODES, len(of))]
    total[:, into[of]] = np.inf
    return np.where(unbounded, np.inf, total)


def _add(total: Array, design: Whole, rows: Array) -> None:
    for own, row in zip(total, rows, strict=True):
        own += np.bincount(design, row, len(own))


@cache
def _rule(nodes: int, ends: bool) -> tuple[Array, Array]:
    """Places in [-1, 1], with both ends or not; and the weights, then those of the last terms.

    Beside an end a kink shows in no value of Gauss's rule; in Lobatto's the end's own tells it.
    """
    node, weight = lobatto(nodes) if ends else rule(nodes)
    series = np.polynomial.legendre.legvander(node, nodes - 1) * (np.arange(nodes) + 0.5)
    sums = weight[:, None] * np.column_stack([np.ones(nodes), series[:, -TERMS:]])
    return read_only((node, sums))
