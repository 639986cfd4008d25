"""Locking sectors without a middle: of a disc what the wheel leaves free in all its motions.

Inside a wheel, and outside where it reaches beyond the crank's axis, nothing is left there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.shapes import Arc, Contour, Line, about, closed
from geneva_cli.errors import GenevaError
from geneva_cli.numerics.tolerances import CLEARLY, SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.reliefs import Relief, followed
from geneva_cli.parts.sizes import Sizes

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

    # Where the wheel comes within the disc in one motion, at every so many of the places
    # that are looked at: x and y in the crank's frame.
    Swept: TypeAlias = Callable[[int, int], tuple[Array, Array]]

LAYER = "CRANK"
EDGE = 0.035  # radians, two degrees: how far a sector's edge reaches
THIN = 0.1  # of the disc's radius: a locking sector is no thinner
POINTED = 0.01  # of the disc's radius: nearer to the axis no sector is brought to a point
SHARES = [1.0 - 0.02 * k for k in range(40)]  # of the locking angle, where not all of it clears
SOME = 16  # places of a motion, of which the first tells most of what does not clear


class Reached(NamedTuple):
    """Where the wheel comes: distances from the crank's axis, and directions from -pi to pi about
    one of them.
    """

    radius: Array
    direction: Array


def towards(x: Array, y: Array, middle: float, half: float) -> tuple[Array, Array]:
    """Of places on the crank those within ``half`` of a direction, up to pi on either side, and a
    few beside them: told in less time than their directions."""
    along, away = x * math.cos(middle) + y * math.sin(middle), np.sqrt(x * x + y * y)
    near = np.flatnonzero(along >= (math.cos(half) - SAME_ANGLE) * away)
    return x[near], y[near]


def seen(x: Array, y: Array, middle: float) -> Reached:
    """Places on the crank as they are from a direction."""
    off = np.remainder(np.arctan2(y, x) - middle + math.pi, math.tau) - math.pi
    return Reached(np.hypot(x, y), off)


def rings(
    assembly: Assembly, sizes: Sizes, around: list[Relief], swept: Swept, spare: float
) -> list[Contour]:
    """The sectors between reliefs, each as wide as it clears the wheel.

    Raises GenevaError where nothing is left of one.
    """

    def reached(every: int) -> tuple[Array, Array]:
        x, y = zip(*(swept(i, every) for i in range(len(assembly.motions))), strict=True)
        return np.concatenate(x), np.concatenate(y)

    some, all_ = reached(SOME), cache(reached)
    limit = (1.0 - THIN) * sizes.lock
    found = []
    for one, after in followed(around):
        if after - one.end <= SAME_ANGLE:
            continue
        whole, middle = 0.5 * (after - one.end), 0.5 * (after + one.end)
        few = seen(*towards(*some, middle, whole), middle)
        every = cache(lambda at=middle, half=whole: seen(*towards(*all_(1), at, half), at))
        for half in (share * whole for share in SHARES):
            if beyond(sizes, few, half) or beyond(sizes, every(), half):
                continue
            edge, floor = inner_arc(sizes, half, every(), spare)
            if max(edge, floor) < limit:
                found.append(_ring(sizes, middle, half, edge, floor))
                break
        else:
            raise GenevaError(
                "the wheel sweeps over the whole locking sector: another lock_radius_mm than "
                f"{sizes.lock:.6g}, or a smaller roller, may leave room for one; 0 leaves it out, "
                "where the wheel is held in another way",
                ("size", "lock_radius_mm"),
            )
    return found


def beyond(sizes: Sizes, wheel: Reached, half: float) -> bool:
    """Whether no inner arc of a sector clears some places of the wheel within its limit; nor does
    any that clears more of them.

    On a circle about a place ahead distances from the axis rise with the way ahead: an arc that
    meets both edges within the limit, and passes beyond a place ahead that lies beyond the limit,
    has its middle beyond it too. And the edges are farther out than places near to them.
    """
    limit, aside = CLEARLY * (1.0 - THIN) * sizes.lock, np.abs(wheel.direction)
    inside = CLEARLY * aside < half
    if (wheel.radius[inside & (aside <= 0.5 * math.pi)] >= limit).any():
        return True
    beside = wheel.radius[inside & (aside > half - EDGE / CLEARLY)]
    return bool((beside + _spare(sizes, beside) >= limit).any())


def _spare(sizes: Sizes, at_edge: Array) -> Array:
    """By how much the edges are farther out than the farthest place near to them."""
    out: Array = np.minimum(sizes.relief, (sizes.lock - at_edge) / 3.0)
    return out


def _ring(sizes: Sizes, middle: float, half: float, edge: float, floor: float) -> Contour:
    low, high = middle - half, middle + half
    outer = about((0.0, 0.0), sizes.lock, low, 2.0 * half)
    start = edge * math.cos(high), edge * math.sin(high)
    end = edge * math.cos(low), edge * math.sin(low)
    bulge = (edge * math.cos(half) - floor) / (edge * math.sin(half))
    return closed(
        LAYER, [outer, Line(outer.end, start), Arc(start, end, bulge), Line(end, outer.start)]
    )


def inner_arc(sizes: Sizes, half: float, wheel: Reached, more: float) -> tuple[float, float]:
    """The inner arc of a locking sector: its distance at the edges and in the middle.

    Directions are from the sector's middle. Through each place goes one circle that meets both
    edges where this arc does; the farthest in the middle clears.
    """
    inside = np.abs(wheel.direction) < half
    radius, off = wheel.radius[inside], wheel.direction[inside]
    at_edge = float(radius[np.abs(off) > half - EDGE].max(initial=0.0))
    spare = min(sizes.relief, (sizes.lock - at_edge) / 3.0) + more
    edge = max(at_edge + spare, POINTED * sizes.lock)
    ex, ey = edge * math.cos(half), edge * math.sin(half)
    x, y = radius * np.cos(off), radius * np.sin(off)
    aside = np.abs(x - ex) > SAME_LENGTH * edge
    x, y = x[aside], y[aside]
    centre = (x * x + y * y - edge * edge) / (2.0 * (x - ex))
    reach = np.copysign(np.hypot(ex - centre, ey), x - ex)
    return edge, float((centre + reach).max(initial=0.0)) + spare
