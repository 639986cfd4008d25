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
    """A dimension by name: a length, an angle, a number, or a word."""

    name: str
    value: float | str
    unit: str = ""


class Joint(Enum):
    """What is in a joint of a link."""

    SHAFT = "shaft"  # a shaft, fast in the link or turning in it
    PIN = "pin"  # a pin on which it turns against another link or the frame
    ROLLER = "roller"  # the roller's pin
    SLIDE = "slide"  # a pin in a block that slides along the link, from its first joint outwards
    CARRIED = "carried"  # the roller's pin, in such a block
    NONE = "none"  # nothing: a point of the link


class Teeth(NamedTuple):
    """Where a gear has its teeth: all round, outside, unless something else is said."""

    sectors: int = 1  # evenly round it
    each_deg: float = 360.0  # how wide one is
    middle_deg: float = 0.0  # the direction of the first one's middle at input angle 0
    inside: bool = False  # of a ring
    fixed: bool = False  # to the frame


class Link(NamedTuple):
    """A body between joints, in mm at input angles: a bar, or a plate of three joints.

    ``joints`` are the x and y of each joint, arrays (n,) by the input angle, and ``kinds`` says
    what is in each. With a radius the link is the pitch circle of a gear about its one joint.
    ``plane`` is the number of the plane in which it lies: 1 is the first below the wheel's.
    """

    name: str
    joints: tuple[tuple[Array, Array], ...]
    kinds: tuple[Joint, ...]
    plane: int
    radius_mm: float = 0.0
    teeth: Teeth = Teeth()


Layout: TypeAlias = tuple[Pivot | Dimension, ...]
