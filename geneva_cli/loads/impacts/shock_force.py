"""Impulse of a jump of the wheel's velocity, and the force of an elastic contact.

A roller strikes the wheel's inertia at its lever. Under the force Q it is pressed into the wall and
its pin is bent, by d = c Q^0.9 + Q / k with c = 3.84e-5 mm / N^0.9 / b^0.8 (contact line b, mm).
The force is greatest where c Q^1.9 0.9 / 1.9 + Q² / (2 k) equals the energy I dw² / 2. Palmgren
measured c for steel on steel (Ball and Roller Bearing Engineering, 3rd ed., 1959); it is
proportional to the 0.9th power of the materials' softness.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.load_case import MM, contact_modulus_GPa, inertia_kgm2, load_case
from geneva_cli.loads.strength.pin_arm_key import PinSize, stiffness_N_mm
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, Number, Whole, parameter, size
from geneva_cli.numerics.roots import find_roots
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.workshops import Stock

POWER, WIDTH = 0.9, 0.8


class Impacts(NamedTuple):
    """Jumps of the wheel's velocity over the input's, and what they cause.

    Of m designs (m,) each; NaN if there is none, or if it is not known.
    """

    at_deg: Array
    jump: Array
    force_N: Array
    moment_Nms: Array
    contact_stress_MPa: Array


def shown(mechanism: Mechanism, engagement: Engagement, at_deg: Array, *others: Array) -> Array:
    """Displayed input angles, jumps, and what else there is of an engagement's impacts, as rows."""
    places = mechanism.shown_deg(parameter(engagement.mid_deg + at_deg[:, None]))
    return np.stack(np.broadcast_arrays(np.ravel(places), *others))


def hardest(mechanism: Mechanism, each: Iterable[Array], pin: PinSize | None) -> Impacts:
    """The hardest impact of m designs, with its force and moment; the first of equal ones.

    ``each`` has displayed input angles, jumps, and the edges of the walls that strike, as
    ``Instant`` has them: (3, m). Without the ``pin`` forces are not known.
    """
    best, hertz = np.full((3, mechanism.designs), np.nan), load_case(mechanism).hertz
    for rows in each:
        best = np.where(abs(rows[1]) > np.nan_to_num(abs(best[1]), nan=-1.0), rows, best)
    at_deg, jump, edge = best
    moment = np.ravel(impulse_Nms(mechanism, jump[:, None]))
    force = np.nan if pin is None else forces_N(mechanism, jump[:, None], pin)
    with np.errstate(divide="ignore"):  # a wall as sharp as the roller
        square = force * np.ravel(np.nan if hertz is None else hertz) / np.maximum(edge, 0.0)
    moment = np.where(moment == 0.0, np.nan, moment)
    return Impacts(*np.broadcast_arrays(at_deg, jump, force, moment, np.sqrt(square)))


def impulse_Nms(mechanism: Mechanism, jump: N) -> N:
    """Moment of a plastic impact, I dw, for a jump over the input's speed; (m, 1) for m designs."""
    w = omega(mechanism.spec.drive.n_rpm)
    return size(jump) * (inertia_kgm2(mechanism.spec) * w)


def forces_N(mechanism: Mechanism, jump: Array, pin: PinSize) -> Array:
    """Greatest forces of elastic impacts, for jumps (m, 1): (m,); NaN without an inertia."""
    work, press, bend = _struck(mechanism, jump, pin)

    def over(force: Array, live: Whole) -> tuple[Array, Array]:
        stored, slope = _energy(force, press[live], bend[live])
        return stored - work[live], slope

    force = find_roots(over, 0.0 * work, np.sqrt(2.0 * work / bend))
    heavy = np.broadcast_to(np.ravel(inertia_kgm2(mechanism.spec)), len(force)) > 0.0
    return np.where(heavy, force, np.nan)


def least_pin_mm(
    mechanism: Mechanism,
    jump: Array,
    pin: PinSize,
    stress_MPa: tuple[Number, Number],
    allowed_MPa: Number,
) -> Array:
    """Diameters at which pins hold impacts, for jumps (m, 1); NaN without one: (m,).

    ``stress_MPa`` are bending and shear of the ``pin`` under 1 N on the wall. A thicker pin is
    struck harder, but the force that it allows grows as d³, or d² in shear, and the energy that it
    stores: one diameter just holds.
    """
    work, press, bend = _struck(mechanism, jump, pin)
    rows = stress_MPa[0], math.sqrt(3.0) * stress_MPa[1], allowed_MPa, pin.diameter_mm
    bending, shear, allowed, usual = (np.broadcast_to(np.ravel(row), len(work)) for row in rows)

    def over(d: Array, live: Whole) -> tuple[Array, Array]:
        ratio = d / usual[live]
        bent, sheared = bending[live] / ratio**3, shear[live] / ratio**2
        force = allowed[live] / np.maximum(bent, sheared)
        give = bend[live] / ratio**4
        stored, slope = _energy(force, press[live], give)
        grows = slope * force * np.where(bent > sheared, 3.0, 2.0)
        weaker = 2.0 * give * force * force  # of a thicker pin, which bends less
        return stored - work[live], (grows - weaker) / d

    some = np.where(work > 0.0, 1.0, np.nan) * usual
    return find_roots(over, 1e-4 * some, 1e4 * some)


def _energy(force: Array, press: Array, bend: Array) -> tuple[Array, Array]:
    """The energy that a force stores, N mm, and its slope, mm."""
    pressed, bent = POWER * press * force**POWER, bend * force
    return pressed * force / (1.0 + POWER) + 0.5 * bent * force, pressed + bent


def _struck(mechanism: Mechanism, jump: Array, pin: PinSize) -> tuple[Array, Array, Array]:
    """Energy of impacts, N mm, Palmgren's c, and 1/k of pin or teeth, mm/N: (m,) each."""
    spec, width = mechanism.spec, pin.contact_mm
    dw = jump * omega(spec.drive.n_rpm)
    energy = 0.5 * inertia_kgm2(spec) * dw * dw / MM
    steel = Stock()  # on steel: half of its plane strain modulus
    usual = 0.5 * steel.youngs_modulus_GPa / (1.0 - steel.poisson_ratio**2)
    soft = usual / contact_modulus_GPa(wheel_material(spec), roller_material(spec))
    # Palmgren's constant in mm, for 1 N on a line of 1 mm, steel on steel
    press = 3.84e-5 * soft**POWER / width**WIDTH
    modulus_GPa = roller_material(spec).youngs_modulus_GPa
    bend = 1.0 / stiffness_N_mm(spec.size, width, pin.diameter_mm, modulus_GPa)
    work, press, bend = (row[:, 0] for row in np.broadcast_arrays(energy, press, bend))
    return work, press, bend
