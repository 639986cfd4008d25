"""The links of a machine as parts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.geometry.plates import Member, Plate, placed
from geneva_cli.geometry.shapes import Circle, Point
from geneva_cli.parts.assembly import same

if TYPE_CHECKING:
    from geneva_cli.parts.links.link_records import Gear, LinkAxis, LinkSizes


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
        return next((axis.radius for axis in self.axes if same(axis.at, at, L)), 0.0)

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
