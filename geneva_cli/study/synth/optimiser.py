"""One search for the best places of many tasks at once: a grid, then samples ever closer.

The places of a task are points of a unit cube. A place is better if it violates its bounds less or,
at equal violations, if it costs less. All tasks are sampled as one batch.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from geneva_cli.numerics.arrays import Array, Mask, Whole, joined

BROKEN = 1e-200  # a violation below it is rounding; each bound kept by rounding adds 1e-300
SETTLED = 1e-11  # fraction of a cost: samples nearer to the best than this are equally good
# Violations, and costs, of places (n, d) of tasks by their numbers; infinite without a machine.
Evaluate: TypeAlias = Callable[[Whole, Array], "tuple[Array, Array]"]


class Places(NamedTuple):
    """Sampled places: the number of the task of each, its point, violation and cost."""

    of: Whole
    at: Array  # (n, d)
    violation: Array
    cost: Array

    def take(self, which: Any) -> Places:
        """Some of the places."""
        return Places(*(part[which] for part in self))

    def best(self, count: int) -> Places:
        """The best places of each task, at most ``count``, in order of the tasks."""
        return self.take(_first(self, self.of, count))

    def joined(self, *others: Places) -> Places:
        """These places and others."""
        return joined([self, *others], 0)


class Zoom(NamedTuple):
    """Samplings near the best places.

    ``offsets`` returns those of a sampling by its number, (k, d) in steps. The first step is a
    fraction of the cube's side; after each sampling it is multiplied by ``better`` if the place was
    improved, and else by ``worse``. ``around`` are the coordinates that wrap round.
    """

    offsets: Callable[[int], Array]
    step: float
    better: float
    worse: float
    most: int  # samplings
    around: Sequence[int] = ()


def sampled(evaluate: Evaluate, of: Whole, at: Array) -> Places:
    """The places of tasks by their numbers, with violations and costs."""
    return Places(of, at, *evaluate(of, at))


def tops(evaluate: Evaluate, tasks: int, axes: Sequence[Array], most: int) -> Places:
    """The places of a grid that are better than their neighbours, at most ``most`` of each task."""
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    shape, count = points.shape[:-1], math.prod(points.shape[:-1])
    at = np.tile(points.reshape(count, -1), (tasks, 1))
    every = sampled(evaluate, np.repeat(np.arange(tasks), count), at)
    rank = np.empty(len(at), dtype=int)
    rank[np.lexsort((every.cost, every.violation))] = np.arange(len(at))
    margins = [(0, 0)] + [(1, 1)] * len(shape)
    wide = np.pad(rank.reshape(tasks, *shape), margins, constant_values=len(at))
    around = sliding_window_view(wide, (1, *[3] * len(shape)))
    least = around.min(axis=tuple(range(-len(shape) - 1, 0)))
    return every.take((rank == least.ravel()) & np.isfinite(every.violation)).best(most)


def zoom(
    evaluate: Evaluate, best: Places, how: Zoom, keep: int = 0, patient: bool = False
) -> Places:
    """Improve places by samples ever closer to them.

    Each place is improved alone until samples near it are equally good. With ``keep`` that many
    places of each task are kept together, and all samplings are made. Without ``patient`` a place
    is given up where no small step can keep the bounds.
    """
    track = best.of if keep else np.arange(len(best.of))
    step, live = np.full(len(track), how.step), np.full(len(track), True)
    for number in range(how.most):
        if not live.any():
            break
        parents, offsets = best.take(live), how.offsets(number)
        k, d = offsets.shape
        at = (parents.at[:, None] + step[live][:, None, None] * offsets).reshape(-1, d)
        inside = np.clip(at, 0.0, 1.0)
        inside[:, how.around] = at[:, how.around] % 1.0
        near = sampled(evaluate, np.repeat(parents.of, k), inside)
        tracks = np.concatenate((track, np.repeat(track[live], k)))
        steps = np.concatenate((step * how.worse, np.repeat(step[live] * how.better, k)))
        every = best.joined(near)
        kept = _first(every, tracks, keep or 1)
        best, track, step = every.take(kept), tracks[kept], steps[kept]
        if keep:
            live = np.full(len(track), True)
        else:
            violation, cost = near.violation.reshape(-1, k), near.cost.reshape(-1, k)
            live[live] = ~_done(best, live, violation, cost, patient)
    return best


def _first(places: Places, group: Whole, count: int) -> Whole:
    """Numbers of the best ``count`` places of each group, in order of groups."""
    order = np.lexsort((places.cost, places.violation, group))
    own = group[order]
    which: Whole = order[np.arange(len(own)) - np.searchsorted(own, own) < count]
    return which


def _done(best: Places, live: Mask, violation: Array, cost: Array, patient: bool) -> Mask:
    """Mask of the live places that need no closer samples, from their last ones (n, k)."""
    own = best.take(live)
    with np.errstate(invalid="ignore"):
        spread = np.abs(cost - own.cost[:, None]).max(axis=1)
        # as good as all samples, or the best in a corner; or broken alike
        kept = (violation < BROKEN).all(axis=1) & (own.violation < BROKEN)
        corner = np.isin(own.at, (0.0, 1.0)).all(axis=1)
        settled = kept & ((spread <= SETTLED * np.abs(own.cost)) | corner)
        off = np.abs(violation - own.violation[:, None]).max(axis=1)
        broken = own.violation > BROKEN
        settled |= broken & (off <= SETTLED * own.violation)
        # beaten by another place of the task, by more than samples differ
        least = np.full(best.of.max() + 1, math.inf)
        np.minimum.at(least, best.of, np.where(best.violation < BROKEN, best.cost, math.inf))
        beaten = own.cost - 4.0 * spread > least[own.of]
        beaten |= broken & np.isfinite(least[own.of])
        if patient:
            return settled | beaten
        # the violation is more than twice what a step near it changes
        hopeless = broken & (own.violation > 2.0 * (violation.max(axis=1) - own.violation))
        return settled | beaten | hopeless
