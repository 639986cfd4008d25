"""The best machine of each family that keeps the bounds, or the one nearest to them.

A search has many tasks as one batch: a grid, then samples ever closer. The places of a task are
points of a unit cube. A place is better if it violates its bounds less or, at equal violations, if
it costs less: in peak acceleration (in rad/s² if times are required), or in the goal's quantity.
If any motion is allowed, the cost is the distance from the plain crank.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Array, Mask, Whole, joined
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.study.batches import Batch, SpecGroups
from geneva_cli.study.batches import numbers as quantities
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

ROUNDING = 1e-200  # a violation below it is rounding; each bound kept by rounding adds 1e-300
SETTLED = 1e-11  # fraction of a cost: samples nearer to the best than this are equally good
# Violations, and costs, of places (n, d) of tasks by their numbers; infinite without a machine.
Evaluate: TypeAlias = Callable[[Whole, Array], "tuple[Array, Array]"]
SOFT = 1e-60  # weight of the limits of a frame, which matter less than any bound
GRID, TRACKS = 24, 3  # intervals of a span, sampled first; the best places that are improved
QUARTERS = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])[:, None] / 4.0


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
    fraction of the cube's side; after each sampling it is multiplied by ``closer``. ``around`` are
    the coordinates that wrap round.
    """

    offsets: Callable[[int], Array]
    step: float
    closer: float
    most: int  # samplings
    around: Sequence[int] = ()


def sampled(evaluate: Evaluate, of: Whole, at: Array) -> Places:
    """The places of tasks by their numbers, with violations and costs."""
    return Places(of, at, *evaluate(of, at))


def tops(evaluate: Evaluate, tasks: Whole, line: Array, most: int) -> Places:
    """The places of a line that are better than both neighbours, at most ``most`` of each task."""
    at = np.tile(line, len(tasks))[:, None]
    every = sampled(evaluate, np.repeat(tasks, len(line)), at)
    rank = np.empty(len(at), dtype=int)
    rank[np.lexsort((every.cost, every.violation))] = np.arange(len(at))
    wide = np.pad(rank.reshape(-1, len(line)), ((0, 0), (1, 1)), constant_values=len(at))
    beside = np.minimum(wide[:, :-2], wide[:, 2:]).ravel()
    return every.take((rank < beside) & np.isfinite(every.violation)).best(most)


def zoom(evaluate: Evaluate, best: Places, how: Zoom, keep: int = 0) -> Places:
    """Improve places by samples ever closer to them.

    Each place is improved alone until samples near it are equally good, or until no small step can
    keep the bounds. With ``keep`` that many places of each task are kept together, and all
    samplings are made.
    """
    track = best.of if keep else np.arange(len(best.of))
    step, live = how.step, np.full(len(track), True)
    for number in range(how.most):
        if not live.any():
            break
        parents, offsets = best.take(live), how.offsets(number)
        k, d = offsets.shape
        at = (parents.at[:, None] + step * offsets).reshape(-1, d)
        inside = np.clip(at, 0.0, 1.0)
        inside[:, how.around] = at[:, how.around] % 1.0
        near = sampled(evaluate, np.repeat(parents.of, k), inside)
        tracks = np.concatenate((track, np.repeat(track[live], k)))
        every, step = best.joined(near), step * how.closer
        kept = _first(every, tracks, keep or 1)
        best, track = every.take(kept), tracks[kept]
        if keep:
            live = np.full(len(track), True)
        else:
            violation, cost = near.violation.reshape(-1, k), near.cost.reshape(-1, k)
            live[live] = ~_done(best, live, violation, cost)
    return best


def _first(places: Places, group: Whole, count: int) -> Whole:
    """Numbers of the best ``count`` places of each group, in order of groups."""
    order = np.lexsort((places.cost, places.violation, group))
    own = group[order]
    which: Whole = order[np.arange(len(own)) - np.searchsorted(own, own) < count]
    return which


def _done(best: Places, live: Mask, violation: Array, cost: Array) -> Mask:
    """Mask of the live places that need no closer samples, from their last ones (n, k)."""
    own = best.take(live)
    with np.errstate(invalid="ignore"):
        spread = np.abs(cost - own.cost[:, None]).max(axis=1)
        # the samples are broken alike, and as good; or it is the best, in a corner
        off = np.abs(violation - own.violation[:, None]).max(axis=1)
        broken = own.violation > ROUNDING
        corner = np.isin(own.at, (0.0, 1.0)).all(axis=1)
        settled = broken | corner | (spread <= SETTLED * np.abs(own.cost))
        settled &= off <= SETTLED * own.violation + ROUNDING
        # beaten by another place of the task, by more than samples differ
        least = np.full(best.of.max() + 1, math.inf)
        np.minimum.at(least, best.of, np.where(best.violation < ROUNDING, best.cost, math.inf))
        beaten = own.cost - 4.0 * spread > least[own.of]
        beaten |= broken & np.isfinite(least[own.of])
        # the violation is more than twice what a step near it changes
        hopeless = broken & (own.violation > 2.0 * (violation.max(axis=1) - own.violation))
        return settled | beaten | hopeless


