"""Gear teeth as a rack cuts them, along any pitch curve: flanks, fillets, and whole round gears.

The rack's pitch line rolls on the pitch curve. Where they touch, at P, all normals of contact meet:
a point of the gear is the foot of the perpendicular from P on the rack's flank; below, it lies on
the line from P through the centre of the rounded corner. A curve is a function of its length s in
mm, counterclockwise, that returns points and unit tangents. A tooth has the sides 1, at greater s,
and -1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.geometry.measure import mirrored
from geneva_cli.geometry.shapes import ORIGIN, Point, Segment, about
from geneva_cli.numerics.arrays import Array

if TYPE_CHECKING:
    from geneva_cli.geometry.fit.arcs import Curve


Writer: TypeAlias = "Callable[[Curve, float, float], Sequence[Segment]]"  # fits pieces to a curve


class Rack(NamedTuple):
    """The rack that cuts a gear: its module, mm, and the shift of its datum from the pitch curve.

    Shift, dedendum and rounding are in modules; the profile is type A of ISO 53. A tooth of the
    rack is straight from its addendum, one module, to the rounded corner.
    """

    module: float
    shift: float = 0.0  # outwards
    angle: float = math.radians(20.0)  # pressure angle
    dedendum: float = 1.25
    rounding: float = 0.38

    @property
    def pitch(self) -> float:
        """Distance of teeth along the pitch curve."""
        return math.pi * self.module

    @property
    def half(self) -> float:
        """Half the thickness of a gear's tooth on the pitch curve."""
        return self.module * (0.25 * math.pi + self.shift * math.tan(self.angle))

    @property
    def straight(self) -> float:
        """Depth below the pitch curve at which the straight flank ends."""
        corner = self.rounding * (1.0 - math.sin(self.angle))
        return self.module * (self.dedendum - corner - self.shift)

    @property
    def corner(self) -> tuple[float, float]:
        """Centre of the rounded corner: along the pitch line from the gear's tooth; its height."""
        height = self.module * (self.rounding - self.dedendum + self.shift)
        radius = self.rounding * self.module
        return self.half - height * math.tan(self.angle) + radius / math.cos(self.angle), height

    @property
    def end(self) -> float:
        """Roll at which flank and fillet meet, from the tooth's middle."""
        return self.half + self.straight / (math.sin(self.angle) * math.cos(self.angle))

    @property
    def least_radius(self) -> float:
        """Least radius of a pitch curve without undercut: z = 2 (1 - x)/sin² for a circle."""
        return self.straight / math.sin(self.angle) ** 2

    @property
    def least_tip(self) -> float:
        """Least thickness of a tooth at its tip: DIN 3960 keeps a fifth of a module."""
        return 0.2 * self.module


def flank(pitch: Curve, rack: Rack, middle: float | Array, side: int) -> Curve:
    """Return a flank of the tooth whose middle is at a length of the pitch curve, by the roll."""
    c, n = math.cos(rack.angle), math.sin(rack.angle)

    def curve(s: Array) -> tuple[Array, Array]:
        place, along = pitch(s)
        out = right(along)
        far = ((rack.half - side * (s - middle)) * c)[:, None]
        return place + far * (side * c * along + n * out), n * along - side * c * out

    return curve


def fillet(pitch: Curve, rack: Rack, middle: float, side: int) -> Curve:
    """Return a fillet of a tooth by the roll backwards, -s, so that it runs counterclockwise."""
    (ahead, height), radius = rack.corner, rack.rounding * rack.module

    def curve(u: Array) -> tuple[Array, Array]:
        place, along = pitch(-u)
        away = (side * ahead + u + middle)[:, None] * along + height * right(along)
        normal = away / np.hypot(away[:, 0], away[:, 1])[:, None]
        return place + away + radius * normal, right(normal)

    return curve


def parallel(pitch: Curve, height: float) -> Curve:
    """Return the curve at a height above a pitch curve, outwards."""

    def curve(s: Array) -> tuple[Array, Array]:
        place, along = pitch(s)
        return place + height * right(along), along

    return curve


def right(direction: Array) -> Array:
    """Return vectors turned clockwise by a right angle."""
    return np.column_stack((direction[:, 1], -direction[:, 0]))


def involute(angle: float) -> float:
    """Return the involute function tan a - a of an angle in radians."""
    return math.tan(angle) - angle


class SpaceCorner(NamedTuple):
    """A rounded corner of a ring's space: centre and radius, mm, and where its arc touches."""

    at: Point
    radius: float
    direction: float  # of its centre, and of its end on the root circle, radians
    tangent: float  # of the base circle, to its end on the flank, mm


