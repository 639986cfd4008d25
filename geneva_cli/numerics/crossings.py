"""Cells of many designs' spans in which signs change: whether an extreme may be within them.

There functions jump or have a kink; but with either choice of the signs each of them goes on, and
is as smooth as elsewhere. So samples beside such a cell tell by how much it may be passed, and the
place of the change is not looked for where that is not enough.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.between_samples import HIGHER, limits
from geneva_cli.numerics.cells import Across, Cells, Range, Tops
from geneva_cli.numerics.cubics import touches
from geneva_cli.numerics.quintics import turns_as_told
from geneva_cli.numerics.samples_many import SHARE, Samples, some_of, unpredicted_at

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask
    from geneva_cli.numerics.turns_many import Signed


def about(f: Signed, samples: Samples, at: Any, where: Mask, before: int) -> list[Across]:
    """What is known about the cells ``where`` one sign changes, or two, if there are any.

    ``at`` is what the samples are made of, ``before`` how many cells come before these.
    """
    row, column = samples.numbers(where)
    ends = np.stack([samples.positive[:, row, column + end] for end in (0, 1)])
    changes = ends[0] != ends[1]
    count = changes.sum(axis=0)
    two = np.flatnonzero(count == 2)
    cell = np.concatenate((np.flatnonzero(count <= 2), two))
    k, signs = len(cell), f.signs
    if not k:
        return []
    row, column, changes, ends = row[cell], column[cell], changes[:, cell], ends[..., cell]
    # of two signs one may change before the other, or after it
    swapped = changes[:, k - len(two) :].argmax(axis=0), np.arange(k - len(two), k)
    ends[(slice(None), *swapped)] = ends[(slice(None, None, -1), *swapped)]
    start = np.stack((np.maximum(column - 1, 0), np.minimum(column, samples.x.shape[1] - 3)))
    places = start[:, None] + np.arange(3)[:, None]  # (2, 3, k)
    rows = np.broadcast_to(row, places.shape)
    forced = np.repeat(np.where(ends, 1.0, -1.0)[:, :, None], 3, axis=2)
    forced = forced.swapaxes(0, 1).reshape(signs, -1, 1)
    _, found = f.look(f.picked(at, rows.ravel(), places.ravel()), forced)
    value, slope = (part.reshape(-1, 2, 3, k).swapaxes(0, 1) for part in found)
    first = start == column
    here = np.where(first[:, None, None], value[:, :signs, :2], value[:, :signs, 1:])
    stays = ((here > 0.0) == ends[:, :, None]).all(axis=(0, 2))
    known, x = (stays | changes).all(axis=0), samples.x[rows, places]
    return [Across(cell + before, changes, known, first, x, value, slope * DEGREE)]


def matters(f: Signed, cells: Cells, across: Across, range_: Range, tops: Tops) -> Mask:
    """Whether an extreme may be within cells in which signs change, or one may change again.

    Of those about which nothing is known it may.
    """
    signs, changes, design = f.signs, across.changes, cells.design[across.cell]
    low, high = range_.low[:, design], range_.high[:, design]
    # a function may have no bound from the place on where a room is 0
    found = ~across.known | changes[list(f.rooms)].any(axis=0)
    for choice in (0, 1):
        three, first = across.samples(choice), across.first[choice]
        missed = unpredicted_at(*three, (low, high), signs, changes)
        x, v, d = (np.where(first, a, b) for a, b in zip(*three[:2], strict=True))
        y, w, e = (np.where(first, a, b) for a, b in zip(*three[1:], strict=True))
        again = touches(y - x, v[:signs], d[:signs], w[:signs], e[:signs])
        rise = np.where(d * e <= 0.0, HIGHER * np.abs(d - e) * (y - x), 0.0)
        least, most = np.minimum(v, w) - rise, np.maximum(v, w) + rise
        where = np.nonzero(missed)
        left, middle, right = (some_of(one, where) for one in three)
        told = turns_as_told(left, middle, right, SHARE * (high - low)[where])
        reach = limits(left, middle, right)
        least[where] = np.where(told, least[where], reach.low)
        most[where] = np.where(told, most[where], reach.high)
        apart = (least[:signs] > 0.0) | (most[:signs] < 0.0)
        found |= (again | (missed[:signs] & (changes | ~apart))).any(axis=0)
        for k in range(f.wanted):
            found |= tops.may_pass(np.array(k), design, least[signs + k], most[signs + k])
    out = np.ones(len(cells.design), dtype=bool)
    out[across.cell] = False
    out[across.cell[found]] = True
    return out
