"""The load case of a machine, from its spec; pressures of contacts."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from geneva_cli.loads.carried import carried_kg, inertia_kgm2, resisting_torque_Nm
from geneva_cli.loads.contact import LoadCase
from geneva_cli.loads.strength.pin import pin_diameter_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import thing
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, all_true, choose, library
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.workshops import Stock


def contact_modulus_GPa(one: Stock, other: Stock) -> float:
    """E* of two materials in contact, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2."""
    each = ((1.0 - m.poisson_ratio**2) / m.youngs_modulus_GPa for m in (one, other))
    return 1.0 / sum(each)


def hertz_MPa(modulus_GPa: float, line_N_mm: N, radius_mm: float) -> N:
    """Hertz stress on a line, from E*, the force per length and the effective radius."""
    modulus = modulus_GPa * 1e3
    out: N = library(line_N_mm, radius_mm).sqrt(line_N_mm * modulus / (math.pi * radius_mm))
    return out


def load_case(mechanism: Mechanism) -> LoadCase:
    """The load case of a machine's spec."""
    spec = mechanism.spec
    load, size = spec.load, spec.size
    w = omega(spec.drive.n_rpm)
    hertz = None
    if size.face_width_mm is not None:
        # p0² = N E* / (pi b R_e)
        modulus = contact_modulus_GPa(wheel_material(spec), roller_material(spec)) * 1e3
        hertz = modulus / (math.pi * size.face_width_mm * mechanism.roller_radius_mm)
    case = LoadCase(
        w,
        inertia_kgm2(spec) * w * w,
        resisting_torque_Nm(spec),
        mechanism.center_distance_mm / 1000.0,
        mechanism.roller_radius_mm / mechanism.center_distance_mm,
        rubbing(mechanism),
        load.efficiency,
        hertz,
        mechanism.frame,
        design=mechanism.design,
    )
    complete: Callable[[Mechanism, LoadCase], LoadCase] | None
    complete = thing(spec.wheel.NAME, "load_case")
    return complete(mechanism, case) if complete else case


def rubbing(mechanism: Mechanism) -> float:
    """Ratio of the force along the wall to the force on it, for a roller that moves along it.

    A roller fixed to its pin rubs in the slot, with the coefficient itself. One that turns on its
    pin rolls, held back by the pin: the load passes a circle with the pin's radius times sin rho,
    tan rho being the coefficient. So its angle to the wall's normal has the sine: sin rho times pin
    over roller. In either case the friction work is N times the speed along the wall times this
    ratio.
    """
    load = mechanism.spec.load
    if all_true(load.friction == 0.0) or load.friction_at == "slot":
        return load.friction
    thickness = 0.5 * pin_diameter_mm(mechanism) / mechanism.roller_radius_mm
    m = library(thickness, load.friction)
    sine = thickness * load.friction / m.hypot(1.0, load.friction)
    turning = sine / m.sqrt((1.0 - sine) * (1.0 + sine))
    coefficient: float = choose(thickness == 1.0, load.friction, turning)
    return coefficient


def centrifugal_N(mechanism: Mechanism) -> Array:
    """The centrifugal force of all bodies on a wheel on a carrier, N, (m, 1)."""
    spec, L = mechanism.spec, mechanism.center_distance_mm / 1000.0
    return np.atleast_2d(carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L)
