"""Integrals of functions of many designs: Gauss and Kronrod, halved where the two disagree."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.budget import ask
from geneva_cli.numerics.quadrature import DEEPEST

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

BLOCK = 1024  # spans at a time
# Gauss with 7 nodes is of degree 13, Kronrod with 8 more of degree 22: where they differ by this
# share of a design's integral, the latter errs by its power of 22/13, less than a rounding.
AGREED = 1e-9
# Half of the places in [-1, 1], the weights of Kronrod there, and every other one's of Gauss, to
# all digits (R. Piessens et al., Quadpack, 1983, routine QK15).
_PLACES = (
    0.991455371120812639206854697526329,
    0.949107912342758524526189684047851,
    0.864864423359769072789712788640926,
    0.741531185599394439863864773280788,
    0.586087235467691130294144691693013,
    0.405845151377397166906606412076961,
    0.207784955007898467600689403773245,
    0.0,
)
_KRONROD = (
    0.022935322010529224963732008058970,
    0.063092092629978553290700663189204,
    0.104790010322250183839876322541518,
    0.140653259715525918745189590510238,
    0.169004726639267902826583426598550,
    0.190350578064785409913256402421014,
    0.204432940075298892414161999234649,
    0.209482141084727828012999174891714,
)
_GAUSS = (
    0.129484966168869693270611432679082,
    0.279705391489276667901467771423780,
    0.381830050505118944950369775488975,
    0.417959183673469387755102040816327,
)
NODE = np.array([-x for x in _PLACES] + list(_PLACES[-2::-1]))
WEIGHT = np.array([*_KRONROD, *_KRONROD[-2::-1]])
_COARSE = np.array([*_GAUSS, *_GAUSS[-2::-1]])


def integrals_many(
    functions: Callable[[Array, Whole], Array],
    a: Array,
    b: Array,
    design: Whole,
    asked: Mask,
    ends: bool = False,
) -> Array:
    """The integral of each function over all spans of each design: (functions, n).

    ``asked`` says of which: the others, as of functions without a bound, mean nothing.

    ``functions(x, which)`` gives the functions (functions, m, k) of the spans ``which`` at places
    (m, k). With ``ends`` they may go with the root of the distance from a span's ends: places are
    then t² (3 - 2 t) of it.
    """
    n = asked.shape[1]
    total, size = np.zeros((2, 0, n))
    low, high, of = np.zeros(len(a)), np.ones(len(a)), np.arange(len(a))
    for _ in range(DEEPEST):
        ask()
        found = []
        for i in range(0, len(of), BLOCK):
            part = slice(i, i + BLOCK)
            found.append(_both(functions, a, b, of[part], low[part], high[part], ends))
        fine, coarse, sizes = (np.concatenate(v, axis=1) for v in zip(*found, strict=True))
        if not len(total):
            total, size = np.zeros((2, len(fine), n))
            for k, row in enumerate(sizes):
                np.add.at(size[k], design[of], row)
        agreed = np.abs(fine - coarse) <= AGREED * size[:, design[of]]
        open_ = (~agreed & asked[:, design[of]]).any(axis=0)
        for k, row in enumerate(fine):
            np.add.at(total[k], design[of[~open_]], row[~open_])
        if not open_.any():
            return total
        middle = 0.5 * (low + high)[open_]
        low, high = np.concatenate((low[open_], middle)), np.concatenate((middle, high[open_]))
        of = np.concatenate((of[open_], of[open_]))
    total[:, design[of]] = np.inf
    return total


def _both(
    functions: Callable[[Array, Whole], Array],
    a: Array,
    b: Array,
    of: Whole,
    low: Array,
    high: Array,
    ends: bool,
) -> tuple[Array, Array, Array]:
    """Of shares of spans the integrals by both rules, and that of the functions' sizes."""
    half = 0.5 * (high - low)
    # designs lie side by side in memory
    t = np.asfortranarray((0.5 * (low + high))[:, None] + half[:, None] * NODE)
    width = (b - a)[of, None]
    rate = width * half[:, None]
    if ends:
        rate = rate * (6.0 * t * (1.0 - t))
        t = t * t * (3.0 - 2.0 * t)
    value = functions(a[of, None] + width * t, of) * rate
    return value @ WEIGHT, value[..., 1::2] @ _COARSE, np.abs(value) @ WEIGHT
