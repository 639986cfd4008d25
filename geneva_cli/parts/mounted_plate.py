"""A frame as a plate with its holes, and what stands on it: shafts, screws, spacers."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Plate, Stack
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Point, convex_hull
from geneva_cli.geometry.stacks import apart
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.parts.shafts.bores import around
from geneva_cli.parts.shafts.screws import Screws, screw_through, tapped
from geneva_cli.parts.shafts.shaft import SERIES_60
from geneva_cli.spec.default_sizes import half_or
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.spec.tables import Size

NAME = "frame"


def mounted_plate(
    holes: Sequence[Circle], within: Iterable[Circle], eye: float, span: tuple[float, float]
) -> Plate:
    """Return a frame with its holes, around circles that it contains.

    Four mounting holes are in its corners, whose radius is ``eye``, if there is a screw for them.
    ``span`` has its lower and upper face.
    """
    inside = list(within)
    low, high = (
        [pick(c.centre[k] + sense * c.radius for c in inside) + 3.0 * sense * eye for k in (0, 1)]
        for sense, pick in ((-1.0, min), (1.0, max))
    )
    corners = [(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
    outline = convex_hull("FRAME", [Circle("FRAME", corner, eye) for corner in corners])
    mount = screw_through(0.8 * eye)
    mounts = [Circle("BORE", corner, 0.5 * mount.through) for corner in corners] if mount else []
    return Plate(NAME, "FRAME", outline, (*holes, *mounts), *span)


def mounts_of(frame: Plate) -> list[Circle]:
    """Return the mounting holes of a frame: those about its corners; none of a carrier."""
    if frame.name != NAME or not isinstance(frame.outline, Contour):
        return []
    corners = [piece.centre for piece in frame.outline.segments if isinstance(piece, Arc)]
    near = 1e-9  # of a corner: rounding
    return [
        hole
        for hole in frame.holes
        if isinstance(hole, Circle) and any(math.dist(hole.centre, at) <= near for at in corners)
    ]


def corner_radius(size: Size, L: float) -> float:
    """Return the radius of a frame's corners, which leaves walls around their mounting holes."""
    return max(L / 20.0, 3.0 * wall_min(size, L))


def shaft_holes(size: Size, axles: Iterable[Member], top: float) -> Iterator[Circle]:
    """Yield the holes of a frame for the shafts that reach below its upper face ``top``.

    They are as wide as the bearings on turned shafts, or as bores for plain ones.
    """
    for axle in axles:
        shaft, at = axle.part, axle.at
        assert isinstance(shaft, Plate | Stack)
        if shaft.low >= top:
            continue
        if isinstance(shaft, Stack):
            # both are exactly the numbers of which the steps were made
            seat = next(step for step in shaft.plates if step.high == top)
            bearing = next(one for one in SERIES_60 if one.bore == 2.0 * around(seat.outline))
            yield Circle("BORE", at, 0.5 * bearing.outside)
        else:
            radius = around(shaft.outline) + 0.5 * size.allowances.shaft_fit_mm
            yield Circle("BORE", at, radius)


def hole_without_shaft(diameter_mm: float | None, at: Point, L: float) -> Circle:
    """Return the hole for a part that is one piece with its shaft, of the spec or L/10 wide."""
    return Circle("BORE", at, half_or(diameter_mm, bore_radius(L / 20.0)))


def require_walls(holes: list[Circle], least: float, axles: list[Member]) -> None:
    """Raise GenevaError where the bearings of turned shafts leave less than the least wall."""
    if not any(isinstance(one.part, Stack) for one in axles):
        return
    for one, other in combinations(holes, 2):
        wall = apart(one, other)
        if wall < least:
            both = (hole.centre for hole in (one, other))
            names = [next((a.part.name for a in axles if a.at == at), "a hole") for at in both]
            raise GenevaError(
                f'shafts = "turned": {" and ".join(names)} leave a wall of {wall:.4g} mm between '
                f"their bearings in the frame, and wall_min_mm is {least:.4g}; smaller bores have "
                "smaller bearings",
                ("size", "shafts"),
            )


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
        kinds = Counter((one.part, one.hole.radius) for one in self.screwed)
        fixed = [Screws(part, n, 2.0 * r, "the frame") for (part, r), n in kinds.items()]
        mounts = mounts_of(self.plate)
        if mounts:
            fixed.append(Screws("frame", len(mounts), 2.0 * mounts[0].radius, "its base"))
        return tuple(fixed)
