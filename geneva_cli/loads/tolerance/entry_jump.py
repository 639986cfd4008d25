"""The jump of the wheel's velocity at entry, for many deviations of one machine.

The true path is tabulated once. Each machine's jump is interpolated where its roller reaches the
slot's axis (see ``loads.impacts.shock``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.impacts import arm_mm
from geneva_cli.loads.impacts.shock import RestingAxis
from geneva_cli.loads.tolerance.dimensions import Deviations
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.jet import Array


class Branch(NamedTuple):
    """The true path on one side of its entry, for crossings of the axis by paths with errors.

    ``side`` is the side of the axis on which the true path is; the others are arrays along it.
    """

    side: float
    root: Array  # square root of its distance from the axis, over L
    # Speed of its approach to the axis over that root, nearly constant, and as imaginary part the
    # wheel's lever to the roller: one search interpolates both.
    speed_and_lever: Array


class EntryJumpFunction(NamedTuple):
    """The jump at one engagement's entry as a function of deviations; lengths in millimetres."""

    axis: RestingAxis
    L: float
    arm: float
    branches: tuple[Branch, ...]

    def __call__(self, by: Deviations) -> tuple[Array, Array]:
        """Sizes of the jumps, over the input's speed, and a mask of machines that miss the axis.

        A machine that misses it has a jump of 0: its roller meets the mouth instead.
        """
        crank, center = by.crank_radius_mm.c[0] / self.arm, by.center_distance_mm.c[0] / self.L
        offset = np.atleast_1d(self.axis.offset(array(crank), array(center)))
        moved = np.broadcast_to((center - crank) / (1.0 + crank) * self.axis.along, offset.shape)
        jump, missed = np.zeros(len(offset)), offset != 0.0
        for branch in self.branches:
            here = np.flatnonzero(offset * branch.side > 0.0)
            at = np.sqrt(abs(offset[here]))
            both = np.interp(at, branch.root, branch.speed_and_lever, right=np.nan)
            speed, lever = at * both.real, both.imag + moved[here]
            jump[here] = np.nan_to_num(speed / lever)
            missed[here] = np.isnan(speed)
        return jump, missed


def entry_jumps(mechanism: Mechanism) -> list[EntryJumpFunction]:
    """Entry jump of each engagement whose roller should enter along its slot's axis."""
    L = mechanism.center_distance_mm
    out = []
    for engagement in mechanism.engagements:
        axis = RestingAxis.of(engagement)
        if axis is not None:
            # the path after the true entry counts if it is on the other side
            before, after = _branch(axis, -1.0), _branch(axis, 1.0)
            branches = (before,) if before.side == after.side else (before, after)
            arm = arm_mm(mechanism, engagement)
            out.append(EntryJumpFunction(axis, L, arm, branches))
    return out


def _branch(axis: RestingAxis, sense: float) -> Branch:
    anchor = axis.anchor
    span = 0.5 * axis.engagement.motion_deg * DEGREE
    # In geometric progression from next to the true entry to half-way through the motion: between
    # two places, interpolation has a relative error of 1e-6 at most.
    tau = sense * span * np.geomspace(1e-7, 1.0, 8193)
    along, across = anchor.displacement(tau, 1)
    off, slope = across.arrays()
    root = np.sqrt(abs(off))
    first = int(np.argmax(root > 3e-8))  # the root of a distance that is not rounding
    leaves = np.append(np.diff(root[first:]) > 0.0, False)
    part = slice(first, first + int(np.argmin(leaves)) + 1)  # as far as it leaves the axis
    side, root = float(np.sign(off[first])), root[part]
    lever = anchor.along + along.arrays()[0][part]
    return Branch(side, root, abs(slope)[part] / root + 1j * lever)
