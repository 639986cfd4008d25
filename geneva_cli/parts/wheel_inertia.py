"""The wheel's own mass and inertia, without its outline in arcs and without its crank."""

from __future__ import annotations

from functools import lru_cache

from geneva_cli.curves.mass import MassProperties, added, face_properties, mass_properties
from geneva_cli.curves.moments import Moments, moments, total
from geneva_cli.curves.shapes import Contour, Line, about
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.sizes import Sizes, sizes
from geneva_cli.parts.walls.straight import straight_walls
from geneva_cli.parts.wheel import LAYER, wheel_circles, wheel_contour
from geneva_cli.parts.wheel_hub import wheel_hub


def wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """Mass and inertia of the wheel, and of a hub that is given; None without a thickness.

    J = rho h Ip, the polar moment of what is inside the outline and no bore, by Green's theorem:
    exact for lines and arcs; what a curved slot takes is right to some millionths of it. Of a
    sphere its shell and the hub in it. Raises GenevaError where the machine has no parts, or its
    sizes leave none.
    """
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    if spec.wheel.SHELLS:
        from geneva_cli.parts.sphere.body import wheel_body as of_shell  # flat wheels do without

        return of_shell(mechanism)
    where = assembly(mechanism)
    size = sizes(where)
    circles = wheel_circles(where, size)
    outer = total(moments(c) for c in circles if c.layer == LAYER)
    bores = total(moments(c) for c in circles if c.layer != LAYER)
    contour = _contour(where, size)
    # an internal wheel's contour is its opening, within its outside
    face = outer.less(contour) if outer.area else contour
    density = spec.material_wheel.density_kgm3
    wheel = face_properties(face.less(bores), size.wheel_thickness, density)
    hub = wheel_hub(where, size)
    return added(wheel, mass_properties(hub, density)) if hub else wheel


@lru_cache(maxsize=16)
def known_wheel_body(mechanism: Mechanism) -> MassProperties | None:
    """The same, kept while the machine is asked about; None too where there are no parts."""
    try:
        return wheel_body(mechanism)
    except GenevaError:
        return None


def _contour(where: Assembly, size: Sizes) -> Moments:
    """What is inside the wheel's contour; each kind of slot is worked out once.

    The contour is that of a wheel whose slots are closed at their mouths, and what the slots take
    from it, turned to each slot's place; the opening of an internal wheel gains what they take.
    """
    slots = {engagement: _slot(where, size, engagement) for engagement in where.kinds}
    mouths = {engagement: mouth for engagement, (mouth, _) in slots.items()}
    around = [slots[engagement][1].turned(direction) for engagement, direction in where.slots]
    return total((moments(wheel_contour(where, size, mouths)), *around))


def _slot(where: Assembly, size: Sizes, engagement: Engagement) -> tuple[Contour, Moments]:
    """A line that closes a slot's mouth, and what its walls sweep beyond that line."""
    if engagement.slot.curved:
        from geneva_cli.parts.walls.rings import taken  # which straight slots do without

        found = taken(where, size, engagement)
        rim = about((0.0, 0.0), size.rim, found.low, found.high - found.low)
        return Contour(LAYER, (rim,), closed=False), found.face.times(-where.sign)
    contour = straight_walls(where, size, engagement)
    chord = Contour(
        LAYER, (Line(contour.segments[0].start, contour.segments[-1].end),), closed=False
    )
    return chord, moments(contour).less(moments(chord))
