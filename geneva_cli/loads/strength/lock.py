"""The lock under a torque in the dwell, and the contact at a stop of the crank.

The wheel turns through its play until disc and recess touch (``locking``). The force passes through
the axis of disc or recess, at an angle phi to the line of centres: a torque M needs
F = M/(L sin phi). The wheel's deflection is the play, which is exact; the approach of a cylinder of
radius R1 and a body as thick as the horn (Johnson, Contact Mechanics, 5.6), a being Hertz's half
width,

    F (1 - nu²)/(pi b E) [2 ln(4 R1/a) - 1 + 2 ln(2 h/a) - nu/(1 - nu)]

or, if a is more than a quarter of the horn, of two columns under the pressure below; and the
bending of the horn (``horn``) under a force at its end, 6 to 30 % less than in plane stress.

A sharp end has no finite contact stress. Without clearance the arcs lie on each other, as they do
after wear, and the pressure is as the sine of the angle from the line of centres: at most
2 M sin phi/(b R L (phi - sin phi cos phi)).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.load_case import contact_modulus_GPa, hertz_MPa
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.batch import designs_in, taken
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Number, all_true, blocks, value_or
from geneva_cli.spec.defaults import wheel_material

if TYPE_CHECKING:
    from geneva_cli.loads.strength.horn import HornStress

SHEAR = 1.2  # of a rectangular section: energy of its shear stress over that of the mean stress


# Values of a lock: Hertz's contact stress is NaN for a sharp edge, and without clearance; the
# pressure is that after wear. The deflection is the sum of play, approach and bending.
VALUES = (
    *("torque_Nm", "force_N", "contact_stress_MPa", "pressure_MPa", "horn_stress_MPa"),
    *("play_deg", "approach_deg", "bending_deg", "deflection_deg"),
)


def dwell_torque_Nm(mechanism: Mechanism) -> Array:
    """Torque in the wheel's shaft during the dwell, (m,); 0 without one of the spec.

    A load that only resists motion, as ``torque_Nm`` does, needs none at rest.
    """
    torque = mechanism.spec.load.dwell_torque_Nm
    return np.broadcast_to(np.ravel(0.0 if torque is None else torque), mechanism.designs)


def held_force_N(mechanism: Mechanism, by: Lock | None) -> Array:
    """The force of disc on wheel that holds the torque in the dwell, (m,); 0 without a lock."""
    torque = dwell_torque_Nm(mechanism)
    if by is None or not torque.any():
        return 0.0 * torque
    return np.nan_to_num(1e3 * torque / np.ravel(by.L * np.sin(by.contact().phi)))


def loaded_locks(
    mechanism: Mechanism, half_width_mm: float, by: Lock, width_mm: Number
) -> dict[str, Array] | None:
    """The ``VALUES`` of locks of m designs, of sizes (m, 1): (m,) each, NaN if unknown.

    None if no design has a torque.
    """
    load, width = mechanism.spec.load, width_mm
    torque = value_or(load.dwell_torque_Nm, load.torque_Nm)
    if all_true(torque == 0.0):
        return None
    touch, known = by.contact(), np.atleast_2d(np.where(torque == 0.0, np.nan, torque))
    sine, lock = np.sin(touch.phi), by.lock
    lever, worn = by.L * sine, touch.phi - sine * np.cos(touch.phi)
    force = 1e3 * known / lever
    pressure = 2e3 * known * sine / (width * lock * by.L * worn)
    arcs = np.equal(touch.on, "recess")  # no horn is bent
    give, bent_MPa, thick = map(np.atleast_2d, (0.0, 0.0, by.recess))
    if not arcs.all():
        bent = bending(mechanism, half_width_mm, by.recess, touch.phi)
        give, bent_MPa = np.where(arcs, 0.0, bent[0]), np.where(arcs, 0.0, bent[1])
        thick = np.where(arcs, thick, bent[2])
    line = force / width
    # Hertz's stress, and the approach; both NaN for a sharp edge, the stress without clearance
    material, radius = wheel_material(mechanism.spec), touch.radius
    nu, modulus = material.poisson_ratio, contact_modulus_GPa(material, material)
    gives = 0.5 / (1e3 * modulus)  # (1 - nu²)/E of each body, mm²/N
    sharp, loose = np.equal(radius, 0.0), np.isfinite(radius)
    with np.errstate(all="ignore"):
        stress = np.where(loose & ~sharp, hertz_MPa(modulus, line, radius), np.nan)
        half = np.sqrt(8.0 * gives * line * radius / math.pi)
        round_ = 2.0 * np.log(4.0 * lock / half) - 1.0
        flat = 2.0 * np.log(2.0 * thick / half) - nu / (1.0 - nu)
        local = gives * line / math.pi * (round_ + flat)
        columns = gives * pressure * (lock + thick)
    approach = np.where(sharp, np.nan, np.where(half > 0.25 * thick, columns, local))
    play, near = np.degrees(touch.play), np.degrees(approach / lever)
    turned = np.degrees(give * line / lever)
    rows = known, force, stress, pressure, bent_MPa * line, play, near, turned, play + near + turned
    every = np.reshape(np.broadcast_arrays(*rows), (len(rows), -1))
    every[:, np.isnan(every[1])] = np.nan  # without a force nothing is known
    return dict(zip(VALUES, every, strict=True))


def horn_MPa(
    machine: Mechanism, half_width: float, by: Lock, known: HornStress | None = None
) -> Array:
    """Return the greatest stress in horns 1 mm thick, (m,), by the roller or the dwell's torque."""
    from geneva_cli.loads.strength.horn import greatest_stress, horns

    own = known or greatest_stress(horns, machine, (half_width, by.recess))
    held = loaded_locks(machine, half_width, by, 1.0)
    rows = np.broadcast_arrays(own.stress_MPa, *([held["horn_stress_MPa"]] if held else []))
    return np.fmax(0.0, np.fmax.reduce(rows))


