"""Round gears as plates up to their pitch circles: whole, in sectors about a hub, or as a ring.

A blank's mass is a gear's within a few percent. A gear that stands still is screwed to the frame.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Plate, plate_wall
from geneva_cli.geometry.shapes import (
    ORIGIN,
    Arc,
    Circle,
    Contour,
    Line,
    Point,
    Shape,
    about,
    closed,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Link, Teeth
from geneva_cli.parts.links.links import Gear, LinkSizes
from geneva_cli.parts.shafts.bores import Bore, bolt_circle


def link_gear(link: Link, at: Point, on: Bore, sizes: LinkSizes, mechanism: Mechanism) -> Gear:
    """Return the gear of a link that is a pitch circle, on a shaft.

    A gear that is fixed to the frame does not turn with the shaft, and is bored round.
    """
    teeth, L, radius = link.teeth, mechanism.center_distance_mm, link.radius_mm
    # the key that sets its bore
    shaft = {0.0: "wheel_bore_mm", L: "crank_bore_mm"}.get(math.hypot(*at), "link_bore_mm")
    if teeth.fixed:
        on = Bore(on.around, on.loose)
    outline: Circle | Contour = Circle("PITCH", ORIGIN, radius)
    holes: list[Shape] = []
    if teeth.inside:
        inner, outer = radius, radius + 2.0 * sizes.eye
        outline, holes = Circle("LINK", ORIGIN, outer), [Circle("PITCH", ORIGIN, inner)]
    else:
        inner, outer = on.reach, radius
        holes += [on.hole()] if inner else []
        if not teeth.all_round:
            hub = sizes.hub(on)
            _refuse(link.name, radius - hub, "hub", shaft)
            outline = _sectors(radius, hub, teeth)
    _refuse(link.name, outer - inner, "bore", shaft)
    screws = None
    if teeth.fixed:
        # the first at 45 degrees, off the line on which the shafts lie
        screws = bolt_circle(mechanism.spec.size, "gear", L, (inner, outer), 0.25 * math.pi)
        holes += screws.holes
    plate = Plate(link.name, "PITCH", outline, tuple(holes), *sizes.span(link.plane))
    _refuse(link.name, plate_wall(plate), "bolts" if teeth.fixed else "bore", shaft)
    return Gear(at, radius, Bore(0.0) if teeth.inside else on, teeth, plate, screws)


def _sectors(radius: float, hub: float, teeth: Teeth) -> Contour:
    """Return evenly spaced sectors of a pitch circle, joined by the hub between them."""
    wide, pitch = math.radians(teeth.each_deg), math.tau / teeth.sectors
    first = math.radians(teeth.middle_deg) - 0.5 * wide
    end = about(ORIGIN, hub, first, 1.0).start
    pieces: list[Line | Arc] = []
    for k in range(teeth.sectors):
        start = first + k * pitch
        rim = about(ORIGIN, radius, start, wide)
        back = about(ORIGIN, hub, start + wide, pitch - wide)
        pieces += [Line(end, rim.start), rim, Line(rim.end, back.start), back]
        end = back.end
    return closed("PITCH", pieces)


def _refuse(name: str, wall: float, what: str, shaft: str) -> None:
    """Raise GenevaError where a hole, or a hub, leaves nothing of a gear bored by a key."""
    if wall > 0.0:
        return
    # the crank's shaft is as wide as its arm's bore, which is the locking disc's by default
    arm = " or arm_bore_mm" if shaft == "crank_bore_mm" else ""
    key, reach, remedy = shaft, f"{what} reaches", f"a smaller {shaft}{arm} leaves"
    if what == "bolts":
        key, reach = "gear_bolt_circle_mm", "bolts reach"
        remedy = "the default gear_bolt_circle_mm, a smaller gear_bolt_mm or fewer gear_bolts leave"
    raise GenevaError(
        f"no blank of the {name} is left: its {reach} {-wall:.4g} mm too far; {remedy} some",
        ("size", key),
    )
