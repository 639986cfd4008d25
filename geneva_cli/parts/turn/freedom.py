"""How far the wheel can be turned from its position until parts touch, at given input angles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.roots_many import End, boundary_many
from geneva_cli.parts.turn.turned import Pose, Turned

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

# radians, of the wheel: a roller of r mm reaches (L STEP)^2 / (8 r) into such a step
STEP = 1e-3
AHEAD = 32  # such steps that are looked at together, and
TOGETHER = 1 << 13  # positions of all times the wheel's pieces, at most
EXACT = 1e-10  # radians: an angle is found to this,
SHARE = 1e-7  # or to this share of it


def search_deg(parts: Turned) -> float:
    """The largest play that is looked for, half a step: beyond it the wheel's position is lost."""
    return math.degrees(min(engagement.half_step for engagement, _ in parts.assembly.rollers))


def free_angles(parts: Turned, at: Array) -> tuple[Array, Array]:
    """How far the wheel can be turned back and on at input angles (n,), radians, (n,) each."""
    count = len(at)
    pose = parts.gaps.pose(at)
    both = np.concatenate((np.arange(count), np.arange(count)))
    found = _stopped(parts, pose.at(both), np.repeat((-1.0, 1.0), count))
    return found[:count], found[count:]


def touching(parts: Turned) -> float:
    """The largest play, radians, that may be none: parts that touch tangentially part slowly.

    It is the angle by which two circles of the rim's radius overlap by ``close``.
    """
    return math.sqrt(2.0 * parts.close / parts.sizes.rim)


def _stopped(parts: Turned, pose: Pose, way: Array) -> Array:
    """How far the wheel can be turned one way (1 on, -1 back) in each pose until parts touch.

    It is turned in steps in which no point of it moves farther than the gap, or than STEP: what a
    step of that size could skip is less deep than the parts are exact.
    """
    most, together = math.radians(search_deg(parts)), TOGETHER // len(parts.gaps.around)
    count, gaps, close = len(way), parts.gaps, parts.close
    low, high = np.zeros(count), np.full(count, np.inf)
    g_low = gaps.gap(pose, low, gaps.near) + close
    g_high = np.full(count, -1.0)
    here = np.flatnonzero(g_low >= 0.0)  # where parts overlap as it stands there is no play
    high[g_low < 0.0] = 0.0
    ahead = 1
    while len(here):
        first = low[here] + np.maximum(g_low[here] / _reach(parts), STEP)
        x = np.minimum(first[:, None] + STEP * np.arange(ahead), most)
        turned = (way[here, None] * x).ravel()
        g = gaps.gap(pose.at(np.repeat(here, ahead)), turned, gaps.near).reshape(x.shape) + close
        past = np.logical_and.accumulate(g >= 0.0, axis=1).sum(axis=1)  # how many before a stop
        free, stopped = np.flatnonzero(past > 0), np.flatnonzero(past < ahead)
        last = free, past[free] - 1
        low[here[free]], g_low[here[free]] = x[last], g[last]
        stop = stopped, past[stopped]
        high[here[stopped]], g_high[here[stopped]] = x[stop], g[stop]
        here = here[(past == ahead) & (x[:, -1] < most)]
        ahead = max(1, min(2 * ahead, AHEAD, together // max(len(here), 1)))
    here = np.flatnonzero((high < np.inf) & (high > 0.0))

    def left(which: NDArray[np.intp], x: Array, width: float) -> Array:
        near = min(_reach(parts) * width, gaps.near)
        return gaps.gap(pose.at(here[which]), way[here[which]] * x, near) + close

    good, bad = End(low[here], g_low[here]), End(high[here], g_high[here])
    low[here] = boundary_many(left, good, bad, lambda x: np.maximum(EXACT, SHARE * x))
    return low


def _reach(parts: Turned) -> float:
    """The greatest distance of the wheel's points from its axis."""
    return max(parts.sizes.rim, parts.sizes.outer)
