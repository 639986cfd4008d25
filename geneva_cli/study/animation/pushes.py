"""Forces of the rollers on the wheel, at their points of contact."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.scene import Push
from geneva_cli.study.animation.turn import MachineTurn, Passage

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

PLACES = 73  # points of a motion
INSIDE = 1e-6  # fraction of a motion that is left out at its ends, where forces may be undefined


def pushes(cycle: Cycle, turn: MachineTurn) -> Iterator[Push]:
    """The force of each passage over a turn; none without a load."""
    if not cycle.is_loaded:
        return
    each = len(cycle.mechanism.engagements)
    for i, one in enumerate(turn.passages):
        local = np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, PLACES)
        local *= 1.0 - INSIDE
        states = cycle.states(local + turn.passages[i % each].mid)
        force, torque = np.abs(states.pin_force_N), np.asarray(states.wheel_torque_Nm)
        sound = np.isfinite(force)
        if not sound.any():
            continue
        normal = _normals(one, local, turn)
        pin = turn.pin(one, one.mid + local)
        arm = pin[:, 0] * normal[:, 1] - pin[:, 1] * normal[:, 0]
        normal *= np.where(arm * torque < 0.0, -1.0, 1.0)[:, None]
        contact = (pin + turn.mechanism.roller_radius_mm * normal)[sound]
        arrow = (force[:, None] * normal)[sound]
        at = (one.mid + local - turn.start)[sound]
        columns = (at, contact[:, 0], contact[:, 1], arrow[:, 0], arrow[:, 1])
        yield Push(*(tuple(column.tolist()) for column in columns))


def _normals(one: Passage, local: Array, turn: MachineTurn) -> Array:
    """Unit normals of the slot in the fixed frame, of either sign; projected from a sphere."""
    if turn.mechanism.spec.wheel.FLAT:
        x, y = one.engagement.slot(local, 2)
        way = np.column_stack((x.c[1] + 0.0 * local, y.c[1] + 0.0 * local))
        bend = np.column_stack((x.c[2] + 0.0 * local, y.c[2] + 0.0 * local))
        slow = (
            np.hypot(*way.T) < 1e-6
        )  # at a cusp the roller turns back, in the direction of its second derivative
        way[slow] = bend[slow]
        # each slot of a pair is offset from the middle between them
        psi = one.engagement.motion(local, 0).c[0] - np.sign(local) * one.engagement.apart
        c, s = np.cos(psi), np.sin(psi)
        way = np.column_stack((c * way[:, 0] - s * way[:, 1], s * way[:, 0] + c * way[:, 1]))
    else:
        way = turn.pin(one, one.mid + local)
    out: Array = np.column_stack((-way[:, 1], way[:, 0])) / np.hypot(*way.T)[:, None]
    return out
