"""Pairs of entry and exit on a roller's closed path that a wheel's straight slots can use.

A wheel takes a roller without shock if the path enters along one slot and leaves along the next.
With the unit tangents t1 and t2 there, its centre is

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. Through each point of the path there is the line
of its chord, as an entry and as an exit: by angle and offset two curves in a plane, cubics between
samples. From their crossings Newton's method leads to the pairs.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole
from geneva_cli.numerics.jet import Jet

SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one
# Slope of the index angle along the family of pairs. With less, two roots are nearly one: within
# 5e-11 radians of index angle.
DOUBLE_ROOT_SLOPE = 1e-5
STEPS, CUBIC_ERROR = 24, 0.01  # least samples of a turn; of an offset, over its range in an arc

# numbers of the designs (N,), crank angles (N,), and position, velocity, acceleration (3, N)
Samples: TypeAlias = "tuple[Whole, Array, Complex]"


class Pairs(NamedTuple):
    """Entry and exit (n, 2) of designs, radians, and the wheel's sense of rotation."""

    which: Whole
    phi: Array
    sense: Array


def complex_of(x: Jet, y: Jet) -> Complex:
    """Derivatives of a point's place as complex numbers, (order + 1, ...)."""
    shape = np.broadcast_shapes(*(np.shape(c) for c in (*x.c, *y.c)))
    both = np.empty((len(x.c), *shape), dtype=complex)
    for k, (p, q) in enumerate(zip(x.arrays(), y.arrays(), strict=True)):
        both[k].real, both[k].imag = p, q
    return both


def points(path: LinkPath, phi: Array, order: int = 2) -> Complex:
    """Position, velocity and acceleration (3, n, k) at crank angles; a row is of one design."""
    return complex_of(*path.at(phi, order))


def turning_rate(at: Complex) -> Array:
    """The rate at which the tangents turn."""
    _, v, a = at
    rate: Array = (v.real * a.imag - v.imag * a.real) / (v.real * v.real + v.imag * v.imag)
    return rate


def sampled(path: LinkPath, count: int) -> tuple[Array, Complex]:
    """Samples of a full turn of ``count`` designs: angles (n, k), and points (3, n, k).

    The last is the first, one turn later; designs with fewer samples than others repeat it.
    """
    # Samples begin after 0.3 of a step: symmetrical paths have their cusps at 0 and at pi.
    even = (np.arange(STEPS + 1) + 0.3) * (math.tau / STEPS)
    phi = np.broadcast_to(even, (count, len(even)))
    at = points(path, phi)
    samples = np.repeat(np.arange(count), len(even)), phi.ravel(), at.reshape(3, -1)
    for _ in range(14):  # halvings
        whose, phi, at = samples
        i = np.flatnonzero((whose[1:] == whose[:-1]) & _bends(phi, at))
        if not len(i):
            break
        samples = _with(path, samples, i, 0.5 * (phi[i] + phi[i + 1]))
    whose, phi, at = samples
    # an inflection on each side of which the tangent turns one way
    turn = turning_rate(at)
    i = np.flatnonzero((whose[1:] == whose[:-1]) & (turn[1:] * turn[:-1] < 0.0))
    which, low, high = path.of(whose[i]), phi[i], phi[i + 1]
    left, right = ((at[1, k].conj() * at[2, k]).imag for k in (i, i + 1))
    for _ in range(12):  # false position, with half of a value that stays (Illinois)
        middle = low + (high - low) * (left / (left - right))
        _, v, a = points(which, middle[:, None])
        bend = (v.conj() * a).imag[:, 0]
        ahead = bend * left > 0.0
        left, right = np.where(ahead, bend, 0.5 * left), np.where(ahead, 0.5 * right, bend)
        low, high = np.where(ahead, middle, low), np.where(ahead, high, middle)
    whose, phi, at = _with(path, samples, i, middle)
    counts = np.bincount(whose, minlength=count)
    columns = np.minimum(np.arange(counts.max()), counts[:, None] - 1)
    place = (np.cumsum(counts) - counts)[:, None] + columns
    return phi[place], at[:, place]


def _with(path: LinkPath, samples: Samples, i: Whole, middle: Array) -> Samples:
    """Samples with one more after each of the i-th."""
    whose, phi, at = samples
    new = points(path.of(whose[i]), middle[:, None])[..., 0]
    return (
        np.insert(whose, i + 1, whose[i]),
        np.insert(phi, i + 1, middle),
        np.insert(at, i + 1, new, axis=1),
    )


