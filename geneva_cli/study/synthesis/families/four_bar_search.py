"""The search of a four-bar: its proportions, the crank's angle at entry, and in a range the motion.

First at places of a unit cube that are spread evenly, the same in every run; then nearer and nearer
about the best.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synthesis.families.coupler import CouplerDrive, FourBarLinks, driving, judged
from geneva_cli.study.synthesis.families.coupler_costs import Costs, order
from geneva_cli.study.synthesis.spans import Interval
from geneva_cli.study.synthesis.wish import Wish

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

SAMPLES = 6000  # four-bars that are looked at for all wheels of a wish together
FEWEST, MOST = 256, 2048  # and for one wheel
PROPORTIONS = 4.0  # coupler and rocker over the ground link, at most, and at least its inverse
CRANK = (0.05, 0.97)  # shares of the longest crank that turns all round
LOOKS, FEW, MANY = 300, 14, 60  # nearer looks for all wheels together, and for one
PARENTS, CHILDREN = 4, 12  # the best, and places about each, of a nearer look
WIDEST, NARROWEST = 0.3, 3e-3  # the first look, of a side of the cube, and the last one over it
COARSE, FINE = 16, 96  # places of a motion that are looked at
WIDER = 1.15  # times the roller for which there is room at the coarse places
OTHERS = 6  # that are offered where a bound or an order is on what this does not know
FINEST = PARENTS + OTHERS
DIMENSIONS = 5  # of what is searched: two proportions, crank, angle, and the motion of a range


class Goal(NamedTuple):
    """What is searched for: bounds to keep, and what is to be the least (``sign`` -1: greatest)."""

    wish: Wish
    wheel: Gearing
    motion: Interval
    roller: float  # of the centre distance: the roller that must have room
    bounds: tuple[Constraint, ...]
    least: str
    sign: float = 1.0


class Pool(NamedTuple):
    """Places in the unit cube, and what becomes of them."""

    unit: Array  # (n, DIMENSIONS)
    links: FourBarLinks
    drive: CouplerDrive
    broken: Array  # by how much the bounds are; infinite where there is no machine
    cost: Array  # what is to be the least
    distance: Array

    def best(self, count: int) -> Pool:
        """The best of those that are machines."""
        order = np.lexsort((self.cost, self.broken))[:count]
        order = order[np.isfinite(self.broken[order])]
        return self.taken(order)

    def taken(self, which: Any) -> Pool:
        """Some of the places."""
        return Pool(*(_taken(part, which) for part in self))


def searched(goal: Goal) -> Pool:
    """Those that keep the bounds, the best first."""
    wheels = len(goal.wish.z)
    count = min(max(SAMPLES // wheels, FEWEST), MOST)
    looks = min(max(LOOKS // wheels, FEW), MANY)
    with np.errstate(all="ignore"):
        unit, sense = np.repeat(_spread(count), 2, axis=0), np.resize([1.0, -1.0], 2 * count)
        first = _pool(goal, unit, sense, COARSE)
        found, width = first.best(PARENTS), WIDEST
        for look in range(looks):
            offset = (_spread(CHILDREN, look) - 0.5) * width
            unit = (found.unit[:, None] + offset).reshape(-1, DIMENSIONS)
            sense = np.repeat(found.drive.sense[:, 0], CHILDREN)
            found = _joined(found, _pool(goal, _inside(unit), sense, COARSE)).best(PARENTS)
            width *= NARROWEST ** (1.0 / looks)
        # those that what lies between the places spares
        every = _joined(found, first.best(OTHERS))
        fine = _pool(goal, every.unit, every.drive.sense[:, 0], FINE).best(FINEST)
    return fine.taken(fine.broken == 0.0)


def _spread(count: int, start: int = 0) -> Array:
    """Points of the unit cube, spread evenly (Roberts' sequence: multiples of the powers of g,
    g^6 = g + 1).
    """
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    points: Array = (
        0.5 + np.arange(1 + start * count, 1 + (start + 1) * count)[:, None] * powers
    ) % 1
    return points


def _inside(unit: Array) -> Array:
    """The angle goes round; what is beyond the other sides is at them."""
    inside = np.clip(unit, 0.0, 1.0)
    inside[:, 3] = unit[:, 3] % 1.0
    return inside


def _pool(goal: Goal, unit: Array, sense: Array, places: int) -> Pool:
    """What becomes of places of the cube, with wheels of some sense."""
    u, motion = unit.T[:, :, None], goal.motion
    g = np.ones(u[0].shape)
    b, c = (PROPORTIONS ** (2.0 * x - 1.0) for x in u[:2])
    longest = np.minimum(
        np.minimum(np.minimum(g, b), c), g + b + c - 2.0 * np.maximum(np.maximum(g, b), c)
    )
    links = FourBarLinks(longest * (CRANK[0] + (CRANK[1] - CRANK[0]) * u[2]), g, b, c)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    share = np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    degrees = motion.low + (motion.high - motion.low) * share
    step = goal.wheel.step
    drive = driving(links, math.tau * u[3], np.radians(degrees), step.b, sense[:, None])
    roller = goal.roller * (WIDER if places < FINE else 1.0)
    names = (goal.least, *(bound.name for bound in goal.bounds))
    told = judged(links, drive, step.b, roller, order(names), places)
    good = told.drives & (longest[:, 0] > 0.0) & (told.reach <= goal.wish.space * told.distance)
    costs = Costs(goal.wish, 360.0 / goal.wheel.z, told.derivatives, degrees[:, 0])
    cost = goal.sign * costs.of(goal.least)
    broken = np.where(good & np.isfinite(cost), costs.broken(goal.bounds), np.inf)
    return Pool(unit, links, drive, broken, cost, told.distance)


def _joined(one: Pool, two: Pool) -> Pool:
    def both(a: Any, b: Any) -> Any:
        if isinstance(a, tuple):
            return type(a)(*map(both, a, b))
        return np.concatenate((a, b))

    joined: Pool = both(one, two)
    return joined


def _taken(part: Any, which: Any) -> Any:
    if isinstance(part, tuple):
        return type(part)(*(_taken(x, which) for x in part))
    return part[which]
