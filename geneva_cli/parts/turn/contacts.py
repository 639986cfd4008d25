"""The points at which two outlines of lines and arcs may touch.

Two boundaries are nearest to each other at a corner of one of them, or where their normals fall
together: on an arc in the direction of the other's centre, or of the other's normal; on a line at
the foot of the perpendicular from the other's centre. Where they overlap, one of these points lies
inside: a region that is bounded by one piece of each has it between its ends, and any other has a
corner in it. So nothing is stepped over, and nothing is lost between samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.curves.distance import Polyarc

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

    Near: TypeAlias = tuple[NDArray[np.intp], NDArray[np.intp]]


def candidates(
    own: Polyarc, near: Near, other: Polyarc, origin: Array, angle: Array, reach: float
) -> tuple[NDArray[np.intp], Array]:
    """Points of ``own`` within ``reach`` of the other's origin that may touch it.

    ``other`` stands with its origin at n places, (n, 2), turned by n angles. Of the pieces of
    ``own`` those are looked at that ``near`` names, each with which of the n it is for. Which of
    the n each point is for comes first, then the points, in the frame of ``own``.
    """
    owner, piece = near
    dx, dy = own.ox[piece] - origin[owner, 0], own.oy[piece] - origin[owner, 1]
    close = dx * dx + dy * dy <= (own.size[piece] + reach) ** 2
    owner, piece = owner[close], piece[close]
    owners, points = [owner], [np.column_stack((own.x0[piece], own.y0[piece]))]
    arcs, lines = np.flatnonzero(other.arc), np.flatnonzero(~other.arc)
    c, s = np.cos(angle)[owner, None], np.sin(angle)[owner, None]
    x, y = other.cx[arcs], other.cy[arcs]
    centre = origin[owner, None, :] + np.stack((c * x - s * y, s * x + c * y), axis=2)
    x, y = other.dy[lines], -other.dx[lines]
    normal = np.stack((c * x - s * y, s * x + c * y), axis=2)

    bent = np.flatnonzero(own.arc[piece])
    middle = np.column_stack((own.cx, own.cy))[piece[bent], None, :]
    facing = np.concatenate((centre[bent] - middle, normal[bent]), axis=1)
    length = np.sqrt(facing[..., 0] ** 2 + facing[..., 1] ** 2)
    facing = facing / np.maximum(length, 1e-300)[..., None]
    i = piece[bent, None]
    along = facing[..., 0] * own.mx[i] + facing[..., 1] * own.my[i]
    for side in (1.0, -1.0):
        pair, which = np.nonzero(side * along >= own.cos_half[i])
        owners.append(owner[bent[pair]])
        radius = side * own.radius[piece[bent[pair]], None]
        points.append(middle[pair, 0] + radius * facing[pair, which])

    flat = np.flatnonzero(~own.arc[piece])
    i = piece[flat, None]
    ax, ay = centre[flat, :, 0] - own.x0[i], centre[flat, :, 1] - own.y0[i]
    share = (ax * own.dx[i] + ay * own.dy[i]) / own.square[i]
    pair, which = np.nonzero((share > 0.0) & (share < 1.0))
    t, i = share[pair, which], piece[flat[pair]]
    owners.append(owner[flat[pair]])
    points.append(np.column_stack((own.x0[i] + t * own.dx[i], own.y0[i] + t * own.dy[i])))

    which_, at = np.concatenate(owners), np.concatenate(points)
    inside = ((at - origin[which_]) ** 2).sum(axis=1) < reach * reach
    return which_[inside], at[inside]
