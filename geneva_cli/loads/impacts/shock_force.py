"""Impulse of a jump of the wheel's velocity, and the force of an elastic contact.

A roller, which the crank carries on unmoved, strikes the wheel's inertia I at its lever. Under the
force Q the roller is pressed into the wall and its pin is bent, together by

    d = c Q^0.9 + Q / k,    c = 3.84e-5 mm / N^0.9 / b^0.8    (b: contact line, mm).

The force is greatest where c Q^1.9 0.9 / 1.9 + Q² / (2 k) equals the energy I dw² / 2. Palmgren
measured c for steel on steel (Ball and Roller Bearing Engineering, 3rd ed., 1959). It is
proportional to the 0.9th power of the materials' softness. The pin bends under a force in its
roller's middle (``pin.stiffness_N_mm``).
"""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.carried import MM, inertia_kgm2
from geneva_cli.loads.forces import contact_modulus_GPa
from geneva_cli.loads.strength.pin import stiffness_N_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, Number, Whole, size
from geneva_cli.numerics.newton import find_roots
from geneva_cli.spec.materials import roller_material, wheel_material
from geneva_cli.spec.workshops import Stock

POWER, WIDTH = 0.9, 0.8


def impulse_Nms(mechanism: Mechanism, jump: N) -> N:
    """Moment of the impact, I dw, for a jump over the input's speed; over the lever its impulse.

    The roller stays at the wall: a plastic impact, the least possible. For m designs jumps and
    moments are (m, 1).
    """
    w = omega(mechanism.spec.drive.n_rpm)
    return size(jump) * (inertia_kgm2(mechanism.spec) * w)


def forces_N(mechanism: Mechanism, jump: Array, pin_mm: Number) -> Array | None:
    """Greatest forces of elastic impacts, for jumps and pin diameters (m, 1) of m designs: (m,).

    NaN without an inertia; None without a ``face_width_mm``.
    """
    spec = mechanism.spec
    face, inertia = spec.size.face_width_mm, inertia_kgm2(spec)
    if face is None:
        return None
    dw = jump * omega(spec.drive.n_rpm)
    energy = 0.5 * inertia * dw * dw / MM  # N mm
    steel = Stock()  # on steel: half of its plane strain modulus
    usual = 0.5 * steel.youngs_modulus_GPa / (1.0 - steel.poisson_ratio**2)
    soft = usual / contact_modulus_GPa(wheel_material(spec), roller_material(spec))
    # Palmgren's constant in mm, for 1 N on a line of 1 mm, steel on steel
    press = 3.84e-5 * soft**POWER / face**WIDTH
    modulus_GPa = roller_material(spec).youngs_modulus_GPa
    bend = 1.0 / stiffness_N_mm(spec.size, face, pin_mm, modulus_GPa)
    rows = np.broadcast_arrays(energy, press, bend, inertia)
    work, c, k, heavy = (row[:, 0] for row in rows)

    def over(force: Array, live: Whole) -> tuple[Array, Array]:
        pressed, bent = c[live] * POWER * force**POWER, k[live] * force
        return pressed * force / (1.0 + POWER) + 0.5 * bent * force - work[live], pressed + bent

    force = find_roots(over, 0.0 * work, np.sqrt(2.0 * work / k))
    return np.where(heavy > 0.0, force, np.nan)
