"""The pieces of outlines by which parts touch: arcs with corners, and lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.distance import Polyarc
from geneva_cli.parts.turn.touch import SLACK

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array


class Rounds(NamedTuple):
    """Arcs and corners, (k,) each."""

    x: Array  # centres
    y: Array
    radius: Array
    sense: Array  # 1 where the material is inside, -1 in a hollow
    mx: Array  # directions of the middles
    my: Array
    least: Array  # cosines of the angles from there to the ends

    def face(
        self, which: NDArray[np.intp], x: Array, y: Array, turn: Array, sense: Array | float = 1.0
    ) -> NDArray[np.bool_]:
        """Whether some arcs go through the directions (x, y), turned and ``sense`` times."""
        c, s = np.cos(turn), np.sin(turn)
        along = self.mx[which] * (x * c - y * s) + self.my[which] * (x * s + y * c)
        out: NDArray[np.bool_] = sense * along >= self.least[which]
        return out


class Lines(NamedTuple):
    """Lines, (k,) each: directions of the normals out of the material, how far off the origin the
    lines are along these, and where they start and end along themselves.
    """

    normal: Array
    off: Array
    start: Array
    end: Array


def rounds(outline: Polyarc) -> Rounds:
    """The arcs of an outline, and its corners where material comes to a point."""
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
    """The lines of an outline."""
    at = np.flatnonzero(~outline.arc)
    tx, ty = outline.dx[at] / outline.length[at], outline.dy[at] / outline.length[at]
    x, y = outline.x0[at], outline.y0[at]
    start = x * tx + y * ty
    end, spare = start + outline.length[at], SLACK * (np.abs(start) + outline.length[at])
    return Lines(np.arctan2(-tx, ty), x * ty - y * tx, start - spare, end + spare)


def reach(arcs: Rounds, far: Array, ahead: Array) -> tuple[Array, Array]:
    """The least and the greatest distance of arcs from the origin, or a little more."""
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
