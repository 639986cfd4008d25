"""Pieces of outlines in the form that the contact formulas need: arcs, corners and lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.collisions.touch import SLACK
from geneva_cli.curves.distance import Polyarc

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array


class Rounds(NamedTuple):
    """Arcs and corners, an array (k,) of each quantity."""

    x: Array  # centres
    y: Array
    radius: Array
    sense: Array  # 1 where the material is inside, -1 in a hollow
    mx: Array  # directions to the middles of the arcs
    my: Array
    least: Array  # cosines of half the angles of the arcs

    def face(
        self, which: NDArray[np.intp], x: Array, y: Array, turn: Array, sense: Array | float = 1.0
    ) -> NDArray[np.bool_]:
        """Return True where arcs contain directions (x, y), turned by ``turn``, times ``sense``."""
        c, s = np.cos(turn), np.sin(turn)
        along = self.mx[which] * (x * c - y * s) + self.my[which] * (x * s + y * c)
        out: NDArray[np.bool_] = sense * along >= self.least[which]
        return out


class Lines(NamedTuple):
    """Lines, an array (k,) of each quantity.

    ``normal`` is the direction out of the material, ``off`` the distance from the origin along it;
    ``start`` and ``end`` are positions along the line.
    """

    normal: Array
    off: Array
    start: Array
    end: Array


def rounds(outline: Polyarc) -> Rounds:
    """Return the arcs of an outline, and those of its corners that are convex."""
    arc, corner = np.flatnonzero(outline.arc), np.flatnonzero(outline.turn_start > 0.0)
    zero, cos = np.zeros(len(corner)), outline.cos_half[arc]
    least = cos - SLACK * np.sqrt(np.maximum(1.0 - cos * cos, 0.0)) - SLACK * SLACK
    columns = (
        (outline.cx[arc], outline.x0[corner]),
        (outline.cy[arc], outline.y0[corner]),
        (outline.radius[arc], zero),
        (outline.sense[arc], zero + 1.0),
        (outline.mx[arc], zero + 1.0),
        (outline.my[arc], zero),
        (least, zero - 2.0),
    )
    return Rounds(*[np.concatenate(both) for both in columns])


def lines(outline: Polyarc) -> Lines:
    """Return the lines of an outline."""
    at = np.flatnonzero(~outline.arc)
    tx, ty = outline.dx[at] / outline.length[at], outline.dy[at] / outline.length[at]
    x, y = outline.x0[at], outline.y0[at]
    start = x * tx + y * ty
    end, spare = start + outline.length[at], SLACK * (np.abs(start) + outline.length[at])
    return Lines(np.arctan2(-tx, ty), x * ty - y * tx, start - spare, end + spare)


def reach(arcs: Rounds, far: Array, ahead: Array) -> tuple[Array, Array]:
    """Return the least and greatest distance of arcs from the origin, with a small margin."""
    every, zero = np.arange(len(far)), np.zeros(len(far))
    half = np.arccos(np.clip(arcs.least, -1.0, 1.0))
    middle = np.arctan2(arcs.my, arcs.mx)
    ends = [
        np.hypot(arcs.x + arcs.radius * np.cos(end), arcs.y + arcs.radius * np.sin(end))
        for end in (middle - half, middle + half)
    ]
    inner = arcs.face(every, zero - 1.0, zero, ahead)
    outer = arcs.face(every, zero + 1.0, zero, ahead)
    low = np.where(inner, np.abs(far - arcs.radius), np.minimum(*ends))
    high = np.where(outer, far + arcs.radius, np.maximum(*ends))
    spare = SLACK * (far + arcs.radius)
    return low - spare, high + spare
