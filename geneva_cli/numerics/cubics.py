"""Cubics through values and slopes at both ends of a cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask


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
