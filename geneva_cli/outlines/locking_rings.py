"""Locking sectors without a middle: the parts of a disc that the wheel leaves free.

If the wheel reaches beyond the crank's axis, nothing is left about the axis. That holds for
internal wheels, and for some external ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.shapes import Arc, Contour, Line, about, closed
from geneva_cli.errors import GenevaError
from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.layout.reliefs import sectors
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import CLEARLY, SAME_ANGLE, SAME_LENGTH

# Points of the wheel inside the disc in one motion, at each so many of its positions: x and y
# in the crank's frame.
Swept: TypeAlias = Callable[[int, int], tuple[Array, Array]]

LAYER = "CRANK"
EDGE = 0.035  # radians, two degrees: width of the range that counts as a sector's edge
THINNEST = 0.1  # least thickness of a locking sector, as a fraction of the disc's radius


class PolarPoints(NamedTuple):
    """Points that the wheel reaches: distances from the crank's axis, and directions.

    Directions are from -pi to pi about a reference direction.
    """

    radius: Array
    direction: Array


def towards(x: Array, y: Array, middle: float, half: float) -> tuple[Array, Array]:
    """Return the points on the crank within ``half`` of a direction, and a few next to them.

    ``half`` is at most pi. This takes less time than their directions.
    """
    along, away = x * math.cos(middle) + y * math.sin(middle), np.sqrt(x * x + y * y)
    near = np.flatnonzero(along >= (math.cos(half) - SAME_ANGLE) * away)
    return x[near], y[near]


def polar_points(x: Array, y: Array, middle: float) -> PolarPoints:
    """Return points on the crank in polar coordinates about a direction."""
    off = np.remainder(np.arctan2(y, x) - middle + math.pi, math.tau) - math.pi
    return PolarPoints(np.hypot(x, y), off)


def rings(assembly: Assembly, sizes: Sizes, swept: Swept, spare: float) -> list[Contour]:
    """Return the sectors between reliefs, each as wide as the wheel leaves it clear.

    Raises GenevaError where nothing is left of one.
    """

    @cache
    def reached(every: int) -> tuple[Array, Array]:
        x, y = zip(*(swept(i, every) for i in range(len(assembly.motions))), strict=True)
        return np.concatenate(x), np.concatenate(y)

    def ring(start: float, end: float) -> Contour:
        middle, whole = 0.5 * (end + start), 0.5 * (end - start)

        @cache
        def wheel(every: int) -> PolarPoints:
            return polar_points(*towards(*reached(every), middle, whole), middle)

        @cache
        def arc(half: float) -> tuple[float, float]:
            return inner_arc(sizes, half, wheel(1), spare)

        def clears(half: float) -> bool:
            # every 16th position shows most collisions
            if beyond(sizes, wheel(16), half) or beyond(sizes, wheel(1), half):
                return False
            return max(arc(half)) < (1.0 - THINNEST) * sizes.lock

        half = widest(whole, clears)
        if half is None:
            raise GenevaError(
                "the wheel sweeps over the whole locking sector: a smaller roller, or another "
                f"lock_radius_mm than {sizes.lock:.6g}, may leave part of it; 0 omits it",
                ("size", "lock_radius_mm"),
            )
        return _ring(sizes, middle, half, *arc(half))

    return [ring(*span) for span in sectors(assembly)]


def widest(whole: float, clears: Callable[[float], bool]) -> float | None:
    """Return half the width of the widest locking sector that clears the wheel, up to ``whole``.

    Steps are a fiftieth of ``whole``. None if none of at least a fifth of it clears the wheel.
    """
    return next((half for k in range(40) if clears(half := (1.0 - 0.02 * k) * whole)), None)


def beyond(sizes: Sizes, wheel: PolarPoints, half: float) -> bool:
    """Return True if no inner arc of a sector can clear some points of the wheel within its limit.

    Then no arc clears all of them either. On a circle about a point ahead, distances from the axis
    increase towards that direction. Suppose that an arc meets both edges within the limit, and
    passes beyond a point ahead that lies beyond the limit. Then its middle lies beyond the limit
    too. The edges are farther out than the points near them.
    """
    limit, offset = CLEARLY * (1.0 - THINNEST) * sizes.lock, np.abs(wheel.direction)
    inside = CLEARLY * offset < half
    if (wheel.radius[inside & (offset <= 0.5 * math.pi)] >= limit).any():
        return True
    at_edge = wheel.radius[inside & (offset > half - EDGE / CLEARLY)]
    return bool((at_edge + _spare(sizes, at_edge) >= limit).any())


def _spare(sizes: Sizes, at_edge: Array | float) -> Array:
    """Return the distance of the edges beyond the farthest point near them."""
    return np.minimum(sizes.relief, (sizes.lock - at_edge) / 3.0)


def _ring(sizes: Sizes, middle: float, half: float, edge: float, floor: float) -> Contour:
    low, high = middle - half, middle + half
    outer = about((0.0, 0.0), sizes.lock, low, 2.0 * half)
    start = edge * math.cos(high), edge * math.sin(high)
    end = edge * math.cos(low), edge * math.sin(low)
    bulge = (edge * math.cos(half) - floor) / (edge * math.sin(half))
    return closed(
        LAYER, [outer, Line(outer.end, start), Arc(start, end, bulge), Line(end, outer.start)]
    )


def inner_arc(sizes: Sizes, half: float, wheel: PolarPoints, more: float) -> tuple[float, float]:
    """Return the inner arc of a locking sector: its distance at the edges and in the middle.

    Directions are from the sector's middle. Through each point there is one circle that meets both
    edges where this arc does. The circle that is farthest out in the middle clears all points.
    """
    inside = np.abs(wheel.direction) < half
    radius, off = wheel.radius[inside], wheel.direction[inside]
    at_edge = float(radius[np.abs(off) > half - EDGE].max(initial=0.0))
    spare = float(_spare(sizes, at_edge)) + more
    edge = max(at_edge + spare, 0.01 * sizes.lock)  # no sector is pointed down to the axis
    ex, ey = edge * math.cos(half), edge * math.sin(half)
    x, y = radius * np.cos(off), radius * np.sin(off)
    off_edge = np.abs(x - ex) > SAME_LENGTH * edge
    x, y = x[off_edge], y[off_edge]
    centre = (x * x + y * y - edge * edge) / (2.0 * (x - ex))
    reach = np.copysign(np.hypot(ex - centre, ey), x - ex)
    return edge, float((centre + reach).max(initial=0.0)) + spare
