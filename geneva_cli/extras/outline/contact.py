"""The contact of wheel and crank: which pieces touch, and the motion that they give the wheel.

Each side is a circle or a corner about a point that its body carries, or a straight edge. Two
points keep their distance, and a point keeps its distance from an edge. So the wheel's angle is a
closed form of the crank's, whose derivatives jets carry: they need no differences.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, within_half_turn
from geneva_cli.numerics.jet import Jet, atan2, sin_cos, sqrt
from geneva_cli.parts.turn.free_ranges import FreeRanges
from geneva_cli.parts.turn.lazy_turn import STEEPEST
from geneva_cli.parts.turn.stops import Branches, Meetings

ORDER = 3  # the jerk
NEAR = 1e-6  # radians: what is farther away does not touch
LEAST = 1e-5  # sine of the angle of a contact's normal from the direction of the wheel's axis
CORNER = 1e-9  # of the level: nearer to the end of a branch its corner touches

FIXED = 1e-9  # of L: a point so near to the crank's axis, as a disc's centre, moves no wheel


class Side(NamedTuple):
    """What touches on one side, in the fixed frame, (n,) each: a point, or an edge's foot.

    ``far`` and ``ahead`` are polar coordinates about the wheel's axis; the foot is the edge's
    nearest point to it. ``radius`` is that of the circle about the point, 0 of a corner.
    """

    far: Array
    ahead: Array
    radius: Array
    is_edge: Mask


class Contact(NamedTuple):
    """What touches at n positions; angles are radians.

    ``point`` is where they touch, in the wheel's own frame.
    """

    sense: float
    L: float
    crank: Side
    wheel: Side
    turn: Array  # of the wheel
    is_known: Mask
    point: Array  # (n, 2)

    def motion(self, crank_angle: Array) -> tuple[Array, ...]:
        """Return the wheel's angle, velocity, acceleration and jerk, by the crank's angle.

        Positions without a contact have a velocity of 0.
        """
        theta = Jet.variable(crank_angle, ORDER)
        forms = (self._points(theta), self._on_wheel(theta), self._on_crank(theta))
        x, y = self.crank.far * np.cos(self.crank.ahead), self.crank.far * np.sin(self.crank.ahead)
        stands = ~self.crank.is_edge & (np.hypot(x - self.L, y) < FIXED * self.L)
        which = np.where(self.wheel.is_edge, 1, np.where(self.crank.is_edge, 2, 0))
        rest = (self.turn, *[np.zeros(len(self.turn))] * ORDER)
        out = []
        velocity = np.choose(which, [form[1] for form in forms])
        pushes = self.is_known & ~stands & (np.abs(velocity) <= 2.0 * STEEPEST)
        for k in range(ORDER + 1):
            value = np.choose(which, [form[k] for form in forms])
            out.append(np.where(pushes, value, rest[k]))
        return tuple(out)

    def named(self, i: int) -> tuple[str, str]:
        """Return what touches of the wheel and of the crank, in words."""
        out = []
        for side in (self.wheel, self.crank):
            radius = side.radius[i]
            arc = f"the arc of {radius:.4g} mm" if radius else "the corner"
            out.append("a straight edge" if side.is_edge[i] else arc)
        return out[0], out[1]

    def _crank_point(self, theta: Jet) -> tuple[Jet, Jet]:
        """Return x and y of the point that the crank carries, as the crank turns."""
        x, y = self.crank.far * np.cos(self.crank.ahead), self.crank.far * np.sin(self.crank.ahead)
        radius, ahead = np.hypot(x - self.L, y), np.arctan2(y, x - self.L)
        s, c = sin_cos((theta - theta.c[0]) * -self.sense + ahead)
        return c * radius + self.L, s * radius

    def _points(self, theta: Jet) -> tuple[Array, ...]:
        """Return the motion with two points at a constant distance."""
        x, y = self._crank_point(theta)
        w = np.maximum(self.wheel.far, 1e-300)
        between = within_half_turn(self.crank.ahead - self.wheel.ahead)
        square = x * x + y * y
        # the angle between both points, seen from the wheel's axis, from the triangle's sides
        d2 = self.crank.far**2 + w * w - 2.0 * self.crank.far * w * np.cos(between)
        along = square + w * w - d2  # 2 rho w cos
        across = square * (4.0 * w * w) - along * along
        return self._angle(x, y, across, along, between)

    def _on_wheel(self, theta: Jet) -> tuple[Array, ...]:
        """Return the motion with a point of the crank at a constant distance from an edge."""
        x, y = self._crank_point(theta)
        between = within_half_turn(self.crank.ahead - self.wheel.ahead)
        h = self.crank.far * np.cos(between)
        along = (x * 0.0) + h
        across = x * x + y * y - h * h
        return self._angle(x, y, across, along, between)

    def _angle(self, x: Jet, y: Jet, across: Jet, along: Jet, between: Array) -> tuple[Array, ...]:
        """Return the wheel's angle: that of the crank's point less the angle between both."""
        with np.errstate(all="ignore"):
            gamma = atan2(sqrt(_positive(across)), along)
            psi = atan2(y, x) - gamma * np.where(between < 0.0, -1.0, 1.0)
            return _from(psi, self.turn)

    def _on_crank(self, theta: Jet) -> tuple[Array, ...]:
        """Return the motion with a point of the wheel at a constant distance from an edge."""
        # the edge's normal through the wheel's axis points to its foot
        normal = (theta - theta.c[0]) * -self.sense + self.crank.ahead
        between = within_half_turn(self.wheel.ahead - self.crank.ahead)
        w = np.maximum(self.wheel.far, 1e-300)
        # the distance of the edge from the crank's axis stays as it is
        cosine = sin_cos(normal)[1]
        own = self.crank.far - self.L * np.cos(self.crank.ahead)
        gap = w * np.cos(between) - self.crank.far
        along = cosine * self.L + own + gap
        across = w * w - along * along
        with np.errstate(all="ignore"):
            gamma = atan2(sqrt(_positive(across)), along)
            psi = normal + gamma * np.where(between < 0.0, -1.0, 1.0)
            return _from(psi, self.turn)


def _positive(x: Jet) -> Jet:
    """A jet whose value is at least the least number: its root has derivatives."""
    return Jet((np.maximum(x.c[0], 1e-300), *x.c[1:]))


def _from(psi: Jet, turn: Array) -> tuple[Array, ...]:
    """The derivatives of a jet, with the wheel's angle in place of its own, which has an offset."""
    return (turn, *psi.arrays()[1:])


