"""The links of a machine: their sizes, axes, gears and plates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Point, placed
from geneva_cli.motion.pivots import Joint, Teeth
from geneva_cli.numerics.tolerances import bore_radius, rounded_radius
from geneva_cli.parts.assembly import same
from geneva_cli.parts.shafts.bores import BoltCircle, Bore
from geneva_cli.parts.sizes import HUB, plane_span


class LinkSizes(NamedTuple):
    """Radii of holes and of the plate around them; thicknesses along the axis; all mm."""

    wall: float  # the least wall that `check` lets pass
    pin: float
    roller_stands: float  # radius of a roller's pin; 0 if the spec has none
    roller_pin: float  # radius of its hole
    eye: float  # radius of the plate around a pin
    roller_eye: float
    shaft: float | None  # of the spec, or as a load needs it, for shafts that carry only links
    crank_shaft: float | None  # of the spec, or of the arm on it
    thickness: float
    arm: float  # thickness of arm or link in the first plane
    gap: float  # from the wheel to the first plane
    washer: float
    loose: float  # by which the radius of a hole is above that of the pin or shaft in it

    @property
    def ring(self) -> float:
        """The radius of washers and spacers on a pin."""
        return 0.5 * (self.pin + self.loose + self.eye)

    def hole(self, kind: Joint) -> float:
        """Return the radius of a pin's hole; for shafts see ``bore``."""
        own = kind in (Joint.ROLLER, Joint.CARRIED)
        return self.roller_pin if own and self.roller_pin else self.pin + self.loose

    def block(self, hole: float) -> tuple[float, float]:
        """Return half a sliding block's width, and the offset of its round ends' centres."""
        half = max(1.6 * hole, hole + self.wall)  # as wide as a hub about its pin
        return half, 0.5 * half  # half as long again as it is wide

    def bore(self, space: float, L: float) -> float:
        """Return the radius of a shaft ``space`` mm from the nearest hole; 0 if it is too thin."""
        if self.shaft is not None:
            return self.shaft
        radius = bore_radius(min(L / 20.0, 0.35 * space))  # leaves most of the space as a wall
        return radius if radius >= 0.01 * L else 0.0

    def hub(self, bore: Bore) -> float:
        """Return the radius of a link's plate around a bore, or on a shaft's end."""
        return max(rounded_radius(HUB * bore.radius), bore.reach + self.wall)

    def span(self, plane: int) -> tuple[float, float]:
        """Return lower and upper end, along the axis, of links in a plane below the wheel's."""
        return plane_span(plane, self.gap, self.arm, self.thickness, self.washer)


class LinkAxis(NamedTuple):
    """An axis that links turn about: their names and joints, and its position at input angle 0."""

    names: tuple[str, ...]
    kinds: tuple[Joint, ...]
    at: Point
    stands: bool  # it does not move with the input angle
    bore: Bore = Bore(0.0)  # for its shaft or pivot
    one_piece: frozenset[str] = frozenset()  # names of the links that have no bore for it


class Gear(NamedTuple):
    """A gear about its axis: pitch circle, bore (of radius 0 for none or a ring), and plate."""

    at: Point
    radius: float
    bore: Bore
    teeth: Teeth
    plate: Plate
    screws: BoltCircle  # between a gear that stands still and the frame

    @property
    def member(self) -> Member:
        """The blank in the machine, at input angle 0."""
        return Member(self.plate, self.at)

    @property
    def outer(self) -> float:
        """The greatest distance of the outline from its axis."""
        outline = self.plate.outline
        return outline.radius if isinstance(outline, Circle) else self.radius


class Links(NamedTuple):
    """The links of a machine at input angle 0.

    ``cut`` are links and blocks as plates, ``joined`` the pins, washers and rollers between them,
    ``gears`` the gears as blanks.
    """

    sizes: LinkSizes | None = None  # None without links
    cut: tuple[Member, ...] = ()
    joined: tuple[Member, ...] = ()
    gears: tuple[Gear, ...] = ()
    pin_low: float | None = None  # lower end of the pin on a link that carries the wheel's roller
    standing: frozenset[str] = frozenset()  # names of the links that are fixed to the frame
    blocks: frozenset[str] = frozenset()  # names of the blocks that slide in a link
    axes: tuple[LinkAxis, ...] = ()  # axes that links and gears turn about

    @property
    def plates(self) -> list[Plate]:
        """The plates to cut, each in its own frame."""
        return [one.part for one in self.cut if isinstance(one.part, Plate)]

    def shaft(self, at: Point, L: float) -> float:
        """Return the radius of the shaft that carries links at a point; 0 where there is none."""
        return next((axis.bore.radius for axis in self.axes if same(axis.at, at, L)), 0.0)

    def one_piece(self, at: Point, L: float) -> list[Plate]:
        """Return the links that are one piece with the shaft at a point."""
        names = {name for axis in self.axes if same(axis.at, at, L) for name in axis.one_piece}
        return [plate for plate in self.plates if plate.name in names]


def placed_holes(member: Member) -> Iterator[Circle]:
    """Yield the round holes of a plate at their positions at input angle 0."""
    assert isinstance(member.part, Plate)
    for hole in member.part.holes:
        if isinstance(hole, Circle):
            yield placed(hole, member.at, member.turn)
