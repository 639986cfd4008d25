"""Impulse of a jump of the wheel's velocity, and the force of an elastic contact.

A roller, which the crank carries on unmoved, strikes the wheel's inertia I at its lever. Under the
force Q the roller is pressed into the wall and its pin is bent, together by

    d = c Q^0.9 + Q / k,    c = 3.84e-5 mm / N^0.9 / b^0.8    (b: contact line, mm).

The force is greatest where c Q^1.9 0.9 / 1.9 + Q² / (2 k) equals the energy I dw² / 2. The thicker
a pin, the harder it is struck, but its stress falls: there is one diameter at which it just holds.
Palmgren measured c for steel on steel (Ball and Roller Bearing Engineering, 3rd ed., 1959). It is
proportional to the 0.9th power of the materials' softness. The pin bends under a force in its
roller's middle (``pin.stiffness_N_mm``).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.carried import MM, inertia_kgm2
from geneva_cli.loads.forces import contact_modulus_GPa
from geneva_cli.loads.strength.pin import Pin, PinSize, stiffness_N_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, Number, Whole, size
from geneva_cli.numerics.roots import find_roots
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


class _Struck(NamedTuple):
    """Energy of impacts, N mm, Palmgren's c, and 1/k of pin or teeth, mm/N: (m,) each."""

    work: Array
    press: Array
    bend: Array

    def energy(self, force: Array, live: Whole) -> tuple[Array, Array]:
        """The energy that a force stores, N mm, and its slope, mm."""
        pressed = POWER * self.press[live] * force**POWER
        bent = self.bend[live] * force
        return pressed * force / (1.0 + POWER) + 0.5 * bent * force, pressed + bent


def forces_N(mechanism: Mechanism, jump: Array, pin: PinSize) -> Array:
    """Greatest forces of elastic impacts, for jumps (m, 1) of m designs: (m,).

    NaN without an inertia.
    """
    struck = _struck(mechanism, jump, pin)

    def over(force: Array, live: Whole) -> tuple[Array, Array]:
        stored, slope = struck.energy(force, live)
        return stored - struck.work[live], slope

    force = find_roots(over, 0.0 * struck.work, np.sqrt(2.0 * struck.work / struck.bend))
    heavy = np.broadcast_to(np.ravel(inertia_kgm2(mechanism.spec)), len(force)) > 0.0
    return np.where(heavy, force, np.nan)


def least_pin_mm(
    mechanism: Mechanism, jump: Array, contact_mm: Number, pin: Pin, allowed_MPa: Number
) -> Array:
    """Diameters at which pins hold impacts, for jumps (m, 1); NaN without one: (m,).

    ``pin`` has the stresses at its diameter. The force that a diameter d allows grows as d³, or
    as d² in shear, and the energy that it stores with it: one diameter stores that of the impact.
    """
    struck = _struck(mechanism, jump, PinSize(pin.diameter_mm, contact_mm))
    rows = pin.bending, math.sqrt(3.0) * pin.shear, allowed_MPa, pin.diameter_mm
    bending, shear, allowed, usual = (
        np.broadcast_to(np.ravel(row), len(struck.work)) for row in rows
    )

    def over(d: Array, live: Whole) -> tuple[Array, Array]:
        ratio = d / usual[live]
        bent, sheared = bending[live] / ratio**3, shear[live] / ratio**2
        force = allowed[live] / np.maximum(bent, sheared)
        thicker = struck._replace(bend=struck.bend.copy())
        thicker.bend[live] /= ratio**4
        stored, slope = thicker.energy(force, live)
        grows = slope * force * np.where(bent > sheared, 3.0, 2.0)
        weaker = 2.0 * thicker.bend[live] * force * force  # of a thicker pin, which bends less
        return stored - struck.work[live], (grows - weaker) / d

    some = np.where(struck.work > 0.0, 1.0, np.nan) * usual
    return find_roots(over, 1e-4 * some, 1e4 * some)


def _struck(mechanism: Mechanism, jump: Array, pin: PinSize) -> _Struck:
    spec = mechanism.spec
    inertia, width = inertia_kgm2(spec), pin.contact_mm
    dw = jump * omega(spec.drive.n_rpm)
    energy = 0.5 * inertia * dw * dw / MM  # N mm
    steel = Stock()  # on steel: half of its plane strain modulus
    usual = 0.5 * steel.youngs_modulus_GPa / (1.0 - steel.poisson_ratio**2)
    soft = usual / contact_modulus_GPa(wheel_material(spec), roller_material(spec))
    # Palmgren's constant in mm, for 1 N on a line of 1 mm, steel on steel
    press = 3.84e-5 * soft**POWER / width**WIDTH
    modulus_GPa = roller_material(spec).youngs_modulus_GPa
    bend = 1.0 / stiffness_N_mm(spec.size, width, pin.diameter_mm, modulus_GPa)
    return _Struck(*(row[:, 0] for row in np.broadcast_arrays(energy, press, bend)))
