"""Adaptive sampling and thinning of curves for plots."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array

Curves: TypeAlias = "Callable[[Array], Array]"  # x (n,) -> a row a curve (q, n)

ASPECT = 5.0  # width of a panel over its height
CHORD_ERROR = 4e-4  # of a panel's height: less than 0.1 px of a panel of 200 px


def places(start: float, end: float) -> Array:
    """The first points between two x, both included, denser towards both ends."""
    fraction = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 33))
    x: Array = start + (end - start) * fraction
    x[-1] = end
    return x


def refined(of: Curves, start: float, end: float, width: float, heights: Array) -> Array:
    """Places (n,) at which to sample curves between two x, so that chords err by ``CHORD_ERROR``.

    ``width`` and ``heights`` (q,) are the ranges of x and of each curve that a panel shows. A
    chord's error is its distance from the curve in the panel, measured half-way.
    """
    x = places(start, end)
    y = of(x)
    scale = heights[:, None]
    unmeasured = np.arange(len(x) - 1)  # numbers of chords
    for _ in range(12):  # halvings: the shortest step is about 1e-5 of the piece
        if not len(unmeasured) or len(x) > 3000:
            break
        middle = 0.5 * (x[unmeasured] + x[unmeasured + 1])
        there = of(middle)
        before, after = y[:, unmeasured], y[:, unmeasured + 1]
        run = ASPECT / width * (x[unmeasured + 1] - x[unmeasured])
        with np.errstate(invalid="ignore"):  # a curve without a bound has no chord
            rise = (after - before) / scale
            off = abs(there - 0.5 * (before + after)) / scale * run / np.hypot(run, rise)
            far = (off > CHORD_ERROR).any(axis=0)
        x = np.insert(x, unmeasured + 1, middle)
        y = np.insert(y, unmeasured + 1, there, axis=1)
        left = (unmeasured + np.arange(len(unmeasured)))[far]
        unmeasured = np.sort(np.concatenate((left, left + 1)))
    return x


def thinned(x: Array, y: Array, miss: float) -> list[int]:
    """The numbers of the points (n,) whose polyline is within ``miss`` of all of them.

    ``miss`` has the unit of x and y. After Ramer (1972), and Douglas and Peucker (1973).
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
