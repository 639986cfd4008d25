"""Torque, pin force and input torque of a wheel over a motion, with friction."""

from __future__ import annotations

import math
from functools import cache, partial
from typing import Any

import numpy as np

from bench.method import Method, Subject, Task
from bench.truth import digits, motion
from geneva_cli.loads.cycle import Cycle
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.jet import Array
from geneva_cli.spec.tables import Load, Size

Z = 8
COUNT = 360  # input angles
L, RADIUS, FRICTION = 0.25, 0.012, 0.05
SPEED = 2.0 * math.pi  # of the input, rad/s


def script(x: Array) -> tuple[Array, ...]:
    """Torque, force and input torque by a handbook's formulas; x in radians."""
    l = math.sin(math.pi / Z)
    sine, cosine = np.sin(x), np.cos(x)
    D = 1.0 - 2.0 * l * cosine + l * l
    velocity = l * (cosine - l) / D
    torque = 1.2 * SPEED**2 * (-l * (1.0 - l * l) * sine / D**2) + 20.0
    return _under(torque, velocity, L * np.sqrt(D), L * l * sine / np.sqrt(D))


def _under(torque: Array, velocity: Array, rho: Array, along: Array) -> tuple[Array, ...]:
    """Torque, force and input torque of a roller at ``rho``, m, that slides ``along`` its slot."""
    rubs = along + np.sign(torque) * (1.0 + velocity) * RADIUS
    force = np.abs(torque) / (rho - RADIUS * FRICTION * np.sign(rubs))
    return torque, force, torque * velocity + FRICTION * force * np.abs(rubs)


def differences(x: Array) -> tuple[Array, ...]:
    """Torque, force and input torque with np.gradient of the wheel's angle."""
    l = math.sin(math.pi / Z)
    sine, cosine = np.sin(x), np.cos(x)
    velocity = np.gradient(np.arctan2(l * sine, 1.0 - l * cosine), x)
    torque = 1.2 * SPEED**2 * np.gradient(velocity, x) + 20.0
    rho = L * np.sqrt(1.0 - 2.0 * l * cosine + l * l)
    return _under(torque, velocity, rho, np.gradient(rho, x))


def subject(quick: bool) -> Subject:
    """The handbook's formulas for this wheel, compared with the cycle of any machine."""
    spec = Spec(External(Z), size=Size(250.0, 12.0), load=Load(1.2, 20.0, friction=0.05))
    cycle = Cycle(build(spec))
    (engagement,) = cycle.mechanism.engagements
    degrees = np.linspace(engagement.entry_deg, engagement.exit_deg, COUNT)
    x = np.radians(degrees)

    def ours() -> tuple[Array, ...]:
        loads = cycle.moving(engagement, degrees)
        return loads.wheel_torque_Nm, abs(loads.pin_force_N), loads.input_torque_Nm

    task = Task(
        f"torque, force and input torque at {COUNT} angles",
        f"one np.sin + np.cos over {COUNT} angles",
        lambda: (np.sin(x), np.cos(x)),
        partial(_error, x=x),
        [
            Method("handbook's formulas, one wheel", COUNT, partial(script, x)),
            Method("numerical differentiation", COUNT, partial(differences, x)),
            Method("ours, any machine, all quantities", COUNT, ours, True),
        ],
    )
    return Subject(
        f"Loads over a motion of a wheel of {Z} slots",
        "greatest error, in units of each quantity's peak",
        [task],
    )


def _error(results: Any, x: Array) -> float:
    worst = 0.0
    exact = [_exact(float(a)) for a in x[:: COUNT // 40]]
    for i, values in enumerate(results):
        peak = max(abs(row[i]) for row in exact)
        for value, row in zip(values[:: COUNT // 40], exact, strict=True):
            worst = max(worst, float(abs(digits().mpf(float(value)) - row[i]) / peak))
    return worst


@cache
def _exact(angle: float) -> tuple[Any, ...]:
    """Loads in 50 digits, with the pin as a complex number."""
    mp = digits()
    a = mp.mpf(angle)
    l = mp.sin(mp.pi / Z)
    _, velocity, acceleration, _ = motion(Z, "external", 0.0, a)
    torque = mp.mpf(1.2) * (2 * mp.pi) ** 2 * acceleration + 20
    length, radius, friction = mp.mpf(L), mp.mpf(RADIUS), mp.mpf(FRICTION)
    pin = 1 - l * mp.expj(-a)
    rho = length * abs(pin)
    along = length * (1j * l * mp.expj(-a) * mp.conj(pin)).real / abs(pin)
    rubs = along + mp.sign(torque) * (1 + velocity) * radius
    force = abs(torque) / (rho - radius * friction * mp.sign(rubs))
    return torque, force, torque * velocity + friction * force * abs(rubs)
