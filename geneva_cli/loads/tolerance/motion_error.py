"""The error of the wheel's angle in a straight slot, and its jump at entry, for any deviations.

Deviations dL of the centre distance and dR of the crank's radius move the roller's centre from p to
p + (dL, 0) + dR/R (p - hub). The slot follows it, off by the error of its own angle and by the
clearance c on one side or the other: psi = arg p + asin((e + c) / |p|). A machine that misses the
slot's axis has a jump of 0: its roller meets the mouth instead.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.entry import RestingAxis, arm_mm, first_contacts
from geneva_cli.loads.tolerance import locking
from geneva_cli.loads.tolerance.locking import Effect, used
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics import arrays
from geneva_cli.numerics.jet import Jet, Number, atan2, sqrt

MOTION_SAMPLES = 361  # input angles at which a motion is sampled


class MotionError(NamedTuple):
    """The error of one engagement's motion as a function of deviations; lengths in mm."""

    engagement: Engagement
    L: float
    arm: float  # R; without effect if no crank's arm carries the roller
    clearance: float  # roller to slot, per side

    def __call__(self, by: locking.Deviations, input_deg: Number, side: Number) -> Jet:
        """Wheel angle minus its true one, radians; ``side`` (1, -1) is the wall that bears."""
        x, y = (self.L * z.c[0] for z in self.engagement.path(input_deg, 0))
        offset = self.L * self.engagement.slot.offset
        scale = by.crank_radius_mm * (1.0 / self.arm)
        moved = scale * (x - self.L * self.engagement.hub) + by.center_distance_mm
        px, py = moved + x, scale * y + y
        free = self.play_mm(by)
        free = free * arrays.choose(free.c[0] > 0.0, 1.0, 0.0)
        turned = atan2(scale * y * x - moved * y, px * x + py * y)
        height = free * side + offset
        tilt = atan2(height, sqrt(px * px + py * py - height * height))
        true = np.arcsin(offset / np.hypot(x, y))
        out: Jet = turned + (tilt - true) + by.slot_angle_deg
        return out

    def play_mm(self, by: locking.Deviations) -> Jet:
        """Clearance per side, mm; negative if the roller does not fit into the slot."""
        return (by.slot_width_mm - by.roller_diameter_mm) * 0.5 + self.clearance

    def margin_mm(self, spec: Spec, use: Mapping[str, float]) -> float:
        """Greatest sum of errors of L and R that every random machine allows, mm.

        With larger ones the roller may reach the wheel's axis, or the crank's. Normal deviations
        lie within three times the plus or minus, which is nine standard deviations.
        """
        times = 3.0 if spec.tolerance.distribution == "normal" else 1.0
        play = 0.5 * (use["roller_diameter_mm"] + use["slot_width_mm"])
        entry, exit_ = np.ravel(self.engagement.entry_deg), np.ravel(self.engagement.exit_deg)
        x, y = self.engagement.path(np.linspace(entry, exit_, MOTION_SAMPLES, axis=-1), 0)
        near = np.atleast_2d(np.hypot(x.c[0], y.c[0])).min(axis=-1, keepdims=True)
        nearest = self.L * (near - arrays.size(self.engagement.slot.offset))
        margin = np.minimum((nearest - self.clearance) / times - play, self.arm / times)
        return arrays.parameter(margin if margin.size > 1 else float(margin[0, 0]))

    def at(self, input_deg: float, side: float) -> Effect:
        """The error at one place, towards a side, and which rollers do not fit into their slots."""

        def error(by: locking.Deviations) -> tuple[Jet, arrays.Mask]:
            # mm: less is rounding
            return self(by, input_deg, side) * side, arrays.array(self.play_mm(by).c[0]) < -1e-12

        return error

    def greatest(self, sizes: Sequence[float], squared: bool = False) -> arrays.Array:
        """Greatest error of any machine with deviations up to these sizes, of n designs: (3, n).

        The rows are the error in radians, the input angle, and the side. Of ``squared`` effects it
        is the nominal error and the root of the sum of their squares.
        """
        ends = locking.corners(sizes)
        effects = [(locking.slope_of(i), size) for i, size in enumerate(sizes) if np.any(size)]

        def of(at: arrays.Array, side: float) -> arrays.Array:
            if not squared:
                return np.asarray((arrays.array(self(ends, at, side).c[0]) * side).max(axis=0))
            slopes = [arrays.array(self(by, at, side).c[1]) * size for by, size in effects]
            nominal = abs(arrays.array(self(locking.AS_DRAWN, at, side).c[0]))
            return np.asarray(nominal + np.sqrt(sum(slope * slope for slope in slopes)))

        entry, exit_ = np.ravel(self.engagement.entry_deg), np.ravel(self.engagement.exit_deg)
        best = np.full((3, 1), -np.inf)
        for side in (1.0, -1.0):
            low, high = entry, exit_
            # eleven more samplings, each about the greatest of the last and a tenth as wide
            for count in (MOTION_SAMPLES, *[41] * 11):
                at = np.linspace(low, high, count, axis=-1)
                off = of(at, side)
                at, every = np.broadcast_to(at, off.shape), np.arange(len(off))
                i = np.argmax(off, axis=1)
                here = np.array((off[every, i], at[every, i], np.full(len(off), side)))
                best = np.where(here[0] > best[0], here, best)
                step = (at[:, 1] - at[:, 0]) * count / 20.0
                low, high = np.maximum(entry, here[1] - step), np.minimum(exit_, here[1] + step)
        return best


