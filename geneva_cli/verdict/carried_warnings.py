"""Warnings about what the wheel carries, about materials, unlikely numbers, keys without effect."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import Notice
from geneva_cli.loads.carried import G, inertia_kgm2, weight_kg
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import worst_of
from geneva_cli.numerics.angles import omega
from geneva_cli.spec.tables import Motor

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import MassProperties


def carried_warnings(mechanism: Mechanism, plate: MassProperties | None) -> list[Notice]:
    """Warnings about missing inertia, bodies off the axis, and keys without effect."""
    spec = mechanism.spec
    return [
        *_wheel_inertia(spec, plate),
        *_unbalanced(spec),
        *_distant(mechanism),
        *_unlikely_materials(spec),
        *_keys_without_effect(spec),
    ]


def _wheel_inertia(spec: Spec, plate: MassProperties | None) -> Iterator[Notice]:
    inertia = inertia_kgm2(spec)
    # a [[mass]] of this name is the wheel itself
    if plate is None or not inertia or any(mass.name == "wheel" for mass in spec.mass):
        return
    own = plate.inertia_kgm2
    # A twentieth of the load's inertia is within what loads are known to.
    if own <= 0.05 * inertia:
        return
    across = 1e3 * math.sqrt(8.0 * own / plate.mass_kg)
    helps = (
        f'[[mass]] with name = "wheel", shape = "disc", mass_kg = {plate.mass_kg:.4g} and '
        f"diameter_mm = {across:.4g}"
        if spec.support.gear_ratio == 1.0  # masses are on the table, behind its gears
        else f"{own:.4g} on inertia_kgm2 in [load]"
    )
    yield Notice(
        "wheel-left-out",
        f"the wheel's own inertia, as drawn, is {own:.4g} kg m², {100.0 * own / inertia:.3g} % "
        f"of the {inertia:.4g} kg m² of the load: if the load leaves it out, add {helps}",
    )


def _unbalanced(spec: Spec) -> Iterator[Notice]:
    """Warnings about masses to one side of a horizontal axis, whose gravity is not counted."""
    if spec.support.axis != "horizontal":
        return
    for mass in spec.mass:
        if mass.to_one_side:
            torque = spec.support.gear_ratio * weight_kg(mass) * G * mass.radius_mm * 1e-3
            yield Notice(
                "weight-to-one-side",
                f"{mass.name or mass.shape} stands {mass.radius_mm:g} mm off a horizontal "
                f"axis. Its weight puts up to {torque:.4g} N m on the wheel in either "
                "direction. That is not counted: balance it with another body (count = 2), or "
                "add the torque to torque_Nm in [load]",
            )


def _distant(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about a mass that is farther away than a table reaches."""
    far = max((mass.radius_mm for mass in mechanism.spec.mass), default=0.0)
    distances = far / mechanism.center_distance_mm
    if distances <= 5.0:  # centre distances: most tables are smaller
        return
    yield Notice(
        "far-mass",
        f"radius_mm = {far:g} in [[mass]] is {distances:.3g} centre distances from the wheel's "
        "axis: check that it is in mm",
    )


def _unlikely_materials(spec: Spec) -> Iterator[Notice]:
    """Warnings about materials that seem to be in another unit."""
    # No material is stiffer than diamond, heavier than osmium, or as light as a density in g/cm3
    # suggests.
    diamond_GPa, osmium_kgm3, foam_kgm3 = 1220.0, 22590.0, 25.0
    parts = {"[material.wheel]": spec.material_wheel, "[material.roller]": spec.material_roller}
    for table, part in parts.items():
        modulus = part.youngs_modulus_GPa
        if modulus is not None and modulus > diamond_GPa:
            yield Notice(
                "unlikely-material",
                f"youngs_modulus_GPa = {modulus:g} in {table} is stiffer than diamond "
                f"({diamond_GPa:g} GPa): if it is in MPa, write {1e-3 * modulus:g}",
            )
    dense = [("[[mass]]", mass.density_kgm3) for mass in spec.mass]
    for table, density in (*dense, *[(k, part.density_kgm3) for k, part in parts.items()]):
        if density is not None and not foam_kgm3 <= density <= osmium_kgm3:
            what = "lighter than foam" if density < foam_kgm3 else "heavier than osmium"
            other = 1e3 * density if density < foam_kgm3 else 1e-3 * density
            unit = "g/cm³" if density < foam_kgm3 else "g/m³"
            yield Notice(
                "unlikely-material",
                f"density_kgm3 = {density:g} in {table} is {what}: if it is in {unit}, write "
                f"{other:g}",
            )


def _keys_without_effect(spec: Spec) -> Iterator[Notice]:
    """Warnings about keys without effect."""
    if not spec.is_loaded and spec.motor != Motor():
        yield Notice(
            "nothing-to-act-on",
            "[motor] has no load to drive, so no motor or flywheel is computed: set "
            f"{spec.load_keys}",
        )
    support = spec.support
    if bool(support.friction) != bool(support.radius_mm):
        present, lacking = (
            ("friction", "radius_mm") if support.friction else ("radius_mm", "friction")
        )
        yield Notice(
            "nothing-to-act-on",
            f"{present} in [support] has no effect without {lacking}: set {lacking}, or remove "
            f"{present}",
        )
    elif support.friction and not (spec.mass or support.force_N):
        yield Notice(
            "nothing-to-act-on",
            "friction in [support] has no effect, because nothing presses on the support: set "
            "force_N there, or give the weight as [[mass]]",
        )


def unlikely_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about a length, an inertia or a speed that may be in another unit."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    least_mm = 5.0  # the smallest watches have stops of some mm
    if not least_mm <= L:
        yield Notice(
            "tiny-machine",
            f"the {spec.wheel.DISTANCE} of {L:.4g} mm is below {least_mm:g} mm: check that it is "
            f"in mm. If it is in metres, write {1e3 * L:.4g}; if it is in inches, {25.4 * L:.4g}",
        )
    if not mechanism.output.turns:
        return
    inertia = inertia_kgm2(spec)
    # The largest table expected is solid steel, 6 L across and L/2 thick; J = pi rho h D^4 / 32. A
    # larger inertia is nearly always meant in kg cm2.
    diameter, thickness, density = 6e-3 * L, 0.5e-3 * L, 7850.0  # m, m, kg/m3
    most = math.pi * density * thickness * diameter**4 / 32.0
    if inertia > most:
        yield Notice(
            "heavy-inertia",
            f"an inertia of {inertia:.4g} kg m² is large for a centre distance of {L:.4g} "
            f"mm. A solid steel table {1e3 * diameter:.4g} mm across and {1e3 * thickness:.4g} "
            f"mm thick has {most:.3g} kg m². If it is in kg cm², write {1e-4 * inertia:.4g}",
        )
    engagement, n = mechanism.engagements[0], spec.drive.n_rpm
    x, y = engagement.path(engagement.entry_deg, 0)
    rim = 1e-3 * math.hypot(x.c[0], y.c[0]) * L
    speed = rim * worst_of(mechanism, "velocity").max * omega(n)
    sound_m_s = 343.0
    if speed > sound_m_s:
        yield Notice(
            "faster-than-sound",
            f"the wheel's rim moves at up to {speed:.4g} m/s, faster than sound ({sound_m_s:g} "
            f"m/s): check n_rpm = {n:g}, the input's turns a minute",
        )
