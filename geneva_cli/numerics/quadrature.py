"""Integrals of smooth functions to the last digits: Gauss and Legendre, halved where needed.

A span from a to b is run through as x = a + (b - a) s² (3 - 2 s): so a root at its end, as of a
force that begins there, is as smooth as the rest.

>>> f"{integrals(lambda x, _: (np.sin(x),), [(0.0, np.pi)])[0]:.15g}"
'2'
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import read_only, rows_of

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

# places and the numbers of their spans -> the values of each function
Integrands: TypeAlias = "Callable[[Array, Whole], Sequence[Array]]"

NODES = 28
# Share by which two halves may differ from the whole; their own error is its 2**-56.
AGREED = 1e-13
# Halves of what is smooth differ less than the whole by more than this, and so do those of a kink;
# where the difference is small and they do not, it is rounding.
SHRINKS = 2.4
NOISE = 1e-11
DEEPEST = 40
MOST = 4096  # intervals on which one function is open


@cache
def rule(nodes: int) -> tuple[Array, Array]:
    """Places in [-1, 1] and weights of Gauss and Legendre, by Newton on the polynomial."""
    x = np.cos(np.pi * (np.arange(nodes) + 0.75) / (nodes + 0.5))
    for _ in range(6):
        before, here = np.ones(nodes), x
        for k in range(2, nodes + 1):
            before, here = here, ((2 * k - 1) * x * here - (k - 1) * before) / k
        slope = nodes * (before - x * here) / ((1.0 - x) * (1.0 + x))
        x = x - here / slope
    return read_only((x, 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope)))


def integrals(functions: Integrands, spans: Sequence[tuple[float, float]]) -> list[float]:
    """The integral of each function over all spans, on each of which all are smooth.

    An interval is halved until its halves agree with it; a function without a bound never does,
    and its integral is infinite.
    """
    every, _ = _settled(functions, spans)
    return [math.fsum(row) if np.isfinite(row).all() else math.inf for row in every.tolist()]


def integral_of_each(
    function: Callable[[Array, Whole], Array], spans: Sequence[tuple[float, float]]
) -> list[float]:
    """The integral of one function over each span; what is a rounding of their sum is no matter."""
    (every,), of = _settled(lambda x, span: (function(x, span),), spans)
    return [
        math.fsum(part) if np.isfinite(part).all() else math.inf
        for part in (every[of == k].tolist() for k in range(len(spans)))
    ]


def _settled(functions: Integrands, spans: Sequence[tuple[float, float]]) -> tuple[Array, Whole]:
    """Rows of the functions' integrals over the intervals in the end, and the intervals' spans."""
    node, weight = rule(NODES)
    start, end = (np.array(side, dtype=float) for side in zip(*spans, strict=True))
    span = np.arange(len(start))
    low, high = 0.0 * start, 0.0 * start + 1.0

    def parts(low: Array, high: Array, span: Whole) -> tuple[Array, Array]:
        """Of each function, a row: the integral over each interval, and that of its size."""
        half = 0.5 * (high - low)
        s = (0.5 * (low + high))[:, None] + half[:, None] * node
        a, b, of = start[span, None], end[span, None], np.repeat(span, NODES)
        r = 1.0 - s
        x = np.where(
            s < 0.5,
            a + (b - a) * (s * s * (1.0 + 2.0 * r)),
            b - (b - a) * (r * r * (1.0 + 2.0 * s)),
        )
        with np.errstate(all="ignore"):
            rows = functions(x.ravel(), of)
        value = rows_of(rows, x.size).reshape(-1, *x.shape)
        share = 6.0 * (b - a) * half[:, None] * (s * r * weight)
        with np.errstate(invalid="ignore"):
            return (value * share).sum(axis=-1), (abs(value) * share).sum(axis=-1)

    whole, size = parts(low, high, span)
    total = size.sum(axis=1, keepdims=True)
    done: list[Array] = []
    of: list[Whole] = []
    before = np.full(whole.shape, np.inf)
    sure = np.ones(len(whole), dtype=bool)
    for _ in range(DEEPEST):
        middle = 0.5 * (low + high)
        ends = np.concatenate((low, middle)), np.concatenate((middle, high))
        halves = parts(*ends, np.concatenate((span, span)))[0]
        left, right = halves[:, : len(low)], halves[:, len(low) :]
        with np.errstate(invalid="ignore"):
            off = abs(left + right - whole)
            noise = (off > before / SHRINKS) & (off < NOISE * total)
            opened = (off > AGREED * total) & ~noise
        # a function that is open everywhere is of rounding, which no halving makes any smaller
        sure &= opened.sum(axis=1) <= MOST
        open_ = np.any(opened[sure], axis=0)
        done += [left[:, ~open_], right[:, ~open_]]
        of += [span[~open_]] * 2
        if not open_.any():
            break
        low, middle, high, span = low[open_], middle[open_], high[open_], span[open_]
        low, high = np.concatenate((low, middle)), np.concatenate((middle, high))
        span = np.concatenate((span, span))
        whole = np.concatenate((left[:, open_], right[:, open_]), axis=1)
        before = np.concatenate((off[:, open_], off[:, open_]), axis=1)
    else:
        done.append(whole)
        of.append(span)
    return np.concatenate(done, axis=1), np.concatenate(of)
