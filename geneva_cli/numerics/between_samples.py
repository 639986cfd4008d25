"""How far functions of many designs may go between samples where a cubic does not predict them.

There they are looked at again; but a force that is far from the greatest and from the least need
not be known any better.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.cubics import cubic
from geneva_cli.numerics.roots import PREDICTED

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array
    from geneva_cli.numerics.extrema_many import Sample

# Times what a cubic misses at the middle sample, where it misses a quartic most: 8 leaves room for
# what turns more often.
MISSES = 8.0
RISE = 4.0 / 27.0  # of its end slopes' sum times its width: a cubic passes its ends by no more
HIGHER = RISE * (1.0 + 4.0 * PREDICTED)  # as of ``Tops.hopeful``: nor a function that it predicts


class Limits(NamedTuple):
    """The least and the greatest that functions come to between samples, as far as these tell."""

    low: Array
    high: Array


def limits(left: Sample, middle: Sample, right: Sample) -> Limits:
    """Limits of functions from the first to the last of three samples."""
    (a, v, d), (x, m, s), (b, w, e) = left, middle, right
    steepest = np.maximum(np.maximum(np.abs(d), np.abs(e)), np.abs(s))
    room = MISSES * np.abs(m - cubic(left, right, x)) + RISE * 2.0 * steepest * (b - a)
    low, high = np.minimum(np.minimum(v, w), m), np.maximum(np.maximum(v, w), m)
    return Limits(low - room, high + room)
