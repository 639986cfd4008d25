"""The contact of wheel and crank: which pieces touch, and the motion that they give the wheel.

Two points keep their distance, or a point and an edge. So the wheel's angle is a closed form of the
crank's, whose derivatives jets carry.
"""

from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, within_half_turn
from geneva_cli.numerics.jet import Jet, atan2, sin_cos, sqrt
from geneva_cli.parts.turn.free_ranges import FreeRanges
from geneva_cli.parts.turn.lazy_turn import STEEPEST
from geneva_cli.parts.turn.stops import Branches

ORDER = 3  # the jerk
NEAR = 1e-6  # radians: what is farther away does not touch
LEAST = 1e-5  # sine of the angle of a contact's normal from the direction of the wheel's axis
CORNER = 1e-9  # of the level: nearer to the end of a branch its corner touches
FIXED = 1e-9  # of L: a point so near to the crank's axis, as a disc's centre, moves no wheel


class Side(NamedTuple):
    """What touches on one side, in the fixed frame, (n,) each: a point, or an edge's foot."""

    far: Array
    ahead: Array
    radius: Array
    is_edge: Mask

    def named(self, i: int) -> str:
        """What touches at the i-th position, in words."""
        if self.is_edge[i]:
            return "a straight edge"
        return f"the arc of {self.radius[i]:.4g} mm" if self.radius[i] else "the corner"


class Contact(NamedTuple):
    """What touches at n positions; angles are radians."""

    sense: float
    L: float
    crank: Side
    wheel: Side
    turn: Array  # of the wheel
    is_known: Mask
    point: Array  # where they touch, in the wheel's own frame: (n, 2)

    def motion(self, crank_angle: Array) -> tuple[Array, ...]:
        """The wheel's angle, velocity, acceleration and jerk, by the crank's angle."""
        crank, wheel, w = self.crank, self.wheel, np.maximum(self.wheel.far, 1e-300)
        theta = Jet.variable(crank_angle, ORDER)
        # what the crank carries: a point about its axis, or the normal of an edge
        axis = np.where(crank.is_edge, 0.0, self.L)
        own = np.where(crank.is_edge, 1.0, crank.far) * np.exp(1j * crank.ahead) - axis
        sine, cosine = sin_cos((theta - theta.c[0]) * -self.sense + np.angle(own))
        x, y = cosine * np.abs(own) + axis, sine * np.abs(own)
        # The wheel's point is in a direction a with x cos a + y sin a = level, by the triangle of
        # two points and their distance, or as far as the crank's edge. Or it is the normal of the
        # wheel's edge, whose distance from the point stays.
        square, between = x * x + y * y, within_half_turn(crank.ahead - wheel.ahead)
        with np.errstate(all="ignore"):
            level = square * np.where(wheel.is_edge | crank.is_edge, 0.0, 0.5 / w)
            level += x * np.where(crank.is_edge, self.L / w, 0.0)
            level += np.hypot(x.c[0], y.c[0]) * np.cos(between) - level.c[0]
            across = square - level * level
            # a root of at least the least number has derivatives
            root = sqrt(Jet((np.maximum(across.c[0], 1e-300), *across.c[1:])))
            turn = atan2(y, x) + atan2(root, level) * np.where(between < 0.0, 1.0, -1.0)
            rates = turn.derivatives()[1:]
            stands = ~crank.is_edge & (np.abs(own) < FIXED * self.L)
            pushes = self.is_known & ~stands & (np.abs(rates[0]) <= 2.0 * STEEPEST)
        return self.turn, *[np.where(pushes, rate, 0.0) for rate in rates]


def contacts(
    free: FreeRanges, crank_angle: Array, wheel: Array, near: float = NEAR, lever: float = LEAST
) -> Contact:
    """What touches at positions (n,), of which the wheel is at an end of a free range.

    It is what ends nearest to the wheel's angle, at most ``near`` radians from it. A contact whose
    normal points to the wheel's axis but for a sine of ``lever`` touches, but does not push.
    """
    n, period = len(crank_angle), free.period
    best = np.full(n, near)
    sides, point = np.zeros((2, 4, n)), np.zeros((n, 2))
    for first in range(0, n, 16):
        for met in free.meetings(crank_angle[first : first + 16]):
            row, start, end, start_level, end_level, *both = met
            row = row + first
            # an arc about the wheel's axis pushes nothing; its ends are those of other pieces too
            is_round = sum(Branches(*each).half for each in both) > 0.0
            for place, levels in ((start, start_level), (end, end_level)):
                shift = period * np.round((place - wheel[row]) / period)
                off = np.abs(place - wheel[row] - shift)
                k = np.flatnonzero((off < best[row]) & ~is_round)
                level, off, rows = levels[k], off[k], row[k]
                crank_side, wheel_side = (Branches(*each.take(k, axis=1)) for each in both)
                ours, theirs = _side(crank_side, level), _side(wheel_side, level)
                theirs[1] += wheel[rows] + shift[k]
                # the sine between normal and the direction from the wheel's axis
                p, w = (side[0] * np.exp(1j * side[1]) for side in (ours, theirs))
                normal = np.where(theirs[3] > 0.5, np.exp(1j * theirs[1]), p - w)
                normal = np.where(ours[3] > 0.5, np.exp(1j * ours[1]), normal)
                z = level * np.exp(1j * free.stops.place(crank_side, level))
                size = np.abs(normal) * np.abs(z)
                sine = np.abs((normal.conjugate() * z).imag) / np.maximum(size, 1e-300)
                sine = np.where(np.abs(normal) > 1e-9 * np.abs(z), sine, 0.0)
                own = free.stops.place(wheel_side, level) + shift[k]
                able = np.flatnonzero(sine > lever)
                able = able[np.argsort(-off[able], kind="stable")]  # the nearest one comes last
                at, level, own = rows[able], level[able], own[able]
                best[at], sides[:, :, at] = off[able], np.array((ours, theirs))[:, :, able]
                point[at] = np.column_stack((level * np.cos(own), level * np.sin(own)))
    crank, own_side = (Side(s[0], s[1], s[2], s[3] > 0.5) for s in sides)
    return Contact(free.sense, free.L, crank, own_side, wheel, best < near, point)


def _side(branch: Branches, level: Array) -> Array:
    """What of branches touches at a level, as ``Side``: a corner, a circle's centre, or an edge."""
    near = CORNER * np.maximum(level, 1e-300)
    at_low, at_high = level - branch.low <= near, branch.high - level <= near
    is_corner, is_line = at_low | at_high, branch.size == 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = 1.0 / branch.size
        centre = np.where(is_line, branch.excess, branch.excess + radius)
    corner_at = np.where(at_low, branch.at_low, branch.at_high)
    far = np.where(is_corner, level, centre)
    ahead = branch.ahead + np.where(is_corner, branch.sign * corner_at, 0.0)
    radius = np.where(is_corner | is_line, 0.0, radius)
    return np.array((far, ahead, radius, ~is_corner & is_line))
