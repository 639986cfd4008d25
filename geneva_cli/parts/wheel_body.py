"""The mass and inertia of the wheel, without its crank."""

from __future__ import annotations

from functools import lru_cache

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import MassProperties, added, mass_properties
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import turned_walls, wheel_contour
from geneva_cli.parts.outlines.outlines import wheel_hub, wheel_plate
from geneva_cli.spec.defaults import wheel_material


@lru_cache(maxsize=16)
def wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Return mass and inertia of wheel and hub; None without a thickness or parts."""
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    own = thing(spec.wheel.NAME, "wheel_body")
    try:
        if own:
            return own(mechanism)
        where, size = machine_sizes(mechanism)
        contour = wheel_contour(where, size, turned_walls(where, size), spec.wheel.stopped)
        hub, density = wheel_hub(where, size), wheel_material(spec).density_kgm3
        body = mass_properties(wheel_plate(where, size, contour), density)
        return added(body, mass_properties(hub, density)) if hub else body
    except GenevaError:
        return None