def _bends(phi: Array, at: Complex) -> Mask:
    """True where the rates at two samples do not predict the turn between them."""
    turned = np.angle(at[1, 1:] * at[1, :-1].conj())
    half, rate = 0.5 * np.diff(phi), turning_rate(at)
    left, right = rate[:-1], rate[1:]
    # radians; an arc turns by less than a pair for three slots does, which is pi/3
    wrong = (np.abs(turned - half * (left + right)) > 0.05) | (np.abs(turned) > 1.0)
    # the tangent may turn back and forth
    wrong |= (left * right > 0.0) & (left * (turned - half * (left + right) / 1.5) < 0.0)
    # Rates that differ this much belong to a sharp bend, whose turn they predict by chance only.
    bends: Mask = wrong | (half * np.abs(right - left) > 0.25)  # radians
    return bends


def pairs(path: LinkPath, samples: tuple[Array, Complex], b: Array) -> Pairs:
    """All pairs of designs with half index angles b, (n, 1), from samples of their paths."""
    starts = [_starts(*samples, b, sense) for sense in (1.0, -1.0)]
    which, sense, phi, low, wide = (np.concatenate(both) for both in zip(*starts, strict=True))
    return _solved(path, Pairs(which, phi, sense), low, wide, b)


def _starts(
    phi: Array, at: Complex, b: Array, sense: float
) -> tuple[Whole, Array, Array, Array, Array]:
    """Starts of Newton's method for a sense of the wheel: designs, sense, angles, their arcs."""
    (p, v, _), turn, width = at, turning_rate(at), np.diff(phi)
    lean, tangent = 0.5 * math.pi - b, v / np.abs(v)
    # The tangent turns against the wheel: the lines' angles rise along the arcs that can be used.
    turned = np.angle(v[:, 1:] * v[:, :-1].conj())
    angle = -sense * np.pad(np.cumsum(turned, axis=1), ((0, 0), (1, 0)))
    # Near a sharp bend all lines pass one point. Measured from there their offsets are small.
    origin = np.take_along_axis(p, np.abs(turn).argmax(axis=1)[:, None], axis=1)
    sides = []
    for side in (-sense, sense):  # an arc: its angles, and their slopes; its offsets and theirs
        off = (p - origin) * (tangent * np.exp(1j * side * lean)).conj()
        slope = -np.abs(v) * np.sin(side * lean) - turn * off.real
        rows: list[Array] = []
        for value, by_phi in ((angle, -sense * turn), (off.imag, slope)):
            rows += [value[:, :-1], value[:, 1:], width * by_phi[:, :-1], width * by_phi[:, 1:]]
        sides.append(np.stack([part.ravel() for part in rows]))
    # Entries and exits after them whose lines have an angle in common, in this turn or the next.
    rising = np.diff(angle) > 0.0
    usable = np.argsort(~rising, axis=1, kind="stable")[:, : rising.sum(axis=1).max(initial=0)]
    low, high = (np.take_along_axis(ends, usable, 1) for ends in (angle[:, :-1], angle[:, 1:]))
    low[high <= low] = np.nan
    later = np.tri(low.shape[1], k=-1) * (angle[:, -1:] - angle[:, :1])[:, None]
    later -= 2.0 * lean[:, None]
    # with inflections at both ends the arcs touch: a double root
    high += SAME_ENTRY
    may = (low[:, None] + later < high[:, :, None]) & (high[:, None] + later > low[:, :, None])
    row, i, j = np.nonzero(may)
    first, last = (row * width.shape[1] + usable[row, k] for k in (i, j))
    entry, exit_ = sides[0].take(first, axis=1), sides[1].take(last, axis=1)
    exit_[:2] += later[row, i, j]
    # both ends of the angles that they have in common: the difference of offsets, and its slope
    ends = []
    for end in (0, 1):
        inner = (exit_[0] > entry[0]) if end == 0 else (exit_[1] < entry[1])
        common = np.where(inner, exit_[end], entry[end])
        place = _inverse(np.where(inner, entry[:4], exit_[:4]), common)
        values = []
        for arcs, x in (entry, np.where(inner, place, end)), (exit_, np.where(inner, end, place)):
            (_, turns), (offset, slope) = _cubic(arcs[:4], x), _cubic(arcs[4:], x)
            values.append((offset, slope / turns))
        (one, slope), (two, other) = values
        ends.append((common, one - two, slope - other))
    (low, gap, slope), (high, last_gap, last_slope) = ends
    span = high - low
    once = gap * last_gap <= 0.0
    # the difference may change its sign twice, or the cubics' error may hide a pair near an end
    error = CUBIC_ERROR * (np.abs(entry[5] - entry[4]) + np.abs(exit_[5] - exit_[4]))
    twice = (gap * (gap + slope * span / 3.0) < 0.0) & ~once
    twice |= (last_gap * (last_gap - last_slope * span / 3.0) < 0.0) & ~once
    chord = span * np.nan_to_num(gap / (gap - last_gap))
    begin, stop = twice | (np.abs(gap) < error), twice | (np.abs(last_gap) < error)
    starts = ((once, low + chord), (begin, low), (stop, high))
    cells = np.concatenate([np.flatnonzero(where) for where, _ in starts])
    angles = np.concatenate([common[where] for where, common in starts])
    place = np.stack([_inverse(arcs[:4, cells], angles) for arcs in (entry, exit_)], axis=1)
    pairs_of = np.stack((first[cells], last[cells]), axis=1)
    begins, wide = phi[:, :-1].ravel()[pairs_of], width.ravel()[pairs_of]
    return row[cells], np.full(len(cells), sense), begins + place * wide, begins, wide


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


