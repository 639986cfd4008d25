"""Functions of the input angle as knots of cubics, within a stated error."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Track

# value and slope by the input in degrees, at input angles in degrees
Moving: TypeAlias = "Callable[[Array], tuple[Array, Array]]"


def still() -> Track:
    """The track of what stands at the angle 0."""
    return Track((0.0,), (0.0,), (0.0,))


def track(
    pieces: Iterable[tuple[float, float, Moving]], error: float, start: float, gain: float = 0.0
) -> Track:
    """The track of consecutive smooth functions, each on its own stretch, within ``error``.

    ``start`` is the input angle at the track's 0.
    """
    columns: tuple[list[float], ...] = ([], [], [])
    for a, b, moving in pieces:
        if b > a:
            knots, v, s = _knots(a, b, moving, error)
            for column, more in zip(columns, (knots - start, v, s), strict=True):
                column += more.tolist()
    at, value, slope = map(tuple, columns)
    return Track(at, value, slope, gain)


def sampled(f: Callable[[Array], Array], a: float, b: float) -> Moving:
    """Add numerical slopes to a function on a stretch."""

    def moving(x: Array) -> tuple[Array, Array]:
        d = min(1e-3, 0.1 * (b - a))  # degrees
        left, right = np.maximum(x - d, a), np.minimum(x + d, b)
        return f(x), (f(right) - f(left)) / (right - left)

    return moving


def resting(value: float) -> Moving:
    """A constant with its slope of 0."""
    return lambda x: (0.0 * x + value, 0.0 * x)


def cut(a: float, b: float, places: Sequence[float]) -> list[tuple[float, float]]:
    """Divide a stretch at the places inside it, where a function's derivatives may jump."""
    return list(pairwise([a, *sorted(x for x in set(places) if a < x < b), b]))


def _knots(a: float, b: float, moving: Moving, error: float) -> tuple[Array, Array, Array]:
    """Knots, values and slopes: even steps, halved where the cubic is not within the error."""
    knots = np.linspace(a, b, 5)
    while True:
        v, s = moving(knots)
        h = np.diff(knots)
        off = np.zeros(len(h))
        for u in (0.2, 0.5, 0.8):  # places in a step
            there = moving(knots[:-1] + u * h)[0]
            off = np.maximum(off, np.abs(_hermite(u, h, v, s) - there))
        wide = (off > error) & (h > 1e-3)  # degrees: knots are no nearer to each other
        if not wide.any():
            return knots, v, s
        knots = np.sort(np.concatenate((knots, (knots[:-1] + 0.5 * h)[wide])))


def _hermite(u: float, h: Array, v: Array, s: Array) -> Array:
    w = 1.0 - u
    return (
        w * w * (1.0 + 2.0 * u) * v[:-1]
        + u * u * (1.0 + 2.0 * w) * v[1:]
        + u * w * h * (w * s[:-1] - u * s[1:])
    )
