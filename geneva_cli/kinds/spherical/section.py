"""The section of a spherical machine through both shafts, with a roller at the end of its slot.

The sphere's centre is the origin, the wheel's axis points up, the crank's is to its right.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.view import View
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.shapes import ORIGIN, Arc, Contour, Line, about, closed, polygon
from geneva_cli.geometry.sheet import CENTRE, HIDDEN, OUTLINE, polar
from geneva_cli.kinds.spherical.arm import CapArm
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.regions import QUARTER
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.shafts.bores import around, radius_of
from geneva_cli.spec.written import degrees

Side: TypeAlias = Callable[[float], float]  # an angle from the wheel's axis, on each sphere


def section(parts: SphereParts, scale: float, items: Mapping[str, int]) -> View:
    """Return all parts cut by the plane of the shafts, with angles from the wheel's axis.

    Balloons have the numbers of ``items``, by their names. Locking sectors are turned into that
    plane.
    """
    ball, view = parts.ball, View("section through both shafts", scale)
    inner, outer = ball.span_mm
    end = ball.slot_end
    # opposite, across the wheel's axis, there is a slot too, or the edge between two slots
    back = ball.between_slots if ball.z % 2 else end
    sides = [radial(ball.inner), radial(-ball.inner)]
    if ball.opening_mm:
        sides = [parallel(0.0, ball.opening_mm), parallel(0.0, -ball.opening_mm)]
    cut = {"wheel": [_ring(inner, outer, sides[0], radial(end))]}
    cut["wheel"].append(_ring(inner, outer, radial(-back), sides[1]))
    for name, ring in _crank(parts):
        cut.setdefault(name, []).append(ring)
    for plate, angle in _plates(parts):
        cut.setdefault(plate.name, []).extend(_along(plate, angle))
    for face in (one for some in cut.values() for one in some):
        view.draw(face, OUTLINE)
    view.draw(_ring(inner, outer, radial(end), radial(ball.rim)), HIDDEN)  # the slot's wall, beyond
    middle = ball.axes - ball.arm
    far = max([outer, *(plate.high for one in parts.shafts for plate in plates(one.part))])
    for angle in (0.0, ball.axes, middle):
        tip = polar(ORIGIN, far + 0.1 * ball.radius_mm, QUARTER - angle)
        view.centre_line(ORIGIN, tip)
    locked = Contour("", (_arc(ball.radius_mm, -back, ball.axes + ball.lock),), closed=False)
    view.draw(locked, CENTRE)
    for radius in (inner, outer):
        view.of_arcs([_arc(radius, -back, -ball.inner)], sized.plain(radius, "SR "))
    if parts.arm:
        start = ball.axes + parts.arm.cap
        for radius in ball.arm_span_mm:
            arc = _arc(radius, start - 0.5 * parts.arm.cap, start)
            view.of_arcs([arc], sized.plain(radius, "SR "))
    _dimension_angles(view, parts, far)
    for name, item in items.items():
        tips = [at(piece, 0.5) for face in cut.get(name, ()) for piece in face.segments]
        view.balloon(tips, str(item))
    return view


def _dimension_angles(view: View, parts: SphereParts, far: float) -> None:
    ball = parts.ball
    angles = {
        "slot's end": ball.slot_end,
        "roller": ball.axes - ball.arm,
        "rim": ball.rim,
        "shafts": ball.axes,
    }
    angles |= {} if ball.opening_mm else {"opening": ball.inner}
    # four decimals are 0.2 um on 100 mm
    for name, angle in sorted(angles.items(), key=lambda item: item[1]):
        view.angular([(QUARTER - angle, QUARTER)], far, far, f"{name} {degrees(angle, 4)}")
    axis = QUARTER - ball.axes
    for name, angle in zip(("sector, inside", "sector, lock"), _reach(parts), strict=False):
        view.angular([(axis - angle, axis)], far, far, f"{name} {degrees(angle, 4)}")


def _crank(parts: SphereParts) -> Iterator[tuple[str, Contour]]:
    """Yield the cut faces of rollers, locking sector and arm, with their parts' names."""
    ball, arm = parts.ball, parts.arm
    for middle in _rollers(ball):
        sides = [radial(middle - ball.roller), radial(middle + ball.roller)]
        if arm:
            sides[1:1] = [parallel(middle, -ball.pin_mm), parallel(middle, ball.pin_mm)]
        for low, high in zip(sides[::2], sides[1::2], strict=True):
            yield "roller", _ring(*ball.span_mm, low, high)
    if reach := _reach(parts):
        low, high = (radial(ball.axes + angle) for angle in reach)
        yield "locking sector", _ring(*ball.lock_span_mm, low, high)
    if arm:
        middle, hole = ball.axes - ball.arm, arm.pins[0].radius
        sides = [radial(middle - arm.eye), parallel(middle, -hole), parallel(middle, hole)]
        sides += [parallel(ball.axes, -arm.hub), parallel(ball.axes, arm.hub), *_behind(ball, arm)]
        for low, high in zip(sides[::2], sides[1::2], strict=True):
            yield "arm", _ring(*ball.arm_span_mm, low, high)


