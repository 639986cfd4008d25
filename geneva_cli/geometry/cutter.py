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
from geneva_cli.geometry.measure import at, directions, fraction_at
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.offsets import Closed, between, lines_and_arcs, offset
from geneva_cli.geometry.pieces import prepared
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import (
    Arc,
    Circle,
    Contour,
    Layer,
    Line,
    Point,
    Segment,
    Shape,
    as_contour,
    closed,
)
from geneva_cli.geometry.sheet import Drawing, polar
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import SAME_CUT_MM


class TooWide(GenevaError):
    """A dog bone that does not fit, but one of a narrower cutter may."""


class Fault(NamedTuple):
    """A place that a cutter cannot cut; ``stops`` if the cutter does not enter at all."""

    text: str
    stops: bool


class _Bone(NamedTuple):
    """A dog bone at the end of a piece: its corner, its centre, and the arc that replaces it."""

    piece: int
    corner: Point
    centre: Point
    arc: Arc


def faults(plate: Plate, radius: float) -> Iterator[Fault]:
    """Faults of a plate for a cutter: narrow places, at most one per outline, and corners.

    >>> bore = Circle("BORE", (1.0, 2.0), 2.0)
    >>> washer = Plate("washer", "CRANK", Circle("CRANK", (0.0, 0.0), 9.0), (bore,), 0.0, 1.0)
    >>> [fault.text for fault in faults(washer, 3.0)]
    ['hole of 4 mm at x = 1, y = 2 in washer: narrower than the cutter; drill it']
    """
    for shape, outside in _shapes(plate):
        if isinstance(shape, Circle):
            if not outside and shape.radius < radius - SAME_CUT_MM:
                x, y = shape.centre
                size = f"hole of {2.0 * shape.radius:.6g} mm at x = {x:.6g}, y = {y:.6g}"
                text = f"{size} in {plate.name}: narrower than the cutter; drill it"
                yield Fault(text, False)
            continue
        place = _blocked(shape, outside, radius)
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
        for i, _ in _inner_corners(_pieces(shape), radius):
            x, y = shape.segments[i].end
            yield Fault(
                f"it leaves a radius of {radius:.6g} mm in the corner of {plate.name}, layer "
                f"{shape.layer}, at x = {x:.5g}, y = {y:.5g}: add --dog-bones",
                False,
            )


def _shapes(plate: Plate) -> Iterator[tuple[Shape, bool]]:
    """Outline and holes with the material on their left; True marks the outline."""
    for shape, outside in ((plate.outline, True), *((hole, False) for hole in plate.holes)):
        if isinstance(shape, Circle):
            yield shape, outside
            continue
        for cleaned in prepared(Drawing("", (shape,))).shapes:
            assert isinstance(cleaned, Contour)
            _pieces(cleaned)
            yield with_material_left(cleaned, outside), outside


def _blocked(contour: Contour, outside: bool, radius: float) -> tuple[Point, float] | None:
    """Place that a cutter cannot reach, and the radius of a hollow arc there, or 0."""
    hollow = [p for p in _pieces(contour) if isinstance(p, Arc) and p.bulge < 0.0]
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
    largest = boundary(lambda r: _blocked(contour, outside, r) is None, 0.0, radius, 14)
    if not largest:
        return 0.0
    near, below = (0.5 * to_digits(2.0 * largest, 3, way) for way in (round, math.floor))
    return near if _blocked(contour, outside, near) is None else below


