"""Holes for bolts: how wide they are by default, and where they lie on a circle."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.sizes.plain_sizes import half_or
from geneva_cli.spec.tables import Size


class BoltCircle(NamedTuple):
    """Holes evenly on a circle about an axis: both radii, mm, and the holes' directions."""

    radius: float
    hole: float
    turns: tuple[float, ...]

    @property
    def holes(self) -> list[Circle]:
        """The holes in a plate about the axis."""
        return [
            Circle("BORE", (self.radius * math.cos(turn), self.radius * math.sin(turn)), self.hole)
            for turn in self.turns
        ]


def bolt_radius(diameter_mm: float | None, L: float, half_width: float) -> float:
    """Return the radius of a bolt's hole in the middle of a ring that is twice ``half_width`` wide.

    By default the hole takes at most half of the ring, and its diameter is at most L/40.
    """
    return half_or(diameter_mm, min(L / 80.0, 0.5 * half_width))


def bolt_circle(
    size: Size, part: str, L: float, ring: tuple[float, float], start: float
) -> BoltCircle:
    """Return the bolts of a part, "dial" or "gear"; by default in the middle of a ring.

    ``ring`` has its inner and outer radius, and ``start`` is the first hole's direction.

    >>> bolt_circle(Size(dial_bolts=4), "dial", 100.0, (20.0, 40.0), 0.0)[:2]
    (30.0, 1.25)
    """
    values, (low, high) = vars(size), ring
    count: int = values[f"{part}_bolts"]
    radius = half_or(values[f"{part}_bolt_circle_mm"], 0.5 * (low + high))
    hole = bolt_radius(values[f"{part}_bolt_mm"], L, 0.5 * (high - low))
    return BoltCircle(radius, hole, tuple(start + math.tau * k / count for k in range(count)))
