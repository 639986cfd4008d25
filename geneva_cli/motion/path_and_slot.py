"""Engagements with a known pin path and straight slot, whose motion is solved for.

And the pitch curve of any slot: its tangent, curvature and pressure angle, in jets of any numbers.
"""

from functools import lru_cache
from itertools import pairwise
from operator import attrgetter
from typing import NamedTuple, cast

from geneva_cli.motion import engagement as base
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.arrays import SINGLE, Batchable, array, library, picked, piece_of, size
from geneva_cli.numerics.jet import Array, Jet, Number, Vector, atan2, sqrt, turned, turning

# Where an anchor of an end takes over: this fraction of the span to it from the anchor inside.
NEAR_END = 0.75


class AnchoredPath(Batchable):
    """A pin path written about several anchors: entry, mid-motion, exit, and others between.

    Each input angle uses the nearest anchor; those of both ends serve only near the ends, where the
    motion vanishes. ``cuts`` are the input angles at which one anchor hands over to the next.
    ``ahead`` is the angle from the line of centres to the ray of the ``middle`` anchor, in radians.
    """

    def __init__(self, anchors: tuple[base.Anchor, ...], ahead: float = 0.0) -> None:
        self.anchors, self.ahead = anchors, ahead
        self.middle = anchors[len(anchors) // 2]  # of mid-motion
        first, *inner, last = map(attrgetter("input_deg"), anchors)
        # half-way, and nearer to both ends
        self.cuts = [inner[0] + NEAR_END * (first - inner[0])]
        for before, after in pairwise(inner):
            self.cuts.append(0.5 * (before + after))
        self.cuts.append(inner[-1] + NEAR_END * (last - inner[-1]))

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Pin (x, y) on its path at input angles in degrees from mid-motion."""
        along, across = self.middle(input_deg, order)
        return turned(along, across, self.ahead)

    def nearest(self, input_deg: Number, order: int) -> tuple[Jet, Jet, Number]:
        """Pin along the nearest anchor's ray and across it; and the ray's direction, radians."""
        single = isinstance(input_deg, SINGLE) and isinstance(self.cuts[0], float)
        if single and isinstance(self.cuts[-1], float):
            anchor = self.anchors[piece_of(input_deg, self.cuts)]
        else:
            x, first = array(input_deg), self.cuts[0]
            index = (x > first).astype(int)  # laid out as the angles
            for cut in self.cuts[1:]:
                index = index + (x > cut)
            low, high = int(index.min(initial=len(self.cuts))), int(index.max(initial=0))
            anchor = self.anchors[high]  # any anchor will do for no angles
            if low < high:  # anchors differ in numbers only, so that one call serves all of them
                anchor = picked(index - low, self.anchors[low : high + 1])
        return (*anchor(input_deg, order), anchor.wheel)


class RadialSlot(base.Slot):
    """A straight slot towards the wheel's centre."""

    def __init__(self, path: AnchoredPath) -> None:
        self.path, self.tilt = path, path.ahead - path.middle.wheel

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        x, y = self.path.middle(input_deg, order)
        return turned(sqrt(x * x + y * y), x * 0.0, self.tilt)

    def place(self, input_deg: Number, order: int) -> Jet:
        along, across, _ = self.path.nearest(input_deg, order)
        return sqrt(along * along + across * across)


class StraightSlotMotion(base.WheelMotion):
    """Motion of a wheel whose straight slot follows the pin.

    ``closed`` is for a radial slot on a plain crank, whose peaks have closed forms: 1 for an
    external wheel or -1 for an internal one, l = sin b and 1 - l.
    """

    entry: base.Anchor

    def __init__(
        self,
        path: AnchoredPath,
        half_step: float,
        mirrored: bool = True,
        closed: tuple[float, float, float] | None = None,
    ) -> None:
        self.entry, self.half_step = path.anchors[0], half_step
        self.entry_deg, self.exit_deg = self.entry.input_deg, path.anchors[-1].input_deg
        self.path, self.mirrored, self.closed = path, mirrored, closed

    @property
    def seams_deg(self) -> tuple[float, ...]:
        inside = [self.entry_deg]
        for at in sorted({0.0, *self.path.cuts}):
            if self.entry_deg < at < self.exit_deg:
                inside.append(at)
        return (*inside, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        along, across, ray = self.path.nearest(input_deg, order)
        return atan2(across, along) + ray

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        along, across, _ = self.path.nearest(input_deg, order + 1)
        return turning(along, across)

    def closed_peak(self, quantity: str) -> base.Peak[float] | None:
        if self.closed is None:
            return None
        sign, l, rest = self.closed
        outside = sign > 0.0
        gap = rest if outside else 1.0 + l
        if quantity == "velocity":
            return base.Peak(l / gap, 0.0)
        if quantity == "acceleration" and not outside:  # the jump at entry
            return base.Peak(self.end_rates(self.entry_deg)[0], self.entry_deg)
        if quantity == "acceleration":
            size, at_deg = classic.acceleration_peak(l, gap)
        elif quantity == "jerk":
            size, at_deg = classic.jerk_peak(l, gap, self.exit_deg)
        else:
            size, at_deg = classic.power_peak(l, gap)
        return base.Peak(size, 0.0 - at_deg)

    def end_rates(self, input_deg: float) -> tuple[float, float]:
        if self.closed is None:
            return super().end_rates(input_deg)
        jump = self.closed[1] / self.entry.along  # which is cos b
        return jump, 3.0 * jump * jump


# table columns for a pitch curve with a wall on either side
WALLED = (
    *("x_mm", "y_mm", "left_x_mm", "left_y_mm", "right_x_mm", "right_y_mm"),
    *("pressure_deg", "curvature_radius_mm"),
)


class Pitch(NamedTuple):
    """The pitch curve M at one input angle or at an array of them."""

    x: Number
    y: Number
    tangent_x: Number  # direction of travel of the pin in the wheel
    tangent_y: Number
    speed: Number  # |M'|
    turning: Number  # rate at which it turns left, radians per input radian: curvature x speed
    pressure: Number  # radians, 0 to pi/2


@lru_cache(maxsize=16)
def retraces(engagement: base.Engagement) -> bool:
    """True if the pin stops in the wheel at mid-motion and leaves along the path it came by.

    This holds for straight slots and at the mid condition. Otherwise the pin passes mid-motion
    across the slot's radius, and the pressure angle is 90 degrees there. For a batch the result is
    an array.
    """
    x, y = engagement.slot(0.0, 1)
    m = library(x.c[0])
    left = m.hypot(x.c[1], y.c[1])
    (x0, x1), (y0, y1) = (jet.derivatives() for jet in engagement.path(0.0, 1))
    turns, far = size(engagement.motion(0.0, 1).c[1]), m.hypot(x0, y0)
    # |M'| below 1e-9 of the speeds of pin and wheel is rounding. If a matched R/L is nearly 1, the
    # pin's distance ``far`` itself is only rounding, 2**-52.
    bar = 1e-9 * (m.hypot(x1, y1) + turns * far) + 2.0**-52 * turns
    return cast("bool", left < bar)


def pitch(engagement: base.Engagement, input_deg: Number, first: int = 1) -> Pitch:
    """Compute the pitch curve at input angles other than a retracing mid-motion.

    There M' = 0, and ``first``, the order of the first derivative that moves the pin, is 2: it is
    the limit from the entry.
    """
    x, y = engagement.slot(input_deg, first + 1)
    m, sense = library(x.c[0]), 3.0 - 2.0 * first
    dx, dy = x.derivatives(), y.derivatives()
    (x0, x1, x2), (y0, y1, y2) = (dx[0], *dx[first:]), (dy[0], *dy[first:])
    speed = m.hypot(x1, y1)
    turning = (x1 * y2 - y1 * x2) / (first * speed * speed)
    pressure = m.atan2(size(x0 * y1 - y0 * x1), size(x0 * x1 + y0 * y1))
    along = sense * x1 / speed, sense * y1 / speed
    return Pitch(x0, y0, *along, speed if first == 1 else 0.0, turning, pressure)


def opposites(engagement: base.Engagement, input_deg: Array) -> Array:
    """Input angles on the other branch at which the roller is as far from the wheel's axis."""
    return engagement.inputs_deg(-engagement.own_deg(input_deg))
