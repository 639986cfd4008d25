"""Wheels that roller paths can drive: the pairs of points whose roller stays in its slot.

A pair of points gives the wheel's centre. ``course`` checks that the roller enters at one
point, leaves at the other and stays outside the slot otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.paths.course import (
    OpenIntervals,
    PathWheels,
    PinCourse,
    bounded,
    leaves_slot,
    open_intervals,
)
from geneva_cli.drives.paths.samples import PathSamples, points, sampled
from geneva_cli.drives.paths.tangent_pairs import (
    DOUBLE_ROOT_SLOPE,
    SAME_ENTRY,
    EndPairs,
    firsts,
    newton,
    pairs,
    residual,
)
from geneva_cli.drives.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Mask, joined


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
    with np.errstate(all="ignore"):
        every = list(sampled(path, len(b)))
        ends, doubtful = pairs(path, every, b)
        rest = residual(ends, b)
        steep = np.abs(rest.det) >= DOUBLE_ROOT_SLOPE * np.abs(rest.by_exit)
        doubtful = doubtful.taken(~_lead_to(doubtful, ends.taken(steep), b))
        doubtful = joined([doubtful, ends.taken(~steep)], 0)
        # A path that stops has no direction there; boxes around such a point hold no pair.
        doubtful = doubtful.taken(np.flatnonzero(np.isfinite(doubtful.at.phi).all(axis=1)))
        # doubtful entries within 1e-4 radians lead to one wheel
        doubtful = doubtful.taken(firsts(doubtful.which, doubtful.at.phi, 1e-4))
        ends, sense = ends.taken(steep), rest.sense[steep]
        own = ((some, np.isin(ends.which, some.which)) for some in every)
        parts = ((some, ends.taken(i), sense[i]) for some, i in own)
        return WheelSearch(_followed(path, parts), doubtful)


def followed(path: RollerPath, phi: Array, sense: Array) -> PathWheels:
    """Wheels that a path can drive, among those with entry and exit angles ``phi`` (n, 2)."""
    with np.errstate(all="ignore"):
        ends = EndPairs(np.zeros(len(phi), dtype=int), points(path, phi))
        return _followed(path, [(next(sampled(path, 1)), ends, sense)])


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


def _followed(path: RollerPath, parts: Iterable[tuple[PathSamples, EndPairs, Array]]) -> PathWheels:
    """Wheels of the pairs between which the roller stays in its slot, by blocks of designs."""
    blocks, count = [], 0
    for part in parts:
        block, intervals = _block_followed(*part)
        blocks.append((block, intervals._replace(wheel=intervals.wheel + count)))
        count += len(block.which)
    every, intervals = joined(blocks, 0)
    return every.taken(~leaves_slot(path, every, intervals))


def _block_followed(
    samples: PathSamples, ends: EndPairs, sense: Array
) -> tuple[PathWheels, OpenIntervals]:
    """Wheels of a block of pairs that are wrong at no sample, and where they may be wrong still."""
    (p, q), (t, u) = ends.at.p.T, ends.at.t.T
    rho = np.abs(q - p) / np.abs(t + u)
    centre = 0.5 * ((p + rho * t) + (q - rho * u))
    unknown = np.zeros(len(sense)), np.full(len(sense), np.inf)
    wheel = PathWheels(ends.which, ends.at.phi, centre, rho * rho, sense, *unknown)
    order, count = np.argsort(samples.which), len(samples.angle) - 1
    row = order[np.searchsorted(samples.which, ends.which, sorter=order)]
    # the samples from entry onwards, over a turn, and after them entry and exit: (places, wheels)
    first = samples.at.phi[0, row]
    entry = first + (ends.at.phi[:, 0] - first) % math.tau
    motion = ends.at.phi[:, 1] - ends.at.phi[:, 0]
    before = (samples.at.phi[:-1].take(row, axis=1) <= entry).sum(axis=0, dtype=np.int32)
    sample = before + np.arange(count)[:, None]
    turned = sample >= count
    place = (sample - count * turned) * len(samples.which) + row
    phi, *motions = (
        np.concatenate((x.take(place), y.T))
        for x, y in zip(samples.at[:4], ends.at[:4], strict=True)
    )
    since = phi - entry
    since[:count] += math.tau * turned
    since[count:] = 0.0 * motion, motion
    course = wheel.course(*motions)
    for x in (course.moment, course.short):
        x[count:] = 0.0
    samples_since, moment, short = since[:count], course.moment[:count], course.short[:count]
    inside = samples_since < motion
    good = np.where(inside, (moment > 0.0) & (short > 0.0), short < 0.0)
    good |= np.abs(samples_since - motion) < SAME_ENTRY
    good |= (samples_since < SAME_ENTRY) | (samples_since > math.tau - SAME_ENTRY)
    kept = np.flatnonzero(good.all(axis=0))
    # put the ends among the samples, and the entry again a turn later
    exit_ = inside.sum(axis=0, dtype=np.int32)[kept] + 1
    node = np.arange(-1, count + 2)[:, None] - (np.arange(count + 3)[:, None] > exit_)
    node[[0, -1]] = count
    node[exit_, np.arange(len(kept))] = count + 1
    node = node * len(row) + kept
    nodes, full = since.take(node), PinCourse._make(x.take(node) for x in course)
    nodes[-1] = math.tau
    wheel, motion = bounded(wheel.taken(kept), nodes, motion[kept], full), motion[kept]
    return wheel, open_intervals(nodes, full, motion)
