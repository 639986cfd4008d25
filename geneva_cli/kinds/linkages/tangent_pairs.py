"""Pairs of entry and exit on a roller's closed path that a wheel's straight slots can use.

A wheel with straight radial slots takes a roller without shock if the path enters along one slot
and leaves along the next. Both points are equally far from the wheel's centre O. With the unit
tangents t1 and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. Draw the line of the chord through each point of
the path: as an entry at the angle pi/2 - b from the tangent to one side, as an exit to the other
side. A line is a point in a plane of its angle and its offset from an origin. So entries and exits
are two curves in that plane, and the pairs are the crossings of the curves.

Each path is sampled until its direction is known between the samples. A cell is an arc of the path
for the entry and one for the exit. In the plane of lines each arc is a cubic. Newton's method leads
from the crossing of the cubics to the pair. Where both are nearly parallel it starts at both ends
of the cell, since there may be two pairs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, blocks, joined, record_of

SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one
# Slope of the index angle along the family of pairs. With less, two roots are nearly one: they are
# within 5e-11 radians of index angle from a double root, and known to fewer digits than the rest.
DOUBLE_ROOT_SLOPE = 1e-5
STEPS = 24  # samples of a turn that every path has
FIRST, LAST = slice(None, -1), slice(1, None)  # ends of intervals
# Possible error of a quantity's cubics, as a fraction of their range in a cell. It is ample: of
# 184,000 wheels of random linkages none is lost with 0, and 9 % are with -0.05.
CUBIC_ERROR = 0.03

Cells: TypeAlias = tuple[Whole, Whole, Array]  # arcs of entry and exit, and turns of the exit
R = TypeVar("R", bound=tuple[object, ...])


class PathPoints(NamedTuple):
    """Points of paths at crank angles ``phi``; each row is of one design.

    Position, velocity and acceleration are complex numbers, as is the unit tangent ``t``. ``turn``
    is the rate at which the tangent turns.
    """

    phi: Array
    p: Complex
    v: Complex
    a: Complex
    t: Complex
    turn: Array


class PathSamples(NamedTuple):
    """Samples of a full turn of designs; the last is the first, one turn later."""

    which: Whole  # numbers of the designs, ascending
    at: PathPoints
    angle: Array  # of the tangent, without jumps


class Pairs(NamedTuple):
    """Entry and exit (n, 2) of designs, and the wheel's sense of rotation."""

    which: Whole
    phi: Array
    sense: Array


