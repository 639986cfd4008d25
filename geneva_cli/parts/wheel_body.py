"""The mass and inertia of the wheel, without its crank."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, reduce

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import MassProperties, added, mass_properties, plates
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import thing
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.wheel_circles import wheel_part
from geneva_cli.parts.outlines.wheel_outline import turned_walls, wheel_contour
from geneva_cli.spec.defaults import wheel_material


def wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Return mass and inertia of the wheel and its hub, if it has one; None without a thickness.

    Curved walls are those of the full turn. Raises GenevaError where the machine has no parts.
    """
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    own: Callable[[Mechanism], MassProperties] | None = thing(spec.wheel.NAME, "wheel_body")
    if own:
        return own(mechanism)
    where, size = machine_sizes(mechanism)
    contour = wheel_contour(where, size, turned_walls(where, size), spec.wheel.stopped)
    density = wheel_material(spec).density_kgm3
    solids = plates(wheel_part(where, size, contour))
    return reduce(added, (mass_properties(one, density) for one in solids))


@lru_cache(maxsize=16)
def known_wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Return the cached ``wheel_body`` of a machine; None too where its sizes leave no parts."""
    try:
        return wheel_body(mechanism)
    except GenevaError:
        return None
