"""Wheels that roller paths can drive: the pairs of points whose roller stays in its slot.

A pair of points gives the wheel's centre. ``course`` checks that the roller enters at one
point, leaves at the other and stays outside the slot otherwise.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.kinematics.paths.course import PinCourse, PlacedWheel, leaves_slot, peak_bounds
from geneva_cli.kinematics.paths.pairs import DOUBLE_ROOT_SLOPE, EndPairs, newton, pairs, residual
from geneva_cli.kinematics.paths.samples import PathSamples, points, sampled
from geneva_cli.kinematics.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, blocks, joined

SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one


class PathWheels(NamedTuple):
    """Wheels of the designs numbered in ``which``.

    ``phi`` holds the crank angles at entry and exit in two columns. ``sense`` is the direction in
    which the wheel turns on the path's own axes. The peak velocity is between ``least`` and
    ``most``.
    """

    which: Whole
    phi: Array
    sense: Array
    least: Array
    most: Array

    def taken(self, where: Which) -> PathWheels:
        """Select some of the wheels."""
        return PathWheels._make(part[where] for part in self)


class WheelSearch(NamedTuple):
    """Wheels of designs, and pairs at which there may be a double or nearly double root."""

    wheels: PathWheels
    doubtful: EndPairs

    def of(self, i: int) -> WheelSearch:
        """Result for design ``i``, numbered as a single path."""
        parts = []
        for part in self:
            mine = part.taken(np.flatnonzero(part.which == i))
            parts.append(mine._replace(which=0 * mine.which))
        return WheelSearch._make(parts)


def wheels(path: RollerPath, b: Array) -> WheelSearch:
    """All wheels of designs with half index angles b, (n, 1).

    Those with entry or exit in a bend within 1e-5 radians of the crank may be missed.
    """
    kept = []
    with np.errstate(all="ignore"):
        every = list(sampled(path, len(b)))
        ends, doubtful = pairs(path, every, b)
        ends = ends.taken(_firsts(ends))
        rest = residual(ends, b)
        steep = np.abs(rest.det) >= DOUBLE_ROOT_SLOPE * np.abs(rest.by_exit)
        doubtful = doubtful.taken(~_lead_to(doubtful, ends.taken(steep), b))
        doubtful = joined([doubtful, ends.taken(~steep)], 0)
        # A path that stops has no direction there; boxes around such a point hold no pair.
        doubtful = doubtful.taken(np.flatnonzero(np.isfinite(doubtful.at.phi).all(axis=1)))
        # doubtful entries within 1e-4 radians lead to one wheel
        doubtful = doubtful.taken(_firsts(doubtful, 1e-4))
        ends, sense = ends.taken(steep), rest.sense[steep]
        block = np.zeros(len(b), dtype=int)
        for i, samples in enumerate(every):
            block[samples.which] = i
        for i, samples in enumerate(every):
            mine = block[ends.which] == i
            kept.append(_followed(path, samples, ends.taken(mine), sense[mine]))
    return WheelSearch(joined(kept, 0), doubtful)


def followed(path: RollerPath, phi: Array, sense: Array) -> PathWheels:
    """Wheels that a path can drive, among those with entry and exit angles ``phi`` (n, 2)."""
    with np.errstate(all="ignore"):
        ends = EndPairs(np.zeros(len(phi), dtype=int), points(path, phi))
        return _followed(path, next(sampled(path, 1)), ends, sense)


def _firsts(ends: EndPairs, same: float = SAME_ENTRY) -> Whole:
    """First of each group of equal pairs."""
    place = ends.at.phi[:, 0] % math.tau
    order = np.lexsort((place, ends.which))
    new = np.ones(len(order), dtype=bool)
    new[1:] = (np.diff(ends.which[order]) != 0) | (np.diff(place[order]) > same)
    return order[new]


def _lead_to(doubtful: EndPairs, ends: EndPairs, b: Array) -> Mask:
    """True for doubtful pairs that are next to one of the pairs, sorted by design and entry.

    A Newton step leads from them to it. So its slope does not vanish between them, and they are
    places of the same root, seen from an adjacent box.
    """
    near = np.zeros(len(doubtful.which), dtype=bool)
    if not (len(near) and len(ends.which)):
        return near
    at = doubtful.at.phi
    aim = at + newton(doubtful, residual(doubtful, b))
    own, others = (
        which + phi[:, 0] % math.tau / math.tau
        for which, phi in ((doubtful.which, aim), (ends.which, ends.at.phi))
    )
    after = np.searchsorted(others, own)
    for i in (after - 1, np.minimum(after, len(others) - 1)):
        off, far = (_apart(phi, ends.at.phi[i]) for phi in (aim, at))
        # the step is linear to a tenth, and rounding in a place of the path below 1e-9 radians
        near |= (ends.which[i] == doubtful.which) & (off <= 0.1 * far + 1e-9)
    return near


def _apart(phi: Array, others: Array) -> Array:
    """Distance of pairs of crank angles, whatever their turn."""
    off = phi - others
    distance: Array = np.abs(off - math.tau * np.round(off / math.tau)).max(axis=1)
    return distance


def _followed(path: RollerPath, samples: PathSamples, ends: EndPairs, sense: Array) -> PathWheels:
    """Wheels of the pairs between which the roller stays in its slot."""
    parts = blocks(len(sense), 512)  # the samples of 512 wheels stay in the processor's cache
    return joined([_block_followed(path, samples, ends.taken(i), sense[i]) for i in parts], 0)


def _block_followed(
    path: RollerPath, samples: PathSamples, ends: EndPairs, sense: Array
) -> PathWheels:
    """Wheels of a block of pairs."""
    (p, q), (t, u) = ends.at.p.T, ends.at.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    centre = 0.5 * ((p + rho * t) + (q - rho * u))
    wheel = PlacedWheel(centre, rho * rho, sense)
    number = np.zeros(int(samples.which.max(initial=0)) + 1, dtype=int)
    number[samples.which] = np.arange(len(samples.which))
    row, count = number[ends.which], len(samples.angle) - 1
    # the samples from entry onwards, over a turn: (samples, wheels)
    first = samples.at.phi[0, row]
    entry = first + (ends.at.phi[:, 0] - first) % math.tau
    motion = ends.at.phi[:, 1] - ends.at.phi[:, 0]
    before = np.count_nonzero(samples.at.phi[:-1, row] <= entry, axis=0)
    sample = before + np.arange(count)[:, None]
    turned = sample >= count
    place = (sample - count * turned) * len(samples.which) + row
    phi, *motions = (x.take(place) for x in samples.at[:4])
    since = phi - entry + math.tau * turned
    course = wheel.course(*motions)
    inside = since < motion
    good = np.where(inside, (course.moment > 0.0) & (course.short > 0.0), course.short < 0.0)
    at_entry = (since < SAME_ENTRY) | (since > math.tau - SAME_ENTRY)
    good |= (np.abs(since - motion) < SAME_ENTRY) | at_entry
    kept = np.flatnonzero(good.all(axis=0))
    # add the ends to the samples, and the entry again a turn later
    wheel, ends, motion = wheel.taken(kept), ends.taken(kept), motion[kept]
    limits = wheel.course(ends.at.p.T, ends.at.v.T, ends.at.a.T)
    limits = limits._replace(moment=0.0 * limits.moment, short=0.0 * limits.short)
    exit_, column = np.count_nonzero(inside[:, kept], axis=0) + 1, np.arange(len(kept))
    node = np.arange(-1, count + 2)[:, None] - (np.arange(count + 3)[:, None] > exit_)
    node[[0, -1]] = count
    node[exit_, column] = count + 1
    node = node * len(kept) + column
    nodes = np.concatenate((since[:, kept], [0.0 * motion, motion])).take(node)
    nodes[-1] = math.tau
    full = PinCourse._make(
        np.concatenate((x[:, kept], y)).take(node) for x, y in zip(course, limits, strict=True)
    )
    bounds = peak_bounds(nodes, motion, wheel, full)
    every = PathWheels(ends.which, ends.at.phi, wheel.sense, *bounds)
    return every.taken(~leaves_slot(path, wheel, ends, nodes, full, motion))