class Residual(NamedTuple):
    """Residuals of both conditions of pairs, with slopes, determinant and Newton's step (n, 2).

    ``away`` is the chord's component across the sum of the tangents, and ``excess`` the error of
    the index angle, which turns with the tangents.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array
    step: Array
    double: Mask  # two roots are nearly one: a step towards them would only be rounding


def residual(at: Complex, b: Array, sense: Array) -> Residual:
    """Residuals of pairs with half index angles b, (n,), from their points (3, n, 2)."""
    (p, q), (v, w), (turn, turn_out) = at[0].T, at[1].T, turning_rate(at).T
    t, u = v / np.abs(v), w / np.abs(w)
    chord, both = q - p, (t + u).conj()
    away = (chord * both).imag
    by_entry = (chord * (1j * turn * t).conj() - v * both).imag
    by_exit = (w * both + chord * (1j * turn_out * u).conj()).imag
    excess = np.angle(-u * t.conj() * np.exp(-2j * sense * b))
    det = by_entry * turn_out + by_exit * turn
    step = (excess * by_exit - away * turn_out, -excess * by_entry - away * turn)
    double = np.abs(det) < DOUBLE_ROOT_SLOPE * np.abs(by_exit)
    return Residual(away, by_entry, by_exit, excess, det, (np.stack(step) / det).T, double)


def _solved(path: LinkPath, starts: Pairs, low: Array, wide: Array, b: Array) -> Pairs:
    """Pairs to which Newton's method leads from places in arcs, which begin at ``low``."""
    (which, phi, sense), n = starts, len(low)
    (good, flat), excess, live = np.zeros((2, n), dtype=bool), np.zeros(n), np.arange(n)
    for _ in range(24):  # towards a double root each step halves the error
        rest = residual(points(path.of(which[live]), phi[live]), b[which[live], 0], sense[live])
        move, arc = rest.step, wide[live]
        move = move * np.minimum(1.0, (arc / np.abs(move)).min(axis=1))[:, None]
        phi[live] += move
        near = (np.abs((phi[live] - low[live]) / arc - 0.5) < 4.0).all(axis=1)
        done = near & (np.abs(move).max(axis=1) < 1e-9)  # radians: the next step is rounding
        good[live], flat[live] = done & ~rest.double, done & rest.double
        excess[live] = rest.excess
        live = live[near & ~done]
        if not len(live):
            break
    flat[live] = np.abs(excess[live]) < 1e-5  # radians; with more it is not a double root
    every = [Pairs(which[good], phi[good], sense[good])]
    if flat.any():
        every.append(_double(path, which[flat], phi[flat], sense[flat], b))
    which, phi, sense = (np.concatenate(parts) for parts in zip(*every, strict=True))
    phi = phi % math.tau
    phi[:, 1] += math.tau * (phi[:, 1] < phi[:, 0])
    key = 8.0 * which + phi[:, 0]  # by designs and entries: a turn is less than 8 radians
    order = np.argsort(key, kind="stable")
    order = order[np.append(True, np.diff(key[order]) > SAME_ENTRY)[: len(order)]]
    return Pairs(which[order], phi[order], sense[order])


def _double(path: LinkPath, which: Whole, start: Array, sense: Array, b: Array) -> Pairs:
    """Pairs near these at which the index angle is stationary, if it is the wheel's there."""
    h = 1e-5  # radians: the slope of ``det`` needs few digits
    some, half, phi = path.of(which), b[which, 0], start
    for _ in range(12):
        rest, by_entry, by_exit = (
            residual(points(some, phi + step), half, sense) for step in ((0, 0), (h, 0), (0, h))
        )
        slopes = (by_entry.det - rest.det) / h, (by_exit.det - rest.det) / h
        det = rest.by_entry * slopes[1] - rest.by_exit * slopes[0]
        one = rest.det * rest.by_exit - rest.away * slopes[1]
        two = rest.away * slopes[0] - rest.det * rest.by_entry
        move = (np.stack((one, two)) / det).T
        phi = phi + move
    settled = (np.abs(move) < 1e-9).all(axis=1) & (np.abs(phi - start) < 0.05).all(axis=1)
    settled &= np.abs(rest.excess) < 1e-12
    return Pairs(which[settled], phi[settled], sense[settled])
