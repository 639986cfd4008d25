"""The load case of a machine, from its spec: what the wheel carries, and what resists it.

Also the names of the loads that a machine has.
"""

import math
from operator import attrgetter

import numpy as np

from geneva_cli.kept import Known
from geneva_cli.loads.contact import OF_MOTION, PRESSED, LoadCase
from geneva_cli.loads.instant import QUANTITIES
from geneva_cli.loads.strength.pin_arm_key import pin_diameter_mm
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, N, all_true, choose, library
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.tables import Mass, Size
from geneva_cli.spec.workshops import Stock

G = 9.80665  # standard gravity, m/s²
MM = 1e-3  # metres
PARALLEL_SHAFTS = (
    "parallel shafts; on a sphere the force moves along them, and pushes along them too"
)


def contact_modulus_GPa(one: Stock, other: Stock) -> float:
    """E* of two materials in contact, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2."""
    soft = (1.0 - one.poisson_ratio**2) / one.youngs_modulus_GPa
    return 1.0 / (soft + (1.0 - other.poisson_ratio**2) / other.youngs_modulus_GPa)


def hertz_MPa(modulus_GPa: float, line_N_mm: N, radius_mm: float) -> N:
    """Hertz stress on a line, from E*, the force per length and the effective radius."""
    modulus = modulus_GPa * 1e3
    out: N = library(line_N_mm, radius_mm).sqrt(line_N_mm * modulus / (math.pi * radius_mm))
    return out


# All that the loads of a machine depend on: tables of its spec, and all sizes but these.
_TABLES = (
    *("wheel", "drive", "drive_before", "motion", "load", "mass", "support", "motor", "shaft"),
    *("material_wheel", "material_roller", "tolerance"),
)
FREE = (
    *("lock_radius_mm", "lock_clearance_mm", "wheel_bore_mm", "wheel_hub_mm", "crank_bore_mm"),
    *("crank_hub_mm", "arm_bore_mm"),
)
_SIZES = sorted({*Size.__annotations__}.difference(FREE))
_PATHS = *map("spec.{}".format, _TABLES), *map("spec.size.{}".format, _SIZES)
# Machines with the same key have the same loads.
load_key = attrgetter(*Mechanism._fields[1:], *_PATHS)
# A copy of the first known one of the machines that have the same loads.
first_alike = Known[Mechanism, Mechanism](Mechanism._replace, load_key)


def load_case(mechanism: Mechanism) -> LoadCase:
    """The load case of a machine's spec.

    Its friction is the ratio of the force along the wall to the force on it, for a roller that
    moves along the wall. A roller fixed to its pin rubs in the slot, with the coefficient itself.
    One that turns on its pin rolls, held back by the pin: the load passes a circle with the pin's
    radius times sin rho, tan rho being the coefficient. So its angle to the wall's normal has the
    sine: sin rho times pin over roller. In either case the friction work is N times the speed along
    the wall times this ratio.
    """
    spec, L, r = mechanism.spec, mechanism.center_distance_mm, mechanism.roller_radius_mm
    load, size, w = spec.load, spec.size, omega(spec.drive.n_rpm)
    hertz = None
    if size.face_width_mm is not None:
        # p0² = N E* / (pi b R_e)
        modulus = contact_modulus_GPa(wheel_material(spec), roller_material(spec)) * 1e3
        hertz = modulus / (math.pi * size.face_width_mm * r)
    friction = load.friction
    if not (all_true(load.friction == 0.0) or load.friction_at == "slot"):
        thickness = 0.5 * pin_diameter_mm(mechanism) / r
        m = library(thickness, load.friction)
        sine = thickness * load.friction / m.hypot(1.0, load.friction)
        turning = sine / m.sqrt((1.0 - sine) * (1.0 + sine))
        friction = choose(thickness == 1.0, load.friction, turning)
    inertia, resists = inertia_kgm2(spec) * w * w, sum(resisting_torques_Nm(spec))
    case = LoadCase(
        *(w, inertia, resists, L / 1000.0, r / L, friction, load.efficiency, hertz),
        frame=mechanism.frame,
        design=mechanism.design,
    )
    if complete := thing(spec.wheel.NAME, "load_case"):
        case = complete(mechanism, case)
    return case.with_friction(friction)


def centrifugal_N(mechanism: Mechanism) -> Array:
    """The centrifugal force of all bodies on a wheel on a carrier, N, (m, 1)."""
    spec, L = mechanism.spec, mechanism.center_distance_mm / 1000.0
    return np.full((mechanism.designs, 1), carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L)


