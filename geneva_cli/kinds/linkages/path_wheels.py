"""Wheels that roller paths can drive, and the choice among those of one path.

A pair of entry and exit gives the wheel's centre. From entry to exit the roller must turn the wheel
one way, nearer to its centre than at both ends; on the way back it must be farther away. Samples of
the path give both quantities with their slopes. A condition holds between two samples if no
Bernstein coefficient of the cubic through them has the wrong sign. Otherwise the interval is
sampled more closely.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.kinds.linkages.tangent_pairs import (
    SAME_ENTRY,
    Pairs,
    PathSamples,
    pairs,
    points,
    sampled,
    taken,
)
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, blocks, joined
from geneva_cli.numerics.tolerances import ROUNDED

SAME_PEAK = 1e-8  # fraction by which two wheels' peak velocities may differ and count as equal


class PathWheels(NamedTuple):
    """Wheels of designs: (wheels,). The peak velocity is between ``least`` and ``most``."""

    which: Whole
    phi: Array  # crank angles at entry and exit, in two columns
    sense: Array  # 1 if the wheel turns counterclockwise on the path's axes, or -1
    centre: Complex  # mm, on the path's axes
    square: Array  # squared distance from the centre to entry and exit, mm²
    least: Array
    most: Array

    def course(self, p: Complex, v: Complex, a: Complex) -> tuple[Array, Array, Array, Array]:
        """Two quantities, each with its slope by the crank's angle, at places (wheels, n).

        The moment of the pin's velocity about the centre must be positive from entry to exit, and
        the squared distance at entry less the pin's own there alone. Lengths are in mm.
        """
        ray, sense = (p - self.centre[:, None]).conj(), self.sense[:, None]
        along = ray * v
        short = self.square[:, None] - (ray.real**2 + ray.imag**2)
        return sense * along.imag, sense * (ray * a).imag, short, -2.0 * along.real


def solved_wheels(path: LinkPath, b: Array) -> PathWheels:
    """All wheels of designs with half index angles b, (n, 1)."""
    with np.errstate(all="ignore"):
        samples = list(sampled(path, len(b)))
        found = pairs(path, samples, b)
        parts = [taken(found, np.isin(found.which, some.which)) for some in samples]
        return driven(path, zip(samples, parts, strict=True))


def driven(path: LinkPath, parts: Iterable[tuple[PathSamples, Pairs]]) -> PathWheels:
    """The wheels among pairs whose roller stays in its slot, by blocks of samples."""
    none = np.empty(0)
    empty = PathWheels(
        none.astype(int), np.empty((0, 2)), none, none.astype(complex), none, none, none
    )
    return joined([empty, *(_block(path, *part) for part in parts)], 0)


def _block(path: LinkPath, samples: PathSamples, found: Pairs) -> PathWheels:
    """Wheels of the pairs of a block of samples."""
    ends = points(path.of(found.which), found.phi)
    (p, q), (t, u) = ends.p.T, ends.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    centre, unknown = 0.5 * ((p + rho * t) + (q - rho * u)), np.zeros(len(rho))
    wheels = PathWheels(*found, centre, rho * rho, unknown, unknown)
    row, motion = np.searchsorted(samples.which, found.which), np.diff(found.phi)
    # in order: entry, the samples with the exit among them, and the entry a turn later
    since = (samples.at.phi[row, :-1] - found.phi[:, :1]) % math.tau
    since = np.hstack((0.0 * motion, since, motion, 0.0 * motion + math.tau))
    order = np.argsort(since, axis=1)
    place = np.take_along_axis(since, order, axis=1)
    nodes = (
        np.take_along_axis(
            np.hstack((own[:, :1], all_[row, :-1], own[:, 1:], own[:, :1])), order, 1
        )
        for own, all_ in zip(ends[1:4], samples.at[1:4], strict=True)
    )
    course = wheels.course(*nodes)
    inside, third = place[:, :-1] < motion, np.diff(place) / 3.0
    end = np.abs(place - motion) < SAME_ENTRY
    end |= np.abs(place - math.pi) > math.pi - SAME_ENTRY
    for x in (course[0], course[2]):
        x[end] = 0.0  # without the rounding
    moment, short = course[0][:, :-1], course[2][:, :-1]
    right = np.where(inside, (moment >= 0.0) & (short >= 0.0), short <= 0.0)
    good = np.all(right, axis=1)
    moments, shorts = _bernstein(third, *course[:2]), _bernstein(third, *course[2:])
    # A quotient of cubics is between the quotients of their Bernstein coefficients.
    square = wheels.square[:, None]
    least = most = moments[0] / (square - shorts[0])
    for one, other in zip(moments[1:3], shorts[1:3], strict=True):
        most = np.maximum(most, np.where(square > other, one / (square - other), np.inf))
    least, most = (np.where(inside, x, 0.0).max(axis=1) for x in (least, most))
    wheels = wheels._replace(least=least, most=most)
    rounding = [ROUNDED * np.abs(x).max(axis=1)[:, None] for x in (course[0], course[2])]
    i, j = np.nonzero(_open(moments, shorts, inside, *rounding) & good[:, None])
    between = place[i, j, None], place[i, j + 1, None]
    return taken(wheels, good & ~_leaves(path, wheels, i, between, inside[i, j, None], rounding))


def _bernstein(third: Array, value: Array, slope: Array) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients of cubics between adjacent columns, and a third of their width."""
    a, d = value[:, :-1], value[:, 1:]
    return a, a + third * slope[:, :-1], d - third * slope[:, 1:], d


