"""The greatest loads over a motion, refined to the last digits.

In each stretch in which the loads are smooth they are scanned until nothing is stepped over, and
their maxima are roots of their slopes.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.contact import contact, is_straight
from geneva_cli.analysis.loads.forces import Greatest, Row, Setting
from geneva_cli.analysis.loads.mid_motion import Rows, at_mid_motion
from geneva_cli.analysis.loads.stretches import Stretch, at_break, scanned, stretches
from geneva_cli.analysis.loads.zeros import STEP, between_samples, columns, inside
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import rows_of
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.roots_many import roots_many
from geneva_cli.numerics.scan import Scan, hopeful
from geneva_cli.numerics.ties import first_greatest, usual

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

CROWDED = 0.02  # share of a stretch that is its end
NOUGHT = 1e-28  # of a quantity's size, squared: so small a greatest value is 0


def maxima(
    engagement: Engagement, given: Setting, rows: Rows, least: float = 0.0
) -> list[Greatest]:
    """The greatest of each of ``rows`` over a motion; if not above ``least`` that, at entry."""
    return looked(engagement, given, rows, least)[0]


def looked(
    engagement: Engagement, given: Setting, rows: Rows, least: float
) -> tuple[list[Greatest], Scan]:
    """The same, and the samples of all rows that were taken for it."""
    pieces = stretches(engagement, given)
    signs = np.array([piece[2:] for piece in pieces]).T

    first = rows(contact(engagement, np.array([pieces[0].end]), 1), *pieces[0][2:])
    rooms = {id(row.room): i for i, row in enumerate(first) if row.room is not None}
    bounds, signed = list(rooms.values()), slice(len(first), None)

    def sampled(x: Array, span: Whole) -> tuple[Array, Array]:
        asked = rows(contact(engagement, x, 1), *signs[:, span])
        bound = [room for i in bounds if (room := asked[i].room) is not None]
        value, slope = columns([*(row.value for row in asked), *bound], x)
        for i, row in enumerate(asked):
            if row.room is None:
                continue
            lost = row.room.c[0] <= 0.0
            if np.any(lost):
                value[i] = np.where(lost, np.where(row.way > 0.0, np.nan, -np.inf), value[i])
        return value, slope

    # no two changes of sign of a room are stepped over: between them there is no bound
    found = scanned(sampled, [(p.start, p.end) for p in pieces], signed).first(len(first))
    # samples crowd at the ends of stretches, where loads are often 0: those tell nothing of a size
    start, end = np.array([piece[:2] for piece in pieces]).T[:, found.span]
    even = np.minimum(found.x - start, end - found.x) >= CROWDED * (end - start)
    middle = _middle(engagement, given, rows)
    tops = _tops(engagement, found, rows, signs)
    brinks: dict[int, float] = {}
    out = []
    for i in range(len(found.value)):

        def at(x: Number, piece: Stretch, order: int, i: int = i) -> Row[Jet]:
            return rows(contact(engagement, x, order), *piece[2:])[i]

        lost = np.isnan(found.value[i])
        if lost.any():
            number = _first_with_room(first, i)
            if number not in brinks:
                brinks[number] = _brink(found, lost, pieces, at)
            brink = brinks[number]
            endless = [x for x, value in middle[i] if value == math.inf]
            out.append(Greatest(math.inf, min([brink, *endless])))
        else:
            places = [*middle[i], *tops[i], *_ends(found, i)]
            low, high = usual(found.value[i : i + 1, even])
            size = max(-float(low[0]), float(high[0]), 0.0)
            out.append(_greatest(places, engagement, least, size))
    return out, found


def _first_with_room(rows: list[Row[Jet]], row: int) -> int:
    """The first row that ceases to have a bound where this one does: they need the same."""
    same = [one.room is rows[row].room and bool(np.all(one.way > 0.0)) for one in rows]
    return same.index(True)


def _ends(found: Scan, row: int) -> list[tuple[float, float]]:
    """The first and last sample of each stretch."""
    cuts = np.flatnonzero(~found.joined)
    return [(float(found.x[i]), float(found.value[row][i])) for i in (0, *cuts, *(cuts + 1), -1)]


def _tops(
    engagement: Engagement, found: Scan, rows: Rows, signs: Array
) -> list[list[tuple[float, float]]]:
    """Places and values of the maxima of each row, all of them at once."""
    inner = inside(found)
    hopes = [(row, i) for row in range(len(found.value)) for i in hopeful(found, row) if inner[i]]
    out: list[list[tuple[float, float]]] = [[] for _ in found.value]
    for number, i in hopes:  # a sample may be the top itself
        if found.slope[number, i + 1] == 0.0:
            out[number].append((float(found.x[i + 1]), float(found.value[number, i + 1])))
    hopes = [(number, i) for number, i in hopes if found.slope[number, i + 1]]
    if not hopes:
        return out
    row, before = (np.array(side) for side in zip(*hopes, strict=True))

    def jets(way: Array, which: Whole) -> tuple[Array, Array, Array]:
        """Slope, bend and value, each of the row that is asked for."""
        at = contact(engagement, found.x[before[which]] + way, 2)
        asked = [one.value.c for one in rows(at, *signs[:, found.span[before[which]]])]
        pick = row[which], np.arange(len(way))
        value, slope, bend = (rows_of([c[k] for c in asked], len(way))[pick] for k in range(3))
        return slope, 2.0 * DEGREE * bend, value

    slopes = found.slope[row, before], found.slope[row, before + 1]
    way, rise, (_, _, value) = between_samples(jets, found, before, before + 1, *slopes)
    value = value + DEGREE * rise
    for i, place, most in zip(row, (found.x[before] + way).tolist(), value.tolist(), strict=True):
        out[i].append((place, most))
    return out


def _greatest(
    places: list[tuple[float, float]], engagement: Engagement, least: float, size: float
) -> Greatest:
    """The first of the greatest of some values, of a function of this size."""
    x, value = np.array(sorted(places)).T[..., None]
    most, first = (float(one[0]) for one in first_greatest(value, x, np.array([size])))
    most = 0.0 if abs(most) <= NOUGHT * size else most
    if not most > least:
        return Greatest(least, engagement.entry_deg)
    return Greatest(most, at_break(first, engagement))


def _middle(
    engagement: Engagement, given: Setting, rows: Rows
) -> Mapping[int, Sequence[tuple[float, float]]]:
    """Places and values that no stretch reaches, of each row; straight slots are all scanned."""
    out = defaultdict[int, list[tuple[float, float]]](list)
    if not is_straight(engagement):
        for row, x, most in at_mid_motion(engagement, given, rows):
            if not np.isnan(most[0]):
                out[row].append((float(x[0]), float(most[0])))
    return out


def _brink(
    found: Scan,
    lost: Mask,
    pieces: tuple[Stretch, ...],
    at: Callable[[Number, Stretch, int], Row[Jet]],
) -> float:
    """Where a quantity first has no value: where what it needs is 0, or its stretch begins."""
    first = int(np.argmax(lost))
    if not first or not found.joined[first - 1]:
        return float(found.x[first])
    i = first - 1
    start, width = float(found.x[i]), np.array([found.x[i + 1] - found.x[i]])
    piece = pieces[found.span[i]]

    def room(way: Array, _: Whole) -> tuple[Array, Array]:
        needed = at(start + way, piece, 1).room
        assert needed is not None
        value, slope = needed.c
        return value + 0.0 * way, slope * DEGREE + 0.0 * way

    return start + float(roots_many(room, 0.0 * width, width, STEP)[0])
