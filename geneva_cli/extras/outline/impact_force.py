"""The force of an impact, at the beginning of a push that strikes the wheel's inertia."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import crank_jet
from geneva_cli.extras.outline.turning import Impact, Turned, after
from geneva_cli.loads.impacts.shock_force import forces_N, impulse_Nms
from geneva_cli.loads.strength.pin import PinSize, pin_diameter_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.machine_sizes import built

SAME = 1e-3  # of the roller's radius: the arc that touches is the roller's, less the slack


class Struck(NamedTuple):
    """An impact: the jump of the wheel's velocity over the input's, and what it causes.

    Force and moment are None without an inertia; the force also where no roller strikes.
    """

    jump: float
    at_deg: float
    force_N: float | None
    moment_Nms: float | None


def struck_by(mechanism: Mechanism, result: Turned, impact: Impact) -> Struck:
    """Return what an impact causes.

    The force is that of an elastic impact on the roller's pin (``shock_force``), the moment that of
    a plastic one.
    """
    machine = result.machine
    at_deg = machine.assembly.to_input(math.degrees(impact.crank))
    rate = np.ravel(crank_jet(mechanism, np.array([at_deg]))[0].c[1]).item(0)
    jump = impact.velocity * rate
    shown_deg = machine.assembly.shown_deg(math.degrees(impact.crank))
    moment = float(np.ravel(impulse_Nms(mechanism, np.array([[abs(jump)]])))[0])
    if not moment > 0.0:
        return Struck(jump, shown_deg, None, None)
    sizes = built(mechanism)
    width = sizes.face_width_mm or sizes.wheel_thickness_mm
    force = None
    if width is not None and _is_roller(result, impact):
        pin = PinSize(sizes.pin_mm or pin_diameter_mm(mechanism), width)
        force = float(forces_N(mechanism, np.array([[abs(jump)]]), pin)[0])
    return Struck(jump, shown_deg, force, moment)


def strike_text(struck: Struck) -> str:
    """Return the force in words, or the impulse of what is no roller; empty without an inertia."""
    if struck.force_N is not None:
        return f"; the roller strikes it with {struck.force_N:.4g} N"
    if struck.moment_Nms is not None:
        return f"; it is struck by a moment impulse of {struck.moment_Nms:.4g} N m s"
    return ""


def _is_roller(result: Turned, impact: Impact) -> bool:
    """Whether the roller strikes, and not the disc."""
    found = contacts(result.machine.free, *after(impact))
    radius = result.machine.roller.radius
    near = SAME * radius + result.machine.free.slack
    return bool(found.is_known[0]) and abs(float(found.crank.radius[0]) - radius) < near