def bending(mechanism: Mechanism, half_width: float, recess: float, phi: float) -> Array:
    """The weakest horn of each of m designs under 1 N per mm, (3, m, 1).

    The rows are the deflection of its end, mm, its stress, MPa, and its thickness, mm.
    """
    from geneva_cli.loads.strength.horn import horns

    every, m = (mechanism, half_width, recess, phi), mechanism.designs
    spec, under = mechanism.spec, mechanism.under_load.engagements
    shape = spec.wheel, spec.size, spec.material_wheel, mechanism.center_distance_mm, under
    if m > 8 and designs_in((shape, every[1:])) > 1:  # the sections of 8 designs stay in the cache
        return np.concatenate([bending(*taken(every, some)) for some in blocks(m, 8)], axis=1)
    material = wheel_material(spec)
    E = 1e3 * material.youngs_modulus_GPa
    G = E / (2.0 * (1.0 + material.poisson_ratio))
    weakest = np.full((3, 1, 1), -np.inf)
    for side in horns(mechanism, half_width, recess):
        # sums by trapezoids over 2001 sections have an error of a ten-thousandth at worst
        places = side.at.mouth_deg * np.linspace(1.0, NEAR_CUSP, 2001)
        points = side.points(places)
        wall, thick, normal, own = points[:3:2], points[1], points[3:5], points[6]
        middle = wall + 0.5 * thick * normal
        towards = abs((side.centre * side.axes[1]).sum(axis=0)) / np.hypot(*side.centre)
        ahead = np.arccos(np.minimum(1.0, towards))  # direction of the wheel's axis
        tilt = phi - ahead  # angle of the force from the mouth's direction
        x, y = -np.sin(tilt), np.cos(tilt)
        moment = middle[0] * y - middle[1] * x
        across = x * normal[0] + y * normal[1]
        push = abs(x * normal[1] - y * normal[0])
        give = 12.0 * moment**2 / (E * thick**3) + SHEAR * across**2 / (G * thick)
        stress = 6.0 * abs(moment) / thick**2 + push / thick
        # where another horn has begun, or without a foot, nothing belongs to this one
        own = np.where(np.logical_and.accumulate(own > 0.0, axis=1), own, np.fmin(own, 0.0))
        # fractions of each strip between two sections before it is past the force, or of another
        edges = np.stack(np.broadcast_arrays(wall[0] - recess * x, -own))
        first, last = edges[..., :-1], edges[..., 1:]
        with np.errstate(all="ignore"):
            part = np.where(last > 0.0, -first / (last - first), 1.0)
        begins, ends = np.where(first >= 0.0, 0.0, part)
        length = np.hypot(*np.diff(wall)) * np.maximum(ends - begins, 0.0)
        both = np.stack(np.broadcast_arrays(give, stress))
        both = np.where(np.isfinite(both), both, 0.0)
        low = both[..., :-1] + np.diff(both) * begins
        high = both[..., :-1] + np.diff(both) * ends
        rows = np.broadcast_arrays(
            np.where(length > 0.0, 0.5 * (low[0] + high[0]) * length, 0.0).sum(axis=1),
            np.where(length > 0.0, np.fmax(low[1], high[1]), 0.0).max(axis=1),
            np.where(own > 0.0, thick, np.inf).min(axis=1),
        )
        horn = np.stack(rows)[:, :, None]
        weakest = np.where(horn[0] > weakest[0], horn, weakest)  # the greater deflection counts
    # what does not differ, as where loads alone do, is one row for all of them
    return np.broadcast_to(weakest, (3, m, 1))