class Residual(NamedTuple):
    """Residuals of both conditions of pairs, and their slopes.

    ``away`` is the chord's component across the sum of the tangents, with its slopes by entry and
    by exit. ``excess`` is the error of the index angle, which turns with the tangents. ``det`` is
    the determinant of both.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array


def taken(record: R, where: Any) -> R:
    """Select some rows of each array of a record."""
    parts: Any = record
    return record_of(record, [part[where] for part in parts])


def points(path: LinkPath, phi: Array) -> PathPoints:
    """Points of paths; a row of ``phi`` holds the angles of one design."""
    x, y = path.at(phi, 2)
    return _points(phi, *(_complex(*place) for place in zip(x.arrays(), y.arrays(), strict=True)))


def _points(phi: Array, p: Complex, v: Complex, a: Complex) -> PathPoints:
    """Points with a known position, velocity and acceleration."""
    square = v.real * v.real + v.imag * v.imag
    turn = (v.real * a.imag - v.imag * a.real) / square
    return PathPoints(phi, p, v, a, v / np.sqrt(square), turn)


def _complex(x: Array, y: Array) -> Complex:
    both = np.empty_like(x, dtype=complex)  # in memory in the order of x
    both.real, both.imag = x, y
    return both


def sampled(path: LinkPath, count: int) -> Iterator[PathSamples]:
    """Samples of ``count`` designs, in blocks with similar numbers of samples.

    Designs with fewer samples than others of their block repeat their last one. A bend within 1e-5
    radians of the crank counts as a cusp.
    """
    # Samples begin after 0.3 of a step: symmetrical paths have their cusps at 0 and at pi.
    even = (np.arange(STEPS + 1) + 0.3) * (math.tau / STEPS)
    every: Whole = np.arange(count)
    parts = (every[block] for block in blocks(count, 256))  # in the processor's cache
    base = joined(
        [points(path.of(i), np.broadcast_to(even, (len(i), len(even)))) for i in parts], 0
    )
    closes = np.flatnonzero(np.isfinite(base.turn).all(axis=1))
    base = taken(base, closes)
    row, column = np.nonzero(_bends(*(taken(base, (slice(None), i)) for i in (FIRST, LAST))))
    left, right = (taken(base, (row, column + end, None)) for end in (0, 1))
    row = closes[row]
    found = [(np.repeat(closes, len(even)), *(x.ravel() for x in base[:4]))]
    for _ in range(14):  # halvings
        if not len(row):
            break
        middle = points(path.of(row), 0.5 * (left.phi + right.phi))
        found.append((row, *(x[:, 0] for x in middle[:4])))
        left, right = joined([left, middle], 0), joined([middle, right], 0)
        again = np.flatnonzero(_bends(left, right))
        row = np.concatenate((row, row))[again]
        left, right = taken(left, again), taken(right, again)
    whose, *motion = joined(found)
    # by designs and crank angles: a turn and the first step are less than 8 radians
    place = np.argsort(8.0 * whose + motion[0])
    counts = np.bincount(whose, minlength=count)
    starts = np.cumsum(counts) - counts
    order = closes[np.argsort(counts[closes], kind="stable")]
    for block in blocks(len(order), 256) if len(order) else ():
        which = np.sort(order[block])
        columns = np.arange(counts[which].max())
        number = place[starts[which, None] + np.minimum(columns, counts[which, None] - 1)]
        at = _points(*(x.take(number) for x in motion))
        turned = _turned(taken(at, (slice(None), FIRST)), taken(at, (slice(None), LAST)))
        yield PathSamples(which, at, np.cumsum(np.pad(turned, ((0, 0), (1, 0))), axis=1))


def _turned(left: PathPoints, right: PathPoints) -> Array:
    """Turn from one tangent to the next, less than half a turn."""
    turn: Array = np.angle(right.t * left.t.conj())
    return turn


def _bends(left: PathPoints, right: PathPoints) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    half, turned = 0.5 * (right.phi - left.phi), _turned(left, right)
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left.turn + right.turn)) > 0.05) | (np.abs(turned) > 1.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    return wrong | (half * np.abs(right.turn - left.turn) > 0.25)  # radians


class Arcs(NamedTuple):
    """Arcs between samples, and the lines of their points as (angle, offset) in a plane.

    ``cubics`` are the Bernstein coefficients of both. ``strip`` is the vector from the first line
    to the last, with the least and greatest cross product of it and the coefficients.
    """

    cubics: Array  # (2, 4, n)
    strip: Array  # (4, n)

    def taken(self, where: Whole) -> Arcs:
        """Select some of the arcs."""
        return Arcs(self.cubics.take(where, axis=-1), self.strip.take(where, axis=-1))

    def at(self, place: Array) -> tuple[Array, Array]:
        """Lines at fractions of the arcs, and their slopes: (2, n)."""
        rest, rows = 1.0 - place, self.cubics.swapaxes(0, 1)
        a, b, c = (rows[i] * rest + rows[i + 1] * place for i in range(3))
        a, b = a * rest + b * place, b * rest + c * place
        return a * rest + b * place, 3.0 * (b - a)


class Side(NamedTuple):
    """All arcs of designs as entries or as exits, and the spans of their lines."""

    arcs: Arcs
    spans: list[Array]


def pairs(path: LinkPath, samples: Sequence[PathSamples], b: Array) -> Pairs:
    """All pairs of designs with half index angles b, (n, 1), from samples of their paths."""
    if not samples:
        return Pairs(np.empty(0, dtype=int), np.empty((0, 2)), np.empty(0))
    which, sense, low, wide, place = joined(
        [start for some in samples for start in _starts(some, b)]
    )
    return _solved(path, Pairs(which, (low + place * wide).T, sense), low.T, wide.T, b)


def _starts(samples: PathSamples, b: Array) -> Iterator[tuple[Whole, Array, Array, Array, Array]]:
    """Starts of Newton's method for each sense of the wheel.

    They are designs, senses, the beginnings and widths of the arcs for entry and exit, and places
    in them, (2, n) each.
    """
    at, count = samples.at, len(samples.which)
    lean = 0.5 * math.pi - b[samples.which]
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    origin = np.take_along_axis(at.p, np.abs(at.turn).argmax(axis=1)[:, None], axis=1)
    angle = samples.angle + np.angle(at.t[:, :1])
    both = [_arcs(at, angle, origin, side * lean) for side in (-1.0, 1.0)]
    size = np.max([np.abs(arcs.cubics[1]).reshape(4, count, -1) for arcs in both], axis=(0, 1, 3))
    sides = [Side(arcs, _spans(arcs, count, 32000.0 / size[:, None])) for arcs in both]
    begin, width = at.phi[:, :-1].ravel(), np.diff(at.phi).ravel()
    for sense, (entries, exits) in ((1.0, sides), (-1.0, sides[::-1])):
        first, last, turn = _cells(sense, entries, exits, samples.angle[:, -1], width)
        cell, place = _crossings(entries.arcs.taken(first), exits.arcs.taken(last), turn)
        ends = np.stack((first[cell], last[cell]))
        which = samples.which[ends[0] // (len(begin) // count)]
        yield which, np.full(len(which), sense), begin[ends], width[ends], place


def _arcs(at: PathPoints, angle: Array, origin: Complex, lean: Array) -> Arcs:
    """Lines of all arcs; ``lean`` is the angle from the tangent."""
    from_origin = (at.p - origin) * (at.t * np.exp(1j * lean)).conj()
    slope = -np.abs(at.v) * np.sin(lean) - at.turn * from_origin.real
    third = np.diff(at.phi) / 3.0
    cubics = np.empty((2, 4, third.size))
    for rows, value, by_phi in (
        (cubics[0], angle + lean, at.turn),
        (cubics[1], from_origin.imag, slope),
    ):
        for row, part in zip(rows, bernstein(third, value, by_phi), strict=True):
            row[:] = part.ravel()
    along = cubics[:, 3] - cubics[:, 0]
    across = along[0] * cubics[1] - along[1] * cubics[0]
    return Arcs(cubics, np.stack((*along, across.min(axis=0), across.max(axis=0))))


def bernstein(third: Array, value: Array, slope: Array) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients of cubics between adjacent columns, and a third of their width."""
    a, d = value[:, :-1], value[:, 1:]
    return a, a + third * slope[:, :-1], d - third * slope[:, 1:], d


