"""Warnings about what the wheel carries, materials, unlikely numbers, keys without effect."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import Notice
from geneva_cli.loads.carried import G, inertia_kgm2, weight_kg
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.tables import Motor

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import MassProperties


def carried_warnings(mechanism: Mechanism, plate: MassProperties | None) -> list[Notice]:
    """Warnings about missing inertia, bodies off the axis, units, and keys without effect."""
    spec = mechanism.spec
    return [*_masses(spec, plate), *_materials(spec), *_keys_without_effect(spec)]


def _masses(spec: Spec, plate: MassProperties | None) -> Iterator[Notice]:
    """Warnings about a wheel whose own inertia is left out, and weight to one side."""
    inertia = inertia_kgm2(spec)
    # a [[mass]] of this name is the wheel itself; a twentieth is within what loads are known to
    counted = any(mass.name == "wheel" for mass in spec.mass)
    if plate and inertia and not counted and plate.inertia_kgm2 > 0.05 * inertia:
        own = plate.inertia_kgm2
        helps = f"{own:.4g} on inertia_kgm2 in [load]"
        if spec.support.gear_ratio == 1.0:  # masses are on the table, behind its gears
            across = 1e3 * math.sqrt(8.0 * own / plate.mass_kg)
            helps = f'[[mass]] with name = "wheel", shape = "disc", mass_kg = {plate.mass_kg:.4g} '
            helps += f"and diameter_mm = {across:.4g}"
        yield Notice(
            "wheel-left-out",
            f"the wheel's own inertia, as drawn, is {own:.4g} kg m², "
            f"{100.0 * own / inertia:.3g} % of the {inertia:.4g} kg m² of the load: if the load "
            f"leaves it out, add {helps}",
        )
    for mass in spec.mass if spec.support.axis == "horizontal" else ():
        if mass.to_one_side:
            torque = spec.support.gear_ratio * weight_kg(mass) * G * mass.radius_mm * 1e-3
            yield Notice(
                "weight-to-one-side",
                f"{mass.name or mass.shape} stands {mass.radius_mm:g} mm off a horizontal "
                f"axis. Its weight puts up to {torque:.4g} N m on the wheel in either "
                "direction. That is not counted: balance it with another body (count = 2), or "
                "add the torque to torque_Nm in [load]",
            )


def _materials(spec: Spec) -> Iterator[Notice]:
    """Warnings about materials that seem to be in another unit."""
    # No material is stiffer than diamond, heavier than osmium, or as light as a density in g/cm3
    # suggests.
    diamond_GPa, osmium_kgm3, foam_kgm3 = 1220.0, 22590.0, 25.0
    parts = {"[material.wheel]": spec.material_wheel, "[material.roller]": spec.material_roller}
    dense = [("[[mass]]", mass.density_kgm3) for mass in spec.mass]
    said = []
    for table, part in parts.items():
        dense.append((table, part.density_kgm3))
        modulus = part.youngs_modulus_GPa
        if modulus is not None and modulus > diamond_GPa:
            said.append(
                f"youngs_modulus_GPa = {modulus:g} in {table} is stiffer than diamond "
                f"({diamond_GPa:g} GPa): if it is in MPa, write {1e-3 * modulus:g}"
            )
    for table, density in dense:
        if density is not None and density < foam_kgm3:
            said.append(
                f"density_kgm3 = {density:g} in {table} is lighter than foam: if it is in g/cm³, "
                f"write {1e3 * density:g}"
            )
        elif density is not None and density > osmium_kgm3:
            said.append(
                f"density_kgm3 = {density:g} in {table} is heavier than osmium: if it is in g/m³, "
                f"write {1e-3 * density:g}"
            )
    for text in said:
        yield Notice("unlikely-material", text)


def _keys_without_effect(spec: Spec) -> Iterator[Notice]:
    """Warnings about keys that lack others."""
    support, said = spec.support, []
    if not spec.is_loaded and spec.motor != Motor():
        said.append(
            "[motor] has no load to drive, so no motor or flywheel is computed: set "
            f"{spec.load_keys}"
        )
    if bool(support.friction) != bool(support.radius_mm):
        keys = ("friction", "radius_mm")
        present, lacking = keys if support.friction else reversed(keys)
        said.append(
            f"{present} in [support] has no effect without {lacking}: set {lacking}, or remove "
            f"{present}"
        )
    elif support.friction and not (spec.mass or support.force_N):
        said.append(
            "friction in [support] has no effect, because nothing presses on the support: set "
            "force_N there, or give the weight as [[mass]]"
        )
    for text in said:
        yield Notice("nothing-to-act-on", text)


def unlikely_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about a length or an inertia that may be in another unit."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    least_mm = 5.0  # the smallest watches have stops of some mm
    if not least_mm <= L:
        yield Notice(
            "tiny-machine",
            f"the {spec.wheel.DISTANCE} of {L:.4g} mm is below {least_mm:g} mm: check that it is "
            f"in mm. If it is in metres, write {1e3 * L:.4g}; if it is in inches, {25.4 * L:.4g}",
        )
    # The largest table expected is solid steel, 6 L across and L/2 thick; J = pi rho h D^4 / 32. A
    # larger inertia is nearly always meant in kg cm2.
    diameter, thickness, density = 6e-3 * L, 0.5e-3 * L, 7850.0  # m, m, kg/m3
    most = math.pi * density * thickness * diameter**4 / 32.0
    inertia = inertia_kgm2(spec) if mechanism.output.turns else 0.0
    if inertia > most:
        yield Notice(
            "heavy-inertia",
            f"an inertia of {inertia:.4g} kg m² is large for a centre distance of {L:.4g} "
            f"mm. A solid steel table {1e3 * diameter:.4g} mm across and {1e3 * thickness:.4g} "
            f"mm thick has {most:.3g} kg m². If it is in kg cm², write {1e-4 * inertia:.4g}",
        )
