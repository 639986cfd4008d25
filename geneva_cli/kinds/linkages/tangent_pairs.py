"""Pairs of entry and exit on a roller's closed path that a wheel's straight slots can use.

A wheel takes a roller without shock if the path enters along one slot and leaves along the next.
With the unit tangents t1 and t2 there, its centre is

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. Through each point of the path there is the line
of its chord, as an entry and as an exit: by angle and offset two curves in a plane, cubics between
samples. Where two arcs may cross, Newton's method leads to a pair.
Arrays have designs, samples or pairs along their last axis; paths have numbers (n,).
"""

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, blocks, joined, record_taken

SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one
# Slope of the index angle along the family of pairs. With less, two roots are nearly one: within
# 5e-11 radians of index angle.
DOUBLE_ROOT_SLOPE = 1e-5
STEPS = 24  # least samples of a turn
REACH_ERROR = 0.3  # of the cubics' distances from their chords, over their range


class Samples(NamedTuple):
    """Samples of designs' paths: their numbers (m,), crank angles (m,), and points (3, m)."""

    which: Whole
    phi: Array
    at: Complex


class Pairs(NamedTuple):
    """Entry and exit (2, m) of designs, radians, and the wheel's sense of rotation (m,)."""

    which: Whole
    phi: Array
    sense: Array


def points(path: LinkPath, direction: Complex, order: int = 2) -> Complex:
    """Position, velocity, and acceleration for order 2, for unit vectors of the crank."""
    *_, p, q = path.numbers
    (u, v), (pin_x, pin_y), (ahead, _, side, rate, fall) = path.turn(direction, order)
    x, y = u * p - v * q, u * q + v * p
    out = np.empty((order + 1, *x.shape), dtype=complex)
    out[0].real, out[0].imag = pin_x + x, pin_y + y
    out[1].real, out[1].imag = -(pin_y + rate * y), pin_x + rate * x
    if order > 1:
        change, square = fall + rate * (rate * side + 2.0 * ahead), rate * rate
        out[2].real = change * y - square * x - pin_x
        out[2].imag = -(change * x + square * y) - pin_y
    return out


def points_at(path: LinkPath, phi: Array) -> Complex:
    """Position, velocity and acceleration (3, ...) at crank angles in radians."""
    return points(path, np.exp(1j * phi))


def turning_rate(at: Complex) -> Array:
    """The rate at which the tangents turn."""
    _, v, a = at
    return np.asarray((v.conj() * a).imag / (v.real**2 + v.imag**2))


def sampled(path: LinkPath, count: int) -> Samples:
    """Samples of a full turn of ``count`` designs in order; the last is the first, a turn later."""
    # Samples begin after 0.3 of a step: symmetrical paths have their cusps at 0 and at pi.
    even = [(k + 0.3) * math.tau / STEPS for k in range(STEPS + 1)]
    at = np.broadcast_to(points_at(path, np.array(even)[:, None]), (3, len(even), count))
    rows = [Samples(np.arange(count), np.full(count, x), at[:, i]) for i, x in enumerate(even)]
    begin, end, samples = joined(rows[:-1]), joined(rows[1:]), [*rows]
    crossings = list[tuple[Samples, Samples]]()
    for _ in range(14):  # halvings
        bends = _bends(begin, end)
        crossings.append((record_taken(begin, ~bends), record_taken(end, ~bends)))
        begin, end = record_taken(begin, bends), record_taken(end, bends)
        if not len(begin.which):
            break
        middle = 0.5 * (begin.phi + end.phi)
        new = Samples(begin.which, middle, points_at(path.of(begin.which), middle))
        samples.append(new)
        begin, end = joined((begin, new)), joined((new, end))
    # an inflection on each side of which the tangent turns one way
    begin, end = joined([*crossings, (begin, end)])
    turns = turning_rate(begin.at) * turning_rate(end.at) < 0.0
    (which, low, left_at), (_, high, right_at) = (record_taken(x, turns) for x in (begin, end))
    left, right = ((at[1].conj() * at[2]).imag for at in (left_at, right_at))
    some = path.of(which)
    for _ in range(9):  # false position, with half of a value that stays (Illinois)
        middle = low + (high - low) * (left / (left - right))
        at = points_at(some, middle)
        bend = (at[1].conj() * at[2]).imag
        ahead = bend * left > 0.0
        left, right = np.where(ahead, bend, 0.5 * left), np.where(ahead, 0.5 * right, bend)
        low, high = np.where(ahead, middle, low), np.where(ahead, high, middle)
    every = joined([*samples, Samples(which, middle, at)])
    return record_taken(every, np.lexsort((every.phi, every.which)))