# Samples on both sides of the best, each time four times as close.
LINE = Zoom(lambda number: QUARTERS, 1.0 / GRID, 0.25, 20)


def best(families: Sequence[Family], target: Target) -> list[Spec]:
    """The best machine of each family, or that which breaks the bounds least."""
    searched = [i for i, f in enumerate(families) if f.is_free]
    numbers = {i: f.low for i, f in enumerate(families) if not f.is_free}
    if searched:
        free = FamilyCosts([families[i] for i in searched], target)
        found = _best_places(free)
        own = free.numbers(found.of, found.at[:, 0])
        numbers |= zip((searched[of] for of in found.of.tolist()), own.tolist(), strict=True)
    out: list[Spec] = []
    for i, x in sorted(numbers.items()):
        f = families[i]
        if not abs(x - f.known) <= 1e-4 * (f.high - f.low):  # it is not of another family
            values = f.keys(np.array([x])) if f.keys else {}
            with suppress(GenevaError):  # no machine at a number
                out.append(f.spec.with_keys({key: float(v[0]) for key, v in values.items()}))
    return out


def _best_places(free: FamilyCosts) -> Places:
    """The best place of each family, from the plain crank's and the tops of a grid."""
    every = np.arange(len(free.families))
    plain = (free.plain - free.low) / (free.high - free.low)
    inside = (plain >= 0.0) & (plain <= 1.0)
    nearest = sampled(free, every[inside], plain[inside, None])
    is_best = (nearest.cost == 0.0) & (nearest.violation == 0.0) & free.is_nearest
    left = np.setdiff1d(every, nearest.of[is_best])
    grid = tops(free, left, np.arange(GRID + 1) / GRID, TRACKS)
    # at equal costs the plain crank's place, which may be another family's machine
    settled = np.where(np.isfinite(nearest.cost), SETTLED * np.abs(nearest.cost), 0.0)
    plainly = nearest._replace(cost=nearest.cost - settled)
    tracks = grid.joined(nearest.take(np.isin(nearest.of, left))).best(TRACKS)
    return zoom(free, tracks, LINE).joined(plainly).best(1)


class Costs:
    """Violations of a requirement's bounds, and costs, of machines like some specs.

    The bounds and the goal are those that a batch can compute.
    """

    def __init__(self, specs: Sequence[Spec], target: Target) -> None:
        self.target = target
        self.sort = target.sort if target.sort and in_batch([target.sort.name]) else None
        self.goal = self.sort or Objective(1.0, target.peak)
        self.bounds = [b for b in target.bounds if in_batch([b.name])]
        self.soft = [*target.soft_bounds.values()]
        self.names = [self.goal.name, *(b.name for b in (*self.bounds, *self.soft))]
        self.groups = SpecGroups(specs)

    def of(self, batches: Iterable[Batch], count: int) -> tuple[Array, Array]:
        """Violations and costs of ``count`` designs of batches, infinite without a machine."""
        goal, *others = quantities(self.target.at_speed(batches), self.names, count)
        violation = np.zeros(count)
        for i, (bound, own) in enumerate(zip((*self.bounds, *self.soft), others, strict=True)):
            margin = bound.margin(own)
            rounding = np.where(margin >= -ROUNDED * (bound.bound != 0.0), 1e-300, -margin)
            weight = 1.0 if i < len(self.bounds) else SOFT
            violation += weight * np.where(margin >= 0.0, 0.0, np.minimum(rounding, 1e9))
        known = np.isfinite(goal) & ~np.isnan(violation)
        cost = self.goal.sign * goal
        return np.where(known, violation, math.inf), np.where(known, cost, math.inf)


class FamilyCosts(Costs):
    """Those of families, at places in the unit cube.

    The cost is the quantity to minimise, or the distance from the plain crank.
    """

    def __init__(self, families: Sequence[Family], target: Target) -> None:
        super().__init__([f.spec for f in families], target)
        self.families = families
        self.is_nearest = target.any_motion and not self.sort
        each = [(f.low, f.high, f.plain) for f in families]
        self.low, self.high, self.plain = np.array(each).T

    def numbers(self, of: Whole, at: Array) -> Array:
        """The numbers (n,) of families at places of the unit cube, without the cube's rounding."""
        low, high, plain = self.low[of], self.high[of], self.plain[of]
        inside: Array = np.where(at == 1.0, high, low + (high - low) * at)
        return np.where(abs(inside - plain) <= 1e-15 * (high - low), plain, inside)

    def __call__(self, of: Whole, at: Array) -> tuple[Array, Array]:
        """Violations and costs at places (n, 1) of families, (n,) each."""
        numbers = self.numbers(of, at[:, 0])
        keys = dict[str, Array]()
        for i in np.unique(of).tolist():
            some, keys_of = of == i, self.families[i].keys
            assert keys_of
            for key, value in keys_of(numbers[some]).items():
                own = keys.setdefault(key, np.full(len(of), math.nan))
                own[some] = np.where(np.isnan(value), math.inf, value)
        violation, cost = self.of(self.groups.machines(of, keys), len(of))
        far = np.abs(numbers - self.plain[of])
        is_far = self.is_nearest & np.isfinite(cost) & ~np.isnan(far)
        return violation, np.where(is_far, far, cost)
