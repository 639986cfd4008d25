"""Cubics through values and slopes at both ends of a cell: what is between; where it is zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask
    from geneva_cli.numerics.extrema_many import Sample


def touches(cells_width: Array, v: Array, d: Array, w: Array, e: Array) -> Mask:
    """Whether functions of one sign at both ends may cross zero twice between them.

    The tangents there meet beyond zero: what is bent one way lies between them and its chord.
    """
    meet: Mask = (v * w > 0.0) & (d * v < 0.0) & (e * v > 0.0)
    if meet.any():
        where = np.nonzero(meet)  # few
        v, w, d, e = (one[where] for one in (v, w, d, e))
        way = (w - v - e * np.broadcast_to(cells_width, meet.shape)[where]) / (d - e)
        meet[where] = (v + d * way) * v < 0.0
    return meet


def cubic(left: Sample, right: Sample, x: Array) -> Array:
    """The cubic through two places' values and slopes at x."""
    width = right[0] - left[0]
    t = (x - left[0]) / width
    v, w, d, e = left[1], right[1], left[2] * width, right[2] * width
    value: Array = v + t * (d + t * (3.0 * (w - v) - 2.0 * d - e + t * (d + e - 2.0 * (w - v))))
    return value


def between(left: Sample, right: Sample, x: Array) -> Array:
    """As of ``cubic``, of several functions at the same places."""
    width = right[0] - left[0]
    t = (x - left[0]) / width
    rest = 1.0 - t
    near, far, bulge = rest * rest * (1.0 + 2.0 * t), t * t * (1.0 + 2.0 * rest), t * rest * width
    value: Array = left[1] * near + right[1] * far + (left[2] * rest - right[2] * t) * bulge
    return value


def slope_between(left: Sample, right: Sample, x: Array) -> Array:
    """The slope of ``between`` at the same places."""
    width = right[0] - left[0]
    t = (x - left[0]) / width
    rest = 1.0 - t
    own: Array = rest * (rest - 2.0 * t) * left[2] + t * (t - 2.0 * rest) * right[2]
    return own + 6.0 * t * rest * (right[1] - left[1]) / width


def zero_of_cubic(v: Array, w: Array, d: Array, e: Array) -> Array:
    """Where between 0 and 1 the cubic of two values and slopes is zero, nearly."""
    t = np.where(v * w < 0.0, v / (v - w), 0.5)
    p, q = d + e - 2.0 * (w - v), 3.0 * (w - v) - 2.0 * d - e
    for _ in range(3):
        t = t - (v + t * (d + t * (q + t * p))) / (d + t * (2.0 * q + t * 3.0 * p))
    return np.where((t > 0.0) & (t < 1.0), t, 0.5)
