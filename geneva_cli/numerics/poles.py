"""Functions of many designs that have a pole nearby, which cubics do not predict.

Such a function is a quotient: beside it the ``room`` is known that is 0 where the pole is, and
their product has none. Where cubics predict both, the quotient of the two cubics tells whether the
function rises or falls all the way, by more than they may be wrong: then it has no turn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.numerics.cubics import between, slope_between
from geneva_cli.numerics.quintics import misses_of_cells

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask
    from geneva_cli.numerics.extrema_many import Sample

    Three: TypeAlias = "tuple[Sample, Sample, Sample]"

WITHIN = (0.25, 0.5, 0.75)  # of a cell: where the slope of the quotient is looked at


def goes_one_way(of: Three, room: Three, share: float) -> Mask:
    """Whether functions rise or fall all the way between three samples of each, (k,) all.

    ``room`` has values and slopes of what takes the pole away. Cubics must miss it by less than a
    share of its least value, and the product by less than that of its greatest size.
    """
    left, middle, right = product = [
        (x, v * r, d * r + v * s) for (x, v, d), (_, r, s) in zip(of, room, strict=True)
    ]
    rooms = [r for _, r, _ in room]
    least, most = np.minimum.reduce(rooms), np.maximum.reduce(rooms)
    size = np.maximum.reduce([np.abs(p) for _, p, _ in product])
    knows: Mask = least > 0.0
    knows &= misses_of_cells(*room) < share * least
    knows &= misses_of_cells(left, middle, right) < share * size
    # By the size of the slope: what the product's is, less the quotient times the room's. A cubic
    # that misses the middle of its cell by m may be off in its slope by nearly 4 m / width.
    off = 4.0 * share * size * (most + least)
    ways = [d * r * r for (_, _, d), r in zip(of, rooms, strict=True)]
    for one, two, r_one, r_two in ((left, middle, *room[:2]), (middle, right, *room[1:])):
        for part in WITHIN:
            x = one[0] + part * (two[0] - one[0])
            p, q = between(one, two, x), slope_between(one, two, x)
            r, s = between(r_one, r_two, x), slope_between(r_one, r_two, x)
            ways.append(q * r - p * s)
    narrow = np.minimum(middle[0] - left[0], right[0] - middle[0])
    falls = np.where(of[1][2] < 0.0, -1.0, 1.0)
    knows &= np.minimum.reduce([way * falls for way in ways]) * narrow > off
    return knows
