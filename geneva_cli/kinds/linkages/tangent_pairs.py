"""Pairs of entry and exit on a roller's closed path that a wheel's straight slots can use.

A wheel with straight radial slots takes a roller without shock if the path enters along one slot
and leaves along the next. Both points are equally far from the wheel's centre O. With the unit
tangents t1 and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. Draw the line of the chord through each point of
the path: as an entry at the angle pi/2 - b from the tangent to one side, as an exit to the other
side. A line is a point in a plane of its angle and its offset from an origin. So entries and exits
are two curves in that plane, and the pairs are the crossings of the curves.

Each path is sampled until its direction is known between the samples, and at its inflections. So an
arc between two samples is a cubic in that plane, and angles rise or fall along it. Where an arc of
the entries and one of the exits have angles in common, the difference of their offsets changes its
sign at a pair. If it does not, but falls from an end, it may do so twice. From there Newton's
method leads to the pairs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, blocks, joined, record_of
from geneva_cli.numerics.jet import Jet, sine_versine

SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one
# Slope of the index angle along the family of pairs. With less, two roots are nearly one: they are
# within 5e-11 radians of index angle from a double root, and known to fewer digits than the rest.
DOUBLE_ROOT_SLOPE = 1e-5
STEPS = 24  # samples of a turn that every path has
FIRST, LAST = slice(None, -1), slice(1, None)  # ends of intervals
CUBIC_ERROR = 0.01  # of an offset, as a fraction of its range in an arc

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


def displaced(path: LinkPath, phi: Array, tau: Array) -> PathPoints:
    """Points after crank rotations (n, 2) from their places at crank angles (n, 1), radians.

    In numbers of 80 bits, where the computer has them: what is left of the links' speeds in a
    roller that moves much more slowly then still has the digits of a double.
    """
    begin, since = (cast("Array", np.asarray(x, np.longdouble)) for x in (phi, tau))
    x, y = path.about(cast("float", begin))(*sine_versine(Jet.variable(since, 2)))
    return _points(tau, *(_complex(*place) for place in zip(x.arrays(), y.arrays(), strict=True)))


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
    found.append(_inflections(path, *_in_order(found)))
    whose, at = _in_order(found)
    counts = np.bincount(whose, minlength=count)
    starts = np.cumsum(counts) - counts
    order = closes[np.argsort(counts[closes], kind="stable")]
    for block in blocks(len(order), 256) if len(order) else ():
        which = np.sort(order[block])
        columns = np.minimum(np.arange(counts[which].max()), counts[which, None] - 1)
        some = taken(at, starts[which, None] + columns)
        turned = _turned(taken(some, (slice(None), FIRST)), taken(some, (slice(None), LAST)))
        yield PathSamples(which, some, np.cumsum(np.pad(turned, ((0, 0), (1, 0))), axis=1))


def _in_order(found: Sequence[tuple[Any, ...]]) -> tuple[Whole, PathPoints]:
    """Designs and points of samples, by designs and crank angles."""
    whose, *motion = joined(found)
    # a turn and the first step are less than 8 radians
    place = np.argsort(8.0 * whose + motion[0])
    return whose[place], _points(*(x[place] for x in motion))


def _inflections(path: LinkPath, whose: Whole, at: PathPoints) -> tuple[Any, ...]:
    """Inflections between samples of designs: on each side of them the tangent turns one way."""
    i = np.flatnonzero((whose[1:] == whose[:-1]) & (at.turn[1:] * at.turn[:-1] < 0.0))
    which, low, high = path.of(whose[i]), at.phi[i], at.phi[i + 1]
    left, right = ((at.v[k].conj() * at.a[k]).imag for k in (i, i + 1))
    for _ in range(12):  # false position, with half of a value that stays (Illinois)
        phi = low + (high - low) * (left / (left - right))
        middle = points(which, phi[:, None])
        bend = (middle.v.conj() * middle.a).imag[:, 0]
        ahead = bend * left > 0.0
        left, right = np.where(ahead, bend, 0.5 * left), np.where(ahead, 0.5 * right, bend)
        low, high = np.where(ahead, phi, low), np.where(ahead, high, phi)
    return (whose[i], *(x[:, 0] for x in middle[:4]))


def _turned(left: PathPoints, right: PathPoints) -> Array:
    """Turn from one tangent to the next, less than half a turn."""
    turn: Array = np.angle(right.t * left.t.conj())
    return turn


def _bends(left: PathPoints, right: PathPoints) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    half, turned = 0.5 * (right.phi - left.phi), _turned(left, right)
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left.turn + right.turn)) > 0.05) | (np.abs(turned) > 1.0)
    # the tangent may turn back and forth
    back = left.turn * (turned - half * (left.turn + right.turn) / 1.5)
    wrong |= (left.turn * right.turn > 0.0) & (back < 0.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    return wrong | (half * np.abs(right.turn - left.turn) > 0.25)  # radians


def pairs(path: LinkPath, samples: Sequence[PathSamples], b: Array) -> Pairs:
    """All pairs of designs with half index angles b, (n, 1), from samples of their paths."""
    if not samples:
        return Pairs(np.empty(0, dtype=int), np.empty((0, 2)), np.empty(0))
    senses = (1.0, -1.0)
    starts = joined([_starts(some, b, sense) for some in samples for sense in senses])
    which, sense, low, wide, place = starts
    return _solved(path, Pairs(which, (low + place * wide).T, sense), low.T, wide.T, b)


def _starts(samples: PathSamples, b: Array, sense: float) -> tuple[Any, ...]:
    """Starts of Newton's method for a sense of the wheel."""
    at, lean = samples.at, 0.5 * math.pi - b[samples.which]
    width = np.diff(at.phi)
    # The tangent turns against the wheel: the lines' angles rise along the arcs that can be used.
    angle = -sense * (samples.angle + np.angle(at.t[:, :1]))
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    origin = np.take_along_axis(at.p, np.abs(at.turn).argmax(axis=1)[:, None], axis=1)
    sides = []
    for side in (-sense, sense):
        from_origin = (at.p - origin) * (at.t * np.exp(1j * side * lean)).conj()
        slope = -np.abs(at.v) * np.sin(side * lean) - at.turn * from_origin.real
        rows = ((angle, -sense * at.turn), (from_origin.imag, slope))
        parts = [
            part.ravel()
            for value, by_phi in rows
            for part in (
                value[:, FIRST],
                value[:, LAST],
                width * by_phi[:, FIRST],
                width * by_phi[:, LAST],
            )
        ]
        sides.append(np.stack(parts))
    # Entries and exits after them whose lines have an angle in common, in this turn or the next.
    low, high, n = angle[:, FIRST], angle[:, LAST], width.shape[1]
    use = np.where(high > low, 0.0, np.nan)
    later = np.tri(n, k=-1) * (angle[:, -1:] - angle[:, :1])[:, None] - 2.0 * lean[:, None]
    # with inflections at both ends the arcs touch: a double root
    touching = high + SAME_ENTRY
    may = (low + use)[:, None] + later < touching[:, :, None]
    may &= (touching + use)[:, None] + later > (low + use)[:, :, None]
    place = np.flatnonzero(may)
    row = place // (n * n)
    first, last = place // n, row * n + place % n
    entry, exit_ = sides[0].take(first, axis=1), sides[1].take(last, axis=1)
    exit_[:2] += later.ravel().take(place)
    ends = [_common_end(entry, exit_, end) for end in (0, 1)]
    (low, gap, slope), (high, last_gap, last_slope) = ends
    span, ahead, behind = high - low, -gap / slope, last_gap / last_slope
    # Both ends of the difference's tangents; where it changes its sign, one of them is enough.
    left, right = (ahead >= 0.0) & (ahead <= span), (behind >= 0.0) & (behind <= span)
    once = gap * last_gap <= 0.0
    near = np.minimum(
        gap * (gap + slope * span / 3.0), last_gap * (last_gap - last_slope * span / 3.0)
    )
    twice = ~once & (near < 0.0)
    # the cubics' error may hide a pair near an end
    error = CUBIC_ERROR * (np.abs(entry[5] - entry[4]) + np.abs(exit_[5] - exit_[4]))
    starts = (
        (left & (once | twice), low + ahead),
        (right & (twice | (once & ~left)), high - behind),
        (once & ~left & ~right, low + span * gap / (gap - last_gap)),
        (np.abs(gap) < error, low),
        (np.abs(last_gap) < error, high),
    )
    cells = np.concatenate([np.flatnonzero(where) for where, _ in starts])
    angles = np.concatenate([at_[where] for where, at_ in starts])
    place = np.stack([_inverse(arcs[:4, cells], angles) for arcs in (entry, exit_)])
    arcs = np.stack((first[cells], last[cells]))
    which = samples.which[row[cells]]
    return (
        which,
        np.full(len(which), sense),
        at.phi[:, FIRST].ravel()[arcs],
        width.ravel()[arcs],
        place,
    )


