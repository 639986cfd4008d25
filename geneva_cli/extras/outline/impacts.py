"""The impacts of a drawn machine, at which pushes begin, and the force of one."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import crank_jet
from geneva_cli.extras.outline.turning import Turned
from geneva_cli.loads.impacts.shock_force import forces_N, impulse_Nms
from geneva_cli.loads.strength.pin import PinSize, pin_diameter_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.machine_sizes import built
from geneva_cli.parts.turn.lazy_turn import LazyTurn, Push

LATE = 1e-3  # radians: a push that moves the wheel less is not counted as an impact
JUST = 1e-12  # radians after a push begins
SAME = 1e-3  # of the roller's radius: the arc that touches is the roller's, less the slack


class Impact(NamedTuple):
    """The velocity of the wheel, of the crank's, just after a push begins, and where it does."""

    velocity: float
    crank: float  # radians
    wheel: float
    way: int


class Struck(NamedTuple):
    """An impact: the jump of the wheel's velocity over the input's, and what it causes.

    Force and moment are None without an inertia; the force also where no roller strikes.
    """

    jump: float
    at_deg: float
    force_N: float | None
    moment_Nms: float | None

    @property
    def text(self) -> str:
        """The force in words, or the impulse of what is no roller; empty without an inertia."""
        if self.force_N is not None:
            return f"; the roller strikes it with {self.force_N:.4g} N"
        if self.moment_Nms is not None:
            return f"; it is struck by a moment impulse of {self.moment_Nms:.4g} N m s"
        return ""


def moving(turn: LazyTurn) -> list[Push]:
    """The pushes of a turn that move the wheel, not those within its play."""
    return [push for push in turn.pushes if push.moved > LATE]


def impacts(result: Turned) -> list[Impact]:
    """The impacts of both senses: the velocities at which pushes begin."""
    out: list[Impact] = []
    for sense in result.senses:
        for turn in sense.turns:
            for push in moving(turn):
                one = Impact(math.nan, push.begin, push.begin_wheel, sense.way)
                crank, wheel = _after(one)
                velocity = contacts(result.machine.free, crank, wheel).motion(crank)[1]
                out.append(one._replace(velocity=float(velocity[0])))
    return out


def hardest_impact(result: Turned) -> Impact | None:
    """The hardest impact, the one forwards of two that are equal; None without any."""
    every = impacts(result)
    return max(every, key=lambda one: (round(abs(one.velocity), 4), one.way), default=None)


def _after(impact: Impact) -> tuple[Array, Array]:
    """Crank and wheel angles just after an impact, radians, (1,) each."""
    return np.array([impact.crank + impact.way * JUST]), np.array([impact.wheel])


def struck_by(mechanism: Mechanism, result: Turned, impact: Impact) -> Struck:
    """What an impact causes.

    The force is that of an elastic impact on the roller's pin (``shock_force``), the moment that of
    a plastic one.
    """
    machine = result.machine
    at_deg = machine.assembly.to_input(math.degrees(impact.crank))
    rate = np.ravel(crank_jet(mechanism, np.array([at_deg]))[0].c[1]).item(0)
    jump = impact.velocity * rate
    shown_deg = machine.assembly.shown_deg(math.degrees(impact.crank))
    moment = impulse_Nms(mechanism, np.array([[abs(jump)]])).item()
    if not moment > 0.0:
        return Struck(jump, shown_deg, None, None)
    sizes, force = built(mechanism), None
    width, radius = sizes.face_width_mm or sizes.wheel_thickness_mm, machine.roller.radius
    touching = contacts(machine.free, *_after(impact))
    # whether the roller strikes, and not the disc
    off = abs(float(touching.crank.radius[0]) - radius)
    is_roller = bool(touching.is_known[0]) and off < SAME * radius + machine.free.slack
    if width is not None and is_roller:
        pin = PinSize(sizes.pin_mm or pin_diameter_mm(mechanism), width)
        force = float(forces_N(mechanism, np.array([[abs(jump)]]), pin)[0])
    return Struck(jump, shown_deg, force, moment)