def _cells(sense: float, entries: Side, exits: Side, whole: Array, width: Array) -> Cells:
    """Arcs for entry and exit of each design whose lines may agree."""
    # The tangent turns against the wheel, or not at all; it does alike for both sides.
    turns = np.diff(entries.arcs.cubics[0], axis=0) * sense
    use = ((turns.min(axis=0) <= 0.0) & (width > 0.0)).reshape(len(whole), -1)
    (low, high, down, up), (low2, high2, down2, up2) = entries.spans, exits.spans
    up, up2 = np.where(use, up, -32768), np.where(use, up2, -32768)  # below all others
    both = (high - low)[:, :, None] + (high2 - low2)[:, None]
    may = high2[:, None] - low[:, :, None] <= both
    may &= (down2[:, None] <= up[:, :, None]) & (up2[:, None] >= down[:, :, None])
    place, n = np.flatnonzero(may), use.shape[1]
    first, last = place // n, place // (n * n) * n + place % n
    # the path's whole turn, for an exit that is before the entry in the order of samples
    one, two = entries.arcs, exits.arcs
    turn = np.where(last < first, -whole[first // n], 0.0)
    off = two.cubics[0, 0].take(last) - one.cubics[0, 0].take(first) - turn
    near = np.flatnonzero((np.abs(off) < math.pi) & (first != last))
    first, last, turn = first[near], last[near], turn[near]
    near = np.flatnonzero(_may_cross(one.strip.take(first, -1), two.cubics.take(last, -1), turn))
    first, last, turn = first[near], last[near], turn[near]
    near = np.flatnonzero(_may_cross(two.strip.take(last, -1), one.cubics.take(first, -1), -turn))
    return first[near], last[near], turn[near]


def _may_cross(strip: Array, cubics: Array, turn: Array) -> Mask:
    """True if an arc of lines, turned back by ``turn``, may cross the strip of another arc."""
    across = strip[0] * cubics[1] - strip[1] * (cubics[0] - turn)
    least, most = across.min(axis=0) - strip[3], across.max(axis=0) - strip[2]
    margin = CUBIC_ERROR * (most - least)
    may: Mask = (least <= margin) & (most >= -margin)
    return may


def _spans(arcs: Arcs, count: int, scale: Array) -> list[Array]:
    """Least and greatest angles and offsets of designs' arcs, as whole numbers of 16 bits.

    An angle returns to 0 after a turn, and a comparison takes little time.
    """
    low, high = arcs.cubics.min(axis=1), arcs.cubics.max(axis=1)
    margin = CUBIC_ERROR * (high - low)
    parts = ((low - margin).reshape(2, count, -1), (high + margin).reshape(2, count, -1))
    angles = [np.floor(part[0] * (65536.0 / math.tau)) + end for end, part in enumerate(parts)]
    offsets = [np.floor(part[1] * scale) + end for end, part in enumerate(parts)]
    turned = [x.astype(np.int32).astype(np.uint16) for x in angles]
    return [*turned, *(np.clip(x, -32767.0, 32767.0).astype(np.int16) for x in offsets)]


def _crossings(entry: Arcs, exit_: Arcs, turn: Array) -> tuple[Whole, Array]:
    """Numbers of cells, and the fractions (2, n) of their arcs at which the cubics may cross."""
    (x, y), (u, v) = (np.diff(arcs.cubics, axis=1) for arcs in (entry, exit_))
    cross = x[:, None] * v - y[:, None] * u
    cross *= np.sign(cross[1, 1])
    # the directions of both are apart, by more than the error of the cubics
    once = cross.min(axis=(0, 1)) > 0.1 * cross.max(axis=(0, 1))
    one, two = np.flatnonzero(once), np.flatnonzero(~once)
    place = _refined(entry.taken(one), exit_.taken(one), turn[one], np.full((2, len(one)), 0.5))
    near = (np.abs(place - 0.5) < 0.8).all(axis=0)
    cells, places = [one[near]], [place[:, near]]
    entry, exit_, turn = entry.taken(two), exit_.taken(two), turn[two]
    tried: list[Array] = []
    for start in (*_common_ends(entry, exit_, turn), np.full((2, len(two)), 0.5)):
        place = _refined(entry, exit_, turn, start)
        place = np.where((np.abs(place - 0.5) < 0.8).all(axis=0), place, start)
        new = np.ones(len(two), dtype=bool)
        for other in tried:
            new &= np.abs(place - other).max(axis=0) > 1e-4  # often all lead to one crossing
        tried.append(place)
        cells.append(two[new])
        places.append(place[:, new])
    return np.concatenate(cells), np.concatenate(places, axis=1)


def _common_ends(entry: Arcs, exit_: Arcs, turn: Array) -> list[Array]:
    """Places in cells at the ends of the angles that entry and exit have in common."""
    ahead, (x, *_), (u, *_) = (
        exit_.cubics[0, 0] - turn - entry.cubics[0, 0],
        entry.strip,
        exit_.strip,
    )
    spans = np.sort((0.0 * x, x), axis=0), np.sort((ahead, ahead + u), axis=0)
    ends = np.maximum(spans[0][0], spans[1][0]), np.minimum(spans[0][1], spans[1][1])
    return [np.clip(np.stack((end / x, (end - ahead) / u)), 0.0, 1.0) for end in ends]


def _refined(entry: Arcs, exit_: Arcs, turn: Array, place: Array) -> Array:
    """Places (2, n) in cells after Newton's method for the crossing of the cubics."""
    for _ in range(3):  # the pair itself may be off the crossing by 0.05
        (p, (x, y)), (q, (u, v)) = entry.at(place[0]), exit_.at(place[1])
        off, up = q - p
        off -= turn
        step = np.stack((off * v - up * u, off * y - up * x)) / (x * v - y * u)
        place = np.clip(place + step, -0.5, 1.5)
    return place


def residual(at: PathPoints, b: Array, sense: Array) -> Residual:
    """Residuals of pairs with half index angles b, (n,), from their points (n, 2)."""
    (p, q), (t, u), (v, w) = at.p.T, at.t.T, at.v.T
    chord, both, (turn, turn_out) = q - p, (t + u).conj(), at.turn.T
    by_entry = (chord * (1j * turn * t).conj() - v * both).imag
    by_exit = (w * both + chord * (1j * turn_out * u).conj()).imag
    excess = np.angle(-u * t.conj() * np.exp(-2j * sense * b))
    det = by_entry * turn_out + by_exit * turn
    return Residual((chord * both).imag, by_entry, by_exit, excess, det)


def newton(at: PathPoints, rest: Residual) -> Array:
    """Newton step of pairs (n, 2)."""
    turn, turn_out = at.turn.T
    by_entry = rest.excess * rest.by_exit - rest.away * turn_out
    by_exit = -rest.excess * rest.by_entry - rest.away * turn
    step: Array = (np.stack((by_entry, by_exit)) / rest.det).T
    return step


def _solved(path: LinkPath, starts: Pairs, low: Array, wide: Array, b: Array) -> Pairs:
    """Pairs to which Newton's method leads from places in cells, which begin at ``low``."""
    which, phi, sense = starts
    steep, flat = np.zeros(len(which), dtype=bool), np.zeros(len(which), dtype=bool)
    excess = np.zeros(len(which))
    live: Whole = np.arange(len(which))
    for _ in range(24):  # towards a double root each step halves the error
        left = []
        for block in blocks(len(live), 4096):  # in the processor's cache
            some = live[block]
            at = points(path.of(which[some]), np.asfortranarray(phi[some]))
            rest = residual(at, b[which[some], 0], sense[some])
            move, cell = newton(at, rest), wide[some]
            move *= np.minimum(1.0, (cell / np.abs(move)).min(axis=1))[:, None]
            phi[some] = after = at.phi + move
            near = (np.abs((after - low[some]) / cell - 0.5) < 1.5).all(axis=1)
            done = near & (np.abs(move).max(axis=1) < 1e-9)  # radians: the next step is rounding
            level = np.abs(rest.det) < DOUBLE_ROOT_SLOPE * np.abs(rest.by_exit)
            steep[some] = done & ~level
            flat[some] = done & level
            excess[some] = rest.excess
            left.append(some[near & ~done])
        live = joined([(x,) for x in left])[0]
        if not len(live):
            break
    flat[live] = np.abs(excess[live]) < 1e-5  # radians; with more it is not a double root
    every = taken(starts, steep)
    if flat.any():
        every = joined([every, _double(path, taken(starts, flat), b)], 0)
    phi = every.phi % math.tau
    phi[:, 1] += math.tau * (phi[:, 1] < phi[:, 0])
    key = 8.0 * every.which + phi[:, 0]  # by designs and entries: a turn is less than 8 radians
    order = np.argsort(key, kind="stable")
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(key[order]) > SAME_ENTRY
    return taken(every._replace(phi=phi), order[first])


def _double(path: LinkPath, starts: Pairs, b: Array) -> Pairs:
    """Pairs near these at which the index angle is stationary, if it is the wheel's there."""
    which, phi, sense = starts
    h = 1e-5  # radians: the slope of ``det`` needs few digits
    some, half, start = path.of(which), b[which, 0], phi.copy()
    for _ in range(12):
        rest, by_entry, by_exit = (
            residual(points(some, phi + step), half, sense) for step in ((0, 0), (h, 0), (0, h))
        )
        slopes = (by_entry.det - rest.det) / h, (by_exit.det - rest.det) / h
        det = rest.by_entry * slopes[1] - rest.by_exit * slopes[0]
        move = np.stack(
            (
                rest.det * rest.by_exit - rest.away * slopes[1],
                rest.away * slopes[0] - rest.det * rest.by_entry,
            )
        )
        move = (move / det).T
        phi = phi + move
    settled = (np.abs(move) < 1e-9).all(axis=1) & (np.abs(phi - start) < 0.05).all(axis=1)
    return taken(Pairs(which, phi, sense), settled & (np.abs(rest.excess) < 1e-12))
