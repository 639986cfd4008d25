"""Integrals of functions of many designs: Gauss and Kronrod, halved where the two disagree."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.budget import check_time
from geneva_cli.numerics.quadrature import DEEPEST

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

BLOCK = 256  # spans at a time
# Gauss with 20 nodes is of degree 39, Kronrod with 21 more of degree 61: where they differ by this
# share of a design's integral, the latter errs by its power of 61/39, less than a rounding. A load
# between its cuts is mostly settled by these 41 places, of which fewer would be halved.
AGREED = 1e-9
# Half of the places in [-1, 1] and the weights of Kronrod there, to more than all digits: the
# eigenvalues of the Jacobi matrix of D. P. Laurie, Mathematics of Computation 66 (1997), 1133.
_PLACES = (
    0.9988590315882776638383,
    0.9931285991850949247861,
    0.9815078774502502591933,
    0.9639719272779137912677,
    0.94082263383175475352,
    0.9122344282513259058678,
    0.8782768112522819760774,
    0.8391169718222188233945,
    0.7950414288375511983506,
    0.7463319064601507926143,
    0.6932376563347513848055,
    0.6360536807265150254528,
    0.5751404468197103153429,
    0.5108670019508270980044,
    0.4435931752387251032,
    0.3737060887154195606725,
    0.3016278681149130043206,
    0.2277858511416450780805,
    0.1526054652409226755052,
    0.07652652113349733375464,
    0.0,
)
_WEIGHTS = (
    0.003073583718520531501218,
    0.008600269855642942198662,
    0.01462616925697125298379,
    0.02038837346126652359801,
    0.02588213360495115883451,
    0.03128730677703279895854,
    0.03660016975820079803056,
    0.04166887332797368626379,
    0.04643482186749767472023,
    0.05094457392372869193271,
    0.05519510534828599474483,
    0.05911140088063957237497,
    0.06265323755478116802587,
    0.06583459713361842211156,
    0.06864867292852161934562,
    0.07105442355344406830579,
    0.07303069033278666749519,
    0.07458287540049918898658,
    0.07570449768455667465954,
    0.0763778676720807367055,
    0.07660071191799965644505,
)
NODE = np.array([-x for x in _PLACES] + list(_PLACES[-2::-1]))
WEIGHT = np.array([*_WEIGHTS, *_WEIGHTS[-2::-1]])
_COARSE = np.polynomial.legendre.leggauss(len(NODE) // 2)[1]  # of every other place


def integrals_many(
    functions: Callable[[Array, Whole], Array],
    a: Array,
    b: Array,
    design: Whole,
    asked: Mask,
    ends: bool = False,
    agreed_at: float = AGREED,
) -> Array:
    """The integral of each function over all spans of each design: (functions, n).

    ``asked`` says of which: the others, as of functions without a bound, mean nothing. A share of
    less than ``AGREED`` is for functions whose higher derivatives may jump within a span.

    ``functions(x, which)`` gives the functions (functions, m, k) of the spans ``which`` at places
    (m, k). With ``ends`` they may go with the root of the distance from a span's ends: places are
    then t² (3 - 2 t) of it.
    """
    n = asked.shape[1]
    total, size = np.zeros((2, 0, n))
    low, high, of = np.zeros(len(a)), np.ones(len(a)), np.arange(len(a))
    for _ in range(DEEPEST):
        check_time()
        found = []
        for i in range(0, len(of), BLOCK):
            part = slice(i, i + BLOCK)
            found.append(_both(functions, a, b, of[part], low[part], high[part], ends))
        fine, coarse, sizes = (np.concatenate(v, axis=1) for v in zip(*found, strict=True))
        if not len(total):
            total, size = np.zeros((2, len(fine), n))
            for k, row in enumerate(sizes):
                np.add.at(size[k], design[of], row)
        agreed = np.abs(fine - coarse) <= agreed_at * size[:, design[of]]
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
