"""The free angles of a counter's pinion over a turn of its driver, from the outlines of both.

A point of the driver, seen from the pinion's axis, lies between two teeth. Each of them can turn
towards it until its side at that radius gets there. The least of these angles over all points of
the driver's teeth and rim is how far the pinion is free, ahead and behind.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.named_tuple import NamedTuple
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.known import Known
from geneva_cli.outlines.counter import CounterSizes, counter_sizes, half_angles

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

    # points of the plane of the teeth, and of that of the rim
    Lines: TypeAlias = tuple[list[tuple[Array, Array]], list[tuple[Array, Array]]]


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


@Known
def counter_play(mechanism: Mechanism) -> CounterPlay:
    """Return the free angles up to mid-motion, after which they are mirrored.

    Places are half a degree apart or nearer. They begin two motions before mid-motion: before that
    the rim alone faces the pinion, and nothing changes. Raises GenevaError if no teeth fit.
    """
    sizes, (engagement, *_) = counter_sizes(mechanism), mechanism.engagements
    half, ratio = engagement.exit_deg, engagement.motion.jump
    begin = min(4.0 * half, 180.0)
    places = np.linspace(-begin, 0.0, 1 + math.ceil(begin / 0.5))
    lines = _lines(sizes)
    ends = [
        _free(sizes, lines, x * DEGREE, max(x, -half) * ratio * DEGREE) for x in places.tolist()
    ]
    ahead, behind = np.degrees(np.array(ends)).T
    return CounterPlay(places, ahead, behind)


def _free(sizes: CounterSizes, lines: Lines, input_: float, pinion: float) -> tuple[float, float]:
    """Return how far the pinion can turn ahead and behind, radians, at an input angle."""
    ahead, behind = math.inf, math.inf
    for each, step in zip(lines, (1, 2), strict=True):
        pitch = step * sizes.pinion.step
        for r, side in each:
            direction = math.pi - (input_ + side)
            x, y = sizes.distance + r * np.cos(direction), r * np.sin(direction)
            away, at = _within(x, y, sizes.pinion.tip)
            if not len(away):
                continue
            after = np.mod(at - pinion + 0.5 * pitch, pitch) - 0.5 * pitch  # from a tooth's middle
            side_at = half_angles(sizes.pinion, away)
            spare, other = np.abs(after) - side_at, pitch - np.abs(after) - side_at
            ahead = min(ahead, float(np.where(after > 0.0, spare, other).min()))
            behind = min(behind, float(np.where(after > 0.0, other, spare).min()))
    return ahead, behind


def _within(x: Array, y: Array, reach: float) -> tuple[Array, Array]:
    """Return distances and directions of a line's points within reach, and where it gets there."""
    away = np.hypot(x, y)
    outside = away > reach
    crosses = np.flatnonzero(outside[1:] != outside[:-1])
    t = (reach - away[crosses]) / (away[crosses + 1] - away[crosses])
    on_x, on_y = (v[crosses] + t * (v[crosses + 1] - v[crosses]) for v in (x, y))
    near = ~outside
    directions = np.arctan2(np.append(y[near], on_y), np.append(x[near], on_x))
    return np.append(away[near], 0.0 * t + reach), directions


def _lines(sizes: CounterSizes) -> Lines:
    """Return radii and directions of points along the driver's teeth, and along its rim and gap."""
    teeth, half = sizes.driver, sizes.half_space
    r = np.linspace(teeth.root, teeth.tip, 301)
    own, top = half_angles(teeth, r), np.linspace(-1.0, 1.0, 101) * teeth.half_angle(teeth.tip)
    on_teeth = [(r, middle + s * own) for middle in (-half, half) for s in (-1.0, 1.0)]
    on_teeth += [(0.0 * top + teeth.tip, middle + top) for middle in (-half, half)]
    deep = np.linspace(teeth.root, sizes.rim, 301)
    gap = half - half_angles(teeth, deep)
    rim = np.linspace(gap[-1], math.tau - gap[-1], 6001)
    on_rim = [(deep, s * gap) for s in (-1.0, 1.0)]
    return on_teeth, [*on_rim, (0.0 * rim + sizes.rim, rim)]
