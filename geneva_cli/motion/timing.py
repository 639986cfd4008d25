"""Timing of each motion and each dwell; and the factors of a motion for cam indexers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import choose

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism


class Timing(NamedTuple):
    """One cycle: a motion and the dwell after it; numbers, or arrays (n, 1) of a batch."""

    motion_deg: float  # of the input
    dwell_deg: float
    index_deg: float | None  # of the wheel
    k: float  # motion / dwell, of times, in which a stop of the input counts
    tau: float  # motion / cycle
    motion_s: float
    dwell_s: float
    cycle_s: float
    index_mm: float | None = None  # a rack's step, which has no angle

    @property
    def step(self) -> float:
        """The step in the output's unit: a wheel's in degrees, or a rack's in millimetres."""
        own = self.index_mm if self.index_deg is None else self.index_deg
        assert own is not None  # a machine has one of them
        return own


def timing(
    motion_deg: float,
    dwell_deg: float,
    index_deg: float | None,
    n_rpm: float,
    index_mm: float | None = None,
    stop_s: float = 0.0,
) -> Timing:
    """The timing of one cycle at a steady input speed, with a stop in its dwell."""
    second = 6.0 * n_rpm  # degrees of input a second
    rest = dwell_deg + second * stop_s  # as an angle at that speed
    cycle = motion_deg + rest
    pause = rest != 0.0
    k = choose(pause, motion_deg / choose(pause, rest, math.nan), math.inf)
    times = motion_deg / second, rest / second, cycle / second
    return Timing(motion_deg, dwell_deg, index_deg, k, motion_deg / cycle, *times, index_mm)


def timings(mechanism: Mechanism) -> list[Timing]:
    """The timing of every engagement, in order."""
    output, drive, out = mechanism.output, mechanism.spec.drive, []
    for i, one in enumerate(mechanism.engagements):
        index_deg = mechanism.spec.wheel.index_deg(i) if output.turns else None
        index_mm = None if output.turns else 2.0 * one.half_step * output.per_radian
        ends = one.motion_deg, mechanism.dwell_deg(i)
        out.append(timing(*ends, index_deg, drive.n_rpm, index_mm, drive.stop_s))
    return out


class CamFactors(NamedTuple):
    """Peaks of a motion that is scaled to a step of 1 in a time of 1."""

    Am: float  # peak acceleration
    Vm: float  # peak velocity
    Qm: float  # peak of velocity times acceleration, over Am


def cam_factors(
    velocity: float, acceleration: float, power: float, motion_deg: float, step_deg: float
) -> CamFactors:
    """The factors of a motion, from its invariant peaks, its input angle and the wheel's step."""
    motion, step = radians(motion_deg), radians(step_deg)
    Qm = power * motion / (step * acceleration)
    return CamFactors(acceleration * motion * motion / step, velocity * motion / step, Qm)
