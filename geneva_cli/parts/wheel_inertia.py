"""The wheel's own inertia, from its outline and its thickness."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.curves.moments import moments, total
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.wheel import LAYER, wheel_circles

MM = 1e-3  # metres


class Plate(NamedTuple):
    """The wheel as it is cut from a plate: kg, and kg m² about its axis."""

    mass_kg: float
    inertia_kgm2: float


def wheel_plate(found: Outlines) -> Plate | None:
    """The wheel, as thick as its face is wide; None without ``face_width_mm``. Hubs are left out.

    J = rho h Ip, the polar moment of what is inside the outline and no bore, by Green's theorem.
    """
    spec = found.plane.mechanism.spec
    if spec.size.face_width_mm is None:
        return None
    circles = wheel_circles(found.plane, found.sizes)
    outer = total(moments(c) for c in circles if c.layer == LAYER)
    bores = total(moments(c) for c in circles if c.layer != LAYER)
    contour = moments(found.wheel)
    # an internal wheel's contour is its opening, within its outside
    plate = outer.less(contour) if outer.area else contour
    plate = plate.less(bores)
    per = spec.material_wheel.density_kgm3 * spec.size.face_width_mm * MM
    return Plate(per * plate.area * MM**2, per * plate.polar * MM**4)
