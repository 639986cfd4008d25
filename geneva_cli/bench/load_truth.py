"""Loads of a side-crank's wheel in 50 digits, by a handbook's formulas for this machine.

The search gives the place: an error of a place is squared in a greatest value. The
angle between two sign changes is summed by Gauss's rule, with each value in 50 digits.
"""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.bench.truth import digits, motion
from geneva_cli.loads.cycle import Cycle
from geneva_cli.machine.materials import roller_material, wheel_material
from geneva_cli.machine.mechanism import Mechanism

if TYPE_CHECKING:
    from collections.abc import Sequence

LOADS = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")


@cache
def greatest(machine: Mechanism, A: float) -> list[float]:
    """Greatest size of each of ``LOADS`` for an external side-crank; a plain crank has A = 0."""
    out = []
    extremes = Cycle(machine).extremes
    for k, ends in enumerate(extremes[name] for name in LOADS):
        places = (ends.max_at_deg, ends.min_at_deg)
        sizes = [abs(row[k]) for at in places for row in _limits(machine, A, at)]
        out.append(float(max(sizes)))
    return out


@cache
def roots(machine: Mechanism, A: float) -> list[float]:
    """Root mean square of each of ``LOADS`` over a period."""
    node, weight = np.polynomial.legendre.leggauss(64)
    total = [digits().mpf(0)] * len(LOADS)
    for _, (start, end, drives, slides, _) in Cycle(machine).stretches:
        half = 0.5 * (end - start)
        for x, part in zip(0.5 * (start + end) + half * node, half * weight, strict=True):
            row = _loads(machine, A, float(x), drives, slides)
            total = [a + part * v * v for a, v in zip(total, row, strict=True)]
    return [float(digits().sqrt(one / machine.period_deg)) for one in total]


def _limits(machine: Mechanism, A: float, deg: float) -> list[Sequence[Any]]:
    """Loads at an input angle, from each side if a sign changes there."""
    torque, rubs = _signs(machine, A, deg, 1.0)
    rows = []
    for drives, slides in product((1.0, -1.0), (1.0, -1.0)):
        rubs = _signs(machine, A, deg, drives)[1]
        # where a sliding is 0 but for rounding, both its signs have their limit
        if torque * drives >= 0 and (rubs * slides >= 0 or abs(rubs) < 1e-12):
            rows.append(_loads(machine, A, deg, drives, slides))
    return rows


def _signs(machine: Mechanism, A: float, deg: float, drives: float) -> tuple[Any, Any]:
    """The wheel's torque, and the sliding over L in a roller that drives, or holds back."""
    torque, velocity, _, along, turns, radius = _contact(machine, A, deg)
    return torque, along + drives * (turns + velocity) * radius


def _contact(machine: Mechanism, A: float, deg: float) -> tuple[Any, ...]:
    """Torque, wheel speed, pin distance and its rate, crank speed and roller radius, over L."""
    mp, spec = digits(), machine.spec
    x = mp.mpf(deg) * mp.pi / 180
    _, velocity, acceleration, _ = motion(spec.wheel.z, "external", A, x)
    w = mp.mpf(spec.drive.n_rpm) * mp.pi / 30
    torque = mp.mpf(spec.load.inertia_kgm2) * w * w * acceleration + mp.mpf(spec.load.torque_Nm)
    E = mp.expj(x)
    crank = mp.sin(mp.pi / spec.wheel.z) * mp.conj((A + E) / abs(A + E))
    turns = (E / (A + E)).real
    pin = 1 - crank
    along = turns * (1j * crank * mp.conj(pin)).real / abs(pin)
    radius = mp.mpf(machine.roller_radius_mm) / mp.mpf(machine.center_distance_mm)
    return torque, velocity, abs(pin), along, turns, radius


def _loads(machine: Mechanism, A: float, deg: float, drives: float, slides: float) -> Sequence[Any]:
    """Each of ``LOADS``, for known signs of the torque and of the sliding."""
    mp, spec = digits(), machine.spec
    torque, velocity, rho, along, turns, radius = _contact(machine, A, deg)
    friction, L = mp.mpf(spec.load.friction), mp.mpf(machine.center_distance_mm) / 1000
    force = torque * drives / (rho - radius * friction * slides) / L
    rubs = along + drives * (turns + velocity) * radius
    shaft = torque * velocity + friction * slides * force * rubs * L
    assert spec.size.face_width_mm is not None
    modulus = 1 / sum(
        (1 - mp.mpf(m.poisson_ratio) ** 2) / mp.mpf(m.youngs_modulus_GPa)
        for m in (wheel_material(spec), roller_material(spec))
    )
    flat = modulus * 1000 / (mp.pi * mp.mpf(spec.size.face_width_mm) * machine.roller_radius_mm)
    return force, shaft, mp.sqrt(abs(force) * flat)
