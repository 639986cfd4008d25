"""A function at very many places: by polynomials that are as exact as the function's own rounding.

Intervals of a dyadic grid are halved until a polynomial of degree 10 keeps the last digits. It fits
the values at 21 places, numbers of few bits, so that the places are not rounded, and the values'
rounding is halved. Next to a seam, where another formula takes over or a value vanishes, intervals
shrink with the distance: small values keep their digits too. Where an interval has few places, the
function itself is evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, blocks, matrix_product

FEW = 192  # places of an interval that are evaluated themselves: few more than a fit takes
BLOCK = 8192  # places whose powers stay in the processor's cache
DEGREE = 10
NODES = 21  # places of a fit
# Size of the last two of 11 Chebyshev terms, as a fraction of the greatest value: what rounding of
# the values leaves. The next term is smaller by a factor of 20 or more.
TAIL = 3.0 * 2.0**-52
# The values' rounding, as a fraction of the greatest value of all: where these two terms are not
# larger than what the fit leaves, and that is below this, more intervals would not be more exact.
ROUNDING = 8.0 * 2.0**-52
NARROW = 2.0**-24  # narrower intervals have places that are rounded

Function = Callable[[Array], Sequence[Array]]


class _Interval(NamedTuple):
    low: float
    width: float
    first: int  # the first of its places, and the one after the last
    last: int


def fitted(function: Function, x: Array, seams: Sequence[float]) -> list[Array]:
    """The values of a function at many ascending places (k,), one array (k,) a quantity.

    ``function`` returns the values of each quantity at ascending places (n,). Between two of
    ``seams`` it is analytic. Values are as exact as the function's, to one or two units in the last
    place of the greatest value nearby.
    """
    own = [slice(0, 1), slice(len(x) - 1, len(x))]  # places that are evaluated themselves
    out = [np.empty(len(x)) for _ in function(x[:1])]
    width = float(2.0 ** np.ceil(np.log2(max(x[-1] - x[0], NARROW))))
    low = float(np.floor(x[0] / width)) * width
    pending = [_interval(start, width, x) for start in (low, low + width)]  # over all places
    while pending:
        halved: list[_Interval] = []
        fit: list[_Interval] = []
        for interval in pending:
            low, width, first, last = interval
            if last - first < FEW or width < NARROW:
                own.append(slice(first, last))
            elif any(low - 0.5 * width <= seam <= low + 1.5 * width for seam in seams):
                halved.append(interval)
            else:
                fit.append(interval)
        halved += _fit(function, x, fit, out) if fit else []
        pending = [half for interval in halved for half in _halves(interval, x)]
    places = np.unique(np.concatenate([np.arange(one.start, one.stop) for one in own]))
    for block in blocks(len(places), BLOCK):
        for whole, values in zip(out, function(x[places[block]]), strict=True):
            whole[places[block]] = values
    return out


def _interval(low: float, width: float, x: Array) -> _Interval:
    first, last = np.searchsorted(x, (low, low + width)).tolist()
    return _Interval(low, width, first, last)


def _halves(interval: _Interval, x: Array) -> Iterator[_Interval]:
    width = 0.5 * interval.width
    for low in (interval.low, interval.low + width):
        half = _interval(low, width, x)
        if half.last > half.first:
            yield half


def _fit(
    function: Function, x: Array, intervals: Sequence[_Interval], out: Sequence[Array]
) -> list[_Interval]:
    """Fill in the values of intervals where a polynomial serves, and return the others."""
    nodes, basis, terms, powers = _rule()
    low, width = (np.array([getattr(i, name) for i in intervals]) for name in ("low", "width"))
    middle, half = low + 0.5 * width, 0.5 * width
    order = np.argsort(low)
    places = middle[order, None] + half[order, None] * nodes
    values = np.empty((len(out), len(intervals), NODES))
    for whole, own in zip(values, function(places.ravel()), strict=True):
        whole[order] = own.reshape(places.shape)
    centre = values[..., NODES // 2]
    series = matrix_product(values - centre[..., None], terms)
    left = values - centre[..., None] - matrix_product(series, basis)
    rest = np.sqrt((left * left).mean(axis=-1))
    tail, size = abs(series[..., -2:]).sum(axis=-1), abs(values).max(axis=-1)
    scale = size.max(axis=-1, keepdims=True)
    serves = (tail <= TAIL * size) | (tail <= 2.0 * rest) & (rest <= ROUNDING * scale)
    coefficients = matrix_product(series, powers)
    coefficients[..., 0] += centre
    others = []
    for k, interval in enumerate(intervals):
        if not serves[:, k].all():
            others.append(interval)
            continue
        for part in blocks(interval.last - interval.first, BLOCK):
            here = slice(interval.first + part.start, interval.first + part.stop)
            t = (x[here] - middle[k]) / half[k]
            for whole, own in zip(out, coefficients[:, k].tolist(), strict=True):
                whole[here] = _polynomial(own, t)
    return others


def _polynomial(coefficients: Sequence[float], t: Array) -> Array:
    total = coefficients[-1] * t
    for c in coefficients[-2:0:-1]:
        total += c
        total *= t
    total += coefficients[0]
    return total


@cache
def _rule() -> tuple[Array, Array, Array, Array]:
    """Places from -1 to 1; matrices from Chebyshev terms to values there, back, and to powers."""
    nodes = np.round(4096.0 * -np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)) / 4096.0
    values: Array = np.asarray(np.polynomial.chebyshev.chebvander(nodes, DEGREE), dtype=float)
    powers = np.zeros((DEGREE + 1, DEGREE + 1))
    for k in range(DEGREE + 1):
        powers[k, : k + 1] = np.polynomial.chebyshev.cheb2poly([0.0] * k + [1.0])
    # the normal equations are well-conditioned here, and ten times as exact as pinv
    fit: Array = values @ np.linalg.inv(values.T @ values)
    return nodes, values.T, fit, powers
