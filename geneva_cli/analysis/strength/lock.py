"""The lock under a torque in the dwell: force, contact, and how far the wheel gives.

The wheel turns through its play until the end of a recess rests on the locking disc, or an end of a
shorter disc on the recess, or the arcs on each other (``locking``). The force goes through the axis
of the disc or of the recess, at an angle phi to the line of centres, so that a torque M takes
F = M / (L sin phi). Three things make up the deflection:

- the play, exact: the turn that has used up the clearance;
- the approach of the two bodies (Johnson, Contact Mechanics, 5.6: a cylinder of radius R1, and a
  body as thick as the horn): F/(pi b) [(1 - nu1²)/E1 (2 ln(4 R1/a) - 1)
  + (1 - nu2²)/E2 (2 ln(2 h/a) - nu2/(1 - nu2))], a being Hertz's half width; where that is more
  than a quarter of the horn, both give as columns under the pressure that follows;
- the bending of the horn (see ``horn``) where the force is at its end. Plane stress gives 6 to
  30 % more, as the body that the horn stands on gives too.

On a sharp end no contact stress is finite: the recess's end needs a radius, and an end of the disc
has none. Without clearance the
arcs lie on each other as they do once they have worn in. The pressure then goes with the sine of
the angle from the line of centres, as the wear of a wheel that turns a little does: the greatest is
2 M sin phi/(b R L (phi - sin phi cos phi)).

Of one design, as the sizes of its parts are, which are found one design after the other.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.forces import contact_modulus_GPa
from geneva_cli.analysis.locking import Lock
from geneva_cli.analysis.strength.horn import SHEAR, horns

if TYPE_CHECKING:
    from geneva_cli.analysis.strength.horn import Side
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.jet import Array

SECTIONS = 4001  # of a horn, summed by trapezoids: to a millionth


class LockUnderTorque(NamedTuple):
    """A lock under a torque; None where something is not known."""

    torque_Nm: float
    on: str  # where disc and recess touch, as of ``LockContact``
    force_N: float
    contact_stress_MPa: float | None  # Hertz; None of a sharp edge, and without clearance
    pressure_MPa: float  # worn in
    horn_stress_MPa: float  # bending
    play_deg: float
    approach_deg: float | None
    bending_deg: float

    @property
    def deflection_deg(self) -> float | None:
        """All three together; None where the approach is not known."""
        if self.approach_deg is None:
            return None
        return self.play_deg + self.approach_deg + self.bending_deg


def held_torque_Nm(mechanism: Mechanism) -> float:
    """What the lock holds in the dwell."""
    load = mechanism.spec.load
    return load.torque_Nm if load.dwell_torque_Nm is None else load.dwell_torque_Nm


def lock(mechanism: Mechanism, half_width_mm: float, by: Lock) -> LockUnderTorque | None:
    """The lock of a machine whose parts have these radii; of its horns the one that gives most.

    None without a torque to hold, or a ``face_width_mm``.
    """
    L, lock_mm, recess_mm = by.L, by.lock, by.recess
    torque, width = held_torque_Nm(mechanism), mechanism.spec.size.face_width_mm
    if not (torque and width):
        return None
    found = by.contact()
    sine = math.sin(found.phi)
    force = 1e3 * torque / (L * sine)
    worn = found.phi - sine * math.cos(found.phi)
    pressure = 2e3 * torque * sine / (width * lock_mm * L * worn)
    bent, stress, thick = (
        _bending(mechanism, half_width_mm, recess_mm, found.phi)
        if found.on != "recess"
        else (0.0, 0.0, recess_mm)
    )
    lever = L * sine
    contact, approach = _contact(mechanism, force / width, found.radius, lock_mm, thick, pressure)
    return LockUnderTorque(
        torque,
        found.on,
        force,
        contact,
        pressure,
        stress * force / width,
        math.degrees(found.play),
        None if approach is None else math.degrees(approach / lever),
        math.degrees(bent * force / width / lever),
    )


def _contact(
    mechanism: Mechanism, line: float, radius: float, lock: float, thick: float, pressure: float
) -> tuple[float | None, float | None]:
    """Hertz's stress, MPa, and the approach, mm, for a force on 1 mm; None of a sharp edge."""
    if not radius:
        return None, None
    modulus = contact_modulus_GPa(mechanism.spec) * 1e3
    stress = None if math.isinf(radius) else math.sqrt(line * modulus / (math.pi * radius))
    half = math.sqrt(4.0 * line * radius / (math.pi * modulus))
    wheel, disc = mechanism.spec.material_wheel, mechanism.spec.material_roller
    nu, mu = disc.poisson_ratio, wheel.poisson_ratio
    soft = (1.0 - nu * nu) / (1e3 * disc.youngs_modulus_GPa)
    yields = (1.0 - mu * mu) / (1e3 * wheel.youngs_modulus_GPa)
    if half > 0.25 * thick:
        return stress, pressure * (soft * lock + yields * thick)
    round_ = soft * (2.0 * math.log(4.0 * lock / half) - 1.0)
    flat = yields * (2.0 * math.log(2.0 * thick / half) - mu / (1.0 - mu))
    return stress, line / math.pi * (round_ + flat)


def _bending(
    mechanism: Mechanism, half_width: float, recess: float, phi: float
) -> tuple[float, float, float]:
    """The weakest horn under 1 N on 1 mm: its end's deflection, mm, stress, MPa, and thickness."""
    material = mechanism.spec.material_wheel
    E = 1e3 * material.youngs_modulus_GPa
    G = E / (2.0 * (1.0 + material.poisson_ratio))
    every = []
    for side in horns(mechanism, half_width, recess):
        wall, normal, thick = _sections(side)
        middle = wall + 0.5 * thick * normal
        towards = -side.centre / math.hypot(*side.centre)  # the wheel's axis
        ahead = math.acos(min(1.0, abs(float(towards @ side.across))))
        tilt = phi - ahead  # of the force, which goes through the disc's axis, against the mouth's
        x, y = -math.sin(tilt), math.cos(tilt)
        further = wall[0] >= recess * x
        moment = np.where(further, middle[0] * y - middle[1] * x, 0.0)
        across = np.where(further, x * normal[0] + y * normal[1], 0.0)
        push = abs(x * normal[1] - y * normal[0])
        give = 12.0 * moment**2 / (E * thick**3) + SHEAR * across**2 / (G * thick)
        stress = 6.0 * abs(moment) / thick**2 + push / thick
        way = np.hypot(*np.diff(wall))
        sum_ = float(np.sum(0.5 * (give[1:] + give[:-1]) * way))
        every.append((sum_, float(stress.max()), float(thick.min())))
    return max(every)


def _sections(side: Side) -> tuple[Array, Array, Array]:
    """The wall at a horn's sections, its normals there, and their thickness."""
    wall, normal = side.wall(side.places(SECTIONS))
    thick = side.thickness(wall, normal)
    real = np.isfinite(thick)
    return wall[:, real], normal[:, real], thick[real]