def freed(
    plate: Plate, radius: float, wall: float, works: Callable[[Line | Arc, Layer], bool]
) -> dict[Shape, Contour]:
    """Outlines of a plate that have corners, with dog bones in them.

    ``works(piece, layer)`` is True for pieces that the machine needs as they are. Raises
    GenevaError if a bone would cut one of those, and TooWide if it would meet another wall or leave
    less than ``wall`` mm to another outline.
    """
    outlines: dict[Shape, Contour] = {}
    around = list(_shapes(plate))
    for original, (shape, _) in zip((plate.outline, *plate.holes), around, strict=True):
        if isinstance(shape, Circle):
            continue
        own, layer, bones = _pieces(shape), shape.layer, list[_Bone]()
        for i, turn in _inner_corners(own, radius):
            bone, (x, y) = _bone(own, i, turn, radius), own[i].end
            bones.append(bone)
            adjacent = {i, (i + 1) % len(own)}
            where = f"--dog-bones: the corner at x = {x:.5g}, y = {y:.5g} on {layer}"
            if any(works(own[k], layer) for k in adjacent):
                raise GenevaError(
                    f"{where} is at a wall that guides roller or lock: omit --dog-bones to keep it "
                    "round"
                )
            rest = np.array([k for k in range(len(own)) if k not in adjacent], dtype=np.intp)
            if _away(Polyarc([shape]).subset(rest), bone.centre) < radius - SAME_CUT_MM:
                raise TooWide(
                    f"{where} is so near to another wall that its bite, {2.0 * radius:.6g} mm "
                    "wide, would cut into it"
                )
            others = (as_contour(other) for other, _ in around if other is not shape)
            if any(_away(Polyarc([one]), bone.centre) < radius + wall for one in others):
                raise TooWide(
                    f"--dog-bones: the bone at x = {x:.5g}, y = {y:.5g} in {plate.name} leaves "
                    "less than wall_min_mm to another outline"
                )
        if bones:
            outlines[original] = _with_bones(layer, own, bones)
    return outlines


def _away(outline: Polyarc, point: Point) -> float:
    return abs(float(outline.signed(np.array([point]))[0]))


def _pieces(contour: Contour) -> list[Line | Arc]:
    return lines_and_arcs(contour, "--cutter works on lines and arcs only: use --curves arcs")


def _inner_corners(own: list[Line | Arc], radius: float) -> Iterator[tuple[int, float]]:
    """Corners in which a cutter leaves material: the piece before, and the right turn, radians."""
    for i, piece in enumerate(own):
        before, after = directions(piece)[1], directions(own[(i + 1) % len(own)])[0]
        turn = -math.remainder(after - before, math.tau)
        # less than 1e-4 mm of material is no corner
        if 0.0 < turn < math.pi and radius * (1.0 / math.cos(0.5 * turn) - 1.0) > 1e-4:
            yield i, turn


def _bone(own: list[Line | Arc], i: int, turn: float, radius: float) -> _Bone:
    """The dog bone of a corner, which runs clockwise from one wall through it to the other."""
    walls, corner = (own[i], own[(i + 1) % len(own)]), own[i].end
    bisector = directions(walls[1])[0] + 0.5 * turn - 0.5 * math.pi
    centre = polar(corner, radius, bisector)
    start, end = (_again(wall, centre, corner) for wall in walls)
    halves = [math.asin(min(1.0, 0.5 * math.dist(corner, p) / radius)) for p in (start, end)]
    return _Bone(i, corner, centre, Arc(start, end, -math.tan(0.5 * sum(halves))))


def _with_bones(layer: Layer, own: list[Line | Arc], bones: list[_Bone]) -> Contour:
    """A contour with dog bones in place of its corners."""
    at_end = {bone.piece: bone for bone in bones}
    segments: list[Segment] = []
    for i, piece in enumerate(own):
        ahead, behind = at_end.get(i), at_end.get((i - 1) % len(own))
        start = behind.arc.end if behind else piece.start
        end = ahead.arc.start if ahead else piece.end
        low, high = (fraction_at(piece, point) for point in (start, end))
        if (ahead and high > 1.0) or (behind and low < 0.0) or low >= high:
            x, y = (ahead or behind or bones[0]).corner
            raise TooWide(
                f"the wall of {layer} at its corner x = {x:.5g}, y = {y:.5g} is shorter than a dog "
                "bone"
            )
        segments.append(between(piece, start, end) if ahead or behind else piece)
        segments += [ahead.arc] if ahead else []
    return closed(layer, segments)


def _again(wall: Line | Arc, centre: Point, corner: Point) -> Point:
    """Second point at which a circle through the corner meets a wall: the corner's mirror image."""
    (cx, cy), (px, py) = centre, corner
    if isinstance(wall, Line):
        ux, uy = wall.start[1] - wall.end[1], wall.end[0] - wall.start[0]
    else:
        ux, uy = wall.centre[0] - cx, wall.centre[1] - cy
    along = ((px - cx) * ux + (py - cy) * uy) / (ux * ux + uy * uy)
    return 2.0 * (cx + along * ux) - px, 2.0 * (cy + along * uy) - py
