"""Gears as blanks: plates up to the pitch circle, whole or in sectors about a hub.

Teeth are omitted: their module and cutter are in no key of a spec. They stand out of the pitch
circle about as much as their gaps go into it. So a blank's mass is a gear's within a few percent. A
gear that stands still is screwed to the frame.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import (
    ORIGIN,
    Circle,
    Contour,
    Line,
    Point,
    Segment,
    about,
    closed,
    two_arcs,
)
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.layout import Link, Teeth
from geneva_cli.layout.bolt_holes import bolt_circle
from geneva_cli.layout.hole_walls import least_wall
from geneva_cli.parts.link_sizes import LinkSizes
from geneva_cli.spec.tables import Size

PITCH, HOLES, RIM = "PITCH", "BORE", "LINK"


class Gear(NamedTuple):
    """A gear about its axis: pitch circle, radius of its bore (0 for none or a ring), and blank."""

    at: Point
    radius: float
    bore: float
    teeth: Teeth
    plate: Plate

    @property
    def name(self) -> str:
        """The gear's name."""
        return self.plate.name

    @property
    def member(self) -> Member:
        """The blank in the machine, at input angle 0."""
        return Member(self.plate, self.at)

    @property
    def bolts(self) -> list[Circle]:
        """The holes by which the gear is screwed to the frame."""
        holes = [hole for hole in self.plate.holes if isinstance(hole, Circle)]
        return [hole for hole in holes if hole.layer == HOLES and hole.centre != ORIGIN]

    @property
    def outer(self) -> float:
        """The greatest distance of the outline from its axis."""
        outline = self.plate.outline
        return outline.radius if isinstance(outline, Circle) else self.radius


def link_gear(link: Link, at: Point, bore: float, sizes: LinkSizes, size: Size, L: float) -> Gear:
    """Return the gear of a link that is a pitch circle, with a bore.

    Raises GenevaError, naming the key, where its bore or its bolts leave nothing of it.
    """
    radius, teeth = link.radius_mm, link.teeth
    shaft = _bored_by(at, L)
    low, high = sizes.span(link.plane)
    hole = 0.0 if teeth.inside else bore
    holes: list[Circle] = []
    outline: Circle | Contour = Circle(PITCH, ORIGIN, radius)
    if teeth.inside:
        inner, outer = radius, radius + 2.0 * sizes.eye
        outline, holes = Circle(RIM, ORIGIN, outer), [Circle(PITCH, ORIGIN, inner)]
    else:
        inner, outer = bore, radius
        holes += [Circle(HOLES, ORIGIN, bore)] if bore else []
        hub = sizes.hub(bore)
        if teeth.sectors * teeth.each_deg < 360.0:
            _refuse(link.name, radius - hub, "hub", shaft)
            outline = sectors(radius, hub, teeth)
    _refuse(link.name, outer - inner, "bore", shaft)
    if teeth.fixed:
        # the first at 45 degrees, off the line on which the shafts lie
        holes += bolt_circle(size, "gear", L, (inner, outer), 0.25 * math.pi).holes
    plate = Plate(link.name, PITCH, outline, tuple(holes), low, high)
    _refuse(link.name, gear_wall(plate), "bolts" if teeth.fixed else "bore", shaft)
    return Gear(at, radius, hole, teeth, plate)


def sectors(radius: float, hub: float, teeth: Teeth) -> Contour:
    """Return evenly spaced sectors of a pitch circle, joined by the hub between them."""
    wide = math.radians(teeth.each_deg)
    pitch = math.tau / teeth.sectors
    pieces: list[Segment] = []
    for k in range(teeth.sectors):
        start = math.radians(teeth.middle_deg) + k * pitch - 0.5 * wide
        rim = about(ORIGIN, radius, start, wide)
        back = about(ORIGIN, hub, start + wide, pitch - wide)
        first = pieces[-1].end if pieces else about(ORIGIN, hub, start, 1.0).start
        pieces += [Line(first, rim.start), rim, Line(rim.end, back.start), back]
    return closed(PITCH, pieces)


def gear_wall(plate: Plate) -> float:
    """Return the least wall between a gear's holes, and from them to its pitch circle or rim."""
    outline = plate.outline
    if isinstance(outline, Circle):
        outline = closed(outline.layer, two_arcs(outline))
    return least_wall(plate.holes, [outline])


def _bored_by(at: Point, L: float) -> str:
    """Return the key that sets the bore of a gear, by the shaft that carries the gear."""
    return {0.0: "wheel_bore_mm", L: "crank_bore_mm"}.get(math.hypot(*at), "link_bore_mm")


def _refuse(name: str, wall: float, what: str, shaft: str) -> None:
    """Raise GenevaError where a hole, or a hub, leaves nothing of a gear.

    ``shaft`` is the key that sets its bore.
    """
    if wall > 0.0:
        return
    if what == "bolts":
        key, reach = "gear_bolt_circle_mm", "bolts reach"
        remedy = "the default gear_bolt_circle_mm, a smaller gear_bolt_mm or fewer gear_bolts leave"
    else:
        key, reach = shaft, f"{what} reaches"
        # the crank's shaft is as wide as its arm's bore, which is the locking disc's by default
        arm = " or arm_bore_mm" if shaft == "crank_bore_mm" else ""
        remedy = f"a smaller {shaft}{arm} leaves"
    raise GenevaError(
        f"no blank of the {name} is left: its {reach} {-wall:.4g} mm too far; {remedy} some",
        ("size", key),
    )
