"""Turns of functions of many designs just beside a place that is an extreme of what is known.

Beside a cut a function may fall away, turn, and pass the cut's value further on, within a cell
whose slopes at both ends are of one sign: where the end that is an extreme is nearly flat there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.cells import Cells, Tops, Turns, taken
from geneva_cli.numerics.roots import PREDICTED
from geneva_cli.numerics.turns_many import Signed, jets

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask

FLAT = 0.25  # share of a chord's slope: an end that is steeper has no turn beside it


def flat_ends(row: int, k: int, cells: Cells, tops: Tops, where: Mask) -> Turns:
    """The cells, of those ``where``, that may have two turns of the k-th wanted function."""
    (v, w), (d, e) = cells.value[:, row], cells.slope[:, row]
    few = np.flatnonzero((d * e > 0.0) & where)
    rise, run = w[few] - v[few], cells.x[1, few] - cells.x[0, few]
    few = few[np.minimum(np.abs(d[few]), np.abs(e[few])) * run < FLAT * np.abs(rise)]
    left, right = (
        np.stack([one[few] for one in end]) for end in zip(cells.x, (v, w), (d, e), strict=True)
    )
    first = np.abs(left[2]) < np.abs(right[2])  # the flatter end
    slope = np.where(first, left[2], right[2])
    # falling inwards from the one, or rising to the other, it is a greatest value; or a least one
    rises, rise = np.where(first, -1.0, 1.0) * np.sign(slope), right[1] - left[1]
    of = cells.design[few], cells.span[few]
    ends = Turns(np.full(len(few), k), rises, *of, cells.positive[0][:, few], left, right)
    return taken(ends, (rise * slope > 0.0) & _extreme(tops, ends))


def _extreme(tops: Tops, ends: Turns) -> Mask:
    """Whether the flat ends are extremes of what is known, as far as a cubic tells."""
    v, w = ends.left[1], ends.right[1]
    most = tops.most[tops.number(ends.row, ends.rises), ends.design]
    top = np.maximum(ends.rises * v, ends.rises * w)
    return np.asarray(top >= most - PREDICTED * np.abs(w - v))


def second_turns(f: Signed, tops: Tops, ends: Turns) -> Turns:
    """Those that do, cut where the slope is of the other sign: from there on they turn once.

    Where the slope would be as much below zero as it is above it at the flat end, if it went on as
    it begins.
    """
    ends = taken(ends, _extreme(tops, ends))
    if not len(ends.row):
        return ends
    every = np.arange(len(ends.row))
    left, right = ends.left, ends.right
    first = np.abs(left[2]) < np.abs(right[2])
    x, slope = np.where(first, left[::2], right[::2])
    bend = jets(f, x, ends, every)[2]
    there = x - 2.0 * slope / bend
    inside = np.flatnonzero((there > left[0]) & (there < right[0]))
    ends, there, first = taken(ends, inside), there[inside], first[inside]
    if not len(inside):
        return ends
    value, rise, *_ = jets(f, there, ends, np.arange(len(inside)))
    cut = np.stack((there, value, rise))
    left, right = np.where(first, cut, ends.left), np.where(first, ends.right, cut)
    return taken(ends._replace(left=left, right=right), left[2] * right[2] < 0.0)
