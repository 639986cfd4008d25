"""Engagements with a known pin path and straight slot, whose motion is solved for."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise

from geneva_cli.motion.engagement import (
    Anchor,
    Level,
    Peak,
    Slot,
    SlotAxis,
    WheelMotion,
)
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Batchable, Whole, array, library, parameter, picked
from geneva_cli.numerics.jet import (
    Array,
    Jet,
    Number,
    atan2,
    piecewise,
    sin,
    sin_cos,
    sqrt,
    turning,
)

END_DEG = 0.05  # nearer than this to entry or exit, angle and velocity keep their relative accuracy


class AnchoredPath(Batchable):
    """A pin path written about several anchors: entry, mid-motion, exit, and others between.

    Each input angle uses the nearest anchor; those of both ends serve only near the ends, where the
    motion vanishes. ``cuts`` are the input angles at which one anchor hands over to the next.
    ``ahead`` is the angle from the line of centres to the middle anchor's ray, in radians.
    """

    def __init__(self, anchors: tuple[Anchor, ...], ahead: float = 0.0) -> None:
        self.anchors, self.ahead = anchors, ahead
        self.cuts = cuts([anchor.input_deg for anchor in anchors])

    @property
    def middle(self) -> Anchor:
        """Anchor of mid-motion."""
        return self.anchors[len(self.anchors) // 2]

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) on its path at input angles in degrees from mid-motion."""
        along, across = self.from_middle(input_deg, order)
        return turned(along, across, self.ahead)

    def from_middle(self, input_deg: Number, order: int) -> tuple[Jet, Jet]:
        """Pin along the middle anchor's ray and across it."""
        return self.middle.place(input_deg, order)

    def nearest(self, input_deg: Number, order: int) -> tuple[Jet, Jet, Number]:
        """Pin along the nearest anchor's ray and across it; and the ray's direction, radians."""
        if isinstance(self.cuts[0], float) and isinstance(self.cuts[-1], float):
            places = [partial(anchor.stacked, order=order) for anchor in self.anchors]
            all_three = piecewise(input_deg, self.cuts, places).c
            return Jet(all_three[: order + 1]), Jet(all_three[order + 1 : -1]), all_three[-1]
        # the anchors of a batch differ in numbers only, so that one call serves all of them
        x = array(input_deg)
        first, *others = [x > cut for cut in self.cuts]
        index: Whole = first.astype(int)  # laid out as the angles
        for past in others:
            index = index + past
        low, high = int(index.min(initial=len(self.anchors) - 1)), int(index.max(initial=0))
        anchor = self.anchors[high]  # any anchor will do for no angles
        if low < high:
            anchor = picked(index - low, self.anchors[low : high + 1])
        return (*anchor.place(input_deg, order), anchor.wheel)


def cuts(degrees: Sequence[float]) -> list[float]:
    """Input angles at which one anchor hands over to the next: half-way, nearer to both ends."""
    first, *inner, last = degrees
    near_end = 0.75  # fraction of the span from the last inner anchor to an end
    return [
        inner[0] + near_end * (first - inner[0]),
        *[0.5 * (a + b) for a, b in pairwise(inner)],
        inner[-1] + near_end * (last - inner[-1]),
    ]


class RadialSlot(Slot):
    """A straight slot towards the wheel's centre."""

    def __init__(self, path: AnchoredPath) -> None:
        self.path = path

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin (x, y) in the wheel, on the slot's straight axis."""
        depth = _length(self.path.from_middle(input_deg, order))
        return turned(depth, depth * 0.0, self.path.ahead - self.path.middle.wheel)

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        """Lever of the slot's normal about the wheel's axis, and the pin's speed along it."""
        along, across, _ = self.path.nearest(input_deg, order + 1)
        depth = _length((along, across))
        return SlotAxis(depth.lower, depth.derivative())


class MeridianSlot(Slot):
    """A spherical wheel's slot, a meridian.

    The path is the pin's projection along the wheel's axis. The pitch curve is in the flat
    development from the wheel's pole, which keeps lengths along a meridian.
    """

    def __init__(self, path: AnchoredPath, height: Level) -> None:
        self.path = path
        self.level = self.height = height

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Pin's polar angle on the wheel in radians: arc length over the sphere's radius."""
        x, y = self.path(input_deg, order)
        polar = atan2(sqrt(x * x + y * y), self.level(radians(input_deg), order))
        return polar, polar * 0.0

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        """Lever (the pin's distance from the wheel's axis) and the pin's speed along the slot."""
        polar = self(input_deg, order + 1)[0]
        return SlotAxis(sin(polar.lower), polar.derivative())

    def upright(self, input_deg: Number, order: int = 0) -> Jet:
        """Cosine of the pin's polar angle: the roller's axis passes through the sphere's centre."""
        return sin_cos(self(input_deg, order)[0])[1]


