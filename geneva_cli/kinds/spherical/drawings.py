"""Drawings of a spherical wheel and crank laid flat, and their solids.

Layers: WHEEL and CRANK are cut; ROLLER is the hole of a roller; PITCH is the rollers' path.
"""

from __future__ import annotations

import math
from functools import partial
from itertools import chain

from geneva_cli.geometry.measure import bounds, mapped
from geneva_cli.geometry.plates import Group, Member, Part, Plate
from geneva_cli.geometry.shapes import Contour, Line, Segment, Shape, closed, joined
from geneva_cli.geometry.sheet import Annotations, Drawing
from geneva_cli.geometry.sphere import Cap, Region, SphereArc, place
from geneva_cli.kinds.spherical.arm import CapArm, crank_arm
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.laid_flat import Cone, crank_cone, flat_region, wheel_cone
from geneva_cli.kinds.spherical.parts import SphereParts, arm_solids
from geneva_cli.kinds.spherical.regions import edge, locked, rollers
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
    return _drawing(parts, title, [*left, *moved], whole)._replace(look=Annotations())


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
    path = Line(*(cone.point(polar, 0.0) for polar in (ball.wall_mouth, ball.bottom)))
    both = Contour("PITCH", (*slot.segments, path), closed=False)
    outer: list[Segment] = []
    pitch: list[Shape] = []
    for k in range(ball.z):
        *walls, axis = mapped(both, partial(cone.turned, azimuth=2 * k * b)).segments
        outer += walls
        pitch.append(Contour("PITCH", (axis,), closed=False))
    inner = [cone.point(ball.inner, (2 * k - 1) * b) for k in range(ball.z + 1)][::-1]
    back = [cone.level(p, q, -2.0 * b) for p, q in zip(inner, inner[1:], strict=False)]
    first, last = outer[0].start, outer[-1].end
    rim = closed("WHEEL", [*outer, Line(last, inner[0]), *back, Line(inner[-1], first)])
    return [rim, *pitch]


def slot_flat(ball: Ball, cone: Cone, tolerance: float, curves: str) -> Contour:
    """Return the edge about the first slot, half-way to the adjacent slots on either side."""
    each = (cone.segments(arc, 0.0, tolerance, curves) for arc in edge(ball))
    return Contour("WHEEL", joined(chain(*each)), closed=False)


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


def arm(parts: SphereParts) -> Drawing:
    """Return the arm laid flat; its solid is the cap with its hub.

    Raises GenevaError without an arm.
    """
    ball = parts.ball
    # the error says why there is no arm
    cap_arm = parts.arm or crank_arm(ball, parts.shells.crank, parts.mechanism.spec.size)
    shapes = arm_flat(parts, cap_arm)
    low, high = ball.arm_span_mm
    plate = Plate("arm", "ARM", shapes[0], tuple(shapes[1:]), 0.0, high - low)
    solid = Group("arm", tuple(map(Member, arm_solids(ball, cap_arm))))
    title = titled(parts.mechanism, f"arm, flat: {arm_cone(ball).described('crank')}")
    return Drawing(title, tuple(shapes), solid=plate, shells=solid)


def arm_cone(ball: Ball) -> Cone:
    """Return the cone that touches the middle of the arm's thickness at the pins."""
    return Cone(0.5 * sum(ball.arm_span_mm), ball.arm)


def arm_flat(parts: SphereParts, arm: CapArm) -> list[Contour]:
    """Return the arm's boundary, cut open between its holes, and the holes.

    About the crank's axis the opening is as wide as the hub.
    """
    cone = arm_cone(parts.ball)
    hub, *others = arm.holes
    azimuths = [math.atan2(hole.axis[1], hole.axis[0]) for hole in others]
    cut = _widest_gap(azimuths) - math.tau  # azimuths rise from here by a whole turn, past 0
    head, *between, tail = _opened(arm.boundary, cut)
    edge: list[Segment] = []
    # each arc's azimuths are unwrapped around a value near them
    for arc, about in ((head, 0.5), *((arc, 1.0) for arc in between), (tail, 1.5)):
        edge += cone.segments(arc, cut + about * math.pi, parts.tolerance or 0.0, parts.curves)
    angle = hub.angle(cone.radius_mm)
    far, near = (cone.point(angle, cut + turn) for turn in (math.tau, 0.0))
    back = cone.level(far, near, -math.tau)
    outline = [*edge, Line(edge[-1].end, far), back, Line(near, edge[0].start)]
    holes = []
    for hole, azimuth in zip(others, azimuths, strict=True):
        region = Cap(hole.axis, hole.angle(cone.radius_mm)).region
        about = cut + (azimuth - cut) % math.tau
        holes.append(flat_region("BORE", region, cone, about, parts.tolerance, parts.curves))
    return [closed("ARM", outline), *holes]


def _widest_gap(azimuths: list[float]) -> float:
    """Return the azimuth in the middle of the widest gap, from 0 up to a whole turn."""
    around = sorted(a % math.tau for a in azimuths)
    after = [*around[1:], around[0] + math.tau]
    start, end = max(zip(around, after, strict=True), key=lambda pair: pair[1] - pair[0])
    return 0.5 * (start + end) % math.tau


def _opened(region: Region, azimuth: float) -> list[SphereArc]:
    """Return a boundary round the pole, counterclockwise, cut where it crosses an azimuth."""
    arcs = region.boundary
    number, polar = next((i, p) for i, arc in enumerate(arcs) for p in arc.crossings(azimuth))
    at = place(polar, azimuth)
    head, tail = arcs[number]._replace(start=at), arcs[number]._replace(end=at)
    return [head, *arcs[number + 1 :], *arcs[:number], tail]
