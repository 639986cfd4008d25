"""Drawings and dimensions of a spherical machine: its parts laid flat, and their solids.

A shell is projected from the centre on a tangent cone and unrolled: a sheet cut by this outline and
rolled up lets the roller pass as the shell does. The cone's sector is 2 pi cos(polar) wide; at 90
degrees it is a cylinder.

Layers: WHEEL and CRANK are cut; ROLLER is the hole of a roller; PITCH is the rollers' path.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry import fit, shapes
from geneva_cli.geometry.plates import Group, Member, Part, Plate
from geneva_cli.geometry.sheet import Annotations, Drawing
from geneva_cli.geometry.sphere import Cap, Region, SphereArc, place
from geneva_cli.geometry.sphere_arcs import azimuth, polar
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.regions import edge, locked
from geneva_cli.motion.pivots import Dimension
from geneva_cli.numerics.arrays import Array, Complex, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.projection import Missing, or_missing, titled
from geneva_cli.table import in_decimals as length


class Cone(NamedTuple):
    """The cone about z that touches the sphere all round at a polar angle, radians.

    Laid flat and seen from outside, its origin is the point of contact at azimuth 0. x points away
    from the pole, and y towards rising azimuths.
    """

    radius_mm: float  # of the sphere
    polar: float
    # of curves that are neither lines nor arcs: the greatest distance from them, mm, and "arcs" or
    # "cubics"
    tolerance_mm: float
    curves: str

    @property
    def apex_mm(self) -> float:
        """Distance from the apex to the circle of contact; negative for an apex on the far side."""
        return self.radius_mm * math.tan(self.polar)

    @property
    def sector_deg(self) -> float:
        """The angle of the whole cone, laid flat."""
        return 360.0 * abs(math.cos(self.polar))

    def points(self, polar: Array | float, azimuth: Array) -> list[shapes.Point]:
        """Return the points of the flat cone, mm, that n points of the sphere are projected to."""
        return [(p.real, p.imag) for p in self._flat(np.array(polar), azimuth)[0].tolist()]

    def region(self, layer: shapes.Layer, region: Region, about: float) -> shapes.Contour:
        """Return a region laid flat, whose azimuths are within half a turn of ``about``."""
        return shapes.closed(layer, chain(*(self.segments(arc, about) for arc in region.boundary)))

    def segments(self, arc: SphereArc, about: float) -> list[shapes.Segment]:
        """Return an arc of the sphere on the flat cone."""

        def near(points: Array) -> Array:
            return about + within_half_turn(azimuth(points) - about)

        both = np.array((arc.start, arc.end))
        ends = self.points(polar(both), near(both))
        # a meridian: a great circle is at 90 degrees from its axis
        if not arc.axis[2] and abs(math.cos(arc.angle)) < 1e-12:
            return [shapes.Line(*ends)]
        if not arc.axis[0] and not arc.axis[1]:
            return [self.level(ends[0], ends[1], math.copysign(arc.sweep, arc.axis[2]))]

        def curve(turn: Array) -> tuple[Array, Array]:
            at, rates = arc.at(turn)
            points, outwards, sideways = self._flat(polar(at), near(at))
            (x, y, _), (dx, dy, dz) = at.T, rates.T
            tangents = sideways * (x * dy - y * dx) / np.hypot(x, y) - outwards * dz
            tangents /= np.abs(tangents)
            on, ahead = (np.column_stack((v.real, v.imag)) for v in (points, tangents))
            return on, ahead

        return [*fit.KINDS[self.curves](curve, 0.0, arc.sweep, self.tolerance_mm)]

    def level(self, start: shapes.Point, end: shapes.Point, azimuth: float) -> shapes.Segment:
        """Return the arc about the apex between two points, over an azimuth."""
        bulge = math.tan(0.25 * azimuth * math.cos(self.polar))
        return shapes.Arc(start, end, bulge) if abs(bulge) > SAME_ANGLE else shapes.Line(start, end)

    def _flat(self, polar: Array, azimuth: Array) -> tuple[Complex, Complex, Complex]:
        """Return points of the flat cone, x + iy, and their derivatives by both angles."""
        R, ratio, off = self.radius_mm, math.cos(self.polar), polar - self.polar
        beyond, wide = R * np.tan(off), R * math.sin(self.polar)  # along the cone, from its circle
        half = np.exp(0.5j * ratio * azimuth)
        turn, chord = half * half, azimuth * half * np.sinc(0.5 * ratio * azimuth / math.pi)
        # the chord is (turn - 1) / (i ratio), and on a cylinder the azimuth
        points = beyond * turn + 1j * wide * chord
        return points, turn * R / np.cos(off) ** 2, 1j * turn * (wide + ratio * beyond)


def cone_of(parts: SphereParts, name: str) -> Cone:
    """Return the cone that touches the sphere in the middle of the slots, or at the rollers."""
    ball = parts.ball
    polar = {"wheel": 0.5 * (ball.bottom + _wall_mouth(ball)), "crank": ball.arm}[name]
    return Cone(ball.radius_mm, polar, parts.tolerance or 0.0, parts.curves)


def _wall_mouth(ball: Ball) -> float:
    """Return the polar angle at which a slot's middle leaves the rim."""
    return math.acos(math.cos(ball.rim) / math.cos(ball.half_width))


