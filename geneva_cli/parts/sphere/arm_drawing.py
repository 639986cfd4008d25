"""The crank arm of a sphere laid flat: on a cone that its pins stand square on, cut open."""

from __future__ import annotations

import math

from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.plates import Group, Member, Plate
from geneva_cli.curves.shapes import Contour, Line, Segment, closed
from geneva_cli.curves.sphere import Region, SphereArc, place
from geneva_cli.curves.sphere_hull import Cap
from geneva_cli.parts.link_drawings import titled
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.sphere.arm import CapArm, crank_arm
from geneva_cli.parts.sphere.built import ARM, arm_solids
from geneva_cli.parts.sphere.drawings import flat_region
from geneva_cli.parts.sphere.laid_flat import Cone
from geneva_cli.parts.sphere.sizes import Ball

HOLES = "BORE"


def arm(proof: Proof, tolerance: float, curves: str) -> Drawing:
    """The arm laid flat; as a solid the cap and its hub. Raises GenevaError without an arm."""
    found = proof.shells.ball
    made, cone = crank_arm(proof.shells), arm_cone(found)
    shapes = arm_flat(found, made, tolerance, curves)
    low, high = found.arm_span_mm
    plate = Plate("arm", ARM, shapes[0], tuple(shapes[1:]), 0.0, high - low)
    solid = Group("arm", tuple(map(Member, arm_solids(found, made))))
    title = f"{titled(proof.mechanism)}: arm, flat: {cone.said('crank')}"
    return Drawing(title, tuple(shapes), solid=plate, shells=solid)


def arm_cone(found: Ball) -> Cone:
    """It touches the sphere amid the arm's thickness where the pins are."""
    return Cone(0.5 * sum(found.arm_span_mm), found.arm)


def arm_flat(found: Ball, made: CapArm, tolerance: float, curves: str) -> list[Contour]:
    """The arm's boundary, cut open beside its holes, and these.

    About the crank's axis it is open as wide as the hub.
    """
    cone = arm_cone(found)
    hub, *others = made.holes
    ways = [math.atan2(hole.axis[1], hole.axis[0]) for hole in others]
    cut = _widest_gap(ways) - math.tau  # azimuths rise from there by a whole turn, past 0
    head, *between, tail = _opened(made.boundary, cut)
    edge: list[Segment] = []
    # each arc's azimuths are told by one near to them
    for arc, about in ((head, 0.5), *((arc, 1.0) for arc in between), (tail, 1.5)):
        edge += cone.segments(arc, cut + about * math.pi, tolerance, curves)
    angle = hub.angle(cone.radius_mm)
    far, near = (cone.point(angle, cut + turn) for turn in (math.tau, 0.0))
    back = cone.level(far, near, -math.tau)
    outline = [*edge, Line(edge[-1].end, far), back, Line(near, edge[0].start)]
    holes = []
    for hole, way in zip(others, ways, strict=True):
        region = Cap(hole.axis, hole.angle(cone.radius_mm)).region
        about = cut + (way - cut) % math.tau
        holes.append(flat_region(HOLES, region, cone, about, tolerance, curves))
    return [closed(ARM, outline), *holes]


def _widest_gap(azimuths: list[float]) -> float:
    """An azimuth amid the widest gap between some, above 0 and below a whole turn."""
    around = sorted(a % math.tau for a in azimuths)
    after = [*around[1:], around[0] + math.tau]
    start, end = max(zip(around, after, strict=True), key=lambda pair: pair[1] - pair[0])
    return 0.5 * (start + end) % math.tau


def _opened(region: Region, azimuth: float) -> list[SphereArc]:
    """A boundary round the pole, counterclockwise from where it crosses an azimuth to there."""
    arcs = region.boundary
    number, polar = next((i, p) for i, arc in enumerate(arcs) for p in arc.crossings(azimuth))
    at = place(polar, azimuth)
    head, tail = arcs[number]._replace(start=at), arcs[number]._replace(end=at)
    return [head, *arcs[number + 1 :], *arcs[:number], tail]
