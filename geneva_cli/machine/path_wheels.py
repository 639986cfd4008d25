"""The wheels that roller paths can drive: of pairs of places those whose roller keeps to its slot.

From entry to exit the roller turns the wheel one way and is nearer to its centre than at both; on
the way back it is farther. Both are quantities of which samples of the path have values and
slopes, and hold all along where the cubics through these have no coefficient (Bernstein) of the
other sign; elsewhere it is looked at more closely.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.path_pairs import FLAT, Pairs, pairs, residual
from geneva_cli.machine.path_samples import PathPoints, PathSamples, blocks, joined, points, sampled
from geneva_cli.machine.roller_path import RollerPath

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Complex, Mask, Number, Which, Whole

THIRD = 1.0 / 3.0
SAME = 1e-6  # radians: entries nearer to each other are one
BESIDE = 1e-4  # radians: places in doubt that are nearer to each other lead to one wheel
ROUNDING = 1e-9  # share of its greatest by which a quantity may be below zero where it is zero
CLOSER = 8  # parts into which an interval is cut that is looked at more closely
LOOKS = 4  # times that it is
PLACES = 16  # intervals in which a peak is looked for
NEARER = 12  # times that the look is narrowed, to the three about the greatest
HIGHER = 0.5  # of the bend at the greatest place: a parabola rises above it by an eighth at most
BLOCK = 256  # wheels at a time: they stay in the processor's cache
TIE = 1e-8  # share by which two wheels' peak velocities may differ and be the same


class Wheels(NamedTuple):
    """Wheels of designs ``which``: the crank's angles at entry and exit in two columns, and the
    sense in which they turn on the path's own axes.
    """

    which: Whole
    phi: Array
    sense: Array

    def taken(self, where: Which) -> Wheels:
        """Some of the wheels."""
        return Wheels._make(part[where] for part in self)


class Search(NamedTuple):
    """The wheels of designs; and pairs where a double root, or all but one, may be."""

    wheels: Wheels
    doubtful: Pairs


class _Course(NamedTuple):
    """What must be above zero, with its slope: the pin's moment about the wheel's centre, and the
    square of its distance from the centre, short of that at entry.
    """

    moment: Array
    moment_slope: Array
    short: Array
    short_slope: Array


class _Wheel(NamedTuple):
    """Centres and senses, in a column."""

    centre: Complex
    square: Array  # of the distance of entry and exit
    sense: Array

    def course(self, at: PathPoints) -> _Course:
        """At places of the path, a row a wheel."""
        ray = (at.p - self.centre).conj()
        moment, slope = (self.sense * (ray * x).imag for x in (at.v, at.a))
        short = self.square - (ray.real**2 + ray.imag**2)
        return _Course(moment, slope, short, -2.0 * (ray * at.v).real)

    def taken(self, where: Which) -> _Wheel:
        return _Wheel._make(part[where] for part in self)


def wheels(path: RollerPath, b: Array) -> Search:
    """All wheels of designs of half an index angle b, (n, 1)."""
    found = []
    with np.errstate(all="ignore"):
        every = list(sampled(path, len(b)))
        ends, doubtful = pairs(path, every, b)
        ends = ends.taken(_firsts(ends))
        rest = residual(ends, b)
        steep = np.abs(rest.det) >= FLAT * np.abs(rest.by_exit)
        doubtful = joined([doubtful, ends.taken(~steep)])
        # A path that stops has no direction there; boxes about it are of no place at all.
        doubtful = doubtful.taken(np.flatnonzero(np.isfinite(doubtful.at.phi).all(axis=1)))
        doubtful = doubtful.taken(_firsts(doubtful, BESIDE))
        ends, sense = ends.taken(steep), rest.sense[steep]
        block = np.zeros(len(b), dtype=int)
        for i, samples in enumerate(every):
            block[samples.which] = i
        for i, samples in enumerate(every):
            mine = block[ends.which] == i
            found.append(_followed(path, samples, ends.taken(mine), sense[mine]))
    return Search(joined(found), doubtful)


def followed(path: RollerPath, phi: Array, sense: Array) -> Wheels:
    """Of wheels of one path, entered and left at ``phi``, (n, 2), those that it can drive."""
    with np.errstate(all="ignore"):
        ends = Pairs(np.zeros(len(phi), dtype=int), points(path, phi))
        return _followed(path, next(sampled(path, 1)), ends, sense)


def _firsts(ends: Pairs, same: float = SAME) -> Whole:
    """Of pairs that are one, the first."""
    place = ends.at.phi[:, 0] % math.tau
    order = np.lexsort((place, ends.which))
    new = np.ones(len(order), dtype=bool)
    new[1:] = (np.diff(ends.which[order]) != 0) | (np.diff(place[order]) > same)
    return order[new]


def _followed(path: RollerPath, samples: PathSamples, ends: Pairs, sense: Array) -> Wheels:
    """The wheels of those pairs between which the roller keeps to its slot."""
    (p, q), (t, u) = ends.at.p.T, ends.at.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    centre = 0.5 * ((p + rho * t) + (q - rho * u))
    wheel = _Wheel._make(x[:, None] for x in (centre, rho * rho, sense))
    number = np.zeros(int(samples.which.max(initial=0)) + 1, dtype=int)
    number[samples.which] = np.arange(len(samples.which))
    at = samples.at.taken((number[ends.which], slice(0, -1)))
    entry, motion = ends.at.phi[:, :1], np.diff(ends.at.phi, axis=1)
    since = (at.phi - entry) % math.tau
    course = wheel.course(at)
    inside = since < motion
    good = np.where(inside, (course.moment > 0.0) & (course.short > 0.0), course.short < 0.0)
    good |= (np.abs(since - motion) < SAME) | (since < SAME) | (since > math.tau - SAME)
    kept = np.flatnonzero(good.all(axis=1))
    # the ends among the samples, and the entry again a turn later
    wheel, ends, since, motion = wheel.taken(kept), ends.taken(kept), since[kept], motion[kept]
    limits = wheel.course(ends.at)
    limits = limits._replace(moment=0.0 * limits.moment, short=0.0 * limits.short)
    since = np.hstack((since, 0.0 * motion, motion, 0.0 * motion + math.tau))
    order = np.argsort(since, axis=1)
    nodes = np.take_along_axis(since, order, axis=1)
    full = _Course(
        *(
            np.take_along_axis(np.hstack((x[kept], y, y[:, :1])), order, axis=1)
            for x, y in zip(course, limits, strict=True)
        )
    )
    fails = _fails(path, wheel, ends, nodes, full, motion)
    return Wheels(ends.which[~fails], ends.at.phi[~fails], wheel.sense[~fails, 0])


def _fails(
    path: RollerPath, wheel: _Wheel, ends: Pairs, nodes: Array, course: _Course, motion: Array
) -> Mask:
    """Whether the roller leaves its slot between samples ``nodes`` since entry, a row a wheel."""
    bar = [ROUNDING * np.abs(x).max(axis=1) for x in (course.moment, course.short)]
    fails = np.zeros(len(nodes), dtype=bool)
    inside = nodes[:, :-1] < motion
    row, column = np.nonzero(_open(nodes, course, inside, *(x[:, None] for x in bar)))
    left, right, inside = nodes[row, column], nodes[row, column + 1], inside[row, column]
    for _ in range(LOOKS):
        if not len(row):
            break
        share = np.arange(CLOSER + 1) / CLOSER
        places = left[:, None] + (right - left)[:, None] * share
        phi = places + ends.at.phi[row, :1]
        some = wheel.taken(row).course(points(path.roughly(ends.which[row]), phi))
        low, far = (x[row, None] for x in bar)
        wrong = np.where(
            inside[:, None], (some.moment < -low) | (some.short < -far), some.short > far
        )
        fails[row[wrong.any(axis=1)]] = True
        i, j = np.nonzero(_open(places, some, inside[:, None], low, far) & ~fails[row][:, None])
        row, left, right, inside = row[i], places[i, j], places[i, j + 1], inside[i]
    return fails


def _open(places: Array, course: _Course, inside: Mask, low: Array, far: Array) -> Mask:
    """Intervals in which cubics do not show that all is well."""
    width = np.diff(places, axis=1)
    sign = np.where(inside, 1.0, -1.0)
    short = _least(width, course.short, course.short_slope, sign) < -far
    return short | (inside & (_least(width, course.moment, course.moment_slope, 1.0) < -low))


def _least(width: Array, value: Array, slope: Array, sign: Number) -> Array:
    """The least coefficient of a cubic between neighbours."""
    a, c = value[:, :-1], value[:, 1:]
    b, d = a + THIRD * width * slope[:, :-1], c - THIRD * width * slope[:, 1:]
    least: Array = np.minimum.reduce([sign * x for x in (a, b, c, d)])
    return least


def chosen(path: RollerPath, found: Wheels, wanted: Number | None = None) -> Whole:
    """The numbers of the wheels that are taken, one of each design that has any, in their order.

    The gentlest, which has the least peak velocity, or the one entered nearest to ``wanted``
    (radians, of all designs (n, 1)). Of equal ones, as those of a path that is its own mirror
    image, the one entered first.
    """
    which = found.which
    cost = np.zeros(len(which))
    several = np.flatnonzero(np.bincount(which, minlength=1)[which] > 1)
    some = found.taken(several)
    if wanted is not None:
        goal = np.ravel(wanted)
        off = some.phi[:, 0] - (goal[some.which] if len(goal) > 1 else goal)
        cost[several] = np.abs(off - math.tau * np.round(off / math.tau))
    elif len(several):
        cost[several] = _peaks(path, some)
    least = np.full(int(which.max(initial=-1)) + 1, np.inf)
    np.minimum.at(least, which, cost)
    tied = np.flatnonzero(cost <= least[which] * (1.0 + TIE))
    order = tied[np.lexsort((found.phi[tied, 0] % math.tau, which[tied]))]
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(which[order]) != 0
    return order[first]


def _peaks(path: RollerPath, found: Wheels) -> Array:
    """The peak velocities of several wheels a design, as near as it takes to know the least.

    Each is looked at at a few places, which bound its peak. Wheels whose bounds leave open which
    of a design's is the least are looked at nearer.
    """
    known = _velocities(path, found)
    open_ = _open_peaks(found.which, known)
    for _ in range(NEARER):
        if not len(open_):
            break
        near = _velocities(path, found.taken(open_), known.beside[open_])
        near = near._replace(most=np.minimum(near.most, known.most[open_]))
        for all_, some in zip(known, near, strict=True):
            all_[open_] = some
        open_ = _open_peaks(found.which, known)
    return known.least


def _open_peaks(which: Whole, known: _Velocities) -> Whole:
    """The wheels that may be the least of their design's, where another may be so too."""
    bar = np.full(int(which.max()) + 1, np.inf)
    np.minimum.at(bar, which, known.most)
    may = known.least <= bar[which] * (1.0 + TIE)
    rivals = np.bincount(which[may], minlength=len(bar))[which] > 1
    return np.flatnonzero(may & rivals & (known.most - known.least > 1e-3 * TIE * known.least))


