"""The best machine of each family that keeps the bounds, or the one nearest to them.

The best has the least peak acceleration (in rad/s² if times are required), or the least of the
goal's quantity. If any motion is allowed, it is the nearest to the plain crank.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.study.batches import built, columns, split
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.synth.optimiser import SETTLED, Places, Zoom, sampled, tops, zoom
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

SOFT = 1e-60  # weight of the limits of a frame, which matter less than any bound
BROKEN = 1e-40  # a violation below it is of such limits, or rounding
GRID, TRACKS = 24, 3  # intervals of a span, sampled first; the best places that are improved
QUARTERS = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])[:, None] / 4.0
# Samples on both sides of the best, each time four times as close.
LINE = Zoom(lambda number: QUARTERS, 1.0 / GRID, 0.25, 0.25, 20)


def best(
    families: Sequence[Family], target: Target, how_near: bool = False
) -> tuple[list[Spec], list[Spec]]:
    """The best machine of each family: those that keep the bounds, and the others.

    The others break the bounds least, with ``how_near`` to the last digit.
    """
    numbers = [f.low if math.isnan(f.best) else f.best for f in families]
    searched = [i for i, f in enumerate(families) if f.is_free and math.isnan(f.best)]
    keeps: dict[int, bool | None] = dict.fromkeys(range(len(families)), True)
    keeps |= dict.fromkeys(searched)  # None without a machine
    if searched:
        free = FamilyCosts([families[i] for i in searched], target)
        found = _best_places(free, how_near)
        own = free.numbers(found.of, found.at[:, 0]).tolist()
        kept = (found.violation < BROKEN).tolist()
        for of, x, keep in zip(found.of.tolist(), own, kept, strict=True):
            numbers[searched[of]], keeps[searched[of]] = x, keep
    out: dict[bool | None, list[Spec]] = {True: [], False: []}
    for i, (f, x) in enumerate(zip(families, numbers, strict=True)):
        is_known = abs(x - f.known) <= 1e-4 * (f.high - f.low)  # of another family
        if keeps[i] is not None and not is_known:
            spec = f.at(x) if math.isnan(f.best) else f.spec
            out[keeps[i]] += [spec] if spec else []
    return out[True], out[False]


def _best_places(free: FamilyCosts, how_near: bool) -> Places:
    """The best place of each family, from the plain crank's and the tops of a grid."""
    every = np.arange(len(free.families))
    plain = (free.plain - free.low) / (free.high - free.low)
    inside = (plain >= 0.0) & (plain <= 1.0)
    nearest = sampled(free, every[inside], plain[inside, None])
    done = nearest.take((nearest.cost == 0.0) & (nearest.violation == 0.0) & free.is_nearest)
    left = np.setdiff1d(every, done.of)
    if not len(left):
        return done
    grid = [np.arange(GRID + 1) / GRID]
    first = tops(lambda of, at: free(left[of], at), len(left), grid, TRACKS)
    first = first._replace(of=left[first.of])
    tracks = first.joined(nearest.take(np.isin(nearest.of, left))).best(TRACKS)
    # at equal costs the plain crank's place, which may be another family's machine
    settled = np.where(np.isfinite(nearest.cost), SETTLED * np.abs(nearest.cost), 0.0)
    plainly = nearest._replace(cost=nearest.cost - settled)
    return zoom(free, tracks, LINE, patient=how_near).joined(done, plainly).best(1)


class FamilyCosts:
    """Violations of a requirement's bounds, and costs, at places of families in the unit cube.

    The bounds and the goal are those that a batch can compute. The cost is the quantity to
    minimise, or the distance from the plain crank.
    """

    def __init__(self, families: Sequence[Family], target: Target) -> None:
        self.families, self.peak = families, target.peak
        sort = target.sort if target.sort and in_batch([target.sort.name]) else None
        self.is_nearest = target.any_motion and not sort
        self.goal = sort or Objective(1.0, self.peak)
        self.bounds = [b for b in target.bounds if in_batch([b.name])]
        self.soft = [*target.soft_bounds.values()]
        self.names = [self.goal.name, *(b.name for b in (*self.bounds, *self.soft))]
        each = [(f.low, f.high, f.plain) for f in families]
        self.low, self.high, self.plain = np.array(each).T
        own = split([f.spec for f in families])
        shapes = {shape: i for i, (shape, _) in enumerate(own)}
        self._own = [values for _, values in own]
        self._shape = np.array([shapes[shape] for shape, _ in own])

    def numbers(self, of: Whole, at: Array) -> Array:
        """The numbers (n,) of families at places of the unit cube, without the cube's rounding."""
        low, high, plain = self.low[of], self.high[of], self.plain[of]
        inside: Array = np.where(at == 1.0, high, low + (high - low) * at)
        return np.where(abs(inside - plain) <= 1e-15 * (high - low), plain, inside)

    def __call__(self, of: Whole, at: Array) -> tuple[Array, Array]:
        """Violations and costs at places (n, 1) of families, (n,) each."""
        numbers = self.numbers(of, at[:, 0])
        values = self._values(of, numbers)
        cost = self.goal.sign * values[:, 0]
        if self.is_nearest:
            far = np.abs(numbers - self.plain[of])
            cost = np.where(np.isnan(far), cost, far)
        violation = np.zeros(len(of))
        for i, bound in enumerate((*self.bounds, *self.soft)):
            margin = bound.margin(values[:, i + 1])
            rounding = np.where(margin >= -ROUNDED * (bound.bound != 0.0), 1e-300, -margin)
            weight = 1.0 if i < len(self.bounds) else SOFT
            violation += weight * np.where(margin >= 0.0, 0.0, np.minimum(rounding, 1e9))
        known = np.isfinite(values[:, 0]) & ~np.isnan(violation)
        return np.where(known, violation, math.inf), np.where(known, cost, math.inf)

    def _values(self, of: Whole, numbers: Array) -> Array:
        """The goal and the bounded quantities, (n, names); NaN without a machine."""
        out = np.full((len(of), len(self.names)), math.nan)
        shape = self._shape[of]
        for kind in np.unique(shape).tolist():
            which = np.flatnonzero(shape == kind)
            own = [self._own[i] for i in of[which].tolist()]
            varied = {key: np.array([one[key] for one in own]) for key in own[0]}
            for i in np.unique(of[which]).tolist():
                some, keys = of[which] == i, self.families[i].keys
                assert keys
                for key, value in keys(numbers[which][some]).items():
                    varied[key] = varied[key].astype(float)
                    varied[key][some] = value
            able = np.isfinite(list(varied.values())).all(axis=0)
            if able.any():
                which, varied = which[able], {key: value[able] for key, value in varied.items()}
                for members, machine in built(self.families[of[which[0]]].spec, varied, which):
                    out[members] = self._columns(machine, len(members))
        return out

    def _columns(self, machine: Any, count: int) -> Array:
        values = columns(machine, self.names, count)
        if values is None and (peak := columns(machine, [self.peak], count)):
            # what no batch computes is computed later: it keeps its bounds so far
            bounds = (*self.bounds, *self.soft)
            values = [*peak, *(np.full(count, b.bound) for b in bounds)]
        return np.column_stack(values) if values else np.full((count, len(self.names)), math.nan)
