"""The least wall between two holes or edges of a part, and the material around a hole."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import N, larger, smaller
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.workshops import workshop

if TYPE_CHECKING:
    from geneva_cli.spec.tables import Size


def wall_min(size: Size, L: float) -> float:
    """Return the least wall that ``check`` lets pass, mm; (m, 1) for m designs."""
    return value_or(size.wall_min_mm, larger(L / 200.0, workshop(size.process).wall_mm))


def eye_about(hole: N, wall: N, most: float = math.inf) -> N:
    """Return the radius of the arm around a hole, up to ``most`` if that leaves the least wall."""
    # twice the hole, where there is space
    return larger(smaller(2.0 * hole, 0.0 * hole + most), hole + wall)
