"""Forces of the rollers on the wheel, at their points of contact."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.loads.cycle import Cycle
from geneva_cli.motion.pivots import AxisPlace
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
        contact = (pin + turn.mechanism.roller_radius_mm * normal)[sound]
        arrow = force[sound, None] * normal[sound]
        at = (one.mid + local - turn.start)[sound]
        columns = (at, contact[:, 0], contact[:, 1], arrow[:, 0], arrow[:, 1])
        push = Push(*(tuple(column.tolist()) for column in columns))
        place = turn.on_crank(i)
        yield _moved_push(push, place._replace(behind_deg=0.0), 0.0) if place.turn else push
        for place in turn.mechanism.wheel_places[1:]:
            yield _moved_push(push, place, turn.L)


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
        c, s = np.cos(psi), np.sin(psi)
        direction = np.column_stack(
            (c * direction[:, 0] - s * direction[:, 1], s * direction[:, 0] + c * direction[:, 1])
        )
    else:
        direction = pin
    return np.column_stack((-direction[:, 1], direction[:, 0])) / np.hypot(*direction.T)[:, None]


def _moved_push(push: Push, place: AxisPlace, axis: float) -> Push:
    """The force at the first wheel or crank as that at another one, which works later."""
    c, s = math.cos(place.turn), math.sin(place.turn)

    def turned(x: tuple[float, ...], y: tuple[float, ...], about: float) -> list[list[float]]:
        pairs = [(u - about, v) for u, v in zip(x, y, strict=True)]
        return [[about + c * u - s * v for u, v in pairs], [s * u + c * v for u, v in pairs]]

    places = turned(push.x, push.y, axis)
    forces = turned(push.force_x, push.force_y, 0.0)
    later = tuple(t + place.behind_deg for t in push.at)
    return Push(later, *map(tuple, (*places, *forces)))
