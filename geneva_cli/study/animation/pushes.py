"""Forces of the rollers on the wheel, at their points of contact."""

from __future__ import annotations

import cmath
from collections.abc import Iterator

import numpy as np

from geneva_cli.loads.cycle import Cycle
from geneva_cli.motion.plane_motion import turned_points
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Push
from geneva_cli.parts.assembly import Passage
from geneva_cli.study.animation.animated_turn import MachineTurn


def pushes(cycle: Cycle, turn: MachineTurn) -> Iterator[Push]:
    """The force of each passage over a turn; none without a load."""
    if not cycle.is_loaded:
        return
    each = len(cycle.mechanism.engagements)
    for i, one in enumerate(turn.passages):
        local = np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, 73)
        local *= 1.0 - 1e-6  # forces may be undefined at the ends of a motion
        states = cycle.states(local + turn.passages[i % each].mid)
        force, torque = np.abs(states.pin_force_N), np.asarray(states.wheel_torque_Nm)
        sound = np.isfinite(force)
        if not sound.any():
            continue
        pin = turn.assembly.driving(i, one.mid + local)
        normal = _normals(one, local, turn, pin)
        arm = pin[:, 0] * normal[:, 1] - pin[:, 1] * normal[:, 0]
        if not turn.mechanism.output.turns:
            arm = normal[:, 1]  # a rack is pushed along y
        normal *= np.where(arm * torque < 0.0, -1.0, 1.0)[:, None]
        contact = _complex(pin + turn.mechanism.roller_radius_mm * normal)[sound]
        arrow = force[sound] * _complex(normal)[sound]
        at = (one.mid + local - turn.start)[sound]
        # the first crank's forces as those at its own crank, and those at the other wheels
        own = turn.on_crank(i)._replace(behind_deg=0.0)
        for place, axis in ((own, 0.0), *((x, turn.L) for x in turn.mechanism.wheel_places[1:])):
            turned = cmath.rect(1.0, place.turn)
            there, pushed = (contact - axis) * turned + axis, arrow * turned
            columns = (at + place.behind_deg, there.real, there.imag, pushed.real, pushed.imag)
            yield Push(*(tuple(column.tolist()) for column in columns))


def _complex(points: Array) -> Array:
    return points[:, 0] + 1j * points[:, 1]


def _normals(one: Passage, local: Array, turn: MachineTurn, pin: Array) -> Array:
    """Unit normals of the slot in the fixed frame, of either sign; projected from a sphere."""
    if not turn.mechanism.output.turns:
        return np.column_stack((0.0 * local, 1.0 + 0.0 * local))
    if turn.mechanism.spec.wheel.FLAT:
        x, y = one.engagement.slot(local, 2)
        direction = np.column_stack((x.c[1] + 0.0 * local, y.c[1] + 0.0 * local))
        bend = np.column_stack((x.c[2] + 0.0 * local, y.c[2] + 0.0 * local))
        # at a cusp the roller turns back, in the direction of its second derivative
        slow = np.hypot(*direction.T) < 1e-6
        direction[slow] = bend[slow]
        # each slot of a pair is offset from the middle between them
        psi = one.engagement.motion(local, 0).c[0] - np.sign(local) * one.engagement.apart
        direction = turned_points(direction, psi)
    else:
        direction = pin
    return np.column_stack((-direction[:, 1], direction[:, 0])) / np.hypot(*direction.T)[:, None]