def motion_errors(mechanism: Mechanism) -> list[MotionError]:
    """Motion error of each engagement; none for curved slots, which are solved for."""
    L, clearance = mechanism.center_distance_mm, mechanism.spec.size.allowances.slot_clearance_mm
    if mechanism.engagements[0].slot.curved:
        return []
    return [MotionError(e, L, arm_mm(mechanism, e), clearance) for e in mechanism.engagements]


def motion_plays(mechanism: Mechanism) -> dict[str, arrays.Array]:
    """Greatest errors of m designs, (m,) by their names; none for curved slots.

    NaN if tolerances are all 0, or too wide for a machine.
    """
    sizes, rows = used(mechanism.spec).values(), np.zeros((0, mechanism.designs))
    machines = 2 ** sum(bool(np.any(size)) for size in sizes)
    # a million places of machines with deviations are computed together
    group = max(1, (1 << 20) // (machines * MOTION_SAMPLES))
    if not mechanism.engagements[0].slot.curved:
        blocks = arrays.blocks(mechanism.designs, group)
        rows = np.hstack([_plays(taken(mechanism, block)) for block in blocks])
    return dict(zip(("worst_deg", "rss_deg"), rows, strict=False))


def _plays(mechanism: Mechanism) -> arrays.Array:
    use, rows = used(mechanism.spec), np.zeros((2, mechanism.designs))
    sizes, both = [*use.values()], use["center_distance_mm"] + use["crank_radius_mm"]
    known = np.ravel(sum(sizes) > 0.0)
    for error in motion_errors(mechanism):
        each = error.greatest(sizes)[0], error.greatest(sizes, squared=True)[0]
        rows = np.maximum(rows, np.stack(np.broadcast_arrays(*each)))
        known = known & np.ravel(both < error.margin_mm(mechanism.spec, use))
    return np.where(known, np.degrees(rows), np.nan)


def entry_jumps(mechanism: Mechanism) -> list[Effect]:
    """Entry jump of each engagement whose roller enters along its slot's axis, or as built.

    They are sizes over the input's speed, and masks of machines that miss the axis.
    """
    return [partial(_entry_jump, mechanism, axis) for axis in RestingAxis.each(mechanism)]


def _entry_jump(
    mechanism: Mechanism, axis: RestingAxis, by: locking.Deviations
) -> tuple[Jet, arrays.Mask]:
    crank = by.crank_radius_mm.c[0] / arm_mm(mechanism, axis.engagement)
    center = by.center_distance_mm.c[0] / mechanism.center_distance_mm
    crank, center = (np.reshape(x, (-1, 1)) for x in (crank, center))
    off = np.ravel(axis.offset(crank, center)) != 0.0
    as_drawn = np.ravel(axis.engagement.through.jumps[0])
    jump = np.where(off, first_contacts(axis, crank, center).jump, as_drawn)
    return Jet((np.nan_to_num(abs(jump)),)), off & np.isnan(jump)


def entry_jumps_worst(mechanism: Mechanism, use: Mapping[str, float]) -> arrays.Array | None:
    """Greatest jump at entry for any of the deviations, over the input's speed: (m,)."""
    ends = [(-use[name], use[name]) for name in ("center_distance_mm", "crank_radius_mm")]
    corners = [locking.deviations([*end, *[0.0] * 5]) for end in product(*ends)]
    jumps = [one(by)[0].c[0] for one in entry_jumps(mechanism) for by in corners]
    return np.max(np.broadcast_arrays(*jumps), axis=0) if jumps else None
