"""The crank's outline in the wheel's plane: the locking disc, its relief and its round holes.

It is in the crank's frame: its axis is the origin, and x is through the first roller at
mid-motion. The disc is whole where it locks, and relieved where a roller moves the wheel.
"""

from __future__ import annotations

import math
from itertools import combinations

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Circle, Contour, Line, Segment, Shape, about, closed
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.locking_rings import Swept, rings
from geneva_cli.parts.outlines.reliefs import (
    Relief,
    arc_floor,
    followed,
    is_whole,
    keyway_direction,
    reliefs,
    widened,
)
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.sizes import Sizes, crank_reach_and_hub
from geneva_cli.parts.slots.roller_paths import mouth_corners, roller_centres


def crank_contours(
    assembly: Assembly, sizes: Sizes, relief: str, swept: Swept, spare: float = 0.0
) -> list[Contour]:
    """Return the locking disc with one kind of relief: ``"arc"`` or ``"sector"``.

    ``swept(i)`` are points where the wheel enters the disc in the i-th motion. Where the
    wheel sweeps over the crank's axis, as an internal wheel does, only locking sectors are left.
    The crank carries them next to the wheel's plane. They keep ``spare`` mm more distance from the
    wheel.
    """
    if not is_whole(assembly, sizes):
        return rings(assembly, sizes, swept, spare)
    around = reliefs(assembly)
    if relief == "sector":
        mouths = mouth_corners(assembly, sizes.roller, sizes.recess, sizes.rim)
        around = widened(assembly, sizes, mouths)
    if sum(one.end - one.start for one in around) > math.tau - SAME_ANGLE:
        raise GenevaError(
            "nothing is left of the locking disc: its reliefs go all the way round; use fewer "
            f"rollers, or a smaller one than {sizes.roller:g} mm",
            ("size", "roller_radius_mm"),
        )
    segments: list[Segment] = []
    for one, after in followed(around):
        segments += [_arc(sizes, one)] if relief == "arc" else _sector(assembly, sizes, one)
        if after - one.end > SAME_ANGLE:
            segments.append(about((0.0, 0.0), sizes.lock, one.end, after - one.end))
    return [closed("CRANK", segments)]


def arc_leaves_hub(assembly: Assembly, sizes: Sizes) -> bool:
    """Return True if an arc leaves the spec's bore of the crank a wall, and its hub.

    It also does where a sector would be no deeper. Default bores and hubs are within an arc.
    """
    size = assembly.full.spec.size
    bore = 0.5 * (size.crank_bore_mm or 0.0)
    _, hub = crank_reach_and_hub(size, bore, sizes.wall_min)
    wall = size.allowances.around_shaft_mm + sizes.wall_min
    needed = max(bore + wall if bore else 0.0, hub if size.has_hub("crank") else 0.0)
    sector = assembly.L - sizes.rim - sizes.relief
    return arc_floor(assembly, sizes.lock) >= min(needed, sector)


def _arc(sizes: Sizes, relief: Relief) -> Segment:
    """Return one arc that meets the disc at right angles at both ends."""
    if relief.half > 0.5 * math.pi - SAME_ANGLE:
        raise GenevaError(
            f'relief = "arc": the wheel moves over {math.degrees(2.0 * relief.half):.6g} deg of '
            'the crank, but an arc relieves less than 180 deg; set relief = "sector"',
            ("size", "relief"),
        )
    middle = 0.5 * (relief.start + relief.end)
    away, radius = sizes.lock / math.cos(relief.half), sizes.lock * math.tan(relief.half)
    centre = away * math.cos(middle), away * math.sin(middle)
    half = math.pi / 2.0 - relief.half
    return about(centre, radius, middle + math.pi + half, -2.0 * half)


def _sector(assembly: Assembly, sizes: Sizes, relief: Relief) -> list[Segment]:
    """Return the whole sector, down to where the wheel never comes: L - rim less a clearance."""
    floor = assembly.L - sizes.rim - sizes.relief
    width = relief.end - relief.start
    bottom = about((0.0, 0.0), floor, relief.start, width)
    start = (sizes.lock * math.cos(relief.start), sizes.lock * math.sin(relief.start))
    end = (sizes.lock * math.cos(relief.end), sizes.lock * math.sin(relief.end))
    return [Line(start, bottom.start), bottom, Line(bottom.end, end)]


def crank_circles(assembly: Assembly, sizes: Sizes) -> list[Shape]:
    """Return rollers, pins and bore in its shape."""
    shapes: list[Shape] = []
    for centre in roller_centres(assembly):
        shapes += [Circle("ROLLER", centre, sizes.roller)]
        shapes += [Circle("ROLLER", centre, sizes.pin)] if sizes.pin else []
    if sizes.crank_bore:
        own = bore_of(assembly.mechanism.spec.size, "crank", sizes.crank_bore)
        shapes.append(own.shape("BORE", keyway_direction(assembly)))
    return shapes


def rollers_gap(assembly: Assembly, sizes: Sizes) -> float | None:
    """Return the gap between the roller that starts the wheel and that which stops it, mm.

    It is negative where they overlap, and None if each roller does both.
    """
    if len(assembly.rollers) == len(assembly.motions):
        return None
    pairs = combinations(roller_centres(assembly), 2)
    return min(math.dist(one, other) for one, other in pairs) - 2.0 * sizes.roller