def _rollers(ball: Ball) -> list[float]:
    """Return angles of the rollers in the plane of the shafts: the first, and one opposite."""
    across = any(abs(azimuth - math.pi) < SAME_ON_SHEET for azimuth in ball.rollers)
    return [ball.axes - ball.arm, *([ball.axes + ball.arm] if across else [])]


def _behind(ball: Ball, arm: CapArm) -> list[Side]:
    """Return the sides of the arm across the crank's axis, with a hole that lies there."""
    polars = [polar for arc in arm.boundary.boundary for polar in arc.crossings(math.pi)]
    end = radial(ball.axes + max(polars))
    for hole in (*arm.pins, *arm.bolts):
        x, y, z = hole.axis
        if x < 0.0 and abs(y) < SAME_ON_SHEET:
            polar = ball.axes + math.acos(z)
            return [parallel(polar, -hole.radius), parallel(polar, hole.radius), end]
    return [end]


def _plates(parts: SphereParts) -> Iterator[tuple[Plate, float]]:
    """Yield hubs, shafts and pins, each with the angle of its axis from the wheel's axis."""
    axes = parts.ball.axes
    yield from ((plate, 0.0) for plate in plates(parts.wheel.part))
    for plate in dict.fromkeys(plates(parts.crank.part)):
        angles = _rollers(parts.ball) if plate.layer == "ROLLER" else [axes]
        yield from ((plate, angle) for angle in angles)
    for member in parts.shafts:
        for step in plates(member.part):
            yield step, axes if member.frame else 0.0


def _along(plate: Plate, angle: float) -> Iterator[Contour]:
    """Yield a round plate cut along its axis: both sides of its bore, if it has one."""
    wide = around(plate.outline)
    bore = radius_of(plate.holes[0]) if plate.holes else 0.0
    for low, high in ((bore, wide), (-wide, -bore)) if bore else ((-wide, wide),):
        corners = [(low, plate.low), (high, plate.low), (high, plate.high), (low, plate.high)]
        c, s = math.cos(angle), math.sin(angle)
        ring = [(c * x + s * y, c * y - s * x) for x, y in corners]
        yield polygon("", ring)


def _reach(parts: SphereParts) -> tuple[float, ...]:
    """Return the angles of the locking sectors' inner and outer edge, from the crank's axis."""
    arcs = [arc for one in parts.shells.crank for arc in one.boundary]
    angles = [math.acos(max(-1.0, min(1.0, arc.start[2]))) for arc in arcs]
    return (min(angles), max(angles)) if angles else ()


def radial(angle: float) -> Side:
    """Return a wall that leads to the centre."""
    return lambda sphere: angle


def parallel(axis: float, off: float) -> Side:
    """Return a wall that is parallel to an axis, at the distance ``off``."""
    return lambda sphere: axis + math.asin(off / sphere)


def _ring(inner: float, outer: float, low: Side, high: Side) -> Contour:
    """Return the section of a shell between two walls."""
    out, back = _arc(outer, low(outer), high(outer)), _arc(inner, high(inner), low(inner))
    return closed("", [out, Line(out.end, back.start), back, Line(back.end, out.start)])


def _arc(radius: float, low: float, high: float) -> Arc:
    return about(ORIGIN, radius, QUARTER - low, low - high)
