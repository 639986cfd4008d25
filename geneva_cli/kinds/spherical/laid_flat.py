"""A shell of a sphere laid flat: projected from the centre on a tangent cone and unrolled.

All walls lead to the centre. So a sheet that is cut by this outline and rolled up to the cone lets
the roller pass as the shell does. On the flat sheet a point keeps the distance from the apex that
it has on the cone. The cone's sector is 2 pi cos(polar) wide; at 90 degrees it is a cylinder.
"""

from __future__ import annotations

import math
from itertools import chain
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry import fit
from geneva_cli.geometry.shapes import Arc, Contour, Layer, Line, Point, Segment, closed
from geneva_cli.geometry.sphere import Region, SphereArc, Vector
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.spec.written import length, unit


class Cone(NamedTuple):
    """The cone about z that touches the sphere all round at a polar angle, radians.

    Laid flat and seen from outside, its origin is the point of contact at azimuth 0. x points away
    from the pole, and y towards rising azimuths.

    >>> cone = Cone(100.0, math.radians(60.0))
    >>> round(cone.apex_mm, 9), round(cone.sector_deg, 9)
    (173.205080757, 180.0)
    >>> x, y = cone.point(math.radians(60.0), math.radians(180.0))
    >>> round(x, 9), round(y, 9)  # a quarter of a turn about the apex
    (-173.205080757, 173.205080757)
    """

    radius_mm: float  # of the sphere
    polar: float

    @property
    def apex_mm(self) -> float:
        """Distance from the apex to the circle of contact; negative for an apex on the far side."""
        return self.radius_mm * math.tan(self.polar)

    @property
    def sector_deg(self) -> float:
        """The angle of the whole cone, laid flat."""
        return 360.0 * abs(math.cos(self.polar))

    def point(self, polar: float, azimuth: float) -> Point:
        """Return the point of the flat cone, mm, that a point of the sphere is projected to."""
        points, _ = self._flat(*(np.array([v]) for v in (polar, azimuth, 0.0, 0.0)))
        return float(points[0, 0]), float(points[0, 1])

    def turned(self, at: Point, azimuth: float) -> Point:
        """Return a point of the flat cone after the sphere is turned about z."""
        x, y = at
        turn = azimuth * math.cos(self.polar)
        moved = self.point(self.polar, azimuth)
        c, s = math.cos(turn), math.sin(turn)
        return moved[0] + x * c - y * s, moved[1] + x * s + y * c

    def segments(
        self, arc: SphereArc, about: float, tolerance_mm: float, curves: str
    ) -> list[Segment]:
        """Return an arc of the sphere on the flat cone, as segments.

        Azimuths are unwrapped to within half a turn of ``about``. Circles about z become arcs and
        meridians lines; the rest becomes ``curves``: "arcs" or "cubics".
        """
        ends = [self._at(p, about) for p in (arc.start, arc.end)]
        # a meridian: a great circle is at 90 degrees from its axis
        if not arc.axis[2] and abs(math.cos(arc.angle)) < 1e-12:
            return [Line(*ends)]
        if not arc.axis[0] and not arc.axis[1]:
            return [self.level(ends[0], ends[1], math.copysign(arc.sweep, arc.axis[2]))]

        def curve(turn: Array) -> tuple[Array, Array]:
            (x, y, z), (dx, dy, dz) = (v.T for v in arc.at(turn))
            across = np.hypot(x, y)
            azimuth = about + np.remainder(np.arctan2(y, x) - about + math.pi, math.tau) - math.pi
            d_polar = z * (x * dx + y * dy) / across - across * dz
            d_azimuth = (x * dy - y * dx) / (across * across)
            points, rates = self._flat(np.arctan2(across, z), azimuth, d_polar, d_azimuth)
            return points, rates / np.hypot(*rates.T)[:, None]

        return [*fit.KINDS[curves](curve, 0.0, arc.sweep, tolerance_mm)]

    def level(self, start: Point, end: Point, azimuth: float) -> Segment:
        """Return the arc about the apex between two points, over an azimuth."""
        bulge = math.tan(0.25 * azimuth * math.cos(self.polar))
        return Arc(start, end, bulge) if abs(bulge) > SAME_ANGLE else Line(start, end)

    def described(self, whose: str) -> str:
        """Return a description of the cone's shape and position for the workshop."""
        polar = math.degrees(self.polar)
        sphere = f"the {length(self.radius_mm)} {unit()} sphere"
        at = f"touches {sphere} {polar:.6g} deg from the {whose}'s axis"
        if abs(math.cos(self.polar)) < SAME_ANGLE:
            return f"cylinder that {at}"
        return (
            f"cone that {at}, {length(abs(self.apex_mm))} {unit()} from its apex; sector "
            f"{self.sector_deg:.6g} deg"
        )

    def _at(self, at: Vector, about: float) -> Point:
        x, y, z = at
        azimuth = about + math.remainder(math.atan2(y, x) - about, math.tau)
        return self.point(math.atan2(math.hypot(x, y), z), azimuth)

    def _flat(
        self, polar: Array, azimuth: Array, d_polar: Array, d_azimuth: Array
    ) -> tuple[Array, Array]:
        """Return points and their derivatives, (n, 2)."""
        ratio = math.cos(self.polar)
        off = polar - self.polar
        beyond = self.radius_mm * np.tan(off)  # along the cone, from the circle of contact
        turn, wide = ratio * azimuth, self.radius_mm * math.sin(self.polar)
        c, s = np.cos(turn), np.sin(turn)
        # (1 - cos)/ratio and sin/ratio, which are 0 and the azimuth on a cylinder
        x = beyond * c - wide * azimuth * np.sin(0.5 * turn) * np.sinc(0.5 * turn / math.pi)
        y = beyond * s + wide * azimuth * np.sinc(turn / math.pi)
        along, across = self.radius_mm / np.cos(off) ** 2 * d_polar, wide + ratio * beyond
        across = across * d_azimuth
        return (
            np.column_stack((x, y)),
            np.column_stack((along * c - across * s, along * s + across * c)),
        )


def wheel_cone(ball: Ball) -> Cone:
    """Return the cone that touches the sphere in the middle of the slots' length."""
    return Cone(ball.radius_mm, 0.5 * (ball.bottom + ball.wall_mouth))


def crank_cone(ball: Ball) -> Cone:
    """Return the cone that touches the sphere at the rollers."""
    return Cone(ball.radius_mm, ball.arm)


def flat_region(
    layer: Layer,
    region: Region,
    cone: Cone,
    about: float,
    tolerance: float | None,
    curves: str,
) -> Contour:
    """Return a region laid flat, whose azimuths are within half a turn of ``about``."""
    each = (cone.segments(arc, about, tolerance or 0.0, curves) for arc in region.boundary)
    return closed(layer, chain(*each))
