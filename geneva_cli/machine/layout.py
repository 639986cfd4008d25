"""What a machine is rebuilt from: its pivots in the fixed frame, and its dimensions by name.

The wheel's axis is the origin and the crank's lies on the x axis, as in the assembly's drawing.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias


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


Layout: TypeAlias = tuple[Pivot | Dimension, ...]
