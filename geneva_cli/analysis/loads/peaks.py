"""The greatest loads over a motion, refined to the last digits.

In each stretch in which the loads are smooth they are scanned until nothing is stepped over, and
their maxima are roots of their slopes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR, Contact, contact, is_straight
from geneva_cli.analysis.loads.forces import Greatest, Row, Setting, gain, sliding
from geneva_cli.analysis.loads.stretches import (
    ZERO,
    Stretch,
    at_break,
    stretches,
)
from geneva_cli.analysis.loads.zeros import STEP, between_samples, columns, inside
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.pitch_curve import retraces
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import rows_of, scalar
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.roots_many import roots_many
from geneva_cli.numerics.scan import Scan, hopeful, scan

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

TIE = 1e-12  # two peaks nearer than this are one that occurs twice: the earlier is meant
# So are values that differ by less of their greatest size: a length is looked for as its square,
# and where that is 0 some units in the last place of the length are left, squared.
NOUGHT = 1e-28


# contact, signs of torque, of sliding and of the input's torque -> the quantities
Rows: TypeAlias = Callable[[Contact[Jet], Number, Number, Number], list[Row[Jet]]]


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
    count, each = (
        len(first),
        {id(row.room): i for i, row in enumerate(first) if row.room is not None},
    )
    bounds = list(each.values())  # a row for each room

    def sampled(x: Array, span: Whole) -> tuple[Array, Array]:
        asked = rows(contact(engagement, x, 1), *signs[:, span])
        rooms = [room for i in bounds if (room := asked[i].room) is not None]
        value, slope = columns([*(row.value for row in asked), *rooms], x)
        for i, row in enumerate(asked):
            if row.room is None:
                continue
            lost = row.room.c[0] <= 0.0
            if np.any(lost):
                value[i] = np.where(lost, np.where(row.way > 0.0, np.nan, -np.inf), value[i])
        return value, slope

    # no two changes of sign of a room are stepped over: between them there is no bound
    found = scan(sampled, [(p.start, p.end) for p in pieces], signed=slice(count, None)).first(
        count
    )
    ends = _at_mid_motion(engagement, given, pieces, rows, least)
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
            out.append(Greatest(math.inf, min(brink, 0.0) if ends[i] == math.inf else brink))
        else:
            places = [(0.0, ends[i]), *tops[i], *_ends(found, i)]
            value = found.value[i]
            size = float(np.abs(value[np.isfinite(value)]).max(initial=0.0))
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
    """The first of the greatest of some values, which come to ``size``."""
    most = max(value for _, value in places)
    most = 0.0 if abs(most) <= NOUGHT * size else most
    if not most > least:
        return Greatest(least, engagement.entry_deg)
    if math.isinf(most):
        return Greatest(most, 0.0)
    tie = max(TIE * abs(most), NOUGHT * size)
    first = min(x for x, value in places if value >= most - tie)
    return Greatest(most, at_break(first, engagement))


def _at_mid_motion(
    engagement: Engagement, given: Setting, pieces: tuple[Stretch, ...], rows: Rows, least: float
) -> list[float]:
    """The quantities at mid-motion of a curved slot, which no stretch reaches; infinite or a limit.

    Straight slots are scanned through mid-motion: nothing is added there.
    """
    x = np.zeros(1)
    at = contact(engagement, x)
    torque = at.acceleration * given.inertia_Nm + given.resists_Nm
    needed = float(torque.arrays()[0][0])
    beside = [p for p in pieces if NEAR * engagement.entry_deg in (p.end, -p.start)]
    if is_straight(engagement):
        with np.errstate(all="ignore"):
            return [least for _ in rows(at, 1.0, 1.0, 1.0)]
    # The tangent points away from the axis on the way in and out; at a cusp they are one.
    ways = (1.0,) if retraces(engagement) else (1.0, -1.0)
    common = given.inertia_Nm * abs(scalar(engagement.motion(0.5 * engagement.entry_deg, 2).c[2]))
    loaded = abs(needed) > ZERO * (common + given.resists_Nm)
    limits = [_towards_mid_motion(engagement, piece, rows) for piece in beside]
    out: list[float] = []
    for way in ways:
        here = at._replace(along=at.along * way, aside=at.aside * way, curvature=at.curvature * way)
        drives = math.copysign(1.0, needed)
        slides = math.copysign(1.0, float(sliding(here, drives, given.radius).arrays()[0][0]))
        with np.errstate(all="ignore"):
            feeds = float(np.ravel(gain(given, here, drives, slides).c[0])[0]) * drives
            asked = rows(here, drives, slides, math.copysign(1.0, feeds))
        values = []
        for row, limit in zip(asked, zip(*limits, strict=True), strict=True):
            room = math.inf if row.room is None else float(np.ravel(row.room.c[0])[0])
            value = float(np.ravel(row.value.c[0])[0])
            away = math.isinf(room) and row.way < 0.0  # a cusp: on one side of it the wall turns
            if (room > ZERO or away) and math.isfinite(value):  # away, and its stress goes to 0
                values.append(value)
            elif loaded:
                values.append(math.copysign(math.inf, row.way))
            else:
                values.append(max(limit))
        out = [max(pair) for pair in zip(out, values, strict=True)] if out else values
    return out


def _towards_mid_motion(engagement: Engagement, piece: Stretch, rows: Rows) -> list[float]:
    """The limits of 0/0 there, from the stretch beside it."""
    x = piece.end if piece.end < 0.0 else piece.start
    h = math.radians(x)
    every = [row.value.c for row in rows(contact(engagement, x, 2), *piece[2:])]
    return [float(c[0] - h * (c[1] - h * c[2])) for c in every]


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
