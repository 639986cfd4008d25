"""The best machine of each family that keeps the bounds, or the one nearest to them.

The best has the least peak acceleration (in rad/s² if times are required), or the least of the
goal's quantity. If any motion is allowed, it is the nearest to the plain crank.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.study.batches import BatchKey, columns, numbers, split
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.synth.optimiser import BROKEN, SETTLED, Places, Zoom, sampled, tops, zoom
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

FamilyMachine: TypeAlias = tuple[Spec, Family]
GRID = 24  # intervals of the span of one number, sampled first
QUARTERS = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])[:, None] / 4.0
# Of one number: samples on both sides of the best, each time four times as close.
LINE = Zoom(lambda number: QUARTERS, 1.0 / GRID, 0.25, 0.25, 20)
MIDDLES = (np.arange(10) + 0.5) / 10  # places of the second of two numbers, sampled first


def _ring(number: int) -> Array:
    """Places about the best at its step, half and a quarter of it, rotated each time."""
    count = np.arange(24)
    turn, far = math.tau * (count + 0.382 * number) / 24, 0.5 ** (count % 3)
    return np.stack((far * np.cos(turn), far * np.sin(turn)), axis=-1)


RING = Zoom(_ring, 0.1, 1.4, 0.5, 40)


def best(
    families: Sequence[Family], target: Target, how_near: bool = False
) -> tuple[list[FamilyMachine], list[FamilyMachine]]:
    """The best machine of each family, with it: those that keep the bounds, and the others.

    The others break the bounds least, with ``how_near`` to the last digit.
    """
    chosen: dict[int, tuple[Sequence[float], bool]] = {}
    searched = {i: f for i, f in enumerate(families) if f.keys and f.is_free and math.isnan(f.best)}
    for freedom in (1, 2):
        some = [i for i, f in searched.items() if len(f.low) == freedom]
        if some:
            free = FamilyCosts([families[i] for i in some], target)
            found = _best_places(free, freedom, how_near)
            for of, at, broken in zip(found.of.tolist(), found.at, found.violation, strict=True):
                if broken < BROKEN or freedom == 1:
                    chosen[some[of]] = free.place(of, at), bool(broken < BROKEN)
    kept: list[FamilyMachine] = []
    broken_ones: list[FamilyMachine] = []
    for i, f in enumerate(families):
        if i in searched and i not in chosen:
            continue
        place, keeps = chosen.get(i, (f.low if math.isnan(f.best) else (f.best,), True))
        alike = zip(place, f.known, f.low, f.high, strict=False)
        is_known = f.known and all(abs(x - y) <= 1e-4 * (b - a) for x, y, a, b in alike)
        if not is_known and (spec := f.at(place)):  # known: of another family
            (kept if keeps else broken_ones).append((spec, f))
    return kept, broken_ones


def _best_places(free: FamilyCosts, freedom: int, how_near: bool) -> Places:
    every = np.arange(len(free.families))
    plain, inside = free.plain
    nearest = sampled(free, every[inside], plain[inside])
    done = nearest.take((nearest.cost == 0.0) & (nearest.violation == 0.0) & free.nearest)
    if len(done.of) == len(every):
        return done
    if freedom == 1:
        axes, how, most = [np.arange(GRID + 1) / GRID], LINE, 3
    else:
        is_exact = (free.low == free.high)[:, 0].all()
        axes = [np.array([1.0]) if is_exact else np.array([0.0, *MIDDLES, 1.0]), MIDDLES]
        # a bound, or another goal than the peak, may have several minima
        how, most = RING, 3 if free.bounds or free.goal.name != free.peak else 1
    left = np.setdiff1d(every, done.of)
    first = tops(lambda of, at: free(left[of], at), len(left), axes, most)
    first = first._replace(of=left[first.of])
    tracks = first.joined(nearest.take(np.isin(nearest.of, left))).best(most)
    # at equal costs the plain crank's place, which may be another family's machine
    settled = np.where(np.isfinite(nearest.cost), SETTLED * np.abs(nearest.cost), 0.0)
    plainly = nearest._replace(cost=nearest.cost - settled)
    return zoom(free, tracks, how, patient=how_near).joined(done, plainly).best(1)


class FamilyCosts:
    """Violations of a requirement's bounds, and costs, at places of families in the unit cube.

    The bounds and the goal are those that a batch can compute. The cost is the quantity to
    minimise, or the distance from the plain crank.
    """

    def __init__(self, families: Sequence[Family], target: Target) -> None:
        self.families, self.bounds, self.peak = families, target.known_bounds, target.peak
        sort = target.sort if target.sort and in_batch([target.sort.name]) else None
        self.nearest = target.any_motion and not sort
        self.goal = sort or Objective(1.0, self.peak)
        self.names = [self.goal.name, *(b.name for b in self.bounds)]
        self.low = np.array([f.low or (0.0,) for f in families])
        self.high = np.array([f.high or (f.several - 1.0,) for f in families])
        missing = (math.nan,) * self.low.shape[1]
        self._plain = np.array([f.plain or missing for f in families])
        self._scale = np.array([f.scale for f in families])
        keys: dict[Any, list[BatchKey]] = {}
        own = [split(f.spec, keys) for f in families]
        shapes = {shape: i for i, (shape, _) in enumerate(own)}
        self._own = [values for _, values in own]
        self._shape = np.array([shapes[shape] for shape, _ in own])

    @property
    def plain(self) -> tuple[Array, Mask]:
        """The places of the plain crank, and a mask of the families that have one inside."""
        with np.errstate(all="ignore"):
            unit = (self._plain - self.low) / (self.high - self.low)
        return unit, ((unit >= 0.0) & (unit <= 1.0)).all(axis=1)

    def place(self, i: int, at: Array) -> Sequence[float]:
        """The numbers of a family at a place of the unit cube."""
        numbers: list[float] = self._places(np.array([i]), at[None])[0].tolist()
        return numbers

    def _places(self, of: Whole, at: Array) -> Array:
        low, high, plain = self.low[of], self.high[of], self._plain[of]
        inside: Array = np.where(at == 1.0, high, low + (high - low) * at)
        # without the rounding of the unit cube
        return np.where(abs(inside - plain) <= 1e-15 * (high - low), plain, inside)

    def __call__(self, of: Whole, at: Array) -> tuple[Array, Array]:
        """Violations and costs at places (n, d) of families, (n,) each."""
        places = self._places(of, at)
        values = self._numbers(of, places)
        cost = self.goal.sign * values[:, 0]
        if self.nearest:
            off = (places - self._plain[of]) / self._scale[of]
            far = np.sqrt((off * off).sum(axis=1))
            cost = np.where(np.isnan(far), cost, far)
        violation = np.zeros(len(of))
        for bound, value in zip(self.bounds, values[:, 1:].T, strict=True):
            margin = bound.margin(value)
            rounding = np.where(margin >= -ROUNDED * (bound.bound != 0.0), 1e-300, -margin)
            violation += np.where(margin >= 0.0, 0.0, rounding)
        known = np.isfinite(values[:, 0]) & ~np.isnan(violation)
        return np.where(known, violation, math.inf), np.where(known, cost, math.inf)

    def _numbers(self, of: Whole, places: Array) -> Array:
        """The goal and the bounded quantities at places, (n, names); NaN without a machine."""
        out = np.full((len(of), len(self.names)), math.nan)
        shape = self._shape[of]
        for kind in np.unique(shape).tolist():
            which = np.flatnonzero(shape == kind)
            if self.families[of[which[0]]].make:
                specs = {i: self.families[of[i]].at(places[i]) for i in which.tolist()}
                some = {i: spec for i, spec in specs.items() if spec}
                rows = zip(some, numbers([*some.values()], self.names), strict=True)
                for i, row in rows:
                    out[i] = row or math.nan
                continue
            varied = {
                key: np.array([self._own[i][key] for i in of[which]]) for key in self._own[kind]
            }
            for i in np.unique(of[which]).tolist():
                own, keys = of[which] == i, self.families[i].keys
                assert keys
                for key, value in keys(places[which][own]).items():
                    varied[key] = varied[key].astype(float)
                    varied[key][own] = value
            able = np.isfinite(list(varied.values())).all(axis=0)
            if able.any():
                spec = self.families[of[which[able][0]]].spec
                alike, values = self._batch(spec, {k: v[able] for k, v in varied.items()})
                out[which[able][alike]] = values
        return out

    def _batch(self, spec: Spec, varied: dict[str, Array]) -> tuple[Whole, Array]:
        """The numbers of those machines of a batch that can be built, and their quantities."""
        same = {key for key, value in varied.items() if not (value != value[0]).any()}
        same -= {next(iter(varied))} if len(same) == len(varied) else set()
        try:
            batch = many(spec, {k: v[0].item() if k in same else v for k, v in varied.items()})
        except GenevaError:  # a frame that allows no such machine
            return np.zeros(0, dtype=int), np.zeros((0, len(self.names)))
        count, values = len(batch.which), None
        if batch.machine:
            values = columns(batch.machine, self.names, count)
            if values is None and (peak := columns(batch.machine, [self.peak], count)):
                # what no batch computes is computed later: it keeps its bounds so far
                values = [*peak, *(np.full(count, b.bound) for b in self.bounds)]
        return batch.which, np.reshape(values or [], (len(self.names), -1)).T
