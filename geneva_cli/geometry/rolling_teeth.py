"""Teeth all round a closed pitch curve, as one rack cuts them that rolls along it.

The gear that rolls on the curve, with teeth of the same rack, meshes with these. Tips and roots are
parallel to the pitch curve.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.geometry.gear_teeth import Rack, Writer, fillet, flank, right
from geneva_cli.geometry.shapes import Segment
from geneva_cli.numerics.arrays import Array

if TYPE_CHECKING:
    from geneva_cli.geometry.fit.path import Curve


def teeth_along(
    pitch: Curve, rack: Rack, middles: Array, tip: float, write: Writer
) -> Iterator[Segment]:
    """Yield the outline of a gear whose teeth have their middles at lengths of its pitch curve.

    ``tip`` is the height of the teeth above the curve, mm.
    """
    (first, height), last = rack.corner, rack.end
    root = parallel(pitch, height - rack.rounding * rack.module)
    top = parallel(pitch, tip)
    ends = [_tips(pitch, rack, middles, side, tip) for side in (-1, 1)]
    for k, middle in enumerate(middles.tolist()):
        (first_tip, begin), (last_tip, end) = ((rolls[k], feet[k]) for rolls, feet in ends)
        yield from write(fillet(pitch, rack, middle, -1), first - middle, last - middle)
        yield from write(flank(pitch, rack, middle, -1), middle - last, first_tip)
        yield from write(top, begin, end)
        yield from write(flank(pitch, rack, middle, 1), last_tip, middle + last)
        yield from write(fillet(pitch, rack, middle, 1), -middle - last, -middle - first)
        yield from write(root, middle + first, middle + rack.pitch - first)


def parallel(pitch: Curve, height: float) -> Curve:
    """Return the curve at a height above a pitch curve, outwards."""

    def curve(s: Array) -> tuple[Array, Array]:
        place, along = pitch(s)
        return place + height * right(along), along

    return curve


def _tips(
    pitch: Curve, rack: Rack, middles: Array, side: int, tip: float
) -> tuple[list[float], list[float]]:
    """Return the rolls at which flanks end, and the lengths of the pitch curve below their tips."""
    slope = math.sin(rack.angle) * math.cos(rack.angle)
    s = middles + side * (rack.half - tip / slope)
    foot = middles.copy()
    # the height over the roll is nearly the slope of the rack's flank: a step leaves some m/R of
    # the error, so 60 steps leave rounding alone
    for _ in range(60):
        place, along = pitch(foot)
        away = flank(pitch, rack, middles, side)(s)[0] - place
        foot = foot + np.einsum("ij,ij->i", away, along)
        s = s + side * (np.einsum("ij,ij->i", away, right(along)) - tip) / slope
    return s.tolist(), foot.tolist()


def thinnest_tip(pitch: Curve, rack: Rack, middles: Array, tip: float) -> float:
    """Return the least thickness of teeth at their tips, along the pitch curve, mm."""
    (_, begins), (_, ends) = (_tips(pitch, rack, middles, side, tip) for side in (-1, 1))
    return min(end - begin for begin, end in zip(begins, ends, strict=True))


def curvatures(pitch: Curve, length: float, count: int) -> tuple[float, float]:
    """Return the least and the greatest curvature at places of a closed pitch curve, per mm."""
    s = np.linspace(0.0, length, count + 1)
    along = pitch(s)[1]
    turn = along[:-1, 0] * along[1:, 1] - along[:-1, 1] * along[1:, 0]
    bends = np.arcsin(turn) * count / length
    return float(bends.min()), float(bends.max())
