"""Drawings of a spherical wheel and crank laid flat, and their solids.

Layers: WHEEL and CRANK are cut; ROLLER is the hole of a roller; PITCH is the rollers' path.
"""

from __future__ import annotations

import math

from geneva_cli.geometry.drawing import Annotations, Drawing
from geneva_cli.geometry.measure import bounds, mapped
from geneva_cli.geometry.plates import Group, Member, Part, Plate
from geneva_cli.geometry.shapes import Contour, Line, Point, Segment, Shape, closed, joined
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.crank import locked, rollers
from geneva_cli.kinds.spherical.laid_flat import Cone, crank_cone, flat_region, wheel_cone
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.wheel import edge
from geneva_cli.parts.projection import titled


def wheel(parts: SphereParts) -> Drawing:
    """Return the wheel's cone, cut open between two slots; x is along the first slot."""
    cone = wheel_cone(parts.ball)
    title = titled(parts.mechanism, f"wheel, flat: {cone.described('wheel')}")
    return _drawing(parts, title, wheel_flat(parts, cone), parts.wheel.part)


def crank(parts: SphereParts) -> Drawing:
    """Return the crank's cone: locking sectors, and the rollers where they pass through it."""
    cone = crank_cone(parts.ball)
    title = titled(parts.mechanism, f"crank, flat: {cone.described('crank')}")
    return _drawing(parts, title, crank_flat(parts, cone), parts.crank.part)


def assembly(parts: SphereParts) -> Drawing:
    """Return both laid flat, side by side; the solid is the machine at input angle 0."""
    ball, title = parts.ball, titled(parts.mechanism)
    left, right = wheel_flat(parts, wheel_cone(ball)), crank_flat(parts, crank_cone(ball))
    # wheel and crank are 0.1 of the sphere's radius apart
    shift = 0.1 * ball.radius_mm + max(bounds(shape).x1 for shape in left)
    shift -= min(bounds(shape).x0 for shape in right)
    moved = [mapped(shape, lambda p: (p[0] + shift, p[1])) for shape in right]
    whole = Group(title, parts.members)
    return _drawing(parts, title, [*left, *moved], whole)._replace(look=Annotations((), ()))


def _drawing(parts: SphereParts, title: str, shapes: list[Shape], shells: Part) -> Drawing:
    """Return a drawing of plates of sheet, and the shells that they become."""
    inner, outer = parts.ball.span_mm
    plates = [
        Member(Plate(s.layer.lower(), s.layer, s, (), 0.0, outer - inner))
        for s in shapes
        if s.layer in ("WHEEL", "CRANK")  # others are not cut from sheet
    ]
    return Drawing(title, tuple(shapes), solid=Group(title, tuple(plates)), shells=shells)


def wheel_flat(parts: SphereParts, cone: Cone) -> list[Shape]:
    """Return the wheel's outline on its flat cone, and the rollers' paths."""
    ball = parts.ball
    b = ball.half_step
    slot = slot_flat(ball, cone, parts.tolerance or 0.0, parts.curves)
    mouth = math.acos(math.cos(ball.rim) / math.cos(ball.half_width))
    ends = [cone.point(polar, 0.0) for polar in (mouth, ball.bottom)]
    path = Contour("PITCH", (Line(*ends),), closed=False)
    outer: list[Segment] = []
    pitch: list[Shape] = []
    for k in range(ball.z):

        def to(p: Point, k: int = k) -> Point:
            return cone.turned(p, 2 * k * b)

        outer += mapped(slot, to).segments
        pitch.append(mapped(path, to))
    inner = [cone.point(ball.inner, (2 * k - 1) * b) for k in range(ball.z + 1)][::-1]
    back = [cone.level(p, q, -2.0 * b) for p, q in zip(inner, inner[1:], strict=False)]
    first, last = outer[0].start, outer[-1].end
    rim = closed("WHEEL", [*outer, Line(last, inner[0]), *back, Line(inner[-1], first)])
    return [rim, *pitch]


def slot_flat(ball: Ball, cone: Cone, tolerance: float, curves: str) -> Contour:
    """Return the edge about the first slot, half-way to the adjacent slots on either side."""
    one: list[Segment] = []
    for arc in edge(ball):
        one += cone.segments(arc, 0.0, tolerance, curves)
    return Contour("WHEEL", joined(one), closed=False)


def crank_flat(parts: SphereParts, cone: Cone) -> list[Shape]:
    """Return locking sectors, rollers and the rollers' circle on the crank's flat cone."""
    ball, accuracy = parts.ball, (parts.tolerance, parts.curves)
    shapes: list[Shape] = []
    for region, (a, b) in zip(parts.shells.crank, locked(ball), strict=True):
        shapes.append(flat_region("CRANK", region, cone, 0.5 * (a + b), *accuracy))
    for region, about in zip(rollers(ball), ball.rollers, strict=True):
        shapes.append(flat_region("ROLLER", region, cone, about, *accuracy))
    ends = cone.point(ball.arm, 0.0), cone.point(ball.arm, math.tau)
    shapes.append(Contour("PITCH", (cone.level(*ends, math.tau),), closed=False))
    return shapes
