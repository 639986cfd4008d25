"""Choice among the wheels that a roller path can drive: the gentlest, or the requested one.

The gentlest has the least peak velocity. The samples of each wheel give bounds of its peak.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.paths.course import PathWheels
from geneva_cli.drives.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Number, Whole, blocks, joined

SAME_PEAK = 1e-8  # fraction by which two wheels' peak velocities may differ and count as equal


def chosen(path: RollerPath, wheels: PathWheels, wanted: Number | None = None) -> Whole:
    """Numbers of the chosen wheels, one for each design that has any, in the order of the designs.

    Without ``wanted`` the chosen wheel is the gentlest, with the least peak velocity. ``wanted`` is
    an entry angle in radians, (n, 1) for n designs: then it is the wheel with the nearest entry.
    Among equal wheels, as on a symmetric path, it is the one with the first entry.
    """
    which = wheels.which
    cost = np.zeros(len(which))
    several = np.flatnonzero(np.bincount(which, minlength=1)[which] > 1)
    some = wheels.taken(several)
    if wanted is not None:
        goal = np.ravel(wanted)
        off = some.phi[:, 0] - (goal[some.which] if len(goal) > 1 else goal)
        cost[several] = np.abs(off - math.tau * np.round(off / math.tau))
    elif len(several):
        cost[several] = _peaks(path, some)
    least = np.full(int(which.max(initial=-1)) + 1, np.inf)
    np.minimum.at(least, which, cost)
    tied = np.flatnonzero(cost <= least[which] * (1.0 + SAME_PEAK))
    order = tied[np.lexsort((wheels.phi[tied, 0] % math.tau, which[tied]))]
    first = np.ones(len(order), dtype=bool)
    first[1:] = np.diff(which[order]) != 0
    return order[first]


def _peaks(path: RollerPath, wheels: PathWheels) -> Array:
    """Peak velocities of several wheels per design, accurate enough to know the least.

    If their bounds do not decide which wheel has the least peak, those wheels are sampled more
    closely.
    """
    known = _Velocities(wheels.least.copy(), wheels.most.copy(), wheels.phi.copy())
    open_ = _open_peaks(wheels.which, known)
    # Intervals: many of the whole motion, which may have several peaks; then eight about the
    # greatest velocity, of which each round leaves three. Rounding spoils means over a millionth.
    for count in (64, *[8] * 9):
        if not len(open_):
            break
        near = _velocities(path, wheels.taken(open_), known.bracket[open_], count)
        near = near._replace(least=np.maximum(near.least, known.least[open_]))
        near = near._replace(most=np.minimum(near.most, known.most[open_]))
        for all_, some in zip(known, near, strict=True):
            all_[open_] = some
        open_ = _open_peaks(wheels.which, known)
    return known.least


def _open_peaks(which: Whole, known: _Velocities) -> Whole:
    """Wheels that may have the least peak of their design, if another wheel may have it too."""
    bar = np.full(int(which.max()) + 1, np.inf)
    np.minimum.at(bar, which, known.most)
    may = known.least <= bar[which] * (1.0 + SAME_PEAK)
    rivals = np.bincount(which[may], minlength=len(bar))[which] > 1
    wide = known.most - known.least > 1e-3 * SAME_PEAK * known.least
    return np.flatnonzero(may & rivals & wide)


class _Velocities(NamedTuple):
    """Bounds of peak velocities, and the crank angles between which the peaks are."""

    least: Array
    most: Array
    bracket: Array


def _velocities(path: RollerPath, wheels: PathWheels, between: Array, count: int) -> _Velocities:
    """Peak velocities between crank angles (n, 2), by samples of ``count`` intervals."""
    parts = blocks(len(between), 256)  # 256 wheels stay in the processor's cache
    return joined([_block_velocities(path, wheels.taken(i), between[i], count) for i in parts], 0)


def _block_velocities(
    path: RollerPath, wheels: PathWheels, between: Array, count: int
) -> _Velocities:
    """Peak velocities of a block of wheels."""
    low, high = between[:, :1], between[:, 1:]
    phi = low + (high - low) * (np.arange(count + 1) / count)
    x, y = path.roughly(wheels.which).at(phi, 1)
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
    return _Velocities(least, most, np.take_along_axis(phi, sides, axis=1))
