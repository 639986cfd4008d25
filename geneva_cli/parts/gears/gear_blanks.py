"""Round gears as plates: whole, in sectors about a hub, or as a ring; with teeth or as blanks.

Teeth stand out of the pitch circle about as much as their gaps go into it. So a blank's mass is a
gear's within a few percent. A gear that stands still is screwed to the frame.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.gear_teeth import Writer
from geneva_cli.geometry.measure import turned_pieces
from geneva_cli.geometry.plates import Member, Plate, plate_wall
from geneva_cli.geometry.shapes import (
    ORIGIN,
    Circle,
    Contour,
    Line,
    Point,
    Segment,
    Shape,
    about,
    closed,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Link, Teeth
from geneva_cli.parts.gears.gear_mesh import ToothedGear
from geneva_cli.parts.links.link_sizes import LinkSizes
from geneva_cli.parts.shafts.bores import Bore
from geneva_cli.parts.shafts.hub_and_shafts import ShaftBore
from geneva_cli.parts.shafts.screws import BoltCircle, bolt_circle


class Gear(NamedTuple):
    """A gear about its axis: pitch circle, bore (of radius 0 for none or a ring), and plate.

    The plate of a gear with teeth ends where they begin, until ``with_teeth`` draws them.
    """

    at: Point
    radius: float
    bore: ShaftBore
    teeth: Teeth
    plate: Plate
    cut: ToothedGear | None = None
    screws: BoltCircle | None = None  # between a gear that stands still and the frame

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
        return self.screws.holes if self.screws else []

    @property
    def outer(self) -> float:
        """The greatest distance of the outline from its axis."""
        outline = self.plate.outline
        if self.teeth.inside and isinstance(outline, Circle):
            return outline.radius
        return self.cut.teeth.tip if self.cut else self.radius

    def with_teeth(self, write: Writer) -> Gear:
        """Return the gear with its teeth drawn, if it has any; ``write`` fits curves."""
        if self.cut is None:
            return self
        plate = self.plate._replace(layer="LINK")  # which is cut
        if self.teeth.inside:
            opening = _toothed(self.cut, 0.0, write)
            return self._replace(plate=plate._replace(holes=(opening, *plate.holes[1:])))
        hub = 0.0
        if isinstance(plate.outline, Contour):
            hub = min(math.hypot(*piece.start) for piece in plate.outline.segments)
        return self._replace(plate=plate._replace(outline=_toothed(self.cut, hub, write)))


def link_gear(
    link: Link,
    at: Point,
    on: ShaftBore,
    sizes: LinkSizes,
    mechanism: Mechanism,
    cut: ToothedGear | None,
) -> Gear:
    """Return the gear of a link that is a pitch circle, on a shaft; ``cut`` has its teeth.

    A gear that is fixed to the frame does not turn with the shaft, and is bored round.
    Raises GenevaError, naming the key, where its bore or its bolts leave nothing of it.
    """
    teeth, size, L = link.teeth, mechanism.spec.size, mechanism.center_distance_mm
    radius = link.radius_mm
    if cut:
        radius = cut.teeth.tip if teeth.inside else cut.teeth.root
    # the key that sets its bore
    shaft = {0.0: "wheel_bore_mm", L: "crank_bore_mm"}.get(math.hypot(*at), "link_bore_mm")
    if teeth.fixed:
        on = ShaftBore(Bore(on.bore.around, on.bore.loose))
    bore = on.bore.reach
    holes: list[Shape] = []
    outline: Circle | Contour = Circle("PITCH", ORIGIN, radius)
    if teeth.inside:
        inner, outer = radius, radius + 2.0 * sizes.eye
        outline, holes = Circle("LINK", ORIGIN, outer), [Circle("PITCH", ORIGIN, inner)]
    else:
        inner, outer = bore, radius
        holes += [on.hole()] if bore else []
        hub = sizes.hub(on.bore)
        if not teeth.all_round:
            _refuse(link.name, radius - hub, "hub", shaft)
            outline = _sectors(radius, hub, teeth)
    _refuse(link.name, outer - inner, "bore", shaft)
    screws = None
    if teeth.fixed:
        # the first at 45 degrees, off the line on which the shafts lie
        screws = bolt_circle(size, "gear", L, (inner, outer), 0.25 * math.pi)
        holes += screws.holes
    plate = Plate(link.name, "PITCH", outline, tuple(holes), *sizes.span(link.plane))
    _refuse(link.name, plate_wall(plate), "bolts" if teeth.fixed else "bore", shaft)
    bored = ShaftBore() if teeth.inside else on
    return Gear(at, link.radius_mm, bored, teeth, plate, cut, screws)


def _toothed(gear: ToothedGear, hub: float, write: Writer) -> Contour:
    """Return the outline of a gear with teeth, or of the opening of a ring."""
    one, step = gear.teeth.one(write), gear.teeth.step
    last = gear.teeth._replace(tip=gear.last_tip).one(write) if gear.last_tip else one
    between = [gear.teeth.between()]
    pieces: list[Segment] = []
    for sector, after in zip(gear.middles, (*gear.middles[1:], gear.middles[0]), strict=True):
        for k, middle in enumerate(sector):
            at_end = k + 1 == len(sector)
            pieces += turned_pieces(last if at_end else one, middle)
            if not (at_end and hub):
                pieces += turned_pieces(between, middle)
        if hub:
            end = math.atan2(*reversed(pieces[-1].end))
            start = math.atan2(*reversed(turned_pieces(one, after[0])[0].start))
            back = about(ORIGIN, hub, end, (start - end) % math.tau)
            rise = about(ORIGIN, gear.teeth.root, start, step).start
            pieces += [Line(pieces[-1].end, back.start), back, Line(back.end, rise)]
    return closed("LINK", pieces)


def _sectors(radius: float, hub: float, teeth: Teeth) -> Contour:
    """Return evenly spaced sectors of a pitch circle, joined by the hub between them."""
    wide, pitch = math.radians(teeth.each_deg), math.tau / teeth.sectors
    first = math.radians(teeth.middle_deg) - 0.5 * wide
    end = about(ORIGIN, hub, first, 1.0).start
    pieces: list[Segment] = []
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
