"""Pieces of outlines in the form that the contact formulas need: arcs, corners and lines."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.pairs import SLACK


class Rounds(NamedTuple):
    """Arcs and corners, an array (k,) of each quantity."""

    x: Array  # centres
    y: Array
    radius: Array
    sense: Array  # 1 where the material is inside, -1 in a hollow
    mx: Array  # directions to the middles of the arcs
    my: Array
    sin_half: Array  # of the angles of the arcs
    cos_half: Array
    slack: Array  # radians by which an arc is longer at each end

    def face(
        self, which: Whole, x: Array, y: Array, turn: Array, sense: Array | float = 1.0
    ) -> Mask:
        """Return True where arcs contain directions (x, y), turned by ``turn``, times ``sense``."""
        c, s = np.cos(turn), np.sin(turn)
        x, y = x * c - y * s, x * s + y * c
        mx, my = self.mx[which], self.my[which]
        # the sine of the angle to the nearer end: cosines do not show angles of a millionth
        ahead, aside = sense * (mx * x + my * y), np.abs(mx * y - my * x)
        within = self.sin_half[which] * ahead - self.cos_half[which] * aside
        return within >= -self.slack[which]


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
    zero = np.zeros(len(corner))
    size = np.hypot(outline.ox, outline.oy) + outline.length
    # a direction, a sum of some angles, is rounded by 4e-15 radians
    slack = SLACK * np.minimum(1.0, size[arc] / outline.radius[arc]) + 4e-15
    columns = (
        (outline.cx[arc], outline.x0[corner]),
        (outline.cy[arc], outline.y0[corner]),
        (outline.radius[arc], zero),
        (outline.sense[arc], zero + 1.0),
        (outline.mx[arc], zero + 1.0),
        (outline.my[arc], zero),
        (outline.sin_half[arc], zero),
        (outline.cos_half[arc], zero - 1.0),
        (slack, zero),
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


def spans(outline: Polyarc, arcs: Rounds, far: Array, ahead: Array) -> tuple[Array, Array, Array]:
    """Return how far each arc's radius exceeds its centre's distance ``far`` from the origin.

    ``arcs`` are the outline's own, with centres in the directions ``ahead``. Also returns their
    least and greatest distance from the origin, with a small margin.
    """
    arc, corner = np.flatnonzero(outline.arc), np.flatnonzero(outline.turn_start > 0.0)
    side = outline.distances(np.zeros(1), np.zeros(1)).side
    excess = np.concatenate((outline.sense[arc] * side[arc], -far[len(arc) :]))
    start, end = np.hypot(outline.x0, outline.y0), np.hypot(outline.x1, outline.y1)
    nearer, farther = np.minimum(start, end), np.maximum(start, end)
    every, zero = np.arange(len(far)), np.zeros(len(far))
    inner = arcs.face(every, zero - 1.0, zero, ahead)
    outer = arcs.face(every, zero + 1.0, zero, ahead)
    low = np.where(inner, np.abs(excess), np.concatenate((nearer[arc], start[corner])))
    high = np.where(outer, far + arcs.radius, np.concatenate((farther[arc], start[corner])))
    spare = SLACK * high
    return excess, low - spare, high + spare
