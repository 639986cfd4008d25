"""A spherical wheel's own mass and inertia, without its crank."""

from __future__ import annotations

from geneva_cli.curves.mass import MM, MassProperties, added, mass_properties
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.sphere.built import wheel_hub, wheel_shell
from geneva_cli.parts.sphere.sizes import ball
from geneva_cli.parts.sphere.wheel import POLE


def wheel_body(mechanism: Mechanism) -> MassProperties:
    """Mass and inertia of the wheel's shell and its hub, in closed form.

    Raises GenevaError where its sizes leave none.
    """
    density, found = mechanism.spec.material_wheel.density_kgm3, ball(mechanism)
    size = mechanism.spec.size
    shell, hub = wheel_shell(size, found), wheel_hub(size, found)
    mass = density * shell.volume * MM**3
    own = MassProperties(mass, (0.0, 0.0), density * shell.inertia(POLE) * MM**5)
    return added(own, mass_properties(hub, density)) if hub else own