def multiples(mechanism: Mechanism) -> dict[str, tuple[str, float | None, str]]:
    """Quantities that are multiples of others: the other's name, the factor, and the keys it needs.

    Of two bearings with the overhang a and the distance s, the nearer bears (a + s)/s, the other
    a/s.
    """
    shaft, output = vars(mechanism.spec.shaft), mechanism.output
    flat = mechanism.spec.wheel.FLAT or not output.turns
    out: dict[str, tuple[str, float | None, str]] = {
        "power_W": ("input_torque_Nm", load_case(mechanism).speed_rad_s, "")
    }
    for name, source, factor in output.loads:
        out[name] = source, factor, ""
    for name in ("wheel", "crank") if output.turns else ("crank",):
        a, s = shaft[f"{name}_overhang_mm"], shaft[f"{name}_span_mm"]
        needs = f"{name}_overhang_mm and {name}_span_mm in [shaft]" if flat else PARALLEL_SHAFTS
        far = a / s if flat and a is not None and s is not None else None
        near = None if far is None else 1.0 + far
        out[f"{name}_near_bearing_N"] = (f"{name}_bearing_N", near, needs)
        out[f"{name}_far_bearing_N"] = (f"{name}_bearing_N", far, needs)
    return out


def sources(mechanism: Mechanism) -> dict[str, tuple[str, float]]:
    """Each known quantity by name: the one that is searched for it, and its ratio to that."""
    unknown = {"wall_force_N"}  # the force on the pin, with the sign of a wall
    if not mechanism.spec.is_loaded:
        unknown = QUANTITIES.keys() - {*OF_MOTION}
    elif load_case(mechanism).hertz is None:
        unknown |= {*PRESSED}
    if mechanism.engagements[0].reactions is None:  # as the joints of all of them
        unknown |= {"guide_force_N"}
    out = {name: (name, 1.0) for name in QUANTITIES if name not in unknown}
    for name, (source, factor, _) in multiples(mechanism).items():
        if factor is not None and source in out:
            out[name] = source, factor
    for name in mechanism.output.lacks:
        out.pop(name, None)
    return out


def weight_kg(mass: Mass) -> float:
    """The mass of one body of a ``[[mass]]``, kg."""
    if mass.mass_kg is not None:
        return mass.mass_kg
    assert mass.density_kgm3 is not None and mass.thickness_mm is not None  # Mass has checked this
    D, d, a, c = _face_m(mass)
    face = a * c if a else 0.25 * math.pi * (D - d) * (D + d)
    return mass.density_kgm3 * face * mass.thickness_mm * MM


def _face_m(mass: Mass) -> list[float]:
    """Diameter and bore of a body's face, perpendicular to the wheel's axis, or its sides; m."""
    sizes = mass.diameter_mm, mass.bore_mm, mass.length_mm, mass.width_mm
    return [(size or 0.0) * MM for size in sizes]


def mass_inertia_kgm2(mass: Mass) -> float:
    """Inertia of all bodies of a ``[[mass]]`` about the table's axis, by Steiner's theorem."""
    (D, d, a, c), e, weight = _face_m(mass), mass.radius_mm * MM, weight_kg(mass)
    # about its own axis: m (D² + d²)/8, of a block m (a² + c²)/12
    own = weight * ((D * D + d * d) / 8.0 + (a * a + c * c) / 12.0)
    return mass.count * (own + weight * e * e)


def inertia_kgm2(spec: Spec) -> float:
    """Inertia of everything the wheel turns, at the wheel's shaft."""
    ratio, lever = spec.support.gear_ratio, spec.given_distance_mm * MM
    own = spec.load.inertia_kgm2 + spec.load.mass_kg * (lever * lever)
    return own + ratio * ratio * sum(map(mass_inertia_kgm2, spec.mass))


def carried_kg(spec: Spec) -> float:
    """The mass of all bodies on the table, kg."""
    return sum((mass.count * weight_kg(mass) for mass in spec.mass), 0.0)


def farthest_mm(spec: Spec) -> float:
    """Radius about the wheel's axis that contains all bodies on the table; 0 without bodies."""
    reaches = [0.0]
    for one in spec.mass:
        sides = one.length_mm or 0.0, one.width_mm or 0.0
        reaches.append(one.radius_mm + 0.5 * max(one.diameter_mm or 0.0, math.hypot(*sides)))
    return max(reaches)


def resisting_torques_Nm(spec: Spec) -> tuple[float, float]:
    """Torques that resist at the wheel's shaft while it turns, N m: of the work and of the support.

    The support's friction is mu (m g + F) r, through the gears.
    """
    load, support = spec.load, spec.support
    pressed = carried_kg(spec) * G + support.force_N
    rubbed = support.gear_ratio * support.friction * pressed * support.radius_mm * MM
    return load.torque_Nm + load.force_N * (spec.given_distance_mm * MM), rubbed
