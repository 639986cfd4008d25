"""The lobes of the residual: local maxima of a motion's vibration over the period ratio.

The residual's square is band-limited: over the period ratio it oscillates at most once per 1. So
closely spaced samples find its maxima, and a polynomial between them places each to the last
digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.vibration.panels import Panels
from geneva_cli.numerics.arrays import Array, Whole, joined, matrix_product

_chebyshev = np.polynomial.chebyshev


class Lobes(NamedTuple):
    """Local maxima of the residuals of n oscillators: number, period ratio and residual of each."""

    which: Whole
    ratio: Array
    share: Array


def lobes(share_at: Callable[[Whole, Array], Array], low: Array, high: Array) -> Lobes:
    """Return the local maxima of n residuals, each between its own two period ratios.

    ``share_at(which, ratio)`` gives the residuals of the oscillators ``which``, (k,) each. A
    maximum nearer than a sample to a minimum is left out: damping makes such flat ones.
    """
    # 16 samples for each 1 of the period ratio
    count = np.maximum(64, np.ceil(16 * (high - low)).astype(np.intp))
    apart = (high - low) / count
    first, last = low - apart, high + apart  # a maximum next to an end has a sample beyond it
    maxima = []
    for number in sorted(set(count.tolist())):
        some = np.flatnonzero(count == number)
        ratio = np.linspace(first[some], last[some], number + 3, axis=1)
        share = share_at(np.repeat(some, number + 3), ratio.ravel()).reshape(ratio.shape)
        before, here, after = share[:, :-2], share[:, 1:-1], share[:, 2:]
        row, at = np.nonzero((here >= before) & (here > after))
        maxima.append((some[row], ratio[row, at + 1], apart[some[row]]))
    which, middle, reach = joined(maxima)
    degree = 12  # of the polynomial between two samples about a maximum: exact to a double there
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    places = middle[:, None] + reach[:, None] * nodes
    square = share_at(np.repeat(which, len(nodes)), places.ravel()).reshape(places.shape) ** 2
    # at Chebyshev's nodes his coefficients are sums over them
    vander: Array = _chebyshev.chebvander(nodes, degree).astype(float)
    series = (matrix_product(square, vander) * (2.0 / (degree + 1))).T
    series[0] *= 0.5
    slope = _chebyshev.chebder(series)
    bend = _chebyshev.chebder(slope)
    x = np.zeros(len(which))
    for _ in range(6):  # Newton steps
        turn = _chebyshev.chebval(x, bend, tensor=False)
        rate = _chebyshev.chebval(x, slope, tensor=False)
        step = np.divide(rate, turn, out=np.zeros_like(x), where=turn < 0.0)
        x = np.clip(x - step, -1.0, 1.0)
    ratios = middle + reach * x
    inside = (ratios >= low[which]) & (ratios <= high[which])
    which, ratios = which[inside], ratios[inside]
    return Lobes(which, ratios, share_at(which, ratios))


def highest_ratio(panels: Panels, share: float, damping: float) -> float:
    """Return a period ratio above which a motion never leaves more than this fraction of the step.

    The residual is at most the variation of a derivative over Omega to its order, and over sqrt(1 -
    zeta²).
    """
    variation = panels.variation[: int(panels.smooth[0]) + 1, 0]
    orders = np.arange(1, len(variation) + 1)
    # a variation may exceed that of its samples by 2 %
    most = 1.02 * variation / math.sqrt(1.0 - damping * damping)
    omega = (most / share) ** (1.0 / orders)
    return float(omega.min()) / (2.0 * math.pi)
