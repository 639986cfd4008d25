"""How far functions of many designs may go between samples where a cubic does not predict them.

There they are looked at again; but a force that is far from the greatest and from the least need
not be known any better, nor one beside a pole, whose reciprocal is as good as a cubic.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.numerics.cubics import cubic
from geneva_cli.numerics.extrema_many import ROUNDING, goes_back
from geneva_cli.numerics.roots import PREDICTED

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask
    from geneva_cli.numerics.extrema_many import Sample

# Times what a cubic misses at the middle sample, where it misses a quartic most: 8 leaves room for
# what turns more often.
MISSES = 8.0
RISE = 4.0 / 27.0  # of its end slopes' sum times its width: a cubic passes its ends by no more


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


def told_by_reciprocals(
    left: Sample, middle: Sample, right: Sample, low: Array, high: Array
) -> Mask:
    """Whether cubics tell of the reciprocals of functions what they do not of the functions.

    That is so of those that rise or fall from the first to the last of three samples, above zero or
    below it: ``low`` and ``high`` are how far they come elsewhere, and within a share of that the
    middle sample must be predicted.

    >>> x = np.array([[0.0], [0.1], [0.2]])
    >>> samples = [(at, 1.0 / (at + 0.02), -1.0 / (at + 0.02) ** 2) for at in x]
    >>> told_by_reciprocals(*samples, np.zeros(1), np.full(1, 50.0))
    array([ True])
    """
    one, two, three = ((x, 1.0 / v, -d / (v * v)) for x, v, d in (left, middle, right))
    told: Mask = np.abs(1.0 / cubic(one, three, two[0]) - middle[1]) <= PREDICTED * (high - low)
    for _, v, d in (left, right):
        told &= (np.sign(v) == np.sign(middle[1])) & (np.sign(d) == np.sign(middle[2]))
    rounding = ROUNDING * np.maximum(np.abs(one[1]), np.abs(three[1]))
    return told & ~goes_back(one, two, rounding) & ~goes_back(two, three, rounding)
