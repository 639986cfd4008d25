"""Locking sectors without a middle: the parts of a disc that the wheel leaves free.

If the wheel reaches beyond the crank's axis, nothing is left about the axis. That holds for
internal wheels, and for some external ones.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Contour, Line, about, closed
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.reliefs import reliefs, sectors
from geneva_cli.parts.sizes import Sizes

# points of the wheel inside the disc in one motion: x and y in the crank's frame
Swept: TypeAlias = Callable[[int], tuple[Array, Array]]


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
    x, y = map(np.concatenate, zip(*map(swept, range(len(assembly.motions))), strict=True))

    def ring(start: float, end: float) -> Contour:
        middle, whole = 0.5 * (end + start), 0.5 * (end - start)
        wheel = polar_points(*towards(x, y, middle, whole), middle)

        @cache
        def arc(half: float) -> tuple[float, float]:
            return inner_arc(sizes, half, wheel, spare)

        # the least thickness of a sector is a tenth of the disc's radius
        half = widest(whole, lambda half: max(arc(half)) < 0.9 * sizes.lock)
        if half is None:
            raise GenevaError(
                "the wheel sweeps over the whole locking sector: a smaller roller, or another "
                f"lock_radius_mm than {sizes.lock:.6g}, may leave part of it; 0 omits it",
                ("size", "lock_radius_mm"),
            )
        return _ring(sizes, middle, half, *arc(half))

    return [ring(*span) for span in sectors(reliefs(assembly))]


def widest(whole: float, clears: Callable[[float], bool]) -> float | None:
    """Return half the width of the widest locking sector that clears the wheel, up to ``whole``.

    Steps are a fiftieth of ``whole``. None if none of at least a fifth of it clears the wheel.
    Narrower sectors clear the wheel where a wider one does.
    """
    if clears(whole):  # as most do
        return whole
    halves = [(1.0 - 0.02 * k) * whole for k in range(1, 40)]
    first = bisect_left(halves, True, key=clears)
    return halves[first] if first < len(halves) else None


def _ring(sizes: Sizes, middle: float, half: float, edge: float, floor: float) -> Contour:
    low, high = middle - half, middle + half
    outer = about((0.0, 0.0), sizes.lock, low, 2.0 * half)
    start = edge * math.cos(high), edge * math.sin(high)
    end = edge * math.cos(low), edge * math.sin(low)
    bulge = (edge * math.cos(half) - floor) / (edge * math.sin(half))
    return closed(
        "CRANK", [outer, Line(outer.end, start), Arc(start, end, bulge), Line(end, outer.start)]
    )


def inner_arc(sizes: Sizes, half: float, wheel: PolarPoints, more: float) -> tuple[float, float]:
    """Return the inner arc of a locking sector: its distance at the edges and in the middle."""
    inside = np.abs(wheel.direction) < half
    radius, off = wheel.radius[inside], wheel.direction[inside]
    at_edge = float(radius[np.abs(off) > half - 0.035].max(initial=0.0))  # within two degrees
    spare = min(sizes.relief, (sizes.lock - at_edge) / 3.0) + more
    edge = max(at_edge + spare, 0.01 * sizes.lock)  # no sector is pointed down to the axis
    ex, ey = edge * math.cos(half), edge * math.sin(half)
    x, y = radius * np.cos(off), radius * np.sin(off)
    off_edge = np.abs(x - ex) > SAME_LENGTH * edge
    x, y = x[off_edge], y[off_edge]
    centre = (x * x + y * y - edge * edge) / (2.0 * (x - ex))
    reach = np.copysign(np.hypot(ex - centre, ey), x - ex)
    return edge, float((centre + reach).max(initial=0.0)) + spare