class StraightSlotMotion(WheelMotion):
    """Motion of a wheel whose straight slot follows the pin."""

    def __init__(self, path: AnchoredPath, half_step: float, mirrored: bool = True) -> None:
        super().__init__(path.anchors[0].input_deg, path.anchors[-1].input_deg, half_step)
        self.path, self.mirrored = path, mirrored

    @property
    def entry(self) -> Anchor:
        """Anchor of the entry."""
        return self.path.anchors[0]

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        """Peak of a quantity from ``closed_peaks``, or None if it has none."""
        return self.closed_peaks(quantity) if self.closed_peaks else None

    @property
    def seams_deg(self) -> tuple[float, ...]:
        """Entry, mid-motion, where one anchor hands over to the next, the path's own, and exit."""
        path = self.path
        places = {0.0, *path.cuts, *[at for one in path.anchors for at in one.seams_deg]}
        inside = sorted(at for at in places if self.entry_deg < at < self.exit_deg)
        return (self.entry_deg, *inside, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        """Wheel angle from the direction of the pin at the nearest anchor; at rest at both ends."""
        along, across, ray = self.path.nearest(input_deg, order)
        return atan2(across, along) + ray

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        """Rate at which the pin's direction turns, computed without an arc tangent."""
        along, across, _ = self.path.nearest(input_deg, order + 1)
        return turning(along, across)


class ClassicMotion(StraightSlotMotion):
    """Motion of a straight radial slot on a plain crank, with its closed forms.

    ``sign`` is +1 for an external wheel and -1 for an internal one; l = sin b and ``rest`` = 1 - l.
    """

    def __init__(
        self,
        path: AnchoredPath,
        half_step: float,
        sign: float,
        l: float,
        rest: float,
    ) -> None:
        super().__init__(path, half_step)
        self.sign, self.l, self.rest = sign, l, rest

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        """Peak of velocity, acceleration, jerk or power in closed form."""
        outside = self.sign > 0.0
        gap = self.rest if outside else 1.0 + self.l
        if quantity == "velocity":
            return Peak(classic.velocity_peak(self.l, gap), 0.0)
        if quantity == "acceleration" and not outside:  # the jump at entry
            jump = parameter(self(self.entry_deg, 2).derivatives()[2])
            return Peak(abs(jump), self.entry_deg)
        if quantity == "acceleration":
            size, at_deg = classic.acceleration_peak(self.l, gap)
        elif quantity == "jerk":
            size, at_deg = classic.jerk_peak(self.l, gap, self.exit_deg)
        else:
            size, at_deg = classic.power_peak(self.l, gap)
        return Peak(size, 0.0 - at_deg)

    def _requested(self, input_deg: Array, orders: Sequence[int]) -> list[Array]:
        """Wheel angle and its derivatives in closed form.

        Near the ends, angle and velocity are computed from the end to keep their relative accuracy.
        """
        if not isinstance(self.l, float):
            return super()._requested(input_deg, orders)
        from geneva_cli.motion.wheels import classic_arrays

        out = classic_arrays.derivatives(self.sign, self.l, self.rest, input_deg, orders)
        first = int(input_deg.searchsorted(self.entry_deg + END_DEG))
        last = int(input_deg.searchsorted(self.exit_deg - END_DEG))
        for part, side in ((slice(0, first), -1.0), (slice(last, None), 1.0)):
            for k, o in zip(orders, out, strict=True):
                if k < 2 and len(o[part]):
                    o[part] = self._near_end(input_deg[part], side, k)
        return out

    def _near_end(self, input_deg: Array, side: float, order: int) -> Array:
        """Angle or velocity near exit (side 1) or entry (-1), computed from that end."""
        import numpy as np

        tau = radians(self.exit_deg - side * input_deg)
        along = self.path.anchors[0].along - self.sign * self.l * np.sin(tau)
        across = 2.0 * self.l * np.sin(0.5 * tau) ** 2
        if order == 0:
            angle: Array = side * (self.half_step - np.arctan2(across, along))
            return angle
        half = radians(self.exit_deg) - 0.5 * tau
        speed = 2.0 * self.l * np.sin(0.5 * tau) * np.sin(half)
        velocity: Array = speed / (along * along + across * across)
        return velocity


def _length(vector: tuple[Jet, Jet]) -> Jet:
    x, y = vector
    return sqrt(x * x + y * y)


def turned(x: Jet, y: Jet, angle: float) -> tuple[Jet, Jet]:
    """Turn a vector by a fixed angle in radians."""
    if isinstance(angle, float) and angle == 0.0:
        return x, y
    m = library(angle)
    s, c = m.sin(angle), m.cos(angle)
    return x * c - y * s, x * s + y * c
