"""The jump of the wheel's velocity at entry, for deviations of R and of L; lengths in mm.

A machine that misses the slot's axis has a jump of 0: its roller meets the mouth instead.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.impacts.entry import RestingAxis, arm_mm, first_contacts
from geneva_cli.loads.tolerance.locking import Deviations, corners
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.engagement import AsBuilt
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.wheels.as_built import RestingSlot
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Complex, Mask, array, parameter


class TrueJump(NamedTuple):
    """The jump at one engagement's entry whose roller should enter along its slot's axis."""

    axis: RestingAxis
    L: float
    arm: float
    # The true path on each side of its entry: the side, the root of its distance from the axis
    # (over L), and over that root its speed towards the axis, nearly constant, with the wheel's
    # lever to the roller as imaginary part: one search interpolates both.
    branches: tuple[tuple[float, Array, Complex], ...]

    def __call__(self, by: Deviations) -> tuple[Array, Mask]:
        """Sizes of the jumps, over the input's speed, and a mask of machines that miss the axis."""
        crank, center = by.crank_radius_mm.c[0] / self.arm, by.center_distance_mm.c[0] / self.L
        offset = np.atleast_1d(self.axis.offset(array(crank), array(center)))
        moved = np.broadcast_to((center - crank) / (1.0 + crank) * self.axis.along, offset.shape)
        jump, missed = np.zeros(len(offset)), offset != 0.0
        for side, root, speed_and_lever in self.branches:
            here = np.flatnonzero(offset * side > 0.0)
            at = np.sqrt(abs(offset[here]))
            both = np.interp(at, root, speed_and_lever, right=np.nan)
            speed, lever = at * both.real, both.imag + moved[here]
            jump[here] = np.nan_to_num(speed / lever)
            missed[here] = np.isnan(speed)
        return jump, missed


class BuiltJump(NamedTuple):
    """The jump at one engagement's entry of a crank as built."""

    built: AsBuilt
    sign: float
    offset: float
    L: float
    R: float
    drive: Drive
    at_deg: float

    def __call__(self, by: Deviations) -> tuple[Array, Mask]:
        """Sizes of the jumps, over the input's speed, and a mask of machines that miss the axis."""
        L = np.atleast_1d(array(by.center_distance_mm.c[0] + self.L))
        l = (by.crank_radius_mm.c[0] + self.R) / L
        across = np.sin(self.built.angle) - self.offset / L
        missed: Mask = abs(across) > l
        with np.errstate(all="ignore"):  # of machines that miss it
            own = self.built
            here = RestingSlot(self.sign, parameter(l), own.angle, parameter(across), own.outer)
            rate = self.drive.crank_rate(array(here.crank_deg) + self.at_deg)
            jump = abs(here.velocity) * rate
        return np.where(missed, 0.0, jump), missed


EntryJump: TypeAlias = TrueJump | BuiltJump


def _built_jumps(mechanism: Mechanism) -> list[BuiltJump]:
    drive, L, out = mechanism.spec.drive, mechanism.center_distance_mm, []
    for i, engagement in enumerate(mechanism.engagements):
        if engagement.built is not None:
            angles = drive.roller_angles_deg
            at_deg = angles[i] if angles else 360.0 * i / drive.rollers
            offset, R = L * engagement.slot.offset, L * mechanism.ratio
            sign = mechanism.spec.wheel.SIGN
            out.append(BuiltJump(engagement.built, sign, offset, L, R, drive, at_deg))
    return out


def entry_jumps(mechanism: Mechanism) -> list[EntryJump]:
    """Entry jump of each engagement whose roller enters along its slot's axis, or as built."""
    out: list[EntryJump] = [*_built_jumps(mechanism)]
    for axis in RestingAxis.each(mechanism):
        # the path after the true entry counts if it is on the other side
        before, after = _branch(axis, -1.0), _branch(axis, 1.0)
        branches = (before,) if before[0] == after[0] else (before, after)
        arm = arm_mm(mechanism, axis.engagement)
        out.append(TrueJump(axis, mechanism.center_distance_mm, arm, branches))
    return out


def _branch(axis: RestingAxis, sense: float) -> tuple[float, Array, Complex]:
    # In geometric progression from next to the true entry to half-way through the motion: between
    # two places, interpolation has a relative error of 1e-6 at most.
    span = 0.5 * axis.through.motion_deg * DEGREE
    along, across = axis.anchor.displacement(sense * span * np.geomspace(1e-7, 1.0, 8193), 1)
    off, slope = across.arrays()
    root = np.sqrt(abs(off))
    first = int(np.argmax(root > 3e-8))  # the root of a distance that is not rounding
    leaves = np.append(np.diff(root[first:]) > 0.0, False)
    part = slice(first, first + int(np.argmin(leaves)) + 1)  # as far as it leaves the axis
    root, lever = root[part], axis.anchor.along + along.arrays()[0][part]
    return float(np.sign(off[first])), root, abs(slope)[part] / root + 1j * lever


def entry_jumps_worst(mechanism: Mechanism, use: Mapping[str, float]) -> Array | None:
    """Greatest jump at entry for any of the deviations, over the input's speed: (m,)."""
    if built := _built_jumps(mechanism):
        sizes = [use["center_distance_mm"], use["crank_radius_mm"], *[0.0] * 5]
        jumps = [one(corners(sizes))[0].reshape(-1, mechanism.designs) for one in built]
        return np.asarray(np.concatenate(jumps).max(axis=0))
    sizes: list[Array] = []
    for axis in RestingAxis.each(mechanism):
        crank = use["crank_radius_mm"] / arm_mm(mechanism, axis.engagement)
        center = use["center_distance_mm"] / mechanism.center_distance_mm
        for one, other in product((-1.0, 1.0), repeat=2):
            sizes.append(np.nan_to_num(abs(first_contacts(axis, one * crank, other * center).jump)))
    return np.max(np.broadcast_arrays(*sizes), axis=0) if sizes else None
