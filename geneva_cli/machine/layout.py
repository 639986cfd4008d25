"""The pivots and dimensions from which a machine can be rebuilt.

The wheel's axis is the origin and the crank's lies on the x axis, as in the assembly's drawing.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Pivot(NamedTuple):
    """Where a shaft, or a joint, stands at input angle 0, in mm."""

    name: str
    x_mm: float
    y_mm: float


class Dimension(NamedTuple):
    """A length, an angle, a number, or a word that names a curve."""

    name: str
    value: float | str
    unit: str = ""


class Joint(Enum):
    """What is in a link's joint."""

    SHAFT = "shaft"  # one that it is fast on, or that turns in it
    PIN = "pin"  # that another link turns on, or the frame
    ROLLER = "roller"  # the roller's pin
    SLIDE = "slide"  # a pin in a block that slides along the link, from its first joint outwards
    CARRIED = "carried"  # the roller's pin, in a block that slides so
    NONE = "none"  # nothing: a place on the link


class Link(NamedTuple):
    """A body between joints, in mm at input angles: a bar, or a plate of three joints.

    ``joints`` are the x and y of each, arrays along the input angles, and ``kinds`` what is in
    them. With a radius it is a circle about its one joint: the pitch circle of a gear. ``plane``
    counts the planes in which links lie, one below the other, from 1 below the wheel's.
    """

    name: str
    joints: tuple[tuple[Array, Array], ...]
    kinds: tuple[Joint, ...]
    plane: int
    radius_mm: float = 0.0


Layout: TypeAlias = tuple[Pivot | Dimension, ...]
