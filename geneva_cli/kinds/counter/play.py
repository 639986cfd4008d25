"""The free angles of a counter's pinion over a turn of its driver, from the outlines of both.

A point of the driver, seen from the pinion's axis, lies between two teeth. Each of them can turn
towards it until its side at that radius gets there. The least of these angles over all points of
the driver's teeth and rim is how far the pinion is free, ahead and behind.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache, partial
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.kinds.counter.outlines import CounterSizes, counter_sizes, half_angles
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array

HalfAngles: TypeAlias = Callable[[Array], Array]  # of teeth, by radii
# radii and directions about the driver's axis, for inputs, of points at fractions of a line
Line: TypeAlias = Callable[[Array, Array], tuple[Array, Array]]
# free angles in some senses, for angles of input and pinion, at fractions of a line
Free: TypeAlias = Callable[[Array, Array, Sequence[float]], list[Array]]
SENSES = 1.0, -1.0  # in which the pinion turns: ahead and behind


class CounterPlay(NamedTuple):
    """Free angles of the pinion at input angles, ahead of its motion and behind; degrees.

    One that is negative is an overlap.
    """

    input_deg: Array
    ahead_deg: Array
    behind_deg: Array

    @property
    def whole_deg(self) -> Array:
        """Both together."""
        return self.ahead_deg + self.behind_deg


@lru_cache(maxsize=16)
def counter_play(mechanism: Mechanism) -> CounterPlay:
    """Return the free angles up to mid-motion, after which they are mirrored.

    Places are half a degree apart or nearer, and one is the entry, where the pinion begins to move.
    They begin two motions before mid-motion: before that the rim alone faces the pinion, and
    nothing changes. Raises GenevaError if no teeth fit.
    """
    sizes, (engagement, *_) = counter_sizes(mechanism), mechanism.engagements
    half, ratio = engagement.exit_deg, engagement.motion.jump
    begin = min(4.0 * half, 180.0)
    stretches = (-begin, -half), (-half, 0.0)
    before, moving = (np.linspace(a, b, 1 + math.ceil((b - a) / 0.5)) for a, b in stretches)
    places = np.concatenate((before[:-1], moving))
    angles = np.column_stack((places, np.maximum(places, -half) * ratio)) * DEGREE
    pinion_side = half_angles(sizes.pinion)
    ends = [_least(partial(_free, sizes, line, pinion_side), angles) for line in _lines(sizes)]
    ahead, behind = np.degrees(np.min(ends, axis=0))
    return CounterPlay(places, ahead, behind)


def _least(free: Free, angles: Array) -> tuple[Array, ...]:
    """Return the least values along a line in each sense, for angles (n, 2) of input and pinion.

    A line has at most a few minima, which 200 steps tell apart.
    """
    at = np.linspace(0.0, 1.0, 201)
    samples = zip(SENSES, free(angles, at, SENSES), strict=True)
    return tuple(_refined(free, angles, at, sense, values) for sense, values in samples)


def _refined(free: Free, angles: Array, at: Array, sense: float, values: Array) -> Array:
    """Return the least values in one sense from samples (n, k) at fractions ``at`` of the line.

    The least is searched between the neighbours of the best sample, in steps a tenth as long each
    time. The error at an end of the reachable part is 1e-9 of the line, and at a minimum inside it
    the square of that. Angles at which no sample is within reach are left out of the search.
    """
    best, fine = values.min(axis=1), np.linspace(0.0, 1.0, 21)
    within = np.flatnonzero(np.isfinite(best))
    values, rows = values[within], np.arange(len(within))
    steps = np.broadcast_to(at, values.shape)
    for _ in range(7):
        k = values.argmin(axis=1)
        before, after = np.maximum(k - 1, 0), np.minimum(k + 1, steps.shape[1] - 1)
        low, high = steps[rows, before], steps[rows, after]
        steps = low[:, None] + (high - low)[:, None] * fine
        (values,) = free(angles[within], steps, (sense,))
        best[within] = np.minimum(best[within], values.min(axis=1))
    return best


def _free(
    sizes: CounterSizes,
    driver: tuple[Line, float],
    pinion_side: HalfAngles,
    angles: Array,
    at: Array,
    senses: Sequence[float],
) -> list[Array]:
    """Return how far the pinion can turn in each sense, radians, for points of the driver.

    ``driver`` is a line of these points, and the pitch of the pinion's teeth there. Points that the
    pinion does not reach have infinity.
    """
    line, pitch = driver
    inputs, turned = angles[:, :1], angles[:, 1:]
    r, side = line(inputs, at)
    direction = math.pi - (inputs + side)
    x, y = sizes.distance + r * np.cos(direction), r * np.sin(direction)
    away = np.hypot(x, y)
    near = away <= sizes.pinion.tip
    turned = np.broadcast_to(turned, near.shape)[near]
    # from a tooth's middle
    after = np.mod(np.arctan2(y[near], x[near]) - turned + 0.5 * pitch, pitch) - 0.5 * pitch
    side, each = pinion_side(away[near]), []
    for sense in senses:
        ahead = np.where(sense * after > 0.0, 0.0, pitch) + sense * after
        spare = np.full(near.shape, np.inf)
        spare[near] = ahead - side
        each.append(spare)
    return each


def _lines(sizes: CounterSizes) -> Iterator[tuple[Line, float]]:
    """Yield lines of the driver's teeth, and of its rim and gap, with the pitch of the pinion."""
    teeth, half, step = sizes.driver, sizes.half_space, sizes.pinion.step
    driver_side = half_angles(teeth)
    for middle in (-half, half):
        for sign in (-1.0, 1.0):
            yield partial(_side, (teeth.root, teeth.tip), driver_side, middle, sign), step
        yield partial(_arc, teeth.tip, middle, teeth.half_angle(teeth.tip)), step
    for sign in (-1.0, 1.0):
        yield partial(_side, (teeth.root, sizes.rim), driver_side, sign * half, -sign), 2.0 * step
    yield partial(_rim, sizes), 2.0 * step


def _side(
    ends: tuple[float, float],
    half_angle: HalfAngles,
    middle: float,
    sign: float,
    inputs: Array,
    at: Array,
) -> tuple[Array, Array]:
    """Return points of one side of a tooth; ``ends`` are the radii of its root and its tip."""
    root, tip = ends
    r = root + (tip - root) * at
    return r, middle + sign * half_angle(r)


def _arc(
    radius: float, middle: float, half: float, inputs: Array, at: Array
) -> tuple[Array, Array]:
    """Return points of an arc about the driver's axis."""
    return radius + 0.0 * at, middle + half * (2.0 * at - 1.0)


def _rim(sizes: CounterSizes, inputs: Array, at: Array) -> tuple[Array, Array]:
    """Return points of the rim that the pinion reaches, beyond the gap."""
    L, r, tip = sizes.distance, sizes.rim, sizes.pinion.tip
    reach = math.acos((L * L + r * r - tip * tip) / (2.0 * L * r))
    side = reach * (2.0 * at - 1.0) - inputs
    gap = sizes.half_space - sizes.driver.half_angle(r)
    beyond = np.abs(np.remainder(side + math.pi, math.tau) - math.pi) >= gap
    # in the gap there is no rim: points on the axis are out of the pinion's reach
    return np.where(beyond, r, 0.0), side
