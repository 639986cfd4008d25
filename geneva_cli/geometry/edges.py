"""The edges around the faces of a plate: sharp, chamfered at 45 degrees, or rounded.

An edge takes as much of the face as of the wall. A section at a height above the wall is the
outline at a depth inside the material (``inset``): as deep as high for a chamfer, and on a quarter
of a circle for a rounding.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.geometry.measure import GAUSS


class Edge(NamedTuple):
    """The edge of a face: its size, mm, 0 for a sharp one, and whether it is rounded."""

    size: float = 0.0
    rounded: bool = False

    @property
    def key(self) -> str:
        """The key of ``[size]`` that sets it."""
        return "edge_fillet_mm" if self.rounded else "edge_chamfer_mm"

    def at(self, fraction: float) -> tuple[float, float]:
        """Return depth and height at a fraction of the way from the wall to the face.

        >>> [round(x, 12) for x in Edge(2.0, rounded=True).at(1.0 / 3.0)]  # 30 degrees
        [0.267949192431, 1.0]
        """
        if not self.rounded:
            return self.size * fraction, self.size * fraction
        angle = 0.5 * math.pi * fraction
        # 1 - cos, without losing digits
        return 2.0 * self.size * math.sin(0.5 * angle) ** 2, self.size * math.sin(angle)

    def slope(self, fraction: float) -> tuple[float, float]:
        """Return the derivatives of depth and height by the fraction."""
        if not self.rounded:
            return self.size, self.size
        angle = 0.5 * math.pi * fraction
        speed = 0.5 * math.pi * self.size
        return speed * math.sin(angle), speed * math.cos(angle)

    def layers(self) -> Iterator[tuple[float, float]]:
        """Yield depths and thicknesses of layers that stand for the edge, at Gauss's points."""
        for node, weight in GAUSS:
            for fraction in (0.5 - 0.5 * node, 0.5 + 0.5 * node):
                yield self.at(fraction)[0], 0.5 * weight * self.slope(fraction)[1]