def contacts(
    free: FreeRanges, crank_angle: Array, wheel: Array, near: float = NEAR, lever: float = LEAST
) -> Contact:
    """Return what touches at positions (n,), of which the wheel is at an end of a free range.

    Of several contacts it is the one whose interval ends nearest to the wheel's angle, at most
    ``near`` radians from it. The sine of the angle between its normal and the direction from the
    wheel's axis is above ``lever``: a smaller one touches, but does not push.
    """
    n = len(crank_angle)
    best = np.full(n, near)
    sides, point = np.zeros((2, 4, n)), np.zeros((n, 2))
    for met in _near(free, crank_angle, wheel):
        for place, level in ((met.start, met.start_level), (met.end, met.end_level)):
            off = place - wheel[met.row]
            shift = free.period * np.round(off / free.period)
            off = np.abs(off - shift)
            # an arc about the wheel's axis pushes nothing; its ends are those of other pieces too
            is_round = met.wheel.half + met.other.half > 0.0
            k = np.flatnonzero((off < best[met.row]) & ~is_round)
            one, rows = met.other.at(k), met.row[k]
            at = free.stops.place(one, level[k])
            touched = np.column_stack((level[k] * np.cos(at), level[k] * np.sin(at)))
            ours, theirs = _side(one, level[k]), _side(met.wheel.at(k), level[k])
            theirs[1] += wheel[rows] + shift[k]
            own = free.stops.place(met.wheel.at(k), level[k]) + shift[k]
            able = np.flatnonzero(_lever(ours, theirs, touched) > lever)
            able = able[np.argsort(-off[k][able], kind="stable")]  # the nearest one comes last
            for i in able:
                best[rows[i]] = off[k[i]]
                point[rows[i]] = level[k[i]] * np.cos(own[i]), level[k[i]] * np.sin(own[i])
                sides[:, :, rows[i]] = ours[:, i], theirs[:, i]
    crank, own_side = (Side(s[0], s[1], s[2], s[3] > 0.5) for s in sides)
    return Contact(free.sense, free.L, crank, own_side, wheel, best < near, point)


def _lever(ours: Array, theirs: Array, touched: Array) -> Array:
    """Return the sine of the angle between contact normals and directions from the wheel's axis."""
    p, w = (side[0] * np.exp(1j * side[1]) for side in (ours, theirs))
    normal = np.where(theirs[3] > 0.5, np.exp(1j * theirs[1]), p - w)
    normal = np.where(ours[3] > 0.5, np.exp(1j * ours[1]), normal)
    at = touched[:, 0] + 1j * touched[:, 1]
    size = np.abs(normal) * np.abs(at)
    sine = np.abs((normal.conjugate() * at).imag) / np.maximum(size, 1e-300)
    return np.where(np.abs(normal) > 1e-9 * np.abs(at), sine, 0.0)


def _near(free: FreeRanges, crank_angle: Array, wheel: Array) -> list[Meetings]:
    """Return the pairs of branches that may touch at positions, a block at a time."""
    out = []
    for i in range(0, len(crank_angle), 16):
        angles = crank_angle[i : i + 16]
        for met in free.meetings(angles):
            out.append(met._replace(row=met.row + i))
    return out


def _side(branch: Branches, level: Array) -> Array:
    """Return what of branches touches at a level: its corner, its circle's centre, or its edge."""
    near = CORNER * np.maximum(level, 1e-300)
    at_low, at_high = level - branch.low <= near, branch.high - level <= near
    corner_at = np.where(at_low, branch.at_low, branch.at_high)
    is_corner = at_low | at_high
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = branch.excess + 1.0 / branch.size
    is_edge = ~is_corner & (branch.size == 0.0)
    far = np.where(is_corner, level, np.where(branch.size == 0.0, branch.excess, centre))
    ahead = branch.ahead + np.where(is_corner, branch.sign * corner_at, 0.0)
    with np.errstate(divide="ignore"):
        radius = np.where(is_corner | is_edge, 0.0, 1.0 / branch.size)
    return np.array((far, ahead, radius, is_edge))
