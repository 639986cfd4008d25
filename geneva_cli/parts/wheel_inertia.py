"""The wheel's own mass and inertia, without its outline in arcs and without its crank."""

from __future__ import annotations

from geneva_cli.curves.moments import Moments, moments, swept, total
from geneva_cli.curves.plates import Body, weighed
from geneva_cli.curves.shapes import Contour, Line
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.sizes import Sizes, sizes
from geneva_cli.parts.walls.straight import straight_walls
from geneva_cli.parts.wheel import LAYER, wheel_circles, wheel_contour

FINE = 2e-6  # of the centre distance: slivers between walls as narrow as this are not looked for


def wheel_body(mechanism: Mechanism) -> Body | None:
    """The wheel's mass and inertia about its axis, hubs left out; None where no thickness is given.

    J = rho h Ip, the polar moment of what is inside the outline and no bore, by Green's theorem:
    exact for lines and arcs; for curved walls to some millionths, and to so many more of a wheel as
    thin as they are finely told (FINE of the centre distance). Raises GenevaError where the
    machine has no flat parts, or its sizes leave none.
    """
    spec = mechanism.spec
    if spec.size.wheel_thickness_mm is None and spec.size.face_width_mm is None:
        return None
    where = assembly(mechanism)
    size = sizes(where)
    circles = wheel_circles(where, size)
    outer = total(moments(c) for c in circles if c.layer == LAYER)
    bores = total(moments(c) for c in circles if c.layer != LAYER)
    contour = _contour(where, size)
    # an internal wheel's contour is its opening, within its outside
    face = outer.less(contour) if outer.area else contour
    return weighed(face.less(bores), size.wheel_thickness, spec.material_wheel.density_kgm3)


def _contour(where: Assembly, size: Sizes) -> Moments:
    """What is inside the wheel's contour; each kind of slot is worked out once.

    The contour is that of a wheel whose slots are chords across their mouths, and what the slots'
    walls sweep beyond those, turned to each slot's place.
    """
    slots = {engagement: _slot(where, size, engagement) for engagement in where.kinds}
    chords = {engagement: chord for engagement, (chord, _) in slots.items()}
    around = [slots[engagement][1].turned(direction) for engagement, direction in where.slots]
    return total((moments(wheel_contour(where, size, chords)), *around))


def _slot(where: Assembly, size: Sizes, engagement: Engagement) -> tuple[Contour, Moments]:
    """The chord across a slot's mouth, and what its walls sweep beyond the chord."""
    if engagement.slot.curved:
        from geneva_cli.parts.walls.chain import chain  # much, which straight slots do without

        pieces = [piece.samples() for piece in chain(where, size, engagement, FINE)]
        walls = total(swept(*piece) for piece in pieces)
        start, end = pieces[0][0][0].tolist(), pieces[-1][0][-1].tolist()
    else:
        contour = straight_walls(where, size, engagement)
        walls = moments(contour)
        start, end = contour.segments[0].start, contour.segments[-1].end
    chord = Contour(LAYER, (Line(tuple(start), tuple(end)),), closed=False)
    return chord, walls.less(moments(chord))
