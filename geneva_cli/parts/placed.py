"""The parts of a machine at their positions, at input angle 0.

They are built once, in a plane (``built``) or on a sphere (``sphere.built``). Drawing, solid, list
of parts, sheet and the checks of shafts are projections of them.
"""

from __future__ import annotations

from typing import Generic, NamedTuple, TypeVar

from geneva_cli.curves.plates import Member
from geneva_cli.parts.links import Links

Arm = TypeVar("Arm")  # of a flat machine or of a spherical one


class PlacedParts(NamedTuple, Generic[Arm]):
    """The parts of a machine, in the wheel's frame."""

    wheel: Member
    crank: Member  # locking disc or sectors, arm, rollers on their pins, hub
    arm: Arm | None
    shafts: tuple[Member, ...]
    links: Links = Links()
    gears: tuple[Member, ...] = ()  # as blanks up to their pitch curves
    first: tuple[Member, ...] = ()  # of two wheels in series, the first and its locking disc
    standing: tuple[Member, ...] = ()  # a cam's groove plate, if there is one, and then the frame

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        links = *self.links.cut, *self.links.joined
        moved = (self.wheel, self.crank, *links, *self.gears, *self.first)
        return (*moved, *self.shafts, *self.standing)
