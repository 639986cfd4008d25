"""Round gears as plates up to their pitch circles: whole, in sectors about a hub, or as a ring.

A blank's mass is a gear's within a few percent. A gear that stands still is screwed to the frame.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import shapes
from geneva_cli.geometry.plates import Plate, plate_wall
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Link, Teeth
from geneva_cli.parts.links.links import Gear, LinkSizes
from geneva_cli.parts.shafts.bores import BoltCircle, Bore, bolt_circle


def link_gear(
    link: Link, at: shapes.Point, on: Bore, sizes: LinkSizes, mechanism: Mechanism
) -> Gear:
    """Return the gear of a link that is a pitch circle, on a shaft; bored round if it is fixed."""
    teeth, L, radius = link.teeth, mechanism.center_distance_mm, link.radius_mm
    if teeth.fixed:
        on = Bore(on.around, on.loose)
    hub = on.reach if teeth.all_round else sizes.hub(on)
    outline: shapes.Circle | shapes.Contour = shapes.Circle("PITCH", shapes.ORIGIN, radius)
    holes: list[shapes.Shape] = [on.hole()] if on.reach else []
    inner, outer = on.reach, radius
    if teeth.inside:
        inner, outer, hub = radius, radius + 2.0 * sizes.eye, 0.0
        outline = shapes.Circle("LINK", shapes.ORIGIN, outer)
        holes = [shapes.Circle("PITCH", shapes.ORIGIN, inner)]
    elif not teeth.all_round and hub < radius:
        outline = _sectors(radius, hub, teeth)
    screws = BoltCircle(0.0, 0.0, ())
    if teeth.fixed:
        # the first at 45 degrees, off the line on which the shafts lie
        screws = bolt_circle(mechanism.spec.size, "gear", L, (inner, outer), 0.25 * math.pi)
        holes += screws.holes
    plate = Plate(link.name, "PITCH", outline, tuple(holes), *sizes.span(link.plane))
    wall = min(radius - hub, plate_wall(plate))
    if wall <= 0.0:
        # the key that sets its bore, unless its bolts are in the way
        key = {0.0: "wheel_bore_mm", L: "crank_bore_mm"}.get(math.hypot(*at), "link_bore_mm")
        key = "gear_bolt_circle_mm" if screws.holes and hub < radius else key
        raise GenevaError(
            f"no blank of the {link.name} is left: its holes reach {-wall:.4g} mm too far; change "
            f"{key}",
            ("size", key),
        )
    return Gear(at, radius, Bore(0.0) if teeth.inside else on, teeth, plate, screws)


def _sectors(radius: float, hub: float, teeth: Teeth) -> shapes.Contour:
    """Return evenly spaced sectors of a pitch circle, joined by the hub between them."""
    wide, pitch = math.radians(teeth.each_deg), math.tau / teeth.sectors
    first = math.radians(teeth.middle_deg) - 0.5 * wide
    end = shapes.about(shapes.ORIGIN, hub, first, 1.0).start
    pieces: list[shapes.Line | shapes.Arc] = []
    for k in range(teeth.sectors):
        start = first + k * pitch
        rim = shapes.about(shapes.ORIGIN, radius, start, wide)
        back = shapes.about(shapes.ORIGIN, hub, start + wide, pitch - wide)
        pieces += [shapes.Line(end, rim.start), rim, shapes.Line(rim.end, back.start), back]
        end = back.end
    return shapes.closed("PITCH", pieces)
