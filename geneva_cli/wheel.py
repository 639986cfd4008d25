"""The wheel's outline: slots, rim and recesses in one closed contour."""

from __future__ import annotations

import math
from typing import NoReturn

from geneva_cli.drawing import Arc, Circle, Contour, Point, Segment, about, closed
from geneva_cli.errors import GenevaError
from geneva_cli.measure import turned
from geneva_cli.plane import Plane
from geneva_cli.sizes import Sizes
from geneva_cli.station import Station

LAYER = "WHEEL"


def wheel_contour(plane: Plane, sizes: Sizes, slots: dict[Station, Contour]) -> Contour:
    """The wheel's contour, counterclockwise: outside its material's edge, inside its opening's.

    ``slots`` has for each station the walls of its slot, from the corner on one side of the mouth
    round the bottom to the other, in the wheel's frame with that slot ahead. Raises GenevaError
    where a recess leaves no horn beside a slot.
    """
    found: list[Segment] = []
    around = plane.slots
    for i, (station, direction) in enumerate(around):
        following, ahead = around[(i + 1) % len(around)]
        found += turned(slots[station], direction).segments
        next_start = turned(slots[following], ahead).segments[0].start
        found += _rim(plane, sizes, found[-1].end, next_start, _between(plane, direction, ahead))
    return closed(LAYER, found)


def wheel_circles(plane: Plane, sizes: Sizes) -> list[Circle]:
    """Bore and hub, and the outside of an internal wheel."""
    found = [Circle(LAYER, (0.0, 0.0), sizes.outer)] if sizes.outer else []
    if sizes.wheel_bore:
        found.append(Circle("BORE", (0.0, 0.0), sizes.wheel_bore))
    return found


def _between(plane: Plane, start: float, end: float) -> float | None:
    """The rest between two neighbouring slots, as an angle above the first one's."""
    span = (end - start) % math.tau
    inside = [start + (at - start) % math.tau for at in plane.rests]
    found = [at for at in inside if at - start < span]
    return found[0] if found else None


def _rim(plane: Plane, sizes: Sizes, start: Point, end: Point, at: float | None) -> list[Segment]:
    """From one slot's corner along the rim, through the recess, to the next slot's corner."""
    first, last = math.atan2(start[1], start[0]), math.atan2(end[1], end[0])
    if math.remainder(last - first, math.tau) <= 0.0:
        raise GenevaError(
            "the mouths of neighbouring slots cut each other; a smaller roller_radius_mm than "
            f"{sizes.roller:g} leaves a rim between them",
            ("size", "roller_radius_mm"),
        )
    last = first + (last - first) % math.tau
    rims = math.hypot(*start), math.hypot(*end)
    if at is None or not sizes.lock:
        return [about((0.0, 0.0), rims[0], first, last - first)]
    at = first + (at - first) % math.tau
    halves = [opening(plane.L, rim, sizes.recess) for rim in rims]
    if not first < at - halves[0] < at + halves[1] < last:
        _refuse(plane, sizes, min(at - first, last - at))
    angles = at - halves[0], at + halves[1]
    corners = [(rim * math.cos(a), rim * math.sin(a)) for rim, a in zip(rims, angles, strict=True)]
    centre = plane.L * math.cos(at), plane.L * math.sin(at)
    a, b = (math.atan2(y - centre[1], x - centre[0]) for x, y in corners)
    # Outside the recess bends towards the wheel's axis, inside away from it.
    sweep = -((a - b) % math.tau) if plane.sign > 0.0 else (b - a) % math.tau
    return [
        about((0.0, 0.0), rims[0], first, angles[0] - first),
        Arc(corners[0], corners[1], math.tan(0.25 * sweep)),
        about((0.0, 0.0), rims[1], angles[1], last - angles[1]),
    ]


def _refuse(plane: Plane, sizes: Sizes, room: float) -> NoReturn:
    """Raise GenevaError: no horn is left beside a slot that begins so far from the recess."""
    L, rim = plane.L, sizes.rim
    most = math.sqrt(L * L + rim * rim - 2.0 * L * rim * math.cos(room)) - sizes.recess
    raise GenevaError(
        f"no horn is left between slot and recess: lock_radius_mm = {sizes.lock:.6g} must be below "
        f"{sizes.lock + most:.6g}, or the roller smaller",
        ("size", "lock_radius_mm"),
    )


def opening(L: float, rim: float, recess: float) -> float:
    """Half the angle over which a recess about a crank's axis opens the rim."""
    return math.acos((L * L + rim * rim - recess * recess) / (2.0 * L * rim))
