"""Functions of many designs that have a pole nearby, which cubics do not predict.

Such a function is a quotient: beside it the ``room`` is known that is 0 where the pole is, and
their product has none. Where cubics predict both, the quotient of the two cubics tells whether the
function rises or falls all the way, by more than they may be wrong: then it has no turn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.numerics.quintics import misses_of_cells

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask
    from geneva_cli.numerics.extrema_many import Sample

    Three: TypeAlias = "tuple[Sample, Sample, Sample]"

WITHIN = (0.25, 0.5, 0.75)  # of a cell: where the slope of the quotient is looked at


def goes_one_way(of: Three, room: Three, share: float) -> Mask:
    """Whether functions rise or fall all the way between three samples of each, (k,) all.

    ``room`` has values and slopes of what takes the pole away. Cubics must miss it by less than a
    share of its least value, and the product by less than that of its greatest size.
    """
    (a, _, _), (b, _, _), (c, _, _) = of
    x = (a, b, c)
    rooms = [(r, s) for _, r, s in room]
    products = [(v * r, d * r + v * s) for (_, v, d), (_, r, s) in zip(of, room, strict=True)]
    least = np.minimum(np.minimum(rooms[0][0], rooms[1][0]), rooms[2][0])
    size = np.maximum.reduce([np.abs(p) for p, _ in products])
    knows: Mask = least > 0.0
    for values, within in ((rooms, least), (products, size)):
        three = [(at, *value) for at, value in zip(x, values, strict=True)]
        knows &= misses_of_cells(three[0], three[1], three[2]) < share * within
    # By the size of the slope: what the product's is, less the quotient times the room's. A cubic
    # that misses the middle of its cell by m may be off in its slope by nearly 4 m / width.
    most = np.maximum(np.maximum(rooms[0][0], rooms[1][0]), rooms[2][0])
    off = 4.0 * share * size * (most + least)
    ways = [d * r * r for (_, _, d), (r, _) in zip(of, rooms, strict=True)]
    for i, j in ((0, 1), (1, 2)):
        width = x[j] - x[i]
        for t in WITHIN:
            p, q = _cubic(t, width, products[i], products[j])
            r, s = _cubic(t, width, rooms[i], rooms[j])
            ways.append(q * r - p * s)
    narrow = np.minimum(x[1] - x[0], x[2] - x[1])
    falls = np.where(of[1][2] < 0.0, -1.0, 1.0)
    knows &= np.minimum.reduce([way * falls for way in ways]) * narrow > off
    return knows


def _cubic(
    t: float, width: Array, one: tuple[Array, Array], two: tuple[Array, Array]
) -> tuple[Array, Array]:
    """Value and slope of the cubic through two places' values and slopes at a share of the way."""
    (v, d), (w, e) = one, two
    rest = 1.0 - t
    value = rest * rest * (v * (1.0 + 2.0 * t) + d * (t * width)) + t * t * (
        w * (1.0 + 2.0 * rest) - e * (rest * width)
    )
    slope = (
        6.0 * t * rest * (w - v) / width + rest * (rest - 2.0 * t) * d + t * (t - 2.0 * rest) * e
    )
    return value, slope
