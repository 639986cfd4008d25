"""Maxima of a vibration: the load's greatest acceleration, and the lobes of the residual."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.panels import NODES, SERIES, TERMS, Panels, X
from geneva_cli.numerics.arrays import Array, Whole, joined, matrix_product

legendre, chebyshev = np.polynomial.legendre, np.polynomial.chebyshev
# values at the nodes -> integrals from -1 to each node, and to 1
_ENDS = np.append(X, 1.0)
_INTEGRALS = matrix_product(
    np.array(
        [legendre.legval(_ENDS, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(NODES)]
    ).T,
    SERIES,
)


def greatest_accelerations(panels: Panels, motion: Whole, swing: Oscillator[Array]) -> Array:
    """Return the greatest size of each load's acceleration by u over the step: (n,).

    It is over the motion, with the load at rest at entry. ``motion`` (n,) are the motions of the
    oscillators by number. A shape's second derivative is integrated over pieces of its panels,
    which are short enough for the swing to have few terms on each.
    """
    most, omega, p = np.zeros(len(motion)), 2.0 * np.pi * swing.ratio, swing.p
    of, panel, first = panels.paired(motion)
    # Panels are cut so that |p h| is at most 2, with h half a piece's width: a dozen terms suffice.
    count = np.maximum(np.ceil(omega[of] * panels.half[panel] / 2.0), 1.0).astype(np.intp)
    last = np.cumsum(count)
    begin = last[first] - count[first]
    total = np.append(begin[1:], last[-1]) - begin
    # the load lags by a jump of the wheel's velocity at entry, where there is one
    begins_at = (panels.series[0, panel[first]] * (-1.0) ** np.arange(TERMS)).sum(axis=1)
    z = np.where(panels.smooth[motion] == 0, -begins_at, 0.0).astype(complex)
    active, start = np.arange(len(motion)), 0
    while len(active):
        wide = max(1, 4096 // len(active))  # 4096 pieces at a time fit in the cache
        at = start + np.arange(min(wide, int(total[active].max()) - start))
        there = at < total[active][:, None]
        number = (begin[active][:, None] + at)[there]
        pair = np.searchsorted(last, number, side="right")
        place, cut = number - last[pair] + count[pair], count[pair]
        half, rate = panels.half[panel[pair]] / cut, p[of[pair]]
        series = panels.series[1, panel[pair]].T[:, :, None]
        u = (2.0 * place[:, None] + 1.0 + X) / cut[:, None] - 1.0
        bent = legendre.legval(u, series, tensor=False)
        # z' = p z - s'': contribution of a piece, seen from its left end
        back = np.exp(-(rate * half)[:, None] * (1.0 + X))
        added = -half[:, None] * matrix_product(bent * back, _INTEGRALS.T)
        ahead = np.exp((rate * half)[:, None] * (1.0 + _ENDS))
        own, whole = np.zeros((2, *there.shape), dtype=complex)
        whole += 1.0
        own[there], whole[there] = added[:, -1], ahead[:, -1]
        begins, end = np.empty_like(own), z[active]
        for k in range(len(at)):  # each piece ends at whole (z + own) from its own start z
            begins[:, k] = end
            end = whole[:, k] * (end + own[:, k])
        z[active] = end
        swung = ahead * (begins[there][:, None] + added)
        w = omega[of[pair]][:, None]
        real, r = rate.real[:, None], swung.imag / rate.imag[:, None]
        load = 2.0 * real * (swung.real + real * r) - w * w * r
        _take_most(most, load, of[pair])
        start += len(at)
        active = active[total[active] > start]
    return most


def _take_most(most: Array, load: Array, of: Whole) -> None:
    """Update ``most`` with |load|, known at nodes and right ends, and its maxima between them."""
    size = np.abs(load)
    np.maximum.at(most, of, size.max(axis=1))
    # a sample may be 2 % below its piece's maximum
    near = np.flatnonzero(size.max(axis=1) >= most[of] * (1.0 - 0.02))
    series = matrix_product(load[near, :NODES], SERIES.T).T
    slope = legendre.legder(series)
    bend = legendre.legder(slope)
    x = X[size[near, :NODES].argmax(axis=1)]
    for _ in range(8):  # Newton steps from the greatest sample of a piece to its maximum
        turn, rate = (legendre.legval(x, c, tensor=False) for c in (bend, slope))
        step = np.divide(rate, turn, out=np.zeros_like(x), where=turn != 0.0)
        x = np.clip(x - step, -1.0, 1.0)
    np.maximum.at(most, of[near], np.abs(legendre.legval(x, series, tensor=False)))


class Lobes(NamedTuple):
    """Local maxima of the residuals of n oscillators: number, period ratio and residual of each."""

    which: Whole
    ratio: Array
    share: Array


def lobes(share_at: Callable[[Whole, Array], Array], low: Array, high: Array) -> Lobes:
    """Return the local maxima of n residuals, each between its own two period ratios.

    ``share_at(which, ratio)`` gives the residuals of the oscillators ``which``, (k,) each. Their
    squares are band-limited: over the period ratio they oscillate at most once per 1. So closely
    spaced samples find the maxima, and a polynomial between them places each to the last digits. A
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
    vander: Array = chebyshev.chebvander(nodes, degree).astype(float)
    series = (matrix_product(square, vander) * (2.0 / (degree + 1))).T
    slope = chebyshev.chebder(series)
    bend = chebyshev.chebder(slope)
    x = np.zeros(len(which))
    for _ in range(6):  # Newton steps
        turn, rate = (chebyshev.chebval(x, c, tensor=False) for c in (bend, slope))
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