def _bends(begin: Samples, end: Samples) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    turned = np.angle(end.at[1] * begin.at[1].conj())
    half, left, right = 0.5 * (end.phi - begin.phi), turning_rate(begin.at), turning_rate(end.at)
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left + right)) > 0.05) | (np.abs(turned) > 1.0)
    # the tangent may turn back and forth
    wrong |= (left * right > 0.0) & (left * (turned - half * (left + right) / 1.5) < 0.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    return np.asarray(wrong | (half * np.abs(right - left) > 0.25))  # radians


def _cells(owner: Whole, arcs: Array, total: Array, lean: Array) -> tuple[Whole, Whole, Array]:
    """Arcs (2, m) of entries, and of exits after them, whose lines have an angle in common.

    Also by how much the exits' angles are shifted, in this turn or to the next.
    """
    counts, cells = np.bincount(owner, minlength=len(lean)), []
    order, begin = np.argsort(counts), np.cumsum(counts) - counts
    for part in blocks(len(order), 64):  # designs with almost as many arcs
        design, number = order[part], np.arange(counts[order[part]].max())[:, None]
        absent = number >= counts[design]
        places = np.where(absent, 0, begin[design] + number)
        low, high = arcs[:, places]
        low[absent] = np.nan
        # with inflections at both ends the arcs touch: a double root
        high += SAME_ENTRY
        later = np.tri(len(low), k=-1)[:, :, None] * total[design] - 2.0 * lean[design]
        may = (low + later < high[:, None]) & (high + later > low[:, None])
        i, j, row = np.unravel_index(np.flatnonzero(may), may.shape)
        cells.append((places[i, row], places[j, row], later[i, j, row]))
    return joined(cells)


def _starts(samples: Samples, b: Array) -> tuple[Pairs, Array]:
    """Starts of Newton's method, and the widths (2, m) of their arcs."""
    which, n, (p, v, _), turn = samples.which, len(b), samples.at, turning_rate(samples.at)
    begin = np.flatnonzero(np.diff(which, prepend=-1))
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    bend, origin = np.abs(turn), np.empty(n, dtype=complex)
    sharpest = bend == np.maximum.reduceat(bend, begin)[which]
    origin[which[sharpest]] = p[sharpest]
    # one sum for all designs, without the NaN of those that cannot be built
    turned = np.append(0.0, np.cumsum(np.nan_to_num(np.angle(v[1:] * v[:-1].conj()))))
    speed = np.abs(v)
    ray = (p - origin[which]) * (v / speed).conj()
    total = turned[np.append(begin[1:], len(turned)) - 1] - turned[begin]
    # The tangent turns against the wheel: the lines' angles rise along the arcs that can be used.
    rises = np.where(which[1:] == which[:-1], np.diff(turned), 0.0)
    each = [np.flatnonzero(sense * rises < 0.0) for sense in (1.0, -1.0)]
    arc, sense = np.concatenate(each), np.repeat([1.0, -1.0], [*map(len, each)])
    both, owner, lean = np.stack((arc, arc + 1)), which[arc], 0.5 * math.pi - b
    phi, wide, angle = samples.phi[arc], np.diff(samples.phi)[arc], -sense * turned[both]
    tilt, bend = np.exp(1j * lean)[owner], turn[both]
    tilt.imag *= sense
    sides = []
    for side in (tilt, tilt.conj()):  # of an arc both angles, one offset, the chord's grade
        off = ray[both] * side
        slope = wide * (speed[both] * side.imag - bend * off.real)
        grade = np.diff(off.imag, axis=0)[0] / (angle[1] - angle[0])
        # the cubic is as far from its chord as the two inner points of its polygon, at most
        one, two = (slope + grade * sense * wide * bend) / 3.0
        least, most = np.minimum(np.minimum(one, -two), 0.0), np.maximum(np.maximum(one, -two), 0.0)
        error = REACH_ERROR * (most - least)
        sides.append(np.stack((*angle, off.imag[0], grade, least - error, most + error)))
    owners, totals = owner + n * (sense < 0.0), np.concatenate((-total, total))
    first, last, later = _cells(owners, angle, totals, np.tile(lean, 2))
    entry, exit_ = sides[0].take(first, axis=1), sides[1].take(last, axis=1)
    exit_[:2] += later
    low, high = np.maximum(entry[0], exit_[0]), np.minimum(entry[1], exit_[1])
    gap, gap_high = (
        np.subtract(*(x[2] + x[3] * (end - x[0]) for x in (entry, exit_))) for end in (low, high)
    )
    kept = np.minimum(gap, gap_high) < exit_[5] - entry[4]
    kept &= np.maximum(gap, gap_high) > exit_[4] - entry[5]
    # from the chords' crossing, or between two crossings; at an arc's end the cubics may be flat
    place = np.clip(np.where(gap * gap_high < 0.0, gap / (gap - gap_high), 0.5), 0.2, 0.8)
    common = low + place * (high - low)
    places = np.stack([(common - x[0]) / (x[1] - x[0]) for x in (entry, exit_)])[:, kept]
    pair = np.stack((first[kept], last[kept]))
    starts = Pairs(owner[pair[0]], phi[pair] + places * wide[pair], sense[pair[0]])
    return starts, wide[pair]


class Residual(NamedTuple):
    """Residuals of both conditions of pairs, the slopes' determinant, and Newton's step (2, m)."""

    away: Array  # the chord's component across the sum of the tangents
    excess: Array  # the error of the index angle, which turns with the tangents
    det: Array
    step: Array
    double: Mask  # two roots are nearly one: a step towards them would only be rounding


def residual(at: Complex, index: Complex) -> Residual:
    """Residuals of pairs from their points (3, 2, m), and the index angle (m,) as unit vectors."""
    (p, q), (v, w), _ = at
    (turn, turn_out), (t, u) = turning_rate(at), at[1] / np.abs(at[1])
    chord, both = q - p, (t + u).conj()
    away = (chord * both).imag
    by_entry = -turn * (chord * t.conj()).real - (v * both).imag
    by_exit = (w * both).imag - turn_out * (chord * u.conj()).real
    excess = np.angle(-u * (t * index).conj())
    det = by_entry * turn_out + by_exit * turn
    step = np.stack((excess * by_exit - away * turn_out, -excess * by_entry - away * turn)) / det
    double = np.abs(det) < DOUBLE_ROOT_SLOPE * np.abs(by_exit)
    return Residual(away, excess, det, step, double)


def pairs(path: LinkPath, samples: Samples, b: Array) -> Pairs:
    """All pairs of designs with half index angles b, (n,), from samples of their paths."""
    starts, wide = _starts(samples, b)
    (which, phi, sense), begin, n = starts, starts.phi.copy(), len(starts.which)
    index = np.exp(2j * sense * b[which])
    (good, flat), live = np.zeros((2, n), dtype=bool), np.arange(n)
    excess, last = np.zeros((2, n))
    for _ in range(24):  # towards a double root each step halves the error
        here, arc = phi.take(live, axis=1), wide.take(live, axis=1)
        rest = residual(points_at(path.of(which[live]), here), index[live])
        move = rest.step * np.minimum(1.0, (arc / np.abs(rest.step)).min(axis=0))
        phi[:, live] = here = here + move
        near = (np.abs(here - begin.take(live, axis=1)) < 2.0 * arc).all(axis=0)
        # Newton's errors are of the order of the last one's square: the next is rounding
        moved, before, excess[live] = np.abs(move).max(axis=0), last[live], rest.excess
        done = near & ((moved < 1e-9) | (moved**3 < 1e-14 * before**2))  # radians
        last[live], good[live], flat[live] = moved, done & ~rest.double, done & rest.double
        live = live[near & ~done]
        if not len(live):
            break
    flat[live] = np.abs(excess[live]) < 1e-5  # radians; with more it is not a double root
    every = [record_taken(starts, good)]
    if flat.any():
        every.append(_double(path, record_taken(starts, flat), index[flat]))
    found = joined(every)
    phi = found.phi % math.tau
    phi[1] += math.tau * (phi[1] < phi[0])
    key = 8.0 * found.which + phi[0]  # by designs and entries: a turn is less than 8 radians
    order = np.argsort(key, kind="stable")
    order = order[np.append(True, np.diff(key[order]) > SAME_ENTRY)[: len(order)]]
    return record_taken(found._replace(phi=phi), order)


def _double(path: LinkPath, starts: Pairs, index: Complex) -> Pairs:
    """Pairs near these at which the index angle is stationary, if it is the wheel's there."""
    h, some, phi = 1e-5, path.of(starts.which), starts.phi  # radians: ``det`` has digits enough
    steps = [np.reshape(step, (2, 1)) for step in ((0.0, 0.0), (h, 0.0), (0.0, h))]
    for _ in range(12):
        rest, one, two = (residual(points_at(some, phi + step), index) for step in steps)
        f, g = rest.away, rest.det
        (a, b), (c, d) = ((x.away - f, x.det - g) for x in (one, two))
        move = np.stack((c * g - d * f, b * f - a * g)) / (a * d - b * c) * h
        phi = phi + move
    settled = (np.abs(move) < 1e-9).all(axis=0) & (np.abs(phi - starts.phi) < 0.05).all(axis=0)
    settled &= np.abs(rest.excess) < 1e-12
    return record_taken(starts._replace(phi=phi), settled)