class _Velocities(NamedTuple):
    """Bounds of peak velocities, and the crank's angles between which the peaks are."""

    least: Array
    most: Array
    beside: Array


def _velocities(path: RollerPath, found: Wheels, between: Array | None = None) -> _Velocities:
    """Peak velocities between crank angles, (n, 2), from entry to exit without."""
    between = found.phi if between is None else between
    looked: _Velocities = joined(
        [
            _looked(path.roughly(found.which[i]), found.phi[i], between[i])
            for i in blocks(len(between), BLOCK)
        ]
    )
    return looked


def _looked(path: RollerPath, phi: Array, between: Array) -> _Velocities:
    """Peak velocities of a block of wheels, each with its path."""
    ends = points(path, phi)
    (p, q), (t, u) = ends.p.T, ends.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    centre = (0.5 * ((p + rho * t) + (q - rho * u)))[:, None]
    low, high = between[:, :1], between[:, 1:]
    phi = low + (high - low) * (np.arange(PLACES + 1) / PLACES)
    x, y = path.at(phi, 1)
    ray = x.c[0] + 1j * y.c[0] - centre
    velocity = np.abs(((x.c[1] + 1j * y.c[1]) / ray).imag)
    # what the wheel turns between two places, over the crank's turn, is no more than the peak
    mean = np.abs(np.angle(ray[:, 1:] * ray[:, :-1].conj())) / np.diff(phi, axis=1)
    steepest = np.maximum(mean, np.maximum(velocity[:, :-1], velocity[:, 1:]))
    i = steepest.argmax(axis=1)[:, None]
    sides = np.hstack((np.maximum(i - 1, 0), np.minimum(i + 2, PLACES)))
    j = velocity.argmax(axis=1)[:, None]
    beside = np.hstack((np.maximum(j - 1, 0), np.minimum(j + 1, PLACES)))
    top, least = velocity.max(axis=1), steepest.max(axis=1)
    bend = 2.0 * top - np.take_along_axis(velocity, beside, axis=1).sum(axis=1)
    most = np.where(least > top, np.inf, top + HIGHER * bend)
    return _Velocities(least, most, np.take_along_axis(phi, sides, axis=1))
