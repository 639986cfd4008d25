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
from geneva_cli.numerics.arrays import Array, Complex, Mask, Which, Whole, joined
from geneva_cli.numerics.extremes import Smooth, search
from geneva_cli.numerics.jet import turning
from geneva_cli.numerics.tolerances import ROUNDED

SAME_PEAK = 1e-8  # fraction by which two wheels' peak velocities may differ and count as equal


class PathWheels(NamedTuple):
    """Wheels of designs: (wheels,)."""

    which: Whole
    phi: Array  # crank angles at entry and exit, in two columns
    sense: Array  # 1 if the wheel turns counterclockwise on the path's axes, or -1
    centre: Complex  # mm, on the path's axes
    square: Array  # squared distance from the centre to entry and exit, mm²

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
    empty = PathWheels(none.astype(int), np.empty((0, 2)), none, none.astype(complex), none)
    return joined([empty, *(_block(path, *part) for part in parts)], 0)


def _block(path: LinkPath, samples: PathSamples, found: Pairs) -> PathWheels:
    """Wheels of the pairs of a block of samples."""
    ends = points(path.of(found.which), found.phi)
    (p, q), (t, u) = ends.p.T, ends.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    wheels = PathWheels(*found, 0.5 * ((p + rho * t) + (q - rho * u)), rho * rho)
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
    """True for intervals in which a Bernstein coefficient has the wrong sign."""
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
    """True for each wheel whose roller leaves its slot in an open interval, since entry."""
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
    """Peak velocities of the wheels of designs that have several; 0 of the others."""
    which, peaks = wheels.which, np.zeros(len(wheels.which))
    open_ = np.flatnonzero(np.bincount(which)[which] > 1)

    def velocity(phi: Array, some: Which, _: int, __: Sequence[int]) -> list[tuple[Array, ...]]:
        of = open_[some]
        x, y = path.of(which[of]).at(phi, 3)
        centre = wheels.centre[of, None]
        return [turning(x - centre.real, y - centre.imag).arrays()]

    if len(open_):
        ends = wheels.phi[open_, :1], wheels.phi[open_, 1:]
        peaks[open_] = search(Smooth(velocity, 1), [ends], sized=True).most[0]
    return peaks
