"""Integrals of functions of designs by Gauss-Legendre rules, halved where a series has not ended.

The values at the rule's n nodes give the first n terms of a function's Legendre series. The error
of the rule is about the size of term 2 n. So the last of the n terms bound it, and no second rule
is needed. Their rate of decay proves nothing about later terms: those of a narrow feature are
hidden below larger ones, which decay sooner.
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
BLOCK = 1024  # spans at a time: their nodes fit in the processor's cache
NODES = 20  # nodes that settle most loads between two cuts
FEW = 12  # nodes for a span below NARROW times its design's widest
NARROW = 0.25
MANY = 28  # nodes for a span that is WIDE times as wide as its poles are far
WIDE = 1.0
TERMS = 2  # last terms taken together: every other term of an even or odd function is 0
# fraction of a design's integral that the last terms may have; the error is a tenth at most
LEFT = 2e-12


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


def span_integrals(
    integrands: Integrands,
    design: Whole,
    asked: Mask,
    apart: bool = False,
    poles: Array | None = None,
) -> Array:
    """The integral of each function over all spans of each design: (functions, n).

    ``asked`` (functions, n) selects the integrals that are needed; others, such as unbounded ones,
    are meaningless. ``functions`` may narrow it later. ``functions(x, which)`` gives the functions
    (functions, m, k) of the spans ``which`` at places (m, k).

    With ``apart`` the result is the integral of each span, (functions, spans), to the same
    fraction of its design's. ``poles`` (spans,) is the distance of the nearest poles from the real
    axis, if known.
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
        lost = ~np.isfinite(sizes)  # a function without a bound is not halved for ever
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
    """Nodes in [-1, 1], with both ends or without; the weights, and the weights of the last terms.

    A kink near an end affects no node of a Gauss rule; a Lobatto rule has a node at the end.
    """
    node, weight = lobatto(nodes) if ends else rule(nodes)
    series = np.polynomial.legendre.legvander(node, nodes - 1) * (np.arange(nodes) + 0.5)
    sums = weight[:, None] * np.column_stack([np.ones(nodes), series[:, -TERMS:]])
    return read_only((node, sums))
