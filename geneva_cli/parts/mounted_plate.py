"""A frame as a plate with its holes, and what stands on it: shafts, screws, spacers."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from geneva_cli.geometry.measure import bounds_of
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Point, convex_hull
from geneva_cli.numerics.arrays import half_or
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.parts.shafts.bores import around
from geneva_cli.parts.shafts.screws import Screws, screw_through, tapped
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import Size

NAME = "frame"


def mounted_plate(
    holes: Sequence[Circle], within: Iterable[Circle], eye: float, span: tuple[float, float]
) -> Plate:
    """Return a frame with its holes, around circles that it contains.

    Mounting holes are in its corners, whose radius is ``eye``. ``span`` has its lower and upper
    face.
    """
    box, away = bounds_of(within), 3.0 * eye
    corners = [
        (x, y) for x in (box.x0 - away, box.x1 + away) for y in (box.y0 - away, box.y1 + away)
    ]
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
    """Yield the holes of a frame for the shafts that reach below its upper face ``top``."""
    for axle in axles:
        assert isinstance(axle.part, Plate)
        if axle.part.low < top:
            radius = around(axle.part.outline) + 0.5 * size.allowances.shaft_fit_mm
            yield Circle("BORE", axle.at, radius)


def hole_without_shaft(diameter_mm: float | None, at: Point, L: float) -> Circle:
    """Return the hole for a part that is one piece with its shaft, of the spec or L/10 wide."""
    return Circle("BORE", at, half_or(diameter_mm, bore_radius(L / 20.0)))


class FrameAndShafts(NamedTuple):
    """The frame, what is on it, and the shafts, whether they reach it or not."""

    plate: Plate
    shafts: tuple[Member, ...]
    spacers: tuple[Member, ...] = ()  # below the parts that are screwed to it
    screwed: tuple[tuple[Circle, str], ...] = ()  # clearance holes of screws, and what they fix
    bridge: Member | None = None  # bears the crank's shaft from above
    unborne: tuple[tuple[str, str], ...] = ()  # shafts that do not reach it, and why

    @property
    def threads(self) -> tuple[Circle, ...]:
        """The tapped holes of the frame."""
        return tuple(tapped(hole) for hole, _ in self.screwed)

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws that fix parts to the frame, and those of its mounting holes."""
        kinds = Counter((part, hole.radius) for hole, part in self.screwed)
        fixed = [Screws(part, n, 2.0 * r, "the frame") for (part, r), n in kinds.items()]
        mounts = mounts_of(self.plate)
        if mounts:
            fixed.append(Screws("frame", len(mounts), 2.0 * mounts[0].radius, "its base"))
        return tuple(fixed)
