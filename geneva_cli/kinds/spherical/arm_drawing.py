"""The crank arm of a spherical machine, laid flat on a cone normal to its pins and cut open."""

from __future__ import annotations

import math

from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Contour, Line, Segment, closed
from geneva_cli.geometry.sphere import Region, SphereArc, place
from geneva_cli.geometry.sphere_hull import Cap
from geneva_cli.kinds.spherical.arm import CapArm, crank_arm
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.laid_flat import Cone, flat_region
from geneva_cli.kinds.spherical.parts import SphereParts, arm_solids
from geneva_cli.parts.projection import titled


def arm(parts: SphereParts) -> Drawing:
    """Return the arm laid flat; its solid is the cap with its hub.

    Raises GenevaError without an arm.
    """
    ball = parts.ball
    # the error says why there is no arm
    size = parts.mechanism.spec.size
    cap_arm = parts.arm or crank_arm(parts.ball, parts.shells.crank, size)
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