class RoundTeeth(NamedTuple):
    """The teeth of a round gear about the origin, or the spaces of a ring gear; mm and radians.

    They end outside at the radius ``tip``. A ring's spaces begin at ``opening``, where their
    neighbours have tips; a gear's teeth begin with the fillets that the rack leaves.
    """

    rack: Rack
    radius: float  # of the circle on which the rack rolls
    tip: float
    opening: float = 0.0

    @property
    def base(self) -> float:
        """Radius of the base circle."""
        return self.radius * math.cos(self.rack.angle)

    @property
    def root(self) -> float:
        """Radius at which the teeth begin; of a ring, its tips."""
        rack = self.rack
        return self.opening or self.radius - rack.module * (rack.dedendum - rack.shift)

    @property
    def flank_end(self) -> float:
        """Length of the base circle's tangent to the inner end of a gear's flank."""
        sine = math.sin(self.rack.angle)
        return self.radius * sine - self.rack.straight / sine

    @property
    def step(self) -> float:
        """Angle from tooth to tooth."""
        return self.rack.pitch / self.radius

    def half_angle(self, radius: float) -> float:
        """Return the angle between middle and flank of a tooth at a radius."""
        rolled = involute(self.rack.angle) - involute(math.acos(self.base / radius))
        return self.rack.half / self.radius + rolled

    def thickness(self, radius: float) -> float:
        """Return the thickness of a tooth along the circle of a radius."""
        return 2.0 * radius * self.half_angle(radius)

    def tangent(self, radius: float) -> float:
        """Return the length of the base circle's tangent to a radius."""
        return math.sqrt((radius - self.base) * (radius + self.base))

    def roll(self, tangent: float) -> float:
        """Return the roll, from the middle of a tooth, at which a tangent's length is cut."""
        beyond = tangent - self.radius * math.sin(self.rack.angle)
        return self.rack.half - beyond / math.cos(self.rack.angle)

    def one(self, write: Writer) -> list[Segment]:
        """Return a tooth, or a space of a ring, about the x axis, counterclockwise."""
        rack = self.rack

        def pitch(s: Array) -> tuple[Array, Array]:
            c, n = np.cos(s / self.radius), np.sin(s / self.radius)
            return self.radius * np.column_stack((c, n)), np.column_stack((-n, c))

        if self.opening:  # corners are arcs that touch the flank and the root circle
            assert self.space_corner
            (x, y), radius, end, touch = self.space_corner
            begin = self.half_angle(self.base) - touch / self.base + 0.5 * math.pi
            inner, outer = self.roll(self.tangent(self.opening)), self.roll(touch)
            before = [*write(flank(pitch, rack, 0.0, -1), -inner, -outer)]
            before.append(about((x, -y), radius, -begin, begin - end))
        else:
            root = write(fillet(pitch, rack, 0.0, -1), rack.corner[0], rack.end)
            last = -self.roll(self.tangent(self.tip))
            before = [*root, *write(flank(pitch, rack, 0.0, -1), -rack.end, last)]
            end = self.half_angle(self.tip)
        return [*before, about(ORIGIN, self.tip, -end, 2.0 * end), *mirrored(before)]

    def between(self) -> Segment:
        """Return the arc from a tooth about the x axis to the next."""
        from_middle = self.rack.corner[0] / self.radius
        if self.opening:
            from_middle = self.half_angle(self.opening)
        return about(ORIGIN, self.root, from_middle, self.step - 2.0 * from_middle)

    @property
    def space_corner(self) -> SpaceCorner | None:
        """The rounded corner of a ring's space; None if the space or the tooth is too narrow.

        A curve parallel to an involute is an involute of the same base circle. So the centre of a
        corner lies on one that is turned by the corner's radius over the base circle's.
        """
        radius = 0.25 * self.rack.module  # below 0.38, for which the space of a ring is too narrow
        far = self.tip - radius
        if far <= self.opening or self.step - 2.0 * self.half_angle(self.opening) <= 0.0:
            return None
        centre, touch = self.half_angle(far) - radius / self.base, self.tangent(far) + radius
        if centre <= 0.0:
            return None
        return SpaceCorner((far * math.cos(centre), far * math.sin(centre)), radius, centre, touch)


def teeth_along(
    pitch: Curve, rack: Rack, middles: Array, tip: float, write: Writer
) -> Iterator[Segment]:
    """Yield a gear with the middles of teeth at lengths of a pitch curve, and tips above it, mm."""
    (first, height), last = rack.corner, rack.end
    root = parallel(pitch, height - rack.rounding * rack.module)
    top = parallel(pitch, tip)
    ends = [zip(*_tips(pitch, rack, middles, side, tip), strict=True) for side in (-1, 1)]
    for middle, (first_tip, begin), (last_tip, end) in zip(middles.tolist(), *ends, strict=True):
        yield from write(fillet(pitch, rack, middle, -1), first - middle, last - middle)
        yield from write(flank(pitch, rack, middle, -1), middle - last, first_tip)
        yield from write(top, begin, end)
        yield from write(flank(pitch, rack, middle, 1), last_tip, middle + last)
        yield from write(fillet(pitch, rack, middle, 1), -middle - last, -middle - first)
        yield from write(root, middle + first, middle + rack.pitch - first)


def _tips(
    pitch: Curve, rack: Rack, middles: Array, side: int, tip: float
) -> tuple[list[float], list[float]]:
    """Return the rolls at which flanks end, and the lengths of the pitch curve below their tips."""
    slope = math.sin(rack.angle) * math.cos(rack.angle)
    s = middles + side * (rack.half - tip / slope)
    foot = middles.copy()
    # the height over the roll is nearly the slope of the rack's flank: a step leaves some m/R of
    # the error, so 60 steps leave rounding alone
    for _ in range(60):
        place, along = pitch(foot)
        away = flank(pitch, rack, middles, side)(s)[0] - place
        foot = foot + np.einsum("ij,ij->i", away, along)
        s = s + side * (np.einsum("ij,ij->i", away, right(along)) - tip) / slope
    return s.tolist(), foot.tolist()


def thinnest_tip(pitch: Curve, rack: Rack, middles: Array, tip: float) -> float:
    """Return the least thickness of teeth at their tips, along the pitch curve, mm."""
    (_, begins), (_, ends) = (_tips(pitch, rack, middles, side, tip) for side in (-1, 1))
    return min(end - begin for begin, end in zip(begins, ends, strict=True))


def curvatures(pitch: Curve, length: float, count: int) -> tuple[float, float]:
    """Return the least and the greatest curvature at places of a closed pitch curve, per mm."""
    s = np.linspace(0.0, length, count + 1)
    along = pitch(s)[1]
    turn = along[:-1, 0] * along[1:, 1] - along[:-1, 1] * along[1:, 0]
    bends = np.arcsin(turn) * count / length
    return float(bends.min()), float(bends.max())
