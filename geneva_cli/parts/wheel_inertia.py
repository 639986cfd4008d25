"""The wheel's own mass and inertia, without its outline in arcs and without its crank."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from geneva_cli.curves.shapes import Contour, Line, about
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.engagement import Engagement
from geneva_cli.layout.assembly import Assembly, assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.layout.sizes import sizes
from geneva_cli.machine.materials import wheel_material
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.outlines.walls.straight import straight_walls
from geneva_cli.outlines.wheel import LAYER, wheel_circles, wheel_contour

if TYPE_CHECKING:
    from geneva_cli.curves.mass import MassProperties
    from geneva_cli.curves.moments import Moments


def wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Return mass and inertia of the wheel and its hub, if it has one; None without a thickness.

    J = rho h Ip, where Ip is the polar moment of the area inside the outline without its bores, by
    Green's theorem. It is exact for lines and arcs, and accurate to some millionths for curved
    slots. Chamfers and roundings of edges are not counted. On a sphere it is that of the shell and
    its hub. Raises GenevaError where the machine has no parts, or its sizes leave none.
    """
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    if spec.wheel.SHELLS:
        from geneva_cli.parts.sphere.sphere_parts import shell_body  # only on a sphere

        return shell_body(mechanism)
    from geneva_cli.curves.mass import added, face_properties, mass_properties
    from geneva_cli.curves.moments import moments, total
    from geneva_cli.outlines.wheel_hub import wheel_hub

    where = assembly(mechanism)
    size = sizes(where)
    circles = wheel_circles(where, size)
    outer = total(moments(c) for c in circles if c.layer == LAYER)
    bores = total(moments(c) for c in circles if c.layer != LAYER)
    contour = _contour(where, size)
    # an internal wheel's contour is its opening, inside its outline
    face = outer.less(contour) if outer.area else contour
    density = wheel_material(spec).density_kgm3
    wheel = face_properties(face.less(bores), size.wheel_thickness, density)
    hub = wheel_hub(where, size)
    return added(wheel, mass_properties(hub, density)) if hub else wheel


@lru_cache(maxsize=16)
def known_wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Return the cached ``wheel_body`` of a machine; None too where its sizes leave no parts."""
    try:
        return wheel_body(mechanism)
    except GenevaError:
        return None


def _contour(where: Assembly, size: Sizes) -> Moments:
    """Return the area inside the wheel's contour; each kind of slot is computed once.

    It is the area of a wheel with closed mouths, less what the slots remove, turned to each slot's
    position. The opening of an internal wheel gains that instead.
    """
    from geneva_cli.curves.moments import moments, total

    slots = {engagement: _slot(where, size, engagement) for engagement in where.kinds}
    mouths = {engagement: mouth for engagement, (mouth, _) in slots.items()}
    around = [slots[engagement][1].turned(direction) for engagement, direction in where.slots]
    closed = wheel_contour(where, size, mouths, where.full.spec.wheel.stopped)
    return total((moments(closed), *around))


def _slot(where: Assembly, size: Sizes, engagement: Engagement) -> tuple[Contour, Moments]:
    """Return a line that closes a slot's mouth, and the area of the slot beyond that line."""
    from geneva_cli.curves.moments import moments

    if engagement.slot.curved:
        from geneva_cli.outlines.walls.rings import removed_face  # not needed for straight slots

        slot_face = removed_face(where, size, engagement)
        rim = about((0.0, 0.0), size.rim, slot_face.low, slot_face.high - slot_face.low)
        return Contour(LAYER, (rim,), closed=False), slot_face.face.times(-where.sign)
    contour = straight_walls(where, size, engagement)
    chord = Contour(
        LAYER, (Line(contour.segments[0].start, contour.segments[-1].end),), closed=False
    )
    return chord, moments(contour).less(moments(chord))
