"""Places along an outline that a round cutter cannot reach, and dog bones that free them.

A cutter reaches all of an outline if the offset by its radius keeps that distance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.inset import Bone, TooWide, bone, inner_corners, pieces, with_bones
from geneva_cli.geometry.kerf import Closed, offset
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.pieces import prepared
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Layer, Line, Point, Shape
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import SAME_CUT_MM


class Fault(NamedTuple):
    """A place that a cutter cannot cut; ``stops`` if the cutter does not enter at all."""

    text: str
    stops: bool


def faults(plate: Plate, radius: float) -> Iterator[Fault]:
    """Faults of a plate for a cutter: narrow places, at most one per outline, and corners.

    >>> bore = Circle("BORE", (1.0, 2.0), 2.0)
    >>> washer = Plate("washer", "CRANK", Circle("CRANK", (0.0, 0.0), 9.0), (bore,), 0.0, 1.0)
    >>> [fault.text for fault in faults(washer, 3.0)]
    ['hole of 4 mm at x = 1, y = 2 in washer: narrower than the cutter; drill it']
    """
    for shape, outside in shapes(plate):
        if isinstance(shape, Circle):
            if not outside and shape.radius < radius - SAME_CUT_MM:
                x, y = shape.centre
                size = f"hole of {2.0 * shape.radius:.6g} mm at x = {x:.6g}, y = {y:.6g}"
                text = f"{size} in {plate.name}: narrower than the cutter; drill it"
                yield Fault(text, False)
            continue
        place = blocked(shape, outside, radius)
        if place:
            # a micrometre's last digit moves with rounding; six decimals in mm are steady
            (x, y), hollow = (round(v, 6) + 0.0 for v in place[0]), place[1]
            what = f"an inner radius of {hollow:.5g} mm" if hollow else "a gap"
            most = 2.0 * _widest(shape, outside, radius)
            instead = f"use a cutter up to {most:.6g} mm" if most else "no cutter is small enough"
            yield Fault(
                f"it does not enter {plate.name}, layer {shape.layer}, at x = {x:.5g}, "
                f"y = {y:.5g}: {what} is narrower; {instead}",
                True,
            )
            continue
        for corner in inner_corners(shape, radius):
            x, y = corner.at
            yield Fault(
                f"it leaves a radius of {radius:.6g} mm in the corner of {plate.name}, layer "
                f"{shape.layer}, at x = {x:.5g}, y = {y:.5g}: add --dog-bones",
                False,
            )


def shapes(plate: Plate) -> Iterator[tuple[Shape, bool]]:
    """Outline and holes with the material on their left; True marks the outline."""
    for shape, outside in ((plate.outline, True), *((hole, False) for hole in plate.holes)):
        if isinstance(shape, Circle):
            yield shape, outside
            continue
        for cleaned in prepared(Drawing("", (shape,))).shapes:
            assert isinstance(cleaned, Contour)
            pieces(cleaned)
            yield with_material_left(cleaned, outside), outside


def blocked(contour: Contour, outside: bool, radius: float) -> tuple[Point, float] | None:
    """Place that a cutter cannot reach, and the radius of a hollow arc there, or 0.

    None if the cutter can follow the whole contour, as the offset by its radius does.
    """
    hollow = [p for p in pieces(contour) if isinstance(p, Arc) and p.bulge < 0.0]
    tightest = min(hollow, key=lambda arc: arc.radius, default=None)
    if tightest and tightest.radius < radius - 0.5 * SAME_CUT_MM:
        return at(tightest, 0.5), tightest.radius
    try:
        # of an arc that just fits, half of SAME_CUT_MM is left
        offset(contour, outside, radius - SAME_CUT_MM)
    except Closed as error:
        return error.at, 0.0
    return None


def _widest(contour: Contour, outside: bool, radius: float) -> float:
    """Largest cutter that enters, as a radius to about three digits; 0 for none."""
    # 14 halvings give more than the three digits that are shown
    largest = boundary(lambda r: blocked(contour, outside, r) is None, 0.0, radius, 14)
    if not largest:
        return 0.0
    near, below = (0.5 * to_digits(2.0 * largest, 3, way) for way in (round, math.floor))
    return near if blocked(contour, outside, near) is None else below


def freed(
    plate: Plate, radius: float, wall: float, works: Callable[[Line | Arc, Layer], bool]
) -> dict[Shape, Contour]:
    """Outlines of a plate that have corners, with dog bones in them.

    ``works(piece, layer)`` is True for pieces that the machine needs as they are. Raises
    GenevaError if a bone would cut one of those, and TooWide if it would meet another wall or leave
    less than ``wall`` mm to another outline.
    """
    outlines: dict[Shape, Contour] = {}
    around = list(shapes(plate))
    for original, (shape, _) in zip((plate.outline, *plate.holes), around, strict=True):
        if isinstance(shape, Circle):
            continue
        bones = [bone(shape, corner, radius) for corner in inner_corners(shape, radius)]
        others = [other for other, _ in around if other is not shape]
        for one in bones:
            _require_free(shape, one, radius, works)
            for other in others:
                _require_wall(plate, one, radius + wall, other)
        if bones:
            outlines[original] = with_bones(shape, bones)
    return outlines


def _require_free(
    shape: Contour, one: Bone, radius: float, works: Callable[[Line | Arc, Layer], bool]
) -> None:
    """Raise if a bone touches a wall that is not at its corner, or a working wall."""
    around, i = pieces(shape), one.corner.piece
    adjacent = {i, (i + 1) % len(around)}
    rest = np.array([k for k in range(len(around)) if k not in adjacent], dtype=np.intp)
    away = abs(float(Polyarc([shape]).subset(rest).signed(np.array([one.centre]))[0]))
    x, y = one.corner.at
    corner = f"--dog-bones: the corner at x = {x:.5g}, y = {y:.5g} on {shape.layer}"
    if any(works(around[k], shape.layer) for k in adjacent):
        raise GenevaError(
            f"{corner} is at a wall that guides roller or lock: omit --dog-bones to keep it round"
        )
    if away < radius - SAME_CUT_MM:
        raise TooWide(
            f"{corner} is so near to another wall that its bite, {2.0 * radius:.6g} mm wide, would "
            "cut into it"
        )


def _require_wall(plate: Plate, one: Bone, reach: float, other: Shape) -> None:
    if isinstance(other, Circle):
        away = abs(math.dist(one.centre, other.centre) - other.radius)
    else:
        away = abs(float(Polyarc([other]).signed(np.array([one.centre]))[0]))
    if away < reach:
        x, y = one.corner.at
        raise TooWide(
            f"--dog-bones: the bone at x = {x:.5g}, y = {y:.5g} in {plate.name} leaves less than "
            "wall_min_mm to another outline"
        )
