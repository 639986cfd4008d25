"""Points on a curve, so near each other that the chords between them stand for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

Curves: TypeAlias = "Callable[[Array], Array]"  # x (n,) -> a row a curve (q, n)

FIRST = 33  # points that a piece begins with
ROUNDS = 12  # of halving: a piece's shortest step is some hundred-thousandth of it
MOST = 3000  # points of a piece
ASPECT = 5.0  # width of a panel over its height
MISS = 4e-4  # of a panel's height, by which a chord may miss: below 0.1 px of a panel of 200


def places(start: float, end: float) -> Array:
    """The first points between two x, closer together towards both, which belong to them."""
    share = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, FIRST))
    x: Array = start + (end - start) * share
    x[-1] = end
    return x


def refined(of: Curves, start: float, end: float, width: float, heights: Array) -> Array:
    """Places (n,) at which to take curves between two x, so that all chords stay within ``MISS``.

    ``width`` and ``heights`` (q,) are what a panel shows of x and of each curve. A chord's error
    is the curve's distance from it in the panel, measured half-way.
    """
    x = places(start, end)
    y = of(x)
    scale = heights[:, None]
    asked = np.arange(len(x) - 1)  # the chords that have not been measured
    for _ in range(ROUNDS):
        if not len(asked) or len(x) > MOST:
            break
        middle = 0.5 * (x[asked] + x[asked + 1])
        there = of(middle)
        before, after = y[:, asked], y[:, asked + 1]
        run = ASPECT / width * (x[asked + 1] - x[asked])
        with np.errstate(invalid="ignore"):  # where a curve has no bound there is no chord
            rise = (after - before) / scale
            off = abs(there - 0.5 * (before + after)) / scale * run / np.hypot(run, rise)
            far = (off > MISS).any(axis=0)
        x = np.insert(x, asked + 1, middle)
        y = np.insert(y, asked + 1, there, axis=1)
        left = (asked + np.arange(len(asked)))[far]
        asked = np.sort(np.concatenate((left, left + 1)))
    return x


def thinned(x: Array, y: Array, miss: float) -> list[int]:
    """The numbers of the points (n,) whose polyline is within ``miss`` of all of them.

    After Ramer (1972) and Douglas and Peucker (1973), in the unit of x and y.
    """
    kept, stack = {0, len(x) - 1}, [(0, len(x) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        dx, dy = x[b] - x[a], y[b] - y[a]
        length = float(np.hypot(dx, dy)) or 1.0
        off = abs((x[a + 1 : b] - x[a]) * dy - (y[a + 1 : b] - y[a]) * dx) / length
        far = int(np.argmax(off))
        if off[far] > miss:
            middle = a + 1 + far
            kept.add(middle)
            stack += [(a, middle), (middle, b)]
    return sorted(kept)
