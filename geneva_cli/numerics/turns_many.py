"""Where functions of many designs turn between two places that are known: Newton on those alone
that may pass what is known of their design.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.cells import Range, Tops, Turns, taken
from geneva_cli.numerics.extrema_many import turn_of_cubic
from geneva_cli.numerics.roots_many import newton_many

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.extrema_many import Which
    from geneva_cli.numerics.jet import Array

TURNED = 1e-5  # share of a cell: after so short a step, its value is rounding
BESIDE = 0.01  # share of a cell: Newton begins no nearer to its ends
NOISE = 1e-12  # share of a function's greatest size below which its sign is rounding
BENT = 1e-7  # share of a function's range: a smaller bend over a cell may be rounding


class Signed(Protocol):
    """The functions of designs. The first are those whose signs count, each of them smooth while
    those before it keep theirs; the others are wanted, and are smooth while all do.
    """

    signs: int  # how many of the functions have a sign that counts
    wanted: int  # how many others are looked for
    rooms: Sequence[int]  # of the first: which are above 0, and 0 where wanted ones have a pole

    def at(self, x: Array, which: Which, order: int) -> Any:
        """What the functions of some designs are made of, at places (m, k) in degrees."""

    def column(self, at: Any, number: int) -> Any:
        """The same at one place of each design."""

    def picked(self, at: Any, row: Whole, column: Whole) -> Any:
        """The same at some of the places, by the numbers of design and place: (m, 1)."""

    def look(
        self, at: Any, forced: Array | None = None, asked: Sequence[int] | None = None
    ) -> tuple[Mask, list[Array]]:
        """Which signs are positive, (signs, m, k), and Taylor coefficients (functions, m, k).

        ``forced`` are signs that are known, 1.0 or -1.0; where it is NaN they are looked up. Of
        the wanted functions only those ``asked`` are among the functions, if that is given. A
        function without a bound is infinite, and its slope 0.
        """


class Doubted(NamedTuple):
    """Turns with another sign than their cell: there one changes twice, unseen."""

    turns: Turns
    x: Array  # (k,)


def turn(f: Signed, range_: Range, tops: Tops, turns: Turns) -> list[Doubted]:
    """Newton on every turn that may still be the greatest: the most hopeful ones of all first."""
    turns = tops.hopeful(_bent(f, range_, tops.hopeful(turns)))
    first = tops.first(turns)
    doubted = _refined(f, range_, tops, taken(turns, first))
    return doubted + _refined(f, range_, tops, tops.hopeful(taken(turns, ~first)))


def _refined(f: Signed, range_: Range, tops: Tops, turns: Turns) -> list[Doubted]:
    if not len(turns.row):
        return []

    a, b = turns.left[0], turns.right[0]
    tiny = np.finfo(float).tiny
    at_a, at_b = (np.abs(end[2]) <= tiny for end in (turns.left, turns.right))
    size = range_.size(turns.design)[: f.signs]

    def slope_of(x: Array, live: Whole) -> tuple[Array, Array, Array, Array]:
        value, slope, bend, *signed = jets(f, x, turns, live)
        # an end that is stationary itself is divided out of the slope that Newton sees
        others = at_a[live] / (x - a[live]) - at_b[live] / (b[live] - x)
        of_signs = np.reshape(signed, (f.signs, len(live)))  # that are none, too
        least = (of_signs / size[:, live]).min(axis=0, initial=np.inf)
        return slope, bend - slope * np.nan_to_num(others), value, least

    width = b - a
    start = turn_of_cubic(turns.left, turns.right)
    start = np.clip(start, a + BESIDE * width, b - BESIDE * width)
    slopes = np.where(at_a, np.nan, turns.left[2]), np.where(at_b, np.nan, turns.right[2])
    found = newton_many(slope_of, a, b, start, turns.rises < 0.0, TURNED, slopes)
    x, rise, (_, _, value, least) = found
    value = value + np.where(np.isnan(rise), 0.0, rise)  # a size that is zero has no slope
    top = np.abs(value) if tops.sized else turns.rises * value
    x = np.where(np.isnan(x), start, x)
    other = least < -NOISE
    if other.any():
        keep = ~other
        tops.add(tops.number(turns.row, turns.rises)[keep], turns.design[keep], x[keep], top[keep])
        return [Doubted(taken(turns, other), x[other])]
    tops.add(tops.number(turns.row, turns.rises), turns.design, x, top)
    return []


def _bent(f: Signed, range_: Range, turns: Turns) -> Turns:
    """Slopes of 0 replaced by the sign that they have within the cell.

    The bend tells it; where that is 0 too, the cell is taken to have a turn. If it has none
    Newton ends at the stationary end, whose value is known.
    """
    row, design = f.signs + turns.row, turns.design
    span = (range_.high - range_.low)[row, design]
    width = turns.right[0] - turns.left[0]
    for end, other, way in (
        (turns.left, turns.right, 1.0),
        (turns.right, turns.left, -1.0),
    ):
        here = np.flatnonzero(end[2] == 0.0)
        if len(here):
            bend = 0.5 * jets(f, end[0, here], turns, here)[2]
            clear = np.abs(bend) * width[here] ** 2 > BENT * span[here]
            sign = np.where(clear, way * np.sign(bend), -np.sign(other[2, here]))
            end[2, here] = sign * np.finfo(float).tiny
    return turns


def jets(f: Signed, x: Array, turns: Turns, live: Whole) -> list[Array]:
    """Value, slope and bend, by degrees, of the functions of some turns, each at its place.

    After them those whose signs count, each times the sign that it has in the cell.
    """
    forced = np.where(turns.positive[:, live], 1.0, -1.0)[..., None]
    row, out = turns.row[live], np.empty((3 + f.signs, len(live)))
    for k in range(f.wanted):
        here = np.flatnonzero(row == k)
        if len(here):
            at = f.at(x[here, None], turns.design[live[here]], 2)
            _, c = f.look(at, forced[:, here], (k,))
            out[:3, here] = [one[-1, :, 0] for one in c]
            out[3:, here] = (c[0][:-1] * forced[:, here])[..., 0]
    out[1] *= DEGREE
    out[2] *= 2.0 * DEGREE * DEGREE
    return list(out)