def wheel(parts: SphereParts) -> Drawing:
    """Return the wheel's cone, cut open between two slots; x is along the first slot."""
    return _drawing(parts, _titled(parts, "wheel"), wheel_flat(parts), parts.wheel.part)


def crank(parts: SphereParts) -> Drawing:
    """Return the crank's cone: locking sectors, and the rollers where they pass through it."""
    return _drawing(parts, _titled(parts, "crank"), crank_flat(parts), parts.crank.part)


def assembly(parts: SphereParts) -> Drawing:
    """Return both laid flat, side by side; the solid is the machine at input angle 0."""
    title, left, right = titled(parts.mechanism), wheel_flat(parts), crank_flat(parts)
    # wheel and crank are 0.1 of the sphere's radius apart
    shift = 0.1 * parts.ball.radius_mm + shapes.bounds_of(left).x1 - shapes.bounds_of(right).x0
    moved = [shapes.placed(shape, (shift, 0.0)) for shape in right]
    whole = Group(title, parts.members)
    return _drawing(parts, title, [*left, *moved], whole)._replace(look=Annotations())


def _titled(parts: SphereParts, name: str) -> str:
    """Return a part's title with its cone's shape and position for the workshop."""
    cone = cone_of(parts, name)
    kind, apex = "cylinder", ""
    if abs(math.cos(cone.polar)) >= SAME_ANGLE:
        kind, apex = "cone", f", {length(abs(cone.apex_mm))} mm from its apex; sector "
        apex += f"{cone.sector_deg:.6g} deg"
    at = f"the {length(cone.radius_mm)} mm sphere {math.degrees(cone.polar):.6g} deg"
    text = f"{name}, flat: {kind} that touches {at} from the {name}'s axis{apex}"
    return titled(parts.mechanism, text)


def _drawing(parts: SphereParts, title: str, drawn: list[shapes.Shape], shells: Part) -> Drawing:
    """Return a drawing of plates of sheet, and the shells that they become."""
    inner, outer = parts.ball.span_mm
    cut = (shape for shape in drawn if shape.layer in ("WHEEL", "CRANK"))  # others are no sheet
    plates = (Member(Plate(s.layer.lower(), s.layer, s, (), 0.0, outer - inner)) for s in cut)
    return Drawing(title, tuple(drawn), solid=Group(title, tuple(plates)), shells=shells)


def wheel_flat(parts: SphereParts) -> list[shapes.Shape]:
    """Return the wheel's outline on its flat cone, and the rollers' paths."""
    ball, cone = parts.ball, cone_of(parts, "wheel")
    b, ends = ball.half_step, (_wall_mouth(ball), ball.bottom)
    outer, pitch = list[shapes.Segment](), list[shapes.Shape]()
    for k in range(ball.z):
        at = 2 * k * b
        # the edge about a slot, half-way to the adjacent slots on either side
        outer += shapes.joined(chain(*(cone.segments(arc, at) for arc in edge(ball, k))))
        path = shapes.Line(*cone.points(np.array(ends), np.array((at, at))))
        pitch.append(shapes.Contour("PITCH", (path,), closed=False))
    inner = cone.points(ball.inner, b * (2.0 * np.arange(ball.z, -1.0, -1.0) - 1.0))
    back = [cone.level(p, q, -2.0 * b) for p, q in zip(inner, inner[1:], strict=False)]
    first, last = outer[0].start, outer[-1].end
    outer += [shapes.Line(last, inner[0]), *back, shapes.Line(inner[-1], first)]
    return [shapes.closed("WHEEL", outer), *pitch]


