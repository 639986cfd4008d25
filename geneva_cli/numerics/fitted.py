"""A function at very many places: by polynomials that are as exact as the function's own rounding.

Intervals of a dyadic grid are halved until a polynomial of degree 10 keeps the last digits. It fits
the values at 21 places, numbers of few bits, so that the places are not rounded, and the values'
rounding is halved. Next to a seam, where another formula takes over or a value vanishes, intervals
shrink with the distance: small values keep their digits too. Where an interval has few places, the
function itself is evaluated.
"""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from geneva_cli.numerics.arrays import Array, Whole, blocks, matrix_product

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


def fitted(function: Function, x: Array, seams: Sequence[float]) -> list[Array]:
    """The values of a function at many ascending places (k,), one array (k,) a quantity.

    ``function`` returns the values of each quantity at ascending places (n,). Between two of
    ``seams`` it is analytic. Values are as exact as the function's, to one or two units in the last
    place of the greatest value nearby.
    """
    out = [np.empty(len(x)) for _ in function(x[:1])]
    itself = np.full(len(x), False)  # places that are evaluated themselves
    itself[[0, -1]] = True
    width = 2.0 * float(2.0 ** np.ceil(np.log2(max(x[-1] - x[0], NARROW))))
    lows = np.floor(x[:1] / (0.5 * width)) * (0.5 * width)  # of intervals of one width
    while len(lows):
        width *= 0.5
        lows = np.sort(np.append(lows, lows + width))
        ends = np.searchsorted(x, (lows, lows + width))
        few = (ends[1] - ends[0] < FEW) | (width < NARROW)
        for first, last in ends[:, few].T:
            itself[first:last] = True
        apart = np.subtract.outer(lows + 0.5 * width, seams)
        smooth = ~few & (np.abs(apart) > width).all(axis=1)
        halved = _fit(function, x, lows[smooth], width, ends[:, smooth], out)
        lows = np.append(lows[~few & ~smooth], halved)
    places = np.flatnonzero(itself)
    for block in blocks(len(places), BLOCK):
        for whole, values in zip(out, function(x[places[block]]), strict=True):
            whole[places[block]] = values
    return out


def _fit(
    function: Function, x: Array, low: Array, width: float, ends: Whole, out: Sequence[Array]
) -> Array:
    """Fill in the values of intervals where a polynomial serves, and return the others' begins."""
    if not len(low):
        return low
    nodes, basis, terms, powers = _rule()
    half = 0.5 * width
    middle = low + half
    places = middle[:, None] + half * nodes
    values = np.stack(function(places.ravel())).reshape(-1, *places.shape)
    centre = values[..., NODES // 2]
    series = matrix_product(values - centre[..., None], terms)
    left = values - centre[..., None] - matrix_product(series, basis)
    rest = np.sqrt((left * left).mean(axis=-1))
    tail, size = abs(series[..., -2:]).sum(axis=-1), abs(values).max(axis=-1)
    scale = size.max(axis=-1, keepdims=True)
    serves = (tail <= TAIL * size) | (tail <= 2.0 * rest) & (rest <= ROUNDING * scale)
    every = serves.all(axis=0)
    coefficients = matrix_product(series, powers)
    coefficients[..., 0] += centre
    for k in np.flatnonzero(every):
        begin, end = ends[:, k]
        for part in blocks(end - begin, BLOCK):
            here = slice(begin + part.start, begin + part.stop)
            t = (x[here] - middle[k]) / half
            for whole, own in zip(out, coefficients[:, k].tolist(), strict=True):
                whole[here] = _polynomial(own, t)
    return low[~every]


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