def _open(
    moments: Sequence[Array], shorts: Sequence[Array], inside: Mask, low: Array, far: Array
) -> Mask:
    """True for intervals in which a Bernstein coefficient has the wrong sign.

    ``low`` and ``far`` are the rounding of moments and squared distances.
    """
    open_ = np.where(inside, np.minimum(*shorts[1:3]), -np.maximum(*shorts[1:3])) < -far
    open_ |= inside & (np.minimum(*moments[1:3]) < -low)
    return open_


def _leaves(
    path: LinkPath,
    wheels: PathWheels,
    wheel: Whole,
    between: tuple[Array, Array],
    inside: Mask,
    rounding: Sequence[Array],
) -> Mask:
    """True for each wheel whose roller leaves its slot in an open interval, since entry.

    ``rounding`` is that of the wheels' moments and squared distances.
    """
    fails = np.zeros(len(wheels.which), dtype=bool)
    for _ in range(4):  # each round cuts an open interval into eight
        if not len(wheel):
            break
        left, right = between
        place = left + (right - left) * (np.arange(9) / 8)
        some = taken(wheels, wheel)
        at = points(path.of(some.which), place + some.phi[:, :1])
        moment, by_phi, short, slope = some.course(at.p, at.v, at.a)
        least, most = (x[wheel] for x in rounding)
        wrong = np.where(inside, (moment < -least) | (short < -most), short > most)
        fails[wheel[wrong.any(axis=1)]] = True
        third = np.diff(place) / 3.0
        moments, shorts = _bernstein(third, moment, by_phi), _bernstein(third, short, slope)
        i, j = np.nonzero(_open(moments, shorts, inside, least, most) & ~fails[wheel][:, None])
        between, wheel, inside = (place[i, j, None], place[i, j + 1, None]), wheel[i], inside[i]
    return fails


def chosen(path: LinkPath, wheels: PathWheels, wanted: Array | None = None) -> PathWheels:
    """One wheel of each design that has any, in the order of the designs.

    Without ``wanted`` the chosen wheel is the gentlest, with the least peak velocity. ``wanted``
    are entry angles of all designs in radians, (n, 1): then it is the wheel with the nearest entry.
    Among equal wheels, as on a symmetric path, it is the one with the first entry.
    """
    which, entry = wheels.which, wheels.phi[:, 0]
    if wanted is None:
        cost = _peaks(path, wheels)
    else:
        off = entry - wanted[which, 0]
        cost = np.abs(off - math.tau * np.round(off / math.tau))
    least = np.full(int(which.max(initial=-1)) + 1, np.inf)
    np.minimum.at(least, which, cost)
    tied = np.flatnonzero(cost <= least[which] * (1.0 + SAME_PEAK))
    order = tied[np.lexsort((entry[tied] % math.tau, which[tied]))]
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(which[order]) != 0
    return taken(wheels, order[first])


def _peaks(path: LinkPath, wheels: PathWheels) -> Array:
    """Peak velocities of wheels, accurate enough to know the least of each design.

    If their bounds do not decide which wheel has the least peak, those wheels are sampled more
    closely.
    """
    which, between = wheels.which, wheels.phi.copy()
    least, most = wheels.least.copy(), wheels.most.copy()
    # Intervals: many of the whole motion, which may have several peaks; then eight about the
    # greatest velocity, of which each round leaves three. Rounding spoils means over a millionth.
    for count in (64, *[8] * 9):
        bar = np.full(int(which.max(initial=-1)) + 1, np.inf)
        np.minimum.at(bar, which, most)
        may = least <= bar[which] * (1.0 + SAME_PEAK)
        rivals = np.bincount(which[may], minlength=len(bar))[which] > 1
        open_ = np.flatnonzero(may & rivals & (most - least > 1e-3 * SAME_PEAK * least))
        for part in blocks(len(open_), 256) if len(open_) else ():  # in the processor's cache
            i = open_[part]
            low, high, between[i] = _sampled_peaks(path, taken(wheels, i), between[i], count)
            least[i], most[i] = np.maximum(low, least[i]), np.minimum(high, most[i])
    return least


def _sampled_peaks(
    path: LinkPath, wheels: PathWheels, between: Array, count: int
) -> tuple[Array, Array, Array]:
    """Bounds of peak velocities between crank angles (n, 2), and closer angles of the peaks."""
    low, high = between[:, :1], between[:, 1:]
    phi = low + (high - low) * (np.arange(count + 1) / count)
    x, y = path.of(wheels.which).at(phi, 1)
    ray = x.c[0] + 1j * y.c[0] - wheels.centre[:, None]
    velocity = np.abs(((x.c[1] + 1j * y.c[1]) / ray).imag)
    # The mean velocity between two points is at most the peak.
    mean = np.abs(np.angle(ray[:, 1:] * ray[:, :-1].conj())) / np.diff(phi, axis=1)
    steepest = np.maximum(mean, np.maximum(velocity[:, :-1], velocity[:, 1:]))
    i = steepest.argmax(axis=1)[:, None]
    sides = np.hstack((np.maximum(i - 1, 0), np.minimum(i + 2, count)))
    j = velocity.argmax(axis=1)[:, None]
    neighbours = np.hstack((np.maximum(j - 1, 0), np.minimum(j + 1, count)))
    top, least = velocity.max(axis=1), steepest.max(axis=1)
    bend = 2.0 * top - np.take_along_axis(velocity, neighbours, axis=1).sum(axis=1)
    # A parabola rises above its greatest sample by an eighth of the bend at most; half is safe.
    most = np.where(least > top, np.inf, top + 0.5 * bend)
    return least, most, np.take_along_axis(phi, sides, axis=1)