def crank_flat(parts: SphereParts) -> list[shapes.Shape]:
    """Return locking sectors, rollers and the rollers' circle on the crank's flat cone."""
    ball, cone = parts.ball, cone_of(parts, "crank")
    drawn = list[shapes.Shape]()
    for sector, (start, end) in zip(parts.shape.crank, locked(ball), strict=True):
        drawn.append(cone.region("CRANK", sector, 0.5 * (start + end)))
    for about in ball.rollers:
        roller = Cap(place(ball.arm, about), ball.roller).region
        drawn.append(cone.region("ROLLER", roller, about))
    ends = cone.points(ball.arm, np.array((0.0, math.tau)))
    drawn.append(shapes.Contour("PITCH", (cone.level(ends[0], ends[1], math.tau),), closed=False))
    return drawn


def dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    """Yield the dimensions of the parts; for those that cannot be built, the reason."""
    return or_missing("dimensions of the shells", lambda: _dimensions(parts))


def _dimensions(parts: SphereParts) -> Iterator[Dimension | Missing]:
    ball = parts.ball
    yield from _lengths("shells'", ball.span_mm)
    yield _angle("roller's cone, half angle", ball.roller)
    yield _angle("slot, between its walls", 2.0 * ball.half_width)
    yield _angle("slot's last round, from the wheel's axis", ball.bottom)
    yield _angle("rim, from the wheel's axis", ball.rim)
    yield _angle("slotted ring's inner edge, from its axis", ball.inner)
    yield from _axle("wheel", ball.bore_mm, ball.hub_mm)
    if ball.lock:
        yield _angle("lock, from the crank's axis", ball.lock)
        yield _angle("recess, from the crank's axis", ball.recess)
        yield Dimension("locking sectors' inner radius", ball.lock_span_mm[0], "mm")
    for k, region in enumerate(parts.shape.crank, 1):
        rim, _, low, _ = region.boundary
        yield _angle(f"locking sector {k}: inner edge", math.pi - low.angle)
        start = math.atan2(rim.start[1], rim.start[0]) % math.tau
        yield _angle(f"locking sector {k}: begins", start)
        yield _angle(f"locking sector {k}: width", rim.sweep)
    yield from or_missing("arm's dimensions", lambda: _arm(parts))
    for whose in ("wheel", "crank"):
        flat, cone = f"{whose} laid flat", cone_of(parts, whose)
        yield _angle(f"{flat}: cone touches the sphere at", cone.polar)
        yield Dimension(f"{flat}: from there to its apex", abs(cone.apex_mm), "mm")
        yield Dimension(f"{flat}: sector", cone.sector_deg, "deg")


def _arm(parts: SphereParts) -> Iterator[Dimension]:
    arm, ball = parts.arm, parts.ball
    if arm is None:
        return
    yield from _lengths("arm's", ball.arm_span_mm)
    yield from _axle("arm", arm.bore.radius, arm.hub)
    yield _angle("arm's cap, from the crank's axis", arm.cap)
    yield _angle("arm's eyes, half angle", arm.eye)
    yield Dimension("pins", 2.0 * ball.pin_mm, "mm")
    yield Dimension("pins' holes in the arm", 2.0 * arm.pins[0].radius, "mm")
    for k, bolt in enumerate(arm.bolts, 1):
        x, y, z = bolt.axis
        yield Dimension(f"lock's bolt {k}: hole", 2.0 * bolt.radius, "mm")
        yield _angle(f"lock's bolt {k}: from the axis", math.acos(z))
        yield _angle(f"lock's bolt {k}: azimuth", math.atan2(y, x))


def _axle(part: str, bore: float, hub: float) -> Iterator[Dimension]:
    if bore:
        yield Dimension(f"{part}'s bore", 2.0 * bore, "mm")
    if hub > bore:
        yield Dimension(f"{part}'s hub", 2.0 * hub, "mm")


def _lengths(whose: str, span_mm: tuple[float, float]) -> Iterator[Dimension]:
    for end, radius in zip(("inner", "outer"), span_mm, strict=True):
        yield Dimension(f"{whose} {end} radius", radius, "mm")


def _angle(name: str, value: float) -> Dimension:
    return Dimension(name, math.degrees(value), "deg")
