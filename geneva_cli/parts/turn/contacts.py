"""The points at which two outlines of lines and arcs may touch, and an index of places nearby.

Two boundaries are nearest to each other at a corner of one of them, or where their normals
coincide. On an arc that is in the direction of the other arc's centre, or of the other line's
normal. On a line it is at the foot of the perpendicular from the other arc's centre. If the
outlines overlap, one of these points lies inside the other outline. If one piece of each bounds the
overlap, the point is between the ends of the pieces; any other overlap has a corner in it. So no
contact between two samples is missed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TypeAlias

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Whole

Near: TypeAlias = tuple[Whole, Whole]


def candidates(
    own: Polyarc, near: Near, other: Polyarc, origin: Array, angle: Array, reach: float
) -> tuple[Whole, Array]:
    """Return points of ``own`` that may touch ``other``, within ``reach`` of its origin.

    ``other`` is placed with its origin at n points, (n, 2), and turned by n angles. ``near``
    selects pieces of ``own``, each with the index of the position that it belongs to. Returns the
    index of the position of each point, and the points in the frame of ``own``.
    """
    owner, piece = near
    dx, dy = own.ox[piece] - origin[owner, 0], own.oy[piece] - origin[owner, 1]
    close = dx * dx + dy * dy <= (own.size[piece] + reach) ** 2
    near = owner, piece = owner[close], piece[close]
    c, s = np.cos(angle)[owner], np.sin(angle)[owner]
    # one row for each of the other's pieces, which are few
    arcs, lines = np.flatnonzero(other.arc)[:, None], np.flatnonzero(~other.arc)[:, None]
    x, y = other.cx[arcs], other.cy[arcs]
    centres = origin[owner, 0] + (c * x - s * y), origin[owner, 1] + (s * x + c * y)
    x, y = other.dy[lines], -other.dx[lines]
    normals = c * x - s * y, s * x + c * y
    columns = [
        (owner, own.x0[piece], own.y0[piece]),
        *_on_arcs(own, near, centres, normals),
        _on_lines(own, near, centres),
    ]
    owner, x, y = (np.concatenate(each) for each in zip(*columns, strict=True))
    inside = (x - origin[owner, 0]) ** 2 + (y - origin[owner, 1]) ** 2 < reach * reach
    return owner[inside], np.column_stack((x[inside], y[inside]))


def _on_arcs(
    own: Polyarc, near: Near, centres: tuple[Array, Array], normals: tuple[Array, Array]
) -> Iterator[tuple[Whole, Array, Array]]:
    """Yield points of arcs in the directions of centres and normals, (k, pieces) each."""
    owner, piece = near
    bent = np.flatnonzero(own.arc[piece])
    i = piece[bent]
    mx, my, half, bend = own.mx[i], own.my[i], 0.5 * own.length[i], 1.0 / own.radius[i]
    px, py = centres[0][:, bent] - own.ox[i], centres[1][:, bent] - own.oy[i]
    nx, ny = normals[0][:, bent], normals[1][:, bent]
    aside = np.concatenate((bend * (mx * py - my * px), mx * ny - my * nx))
    ahead = np.concatenate((bend * (mx * px + my * py) + own.cos_half[i], mx * nx + my * ny))
    size = np.maximum(np.sqrt(aside * aside + ahead * ahead), 1e-300)
    aside, ahead = aside / size, ahead / size
    for side in (1.0, -1.0):
        within = side * own.sin_half[i] * ahead >= own.cos_half[i] * np.abs(aside)
        which, pair = np.nonzero(within)
        k = i[pair]
        along = side * own.radius[k] * aside[which, pair]
        # the arc's height above its chord there: its middle's, less that by which it falls off
        falls = along**2 / (1.0 + side * ahead[which, pair])
        out = bend[pair] * (half[pair] ** 2 / (1.0 + own.cos_half[k]) - falls)
        x = own.ox[k] + out * own.mx[k] - along * own.my[k]
        y = own.oy[k] + out * own.my[k] + along * own.mx[k]
        yield owner[bent[pair]], x, y


def _on_lines(own: Polyarc, near: Near, centres: tuple[Array, Array]) -> tuple[Whole, Array, Array]:
    """Return the feet of perpendiculars from centres, (k, pieces), on lines."""
    owner, piece = near
    flat = np.flatnonzero(~own.arc[piece])
    i = piece[flat]
    ax, ay = centres[0][:, flat] - own.x0[i], centres[1][:, flat] - own.y0[i]
    fraction = (ax * own.dx[i] + ay * own.dy[i]) / own.square[i]
    which, pair = np.nonzero((fraction > 0.0) & (fraction < 1.0))
    t, i = fraction[which, pair], i[pair]
    return owner[flat[pair]], own.x0[i] + t * own.dx[i], own.y0[i] + t * own.dy[i]


def places_within(place: Array, period: float, middle: Array, half: float) -> tuple[Whole, Whole]:
    """Return the places (k,) within ``half`` radians on either side of each of n middles.

    Returns the index of the middle that each belongs to, ascending, and its own. With a finite
    ``period``, a whole turn, places are directions.

    >>> there = np.array([0.0, 3.1, -3.1])
    >>> owner, which = places_within(there, math.tau, np.array([0.1, 3.14]), 0.2)
    >>> owner.tolist(), which.tolist()
    ([0, 1, 1], [0, 1, 2])
    """
    if math.isfinite(period):
        ahead, away = (np.array((np.cos(x), np.sin(x))) for x in (middle, place))
        # 1e-12 is more than the rounding of a cosine
        owner, which = np.nonzero(ahead.T @ away >= math.cos(min(half, math.pi)) - 1e-12)
    else:
        owner, which = np.nonzero(np.abs(place - middle[:, None]) <= half)
    return owner, which
