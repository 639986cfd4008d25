"""Straight slots whose axes miss the wheel's centre by e, in units of the centre distance L.

Shockless at both ends where the slot's axis is tangent to the crank's circle: l = sin b cos d with
d = asin(e / cos b). The crank's angle of motion stays 180° - 2b and the two ends trade their jumps:
entry l / cos(b - d), exit l / cos(b + d). At |e| = cos² b, where b + |d| = 90°, the gentler of the
slot's ends would meet the wheel's centre line: all that is small there is written as a product with
the distance to that limit, which is taken once, exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from geneva_cli.machine.engagement import Anchor, SlotDriven, turned
from geneva_cli.machine.wheels.classic import gap, half_motion_deg
from geneva_cli.machine.wheels.poses import Pose, Step, middle
from geneva_cli.numerics.angles import cos_squared_less, sin_cos_pi
from geneva_cli.numerics.jet import Coefficient, Jet, integral, library, piecewise, sqrt


class Skew(NamedTuple):
    """Proportions of an offset slot."""

    e: float
    tilt: float  # d, radians: the slot against the line of centres, half-way through the step
    deepest: float  # least coordinate of the pin along the slot's axis: at mid-motion
    poses: tuple[Pose, Pose, Pose]
    # at both ends in the slot's own frame, whose axis runs at -e beside the ray from the wheel's
    # centre; in the middle in that of the line of centres


def skew(step: Step, e: float) -> Skew:
    """The slot of offset e for half an index angle b. Raises ValueError unless |e| < cos² b."""
    spare = cos_squared_less(*step, abs(e))
    if not spare > 0.0:
        raise ValueError
    sin_b, cos_b = step.sin_cos
    less = 2.0 * sin_cos_pi(step.p, 2 * step.q)[0] ** 2  # 1 - cos b
    size = abs(e) / cos_b  # |sin d|
    # cos b - |e| = (cos² b - |e|) + cos b (1 - cos b)
    cos_d = math.sqrt((spare + cos_b * less) * (cos_b + abs(e))) / cos_b
    d = math.atan2(size, cos_d)
    wide = cos_b * cos_d + sin_b * size  # cos(b - |d|), a sum of positive terms
    near = spare / cos_b * (cos_b + size)  # cos² b - sin² d
    narrow = near / wide  # cos(b + |d|)
    deepest = near / (cos_d + sin_b)  # cos d - sin b
    least = gap("external", *step) + sin_b * size * size / (1.0 + cos_d)  # 1 - l
    l = sin_b * cos_d
    long = half_motion_deg("external", *step) + math.degrees(d)
    short = math.degrees(math.atan2(narrow, sin_b * cos_d + cos_b * size))
    turn = math.atan2(size * (sin_b - cos_d * less), deepest * cos_d + abs(e) * size)
    mid = middle("external", l, least)
    if e > 0.0:
        poses = (
            Pose(-long, -step.b, wide, (-l, 0.0), (0.0, l)),
            mid._replace(wheel=turn),
            Pose(short, step.b, narrow, (l, 0.0), (0.0, -l)),
        )
    else:
        poses = (
            Pose(-short, -step.b, narrow, (-l, 0.0), (0.0, l)),
            mid._replace(wheel=-turn),
            Pose(long, step.b, wide, (l, 0.0), (0.0, -l)),
        )
    return Skew(e, math.copysign(d, e), deepest, poses)


class OffsetDriven(SlotDriven):
    """Pin path and an offset straight slot are known and give the motion."""

    def __init__(
        self, mid_deg: float, half_step: float, anchors: tuple[Anchor, ...], slot: Skew
    ) -> None:
        super().__init__(mid_deg, half_step, anchors)
        self.slot, self.offset = slot, slot.e

    def motion(self, input_deg: Coefficient, order: int = 3) -> Jet:
        """The slot's direction, taken from the nearest anchor: exactly at rest at both ends."""
        first, last = (self._from_end(self.anchors[i], order) for i in (0, -1))
        return piecewise(input_deg, self._cuts, [first, lambda x: self._inside(x, order), last])

    def _from_end(self, anchor: Anchor, order: int) -> Callable[[Coefficient], Jet]:
        """About entry or exit, where the pin is at (along, -e) in the slot's frame.

        The slot's axis passes the pin at (s, -e) with s² = rho² - e². What s gains on ``along`` is
        written so that it vanishes with ``across``, and the wheel's angle and speed with both.
        """
        e = self.slot.e

        def solve(x: Coefficient) -> Jet:
            along, across = anchor.place(x, order)
            more = across * (across - 2.0 * e)  # s² - along²
            square = along * along + more
            s = sqrt(square)
            gain = more / (s + along)
            a, b, g, s0 = along.c[0], across.c[0], gain.c[0], s.c[0]
            value = library(a).atan2(b * s0 - g * e, a * s0 - (b - e) * e) + anchor.wheel
            return _turning(along, across, gain * e, square + e * e, value)

        return solve

    def _inside(self, x: Coefficient, order: int) -> Jet:
        """About mid-motion: the pin's direction, and less what the slot's gains on it."""
        e, deepest, mid = self.slot.e, self.slot.deepest, self.middle
        toward, across = mid.way(x, order)
        s, rho2 = self._depth(toward)
        along = toward + mid.along
        m, u, depth = library(across.c[0]), toward.c[0], s.c[0]
        value = m.atan2(across.c[0], along.c[0]) + mid.wheel
        # atan2(e, deepest) - atan2(e, s)
        value -= m.atan2(2.0 * u / (depth + deepest) * e, depth * deepest + e * e)
        return _turning(along, across, s * e, rho2, value)

    def _depth(self, toward: Jet) -> tuple[Jet, Jet]:
        """Coordinate s of the pin along its slot's axis, and rho² = s² + e².

        From mid-motion the pin goes by u = l (1 - cos a) along the line of centres, and there
        s² = deepest² + 2 u, a sum of positive terms.
        """
        square = toward * 2.0 + self.slot.deepest**2
        return sqrt(square), square + self.slot.e**2

    def pitch(self, input_deg: Coefficient, order: int = 3) -> tuple[Jet, Jet]:
        """The pin runs along the slot's straight axis."""
        depth = self._depth(self.middle.way(input_deg, order)[0])[0]
        return turned(depth, depth * 0.0 - self.slot.e, self.slot.tilt)

    def rail(self, input_deg: Coefficient, order: int = 0) -> tuple[Jet, Jet]:
        """Lever of the slot's normal about the wheel's axis, and the pin's speed along it."""
        depth = self._depth(self.middle.way(input_deg, order + 1)[0])[0]
        return Jet(depth.c[:-1]), depth.derivative()


def _turning(x: Jet, y: Jet, lever: Jet, rho2: Jet, value: Coefficient) -> Jet:
    """A wheel's angle from its rate, (x y' - y x' - e s') / rho², for ``lever`` = e s."""
    if not x.order:
        return Jet((value,))
    low_x, low_y, low_rho2 = Jet(x.c[:-1]), Jet(y.c[:-1]), Jet(rho2.c[:-1])
    across = low_x * y.derivative() - low_y * x.derivative()
    return integral((across - lever.derivative()) / low_rho2, value)
