"""Quintics through values and slopes of three samples: what two cubics leave out of functions.

Between neighbours functions are taken for cubics. Where one through the outer two of three samples
misses the one between them, the quintic of all three tells how good the cubics of the two cells
are, and whether a function turns within them more often than the slopes at their ends tell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.cubics import between, slope_between

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask
    from geneva_cli.numerics.extrema_many import Sample

NEARLY = 4.0  # times a room, by which a cubic may miss if slopes tell that cells' own miss by less
CELL = 0.375  # of the room
WITHIN = (0.25, 0.5, 0.75)  # of a cell: where the quintic's slope is looked at
CLEAR = 2.0  # times what the cubics miss, over a cell's width: less of a slope has no sure sign


def misses_of_cells(left: Sample, middle: Sample, right: Sample) -> Array:
    """By how much at most the cubic of either cell misses the middle of its cell, if functions are
    quintics.
    """
    return _misses(left, middle, right, _beyond(left, middle, right))


def turns_as_told(left: Sample, middle: Sample, right: Sample, room: Array) -> Mask:
    """Whether functions turn once in a cell whose slopes at the ends differ in sign, and in no
    other cell, as far as three samples tell: the cubics of the cells miss by a share of ``room``.
    """
    more = a, b = _beyond(left, middle, right)
    miss = _misses(left, middle, right, more)
    off = np.abs(middle[1] - between(left, right, middle[0]))
    told: Mask = (miss <= CELL * room) & (off < NEARLY * room)
    for one, two in ((left, middle), (middle, right)):
        width = two[0] - one[0]
        slopes = []
        for share in WITHIN:
            x = one[0] + share * width
            u, w, v = x - left[0], x - right[0], x - middle[0]
            more_of = 2.0 * u * w * (u + w) * (a + b * v) + (u * w) ** 2 * b
            slopes.append(slope_between(left, right, x) + more_of)
        told &= np.abs(one[2]) * width > CLEAR * miss
        before = np.ones(np.shape(miss))  # 1 where the slope is as at the start, -1 if not, 0 if
        way = np.where(one[2] < 0.0, -1.0, 1.0) * width  # it has no sure sign
        for slope in (*slopes, two[2]):
            rise = way * slope
            here = np.where(np.abs(rise) > CLEAR * miss, np.sign(rise), 0.0)
            told &= here <= before  # it turns once
            before = here
        told &= before != 0.0
    return told


def _beyond(left: Sample, middle: Sample, right: Sample) -> tuple[Array, Array]:
    """a and b of (x - left)² (x - right)² (a + b (x - middle)), by which the quintics are not the
    cubics through the outer two.
    """
    one, two = middle[0] - left[0], right[0] - middle[0]
    square = (one * two) ** 2
    a = (middle[1] - between(left, right, middle[0])) / square
    slope = slope_between(left, right, middle[0])
    return a, (middle[2] - slope - 2.0 * a * one * two * (two - one)) / square


def _misses(left: Sample, middle: Sample, right: Sample, more: tuple[Array, Array]) -> Array:
    a, b = more
    one, two = middle[0] - left[0], right[0] - middle[0]
    first = one**4 * np.abs(a - b * (2.0 * two + 0.5 * one))
    worst: Array = np.maximum(first, two**4 * np.abs(a + b * (2.0 * one + 0.5 * two)))
    return worst / 16.0
