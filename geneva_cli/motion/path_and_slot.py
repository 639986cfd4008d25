"""Engagements with a known pin path and straight slot, whose motion is solved for."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from geneva_cli.motion.engagement import Anchor, Height, Peak, Slot, SlotAxis, Vector, WheelMotion
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import (
    SINGLE,
    Batchable,
    Whole,
    array,
    library,
    parameter,
    picked,
    piece_of,
)
from geneva_cli.numerics.jet import Jet, Number, atan2, piecewise, sin, sin_cos, sqrt, turning


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

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Pin (x, y) on its path at input angles in degrees from mid-motion."""
        along, across = self.middle.place(input_deg, order)
        return turned(along, across, self.ahead)

    def nearest(self, input_deg: Number, order: int) -> tuple[Jet, Jet, Number]:
        """Pin along the nearest anchor's ray and across it; and the ray's direction, radians."""
        if isinstance(self.cuts[0], float) and isinstance(self.cuts[-1], float):
            if isinstance(input_deg, SINGLE):
                anchor = self.anchors[piece_of(input_deg, self.cuts)]
                return (*anchor.place(input_deg, order), anchor.wheel)

            def stacked(anchor: Anchor, x: Number) -> Jet:
                along, across = anchor.place(x, order)
                return Jet((*along.c, *across.c, anchor.wheel))

            pieces = [lambda x, one=one: stacked(one, x) for one in self.anchors]
            every = piecewise(input_deg, self.cuts, pieces).c
            return Jet(every[: order + 1]), Jet(every[order + 1 : -1]), every[-1]
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

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        depth = _length(*self.path.middle.place(input_deg, order))
        return turned(depth, depth * 0.0, self.path.ahead - self.path.middle.wheel)

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        along, across, _ = self.path.nearest(input_deg, order + 1)
        depth = _length(along, across)
        return SlotAxis(depth.lower, depth.derivative())


class MeridianSlot(Slot):
    """A spherical wheel's slot, a meridian."""

    def __init__(self, path: AnchoredPath, height: Height) -> None:
        self.path = path
        self.level = self.height = height

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        x, y = self.path(input_deg, order)
        polar = atan2(_length(x, y), self.level(radians(input_deg), order))
        return polar, polar * 0.0

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        polar = self(input_deg, order + 1)[0]
        return SlotAxis(sin(polar.lower), polar.derivative())

    def upright(self, input_deg: Number, order: int = 0) -> Jet:
        return sin_cos(self(input_deg, order)[0])[1]


class StraightSlotMotion(WheelMotion):
    """Motion of a wheel whose straight slot follows the pin."""

    def __init__(self, path: AnchoredPath, half_step: float, mirrored: bool = True) -> None:
        super().__init__(path.anchors[0].input_deg, path.anchors[-1].input_deg, half_step)
        self.path, self.mirrored = path, mirrored

    @property
    def entry(self) -> Anchor:
        return self.path.anchors[0]

    @property
    def seams_deg(self) -> tuple[float, ...]:
        path = self.path
        places = {0.0, *path.cuts}
        inside = sorted(at for at in places if self.entry_deg < at < self.exit_deg)
        return (self.entry_deg, *inside, self.exit_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        along, across, ray = self.path.nearest(input_deg, order)
        return atan2(across, along) + ray

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        along, across, _ = self.path.nearest(input_deg, order + 1)
        return turning(along, across)


class ClassicMotion(StraightSlotMotion):
    """Motion of a straight radial slot on a plain crank, with its closed forms.

    ``sign`` is +1 for an external wheel and -1 for an internal one; l = sin b and ``rest`` = 1 - l.
    """

    def __init__(
        self, path: AnchoredPath, half_step: float, sign: float, l: float, rest: float
    ) -> None:
        super().__init__(path, half_step)
        self.sign, self.l, self.rest = sign, l, rest

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        outside = self.sign > 0.0
        gap = self.rest if outside else 1.0 + self.l
        if quantity == "velocity":
            return Peak(self.l / gap, 0.0)
        if quantity == "acceleration" and not outside:  # the jump at entry
            return Peak(self.end_rates(self.entry_deg)[0], self.entry_deg)
        if quantity == "acceleration":
            size, at_deg = classic.acceleration_peak(self.l, gap)
        elif quantity == "jerk":
            size, at_deg = classic.jerk_peak(self.l, gap, self.exit_deg)
        else:
            size, at_deg = classic.power_peak(self.l, gap)
        return Peak(size, 0.0 - at_deg)

    def end_rates(self, input_deg: float) -> tuple[float, float]:
        jump = self.l / self.entry.along  # which is cos b
        return jump, 3.0 * jump * jump


class SideCrankMotion(StraightSlotMotion):
    """Motion of a straight radial slot behind a side-crank, with peaks of batches."""

    def __init__(
        self, path: AnchoredPath, half_step: float, A: float, sign: float, l: float, rest: float
    ) -> None:
        super().__init__(path, half_step)
        self.A, self.sign, self.l, self.rest = A, sign, l, rest

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        if isinstance(self.A, float) and isinstance(self.l, float):
            return None
        import numpy as np

        from geneva_cli.motion.wheels import side_crank_arrays as arrays

        peaks = {"velocity": arrays.velocity_peaks, "acceleration": arrays.acceleration_peaks}
        if quantity not in peaks:
            return None
        w = arrays.wheels(self.sign, self.l, self.rest, self.A)
        # nearer to 1 the search for arrays may miss a peak
        sure = abs(w.A) <= 0.999
        return Peak(*(parameter(np.where(sure, v, np.nan)[:, None]) for v in peaks[quantity](w)))


def _length(x: Jet, y: Jet) -> Jet:
    return sqrt(x * x + y * y)


def turned(x: Jet, y: Jet, angle: float) -> Vector:
    """Turn a vector by a fixed angle in radians."""
    if isinstance(angle, float) and angle == 0.0:
        return x, y
    m = library(angle)
    s, c = m.sin(angle), m.cos(angle)
    return x * c - y * s, x * s + y * c
