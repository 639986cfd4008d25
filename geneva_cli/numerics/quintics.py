"""Quintics through values and slopes of three samples: what two cubics leave out of functions.

Between neighbours functions are taken for cubics. Where one through the outer two of three samples
misses the one between them, the quintic of all three tells how good the cubics of the two cells
are, and whether a function turns within them more often than the slopes at their ends tell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.cubics import between

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
    (x, v, d), (y, m, s), (z, w, e) = left, middle, right
    told: Mask = (miss <= CELL * room) & (np.abs(m - between(left, right, y)) < NEARLY * room)
    width = z - x
    for start, stop, first, last in ((x, y, d, s), (y, z, s, e)):
        before = np.ones(np.shape(miss))  # 1 where the slope is as at the start, -1 if not, 0 if
        way = np.where(first < 0.0, -1.0, 1.0) * (stop - start)  # it has no sure sign
        told &= np.abs(first) * (stop - start) > CLEAR * miss
        for share in (*WITHIN, 1.0):
            at = start + share * (stop - start)
            one, two, t = at - x, at - z, (at - x) / width
            slope = 6.0 * t * (1.0 - t) * (w - v) / width
            slope += (1.0 - t) * (1.0 - 3.0 * t) * d + t * (3.0 * t - 2.0) * e
            slope += 2.0 * one * two * (one + two) * (a + b * (at - y)) + (one * two) ** 2 * b
            rise = way * (last if share == 1.0 else slope)
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
    width, square = one + two, (one * two) ** 2
    v, w, d, e = left[1], right[1], left[2], right[2]
    rest, t = two / width, one / width
    slope = (
        6.0 * t * rest * (w - v) / width + rest * (rest - 2.0 * t) * d + t * (t - 2.0 * rest) * e
    )
    a = (middle[1] - between(left, right, middle[0])) / square
    return a, (middle[2] - slope - 2.0 * a * one * two * (two - one)) / square


def _misses(left: Sample, middle: Sample, right: Sample, more: tuple[Array, Array]) -> Array:
    a, b = more
    one, two = middle[0] - left[0], right[0] - middle[0]
    first = one**4 * np.abs(a - b * (2.0 * two + 0.5 * one))
    worst: Array = np.maximum(first, two**4 * np.abs(a + b * (2.0 * one + 0.5 * two)))
    return worst / 16.0
