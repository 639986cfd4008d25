"""Pivots and dimensions that a machine can be rebuilt from, and the motion of a body in a plane."""

import math
from enum import Enum
from typing import NamedTuple, TypeAlias

from geneva_cli.numerics.arrays import Array, N, library


class Pivot(NamedTuple):
    """Position of a shaft or a joint at input angle 0, in mm."""

    name: str
    x_mm: float
    y_mm: float


class ShaftPlace(NamedTuple):
    """A shaft on the line of centres."""

    x_mm: float  # from the wheel's axis
    sense: float  # 1 if it turns counterclockwise, else -1

    @property
    def at(self) -> tuple[float, float]:
        """Its axis."""
        return self.x_mm, 0.0


class Dimension(NamedTuple):
    """A dimension by name: a length, an angle, a number, or a word."""

    name: str
    value: float | str
    unit: str = ""


class Joint(Enum):
    """The part that sits in a joint of a link."""

    SHAFT = "shaft"  # a shaft, fixed to the link or turning in it
    PIN = "pin"  # a pin on which the link turns against another link or the frame
    ROLLER = "roller"  # the roller's pin
    SLIDE = "slide"  # a pin in a block that slides along the link, outwards from its first joint
    CARRIED = "carried"  # the roller's pin, in a block that slides along the link
    NONE = "none"  # no part: only a point of the link


class Teeth(NamedTuple):
    """Places of a gear's teeth; by default all round and outside."""

    sectors: int = 1  # toothed sectors, evenly spaced
    each_deg: float = 360.0  # angle of one sector
    middle_deg: float = 0.0  # direction of the first sector's middle at input angle 0
    inside: bool = False  # True for a ring gear
    fixed: bool = False  # True if the gear is fixed to the frame

    @property
    def all_round(self) -> bool:
        """True if the sectors leave no gap."""
        return self.sectors * self.each_deg >= 360.0


class Link(NamedTuple):
    """A body between joints, in mm at input angles: a bar, or a plate with three joints."""

    name: str
    joints: tuple[tuple[Array, Array], ...]  # x and y of each, (n,) by the input angle
    kinds: tuple[Joint, ...]  # the part in each joint
    plane: int  # 1 is the first plane below the wheel's
    radius_mm: float = 0.0  # of a gear's pitch circle about its one joint
    teeth: Teeth = Teeth()


class AxisPlace(NamedTuple):
    """A wheel on a carrier, or a crank about a wheel: where it stands from the first one."""

    number: int  # from 1
    behind_deg: float  # the input's angle after which it does what the first one did
    turn: float  # radians about the fixed axis, counterclockwise
    at: tuple[float, float]  # of its axis, mm from the first wheel's


FIRST = AxisPlace(1, 0.0, 0.0, (0.0, 0.0))  # the only wheel, but on a carrier


def wheel_places(count: int, sign: float, L: float) -> tuple[AxisPlace, ...]:
    """Places of evenly spaced wheels about the axis at (L, 0); ``sign`` is -1 for internal ones."""
    out = [FIRST]
    for k in range(1, count):
        angle = math.tau * k / count
        at = 2.0 * L * math.sin(0.5 * angle) ** 2, sign * L * math.sin(angle)
        out.append(AxisPlace(k + 1, 360.0 * k / count, -sign * angle, at))
    return tuple(out)


Layout: TypeAlias = tuple[Pivot | Dimension, ...]


class PlaneMotion:
    """The motion of a body in its plane: here a wheel that turns about the origin.

    It changes one of two coordinates of a point, the place (radians; of a rack over its pinion's
    radius), and leaves the other, the level: distance from the axis, or position across the rack.
    The crank turns about (L, 0). Arrays of points are (..., 2), and angles have one axis less.
    A unit of coordinates is ``scale`` mm.
    """

    scale = 1.0

    def __init__(self, L: float) -> None:
        import numpy as np

        self.L, self.crank_axis = L, np.column_stack((L, 0.0 * L))  # (1, 2), in the fixed frame

    def into(self, points: Array, turn: Array) -> Array:
        """Return points in the frame of the body, which has moved by angles."""
        return turned_points(points, -turn)

    def level(self, points: Array) -> Array:
        """Return the coordinate of points that the motion leaves as it is."""
        x, y = points[..., 0], points[..., 1]
        return library(points).hypot(x, y)

    def place(self, points: Array) -> Array:
        """Return the coordinate of points that the motion changes, radians."""
        x, y = points[..., 0], points[..., 1]
        return library(points).atan2(y, x)

    def outwards(self, points: Array) -> Array:
        """Return directions (n, 2) out of the body at points: those in which the level rises."""
        return points

    def lever(self, level: N) -> N:
        """Return how far points at a level move a radian."""
        return level

    def half_span(self, reach: float, level: float) -> float:
        """Return half of the range of places that a disc of radius ``reach`` covers."""
        return math.asin(reach / level) if reach < level else math.pi

    def from_crank(self, points: Array, angle: Array) -> Array:
        """Return points (k, 2) of the crank in the fixed frame, at n angles: (n, k, 2)."""
        return turned_points(points, angle[..., None]) + self.crank_axis

    def in_crank(self, points: Array, angle: Array) -> Array:
        """Return points of the fixed frame in that of the crank, at angles."""
        return turned_points(points - self.crank_axis, -angle)


def turned_points(points: Array, angle: Array) -> Array:
    """Return points (..., 2), or (..., 3), each turned about the z axis by its own angle."""
    import numpy as np

    c, s, (x, y, *_) = np.cos(angle), np.sin(angle), np.moveaxis(points, -1, 0)
    out = np.empty((*np.broadcast_shapes(x.shape, c.shape), points.shape[-1]))
    out[..., 0], out[..., 1], out[..., 2:] = x * c - y * s, x * s + y * c, points[..., 2:]
    return out
