"""The jump of the wheel's velocity at entry, for many machines: by a table of one path."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.blows import arm_mm
from geneva_cli.analysis.shock import Line
from geneva_cli.analysis.tolerance.dimensions import Deviations
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

# On the path, from an instant beside the true entry to half-way through the motion, each as much
# farther off than the one before: what is read off between two of them is within 1e-6 of itself.
PLACES = 8193
FIRST = 1e-7  # of that
NOTHING = 3e-8  # the root of a distance from the axis, over L, that is rounding


class Branch(NamedTuple):
    """The true path on one side of its entry, where the path with errors crosses the axis.

    ``side`` is that of the axis on which the true path is; the rest are arrays along it.
    """

    side: float
    root: Array  # of its distance from the axis, over L
    speed: (
        Array  # at which it comes nearer, or goes away, over that root: nearly the same all along
    )
    lever: Array  # of the wheel, to the roller


class Entered(NamedTuple):
    """The roller's way to the axis of one engagement's slot; lengths in millimetres."""

    line: Line
    L: float
    arm: float
    branches: tuple[Branch, ...]

    def __call__(self, by: Deviations) -> tuple[Array, Array]:
        """The sizes of the jumps, over the input's speed, and which machines miss the axis.

        0 for a machine that misses it: what it does at the mouth is another matter.
        """
        crank, center = by.crank_radius_mm.c[0] / self.arm, by.center_distance_mm.c[0] / self.L
        aside = np.atleast_1d(self.line.aside(array(crank), array(center)))
        moved = np.broadcast_to((center - crank) / (1.0 + crank) * self.line.along, aside.shape)
        jump, missed = np.zeros(len(aside)), aside != 0.0
        for branch in self.branches:
            here = np.flatnonzero(aside * branch.side > 0.0)
            at = np.sqrt(abs(aside[here]))
            speed = at * np.interp(at, branch.root, branch.speed, right=np.nan)
            lever = np.interp(at, branch.root, branch.lever) + moved[here]
            jump[here] = np.nan_to_num(speed / lever)
            missed[here] = np.isnan(speed)
        return jump, missed


def entered(mechanism: Mechanism) -> list[Entered]:
    """Every engagement whose roller should come in along the slot's axis."""
    L = mechanism.center_distance_mm
    out = []
    for engagement in mechanism.engagements:
        if engagement.motion.entry is not None:
            line, arm = Line.of(engagement), arm_mm(mechanism, engagement)
            out.append(Entered(line, L, arm, tuple(_branches(engagement))))
    return out


def _branches(engagement: Engagement) -> list[Branch]:
    """Before the true entry; and after it, where the path goes over to the other side there."""
    before = _branch(engagement, -1.0)
    after = _branch(engagement, 1.0)
    return [before] if before.side == after.side else [before, after]


def _branch(engagement: Engagement, way: float) -> Branch:
    anchor = engagement.motion.entry
    assert anchor is not None  # ``entered`` asks for it
    span = 0.5 * engagement.motion_deg * DEGREE
    tau = way * span * np.geomspace(FIRST, 1.0, PLACES)
    along, across = anchor.displacement(tau, 1)
    off, slope = across.arrays()
    root = np.sqrt(abs(off))
    first = int(np.argmax(root > NOTHING))
    leaves = np.append(np.diff(root[first:]) > 0.0, False)
    part = slice(first, first + int(np.argmin(leaves)) + 1)  # as far as it leaves the axis
    side, root = float(np.sign(off[first])), root[part]
    return Branch(side, root, abs(slope)[part] / root, anchor.along + along.arrays()[0][part])
