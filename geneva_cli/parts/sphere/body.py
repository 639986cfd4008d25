"""The mass and inertia of a spherical wheel alone, without its crank."""

from __future__ import annotations

from geneva_cli.curves.mass import MM, MassProperties, added, mass_properties
from geneva_cli.layout.sphere_sizes import ball
from geneva_cli.machine.materials import wheel_material
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.outlines.sphere_wheel import POLE
from geneva_cli.parts.sphere.sphere_parts import wheel_hub, wheel_shell


def wheel_body(mechanism: Mechanism) -> MassProperties:
    """Return mass and inertia of the wheel's shell and hub, in closed form.

    Raises GenevaError where the sizes leave no wheel.
    """
    size, sizes = mechanism.spec.size, ball(mechanism)
    density = wheel_material(mechanism.spec).density_kgm3
    shell, hub = wheel_shell(size, sizes), wheel_hub(size, sizes)
    mass = density * shell.volume * MM**3
    rim = MassProperties(mass, (0.0, 0.0), density * shell.inertia(POLE) * MM**5)
    return added(rim, mass_properties(hub, density)) if hub else rim
