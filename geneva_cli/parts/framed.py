"""A frame with what is on it, its shafts, and the screws that fix parts to it."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.mounted_plate import mounts_of
from geneva_cli.parts.shafts.screws import Screws, tapped


class Unborne(NamedTuple):
    """A shaft that turns and does not reach the frame, and the reason."""

    name: str
    reason: str


class Screwed(NamedTuple):
    """A screw of a part that is fixed to the frame: its clearance hole, and the part's name."""

    hole: Circle
    part: str


class FrameAndShafts(NamedTuple):
    """The frame, what is on it, and the shafts, whether they reach it or not."""

    plate: Plate
    shafts: tuple[Member, ...]
    spacers: tuple[Member, ...] = ()  # below the parts that are screwed to it
    screwed: tuple[Screwed, ...] = ()
    to_fix: tuple[str, ...] = ()  # names of what the shafts turn, and nothing holds on them
    bridge: Member | None = None  # bears the crank's shaft from above
    unborne: tuple[Unborne, ...] = ()

    @property
    def threads(self) -> tuple[Circle, ...]:
        """The tapped holes of the frame."""
        return tuple(tapped(one.hole) for one in self.screwed)

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws that fix parts to the frame, and those of its mounting holes."""
        kinds = dict.fromkeys((one.part, one.hole.radius) for one in self.screwed)
        fixed = (
            Screws(
                part,
                sum((one.part, one.hole.radius) == (part, radius) for one in self.screwed),
                2.0 * radius,
                "the frame",
            )
            for part, radius in kinds
        )
        mounts = mounts_of(self.plate)
        own = Screws("frame", len(mounts), 2.0 * mounts[0].radius, "its base") if mounts else None
        return (*fixed, own) if own else tuple(fixed)
