"""Impulse of a jump of the wheel's velocity, and the force of an elastic contact.

A roller strikes the wheel's inertia at its lever. Under the force Q it is pressed into the wall and
its pin is bent, by d = c Q^0.9 + Q / k with c = 3.84e-5 mm / N^0.9 / b^0.8 (contact line b, mm).
The force is greatest where c Q^1.9 0.9 / 1.9 + Q² / (2 k) equals the energy I dw² / 2. Palmgren
measured c for steel on steel (Ball and Roller Bearing Engineering, 3rd ed., 1959); it is
proportional to the 0.9th power of the materials' softness.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.load_case import MM, contact_modulus_GPa, load_case
from geneva_cli.loads.strength.pin_arm_key import PinSize, stiffness_N_mm
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, N, Whole, parameter, size
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
    force = np.nan if pin is None else forces_N(mechanism, jump[:, None], pin)[:, 0]
    with np.errstate(divide="ignore"):  # a wall as sharp as the roller
        square = force * np.ravel(np.nan if hertz is None else hertz) / np.maximum(edge, 0.0)
    moment = np.where(moment == 0.0, np.nan, moment)
    return Impacts(*np.broadcast_arrays(at_deg, jump, force, moment, np.sqrt(square)))


def impulse_Nms(mechanism: Mechanism, jump: N) -> N:
    """Moment of a plastic impact, I dw, for a jump over the input's speed; (m, 1) for m designs."""
    case = load_case(mechanism)
    return size(jump) * (case.inertia_Nm / case.speed_rad_s)


def forces_N(mechanism: Mechanism, jump: Array, pin: PinSize) -> Array:
    """Greatest forces of elastic impacts, for jumps and pins (m, k); NaN without an inertia."""
    spec, width, inertia = mechanism.spec, pin.contact_mm, load_case(mechanism).inertia_Nm
    steel = Stock()  # on steel: half of its plane strain modulus
    usual = 0.5 * steel.youngs_modulus_GPa / (1.0 - steel.poisson_ratio**2)
    soft = usual / contact_modulus_GPa(wheel_material(spec), roller_material(spec))
    # Palmgren's constant in mm, for 1 N on a line of 1 mm, steel on steel
    palmgren = 3.84e-5 * soft**POWER / width**WIDTH
    modulus_GPa = roller_material(spec).youngs_modulus_GPa
    stiffness = stiffness_N_mm(spec.size, width, pin.diameter_mm, modulus_GPa)
    rows = np.broadcast_arrays(0.5 * inertia * jump * jump / MM, palmgren, 1.0 / stiffness)
    work, press, bend = map(np.ravel, rows)  # energy in N mm, Palmgren's c, and 1/k

    def over(force: Array, live: Whole) -> tuple[Array, Array]:
        pressed, bent = POWER * press[live] * force**POWER, bend[live] * force
        stored = pressed * force / (1.0 + POWER) + 0.5 * bent * force
        return stored - work[live], pressed + bent

    force = find_roots(over, 0.0 * work, np.sqrt(2.0 * work / bend))
    return np.where(inertia > 0.0, force.reshape(rows[0].shape), np.nan)
