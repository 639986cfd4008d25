"""The search of four-bars: proportions, the crank's angle at entry and, in a range, the motion.

All wheels of a requirement are searched as a batch. The first samples are spread evenly in a unit
cube, equal in every run. The next ones are ever closer to the best.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.coupler import CouplerDrive, coupler_drive, driven_wheels
from geneva_cli.kinds.linkages.coupler_costs import Costs, order
from geneva_cli.kinds.linkages.four_bar import CouplerPath
from geneva_cli.kinds.linkages.tangent_pairs import taken
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Whole, parameter
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.optimiser import Places, Zoom, sampled, zoom
from geneva_cli.study.target import AllowedSpan, Target

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


class FourBars(NamedTuple):
    """Machines of the search: which of the places have one, and their links, drive and costs."""

    which: Whole
    links: CouplerPath
    drive: CouplerDrive
    distance: Array
    violation: Array
    cost: Array


def search_four_bars(goal: Goal) -> list[Places]:
    """For each wheel the places of four-bars that keep the bounds, the best first.

    A place is a point of the unit cube: two proportions, the crank, its angle, the motion in a
    range, and the wheel's sense.
    """
    wheels, slots = len(goal.wheels), len(goal.target.z)
    # all wheels of a requirement together have about 6000 samples, and 300 closer samplings
    count = min(max(6000 // slots, SAMPLES[0]), SAMPLES[1])
    samplings = min(max(300 // slots, SAMPLINGS[0]), SAMPLINGS[1])
    parents, children = 4, 12  # the best places of a wheel, and the closer samples near each

    def coarse(of: Whole, at: Array) -> tuple[Array, Array]:
        return _costs(goal, of, at, COARSE)

    def fine(of: Whole, at: Array) -> tuple[Array, Array]:
        return _costs(goal, of, at, FINE)

    def offsets(number: int) -> Array:
        return np.column_stack((_spread(children, number) - 0.5, np.zeros(children)))

    with np.errstate(all="ignore"):
        points = np.repeat(_spread(count), 2, axis=0)
        at = np.column_stack((points, np.resize([1.0, 0.0], 2 * count)))
        each = [sampled(coarse, np.full(2 * count, i), at).best(OTHERS) for i in range(wheels)]
        first = each[0].joined(*each[1:])
        first = first.take(np.isfinite(first.violation))
        closer = 3e-3 ** (1.0 / samplings)
        near = Zoom(offsets, 0.3, closer, closer, samplings, around=(3,))
        several = zoom(coarse, first.best(parents), near, keep=parents).joined(first)
        # fine samples remove those that fail between the coarse ones
        kept = sampled(fine, several.of, several.at)
        kept = kept.take(kept.violation == 0.0).best(parents + OTHERS)
    return [kept.take(kept.of == i) for i in range(wheels)]


def _spread(count: int, start: int = 0) -> Array:
    """Points spread evenly in the unit cube: Roberts' sequence, multiples of the powers of g."""
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    numbers = np.arange(1 + start * count, 1 + (start + 1) * count)
    points: Array = (0.5 + numbers[:, None] * powers) % 1
    return points


def _costs(goal: Goal, of: Whole, at: Array, places: int) -> tuple[Array, Array]:
    """Violations and costs of places; infinite without a machine."""
    found = four_bars_at(goal, of, at, places)
    out = np.full((2, len(of)), np.inf)
    out[:, found.which] = found.violation, found.cost
    return out[0], out[1]


def four_bars_at(goal: Goal, of: Whole, at: Array, places: int = FINE) -> FourBars:
    """The machines at places of the cube, for wheels by their numbers.

    Their motion is sampled at ``places``.
    """
    half, low, high, radius, slots = (row[of][:, None] for row in _rows(goal))
    u = at.T[:, :, None]
    g, sense = np.ones(u[0].shape), np.where(u[5] > 0.5, 1.0, -1.0)
    # coupler and rocker are 1/4 to 4 times as long as the ground link
    b, c = (4.0 ** (2.0 * x - 1.0) for x in u[:2])
    longest = np.minimum(
        np.minimum(np.minimum(g, b), c), g + b + c - 2.0 * np.maximum(np.maximum(g, b), c)
    )
    # the crank is 0.05 to 0.97 times as long as the longest that turns fully
    lengths = (longest * (0.05 + (0.97 - 0.05) * u[2]), g, b, c)
    links = CouplerPath(*map(parameter, lengths), reach_mm=0.0, angle_deg=0.0)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    fraction = np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    degrees = low + (high - low) * fraction
    drive = coupler_drive(links, math.tau * u[3], np.radians(degrees), half, sense)
    # the further tests run on few places
    able = np.flatnonzero((longest > 0.0) & np.isfinite(drive.w))
    links, drive = links.of(able), taken(drive, able)
    # coarse samples miss the nearest places, which a larger roller makes up for
    roller = radius[able] * (1.15 if places < FINE else 1.0)
    names = (goal.least, *(bound.name for bound in goal.bounds))
    passing = driven_wheels(links, drive, half[able], roller, order(names), places)
    within = passing.reach <= goal.target.space * passing.distance
    able = able[passing.which]
    costs = Costs(goal.target, (360.0 / slots[able])[:, 0], passing.derivatives, degrees[able, 0])
    cost = goal.sign * costs.of(goal.least)
    violation = np.where(within & np.isfinite(cost), costs.broken(goal.bounds), np.inf)
    kept = links.of(passing.which), taken(drive, passing.which)
    return FourBars(able, *kept, passing.distance, violation, cost)


def _rows(goal: Goal) -> list[Array]:
    """Columns with half the step, the motion's ends, the roller and the slots of each wheel."""
    rows = [
        (task.wheel.step.b, *task.motion, task.roller, float(task.wheel.z)) for task in goal.wheels
    ]
    return [*np.array(rows).T]
