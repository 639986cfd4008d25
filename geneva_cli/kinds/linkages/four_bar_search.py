"""The search of four-bars: proportions, the crank's angle at entry and, in a range, the motion.

All wheels of a requirement are searched as a batch. The first samples are spread evenly in a unit
cube, equal in every run. The next ones are ever closer to the best.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.coupler import (
    CouplerDrive,
    FourBarLinks,
    coupler_drive,
    driven_wheels,
)
from geneva_cli.kinds.linkages.coupler_costs import Costs, order
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.study.spans import AllowedSpan
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.target import Target

SAMPLES = (256, 2048)  # least and most four-bars that are sampled for one wheel
SAMPLINGS = (14, 60)  # least and most closer samplings for one wheel
COARSE, FINE = 16, 96  # sampled places of a motion
OTHERS = 6  # further results if a bound or the goal is not computed here


class Goal(NamedTuple):
    """The goal of the search: bounds, and a quantity to minimise (``sign`` -1: maximise)."""

    target: Target
    wheels: tuple[WheelGoal, ...]
    bounds: tuple[Constraint, ...]
    least: str
    sign: float = 1.0


class WheelGoal(NamedTuple):
    """A wheel, its allowed motions, and the least roller as a fraction of the centre distance."""

    wheel: Gearing
    motion: AllowedSpan
    roller: float


class Pool(NamedTuple):
    """Places in the unit cube, and their linkages and costs."""

    of: Whole  # the number of the wheel, (n,)
    unit: Array  # (n, 5): two proportions, crank, angle, and the motion in a range
    links: FourBarLinks
    drive: CouplerDrive
    broken: Array  # violation of the bounds; infinite without a machine
    cost: Array  # the quantity to minimise
    distance: Array

    def best(self, count: int) -> Pool:
        """The best places of each wheel that are machines."""
        order = np.lexsort((self.cost, self.broken, self.of))
        of = self.of[order]
        place = np.arange(len(of)) - np.searchsorted(of, of)
        return self.select(order[(place < count) & np.isfinite(self.broken[order])])

    def select(self, which: Any) -> Pool:
        """Some of the places."""
        return Pool(*(_select(part, which) for part in self))


def search_four_bars(goal: Goal) -> list[Pool]:
    """For each wheel the four-bars that keep the bounds, the best first."""
    wheels, slots = len(goal.wheels), len(goal.target.z)
    # all wheels of a requirement together have about 6000 samples, and 300 closer samplings
    count = min(max(6000 // slots, SAMPLES[0]), SAMPLES[1])
    samplings = min(max(300 // slots, SAMPLINGS[0]), SAMPLINGS[1])
    parents, children = 4, 12  # the best places of a wheel, and the closer samples near each
    every = np.arange(wheels)
    with np.errstate(all="ignore"):
        unit, sense = np.repeat(_spread(count), 2, axis=0), np.resize([1.0, -1.0], 2 * count)
        tried = [_pool(goal, np.full(2 * count, i), unit, sense, COARSE) for i in every]
        first = _joined(*(one.best(OTHERS) for one in tried))
        best, width = first.best(parents), 0.3  # of the cube's side
        for number in range(samplings):
            offset = (_spread(children, number) - 0.5) * width
            unit = (best.unit[:, None] + offset).reshape(-1, unit.shape[1])
            of, sense = (np.repeat(x, children) for x in (best.of, best.drive.sense[:, 0]))
            best = _joined(best, _pool(goal, of, _inside(unit), sense, COARSE)).best(parents)
            width *= 3e-3 ** (1.0 / samplings)
        # fine samples remove those that fail between the coarse ones
        several = _joined(best, first)
        sense = several.drive.sense[:, 0]
        fine = _pool(goal, several.of, several.unit, sense, FINE).best(parents + OTHERS)
    kept = fine.select(fine.broken == 0.0)
    return [kept.select(kept.of == i) for i in every]


def _spread(count: int, start: int = 0) -> Array:
    """Points spread evenly in the unit cube: Roberts' sequence, multiples of the powers of g.

    g is the root of g^6 = g + 1.
    """
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    points: Array = (
        0.5 + np.arange(1 + start * count, 1 + (start + 1) * count)[:, None] * powers
    ) % 1
    return points


def _inside(unit: Array) -> Array:
    """Places with the angle wrapped and the other coordinates clipped to the cube."""
    inside = np.clip(unit, 0.0, 1.0)
    inside[:, 3] = unit[:, 3] % 1.0
    return inside


def _pool(goal: Goal, of: Whole, unit: Array, sense: Array, places: int) -> Pool:
    """The machines at places of the cube, for wheels by their numbers and senses."""
    half, low, high, radius, slots = (row[of][:, None] for row in _rows(goal))
    u = unit.T[:, :, None]
    g = np.ones(u[0].shape)
    # coupler and rocker are 1/4 to 4 times as long as the ground link
    b, c = (4.0 ** (2.0 * x - 1.0) for x in u[:2])
    longest = np.minimum(
        np.minimum(np.minimum(g, b), c), g + b + c - 2.0 * np.maximum(np.maximum(g, b), c)
    )
    # the crank is 0.05 to 0.97 times as long as the longest that turns fully
    links = FourBarLinks(longest * (0.05 + (0.97 - 0.05) * u[2]), g, b, c)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    fraction = np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    degrees = low + (high - low) * fraction
    drive = coupler_drive(links, math.tau * u[3], np.radians(degrees), half, sense[:, None])
    # the further tests run on few places
    at = np.flatnonzero((longest > 0.0) & np.isfinite(drive.w))
    links, drive = links.select(at), drive.select(at)
    # coarse samples miss the nearest places, which a larger roller makes up for
    roller = radius[at] * (1.15 if places < FINE else 1.0)
    names = (goal.least, *(bound.name for bound in goal.bounds))
    passing = driven_wheels(links, drive, half[at], roller, order(names), places)
    within = passing.reach <= goal.target.space * passing.distance
    at = at[passing.which]
    costs = Costs(goal.target, (360.0 / slots[at])[:, 0], passing.derivatives, degrees[at, 0])
    cost = goal.sign * costs.of(goal.least)
    broken = np.where(within & np.isfinite(cost), costs.broken(goal.bounds), np.inf)
    kept = links.select(passing.which), drive.select(passing.which)
    return Pool(of[at], unit[at], *kept, broken, cost, passing.distance)


def _rows(goal: Goal) -> list[Array]:
    """Columns with half the step, the motion's ends, the roller and the slots of each wheel."""
    rows = [
        (task.wheel.step.b, *task.motion, task.roller, float(task.wheel.z)) for task in goal.wheels
    ]
    return [*np.array(rows).T]


def _joined(*pools: Any) -> Any:
    """Several pools, or parts of them, joined into one."""
    if isinstance(pools[0], tuple):
        return type(pools[0])(*map(_joined, *pools))
    return np.concatenate(pools)


def _select(part: Any, which: Any) -> Any:
    if isinstance(part, tuple):
        return type(part)(*(_select(x, which) for x in part))
    return part[which]
