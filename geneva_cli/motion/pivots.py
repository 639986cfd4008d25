"""Pivots and dimensions from which a machine can be rebuilt, in the frame of the assembly."""

import math
from enum import Enum
from typing import NamedTuple, TypeAlias

from geneva_cli.numerics.arrays import Array


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