def _common_end(entry: Array, exit_: Array, end: int) -> tuple[Array, Array, Array]:
    """First or last angle that lines of both arcs have; the difference of offsets and its slope."""
    inner = (exit_[end] > entry[end]) if end == 0 else (exit_[end] < entry[end])
    angle = np.where(inner, exit_[end], entry[end])
    place = _inverse(np.where(inner, entry[:4], exit_[:4]), angle)
    values = []
    for arcs, at in ((entry, np.where(inner, place, end)), (exit_, np.where(inner, end, place))):
        (_, turn), (offset, slope) = _cubic(arcs[:4], at), _cubic(arcs[4:], at)
        values.append((offset, slope / turn))
    (one, slope), (two, other) = values
    return angle, one - two, slope - other


def _inverse(arcs: Array, angle: Array) -> Array:
    """Fractions of arcs at which lines have an angle, which rises along them."""
    place = np.clip((angle - arcs[0]) / (arcs[1] - arcs[0]), 0.0, 1.0)
    for _ in range(4):  # Newton steps
        value, slope = _cubic(arcs, place)
        place = np.clip(place - np.nan_to_num((value - angle) / slope), 0.0, 1.0)
    return place


def _cubic(arcs: Array, place: Array) -> tuple[Array, Array]:
    """Value and slope of cubics from values and slopes at both ends."""
    a, d, first, last = arcs
    rise = d - a
    square, cube = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
    value = a + place * (first + place * (square + place * cube))
    return value, first + place * (2.0 * square + 3.0 * place * cube)


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
            near = (np.abs((after - low[some]) / cell - 0.5) < 4.0).all(axis=1)
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
