"""Where a turning wheel on a sphere comes to touch what stands beside it, in closed form.

What lies to the left of an arc lies in a cap about its axis, and so does a roller; a corner is a
cap of no size. Caps touch where their axes are as far apart as the sum of their angles: a hollow is
the rim of a cap of more than half the sphere, so this holds for what runs in it, too. As the wheel
turns, the axes of its caps go round its own, and a stop is a spherical triangle of known sides.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.sphere_arcs import Arcs
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.turn.touch import SLACK, WAYS, Touch, triangles, within

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

WHOLE = 7.0  # radians, more than a whole turn


class Caps(NamedTuple):
    """k caps about axes (k, 3), of angles (k,), and what of their rims is an edge."""

    axis: Array
    angle: Array
    x: Array  # (k, 3), square to the axis: from there to where the edge begins,
    y: Array  # and on along the edge,
    sweep: Array  # which is so long, radians about the axis

    def edge(self, which: NDArray[np.intp], points: Array) -> NDArray[np.bool_]:
        """Whether points (n, 3) on the rims of some caps are on their edges."""
        along = (points * self.x[which]).sum(axis=1)
        aside = (points * self.y[which]).sum(axis=1)
        turn = np.remainder(np.arctan2(aside, along) + SLACK, 2.0 * np.pi)
        out: NDArray[np.bool_] = turn <= self.sweep[which] + 2.0 * SLACK
        return out


def caps(boundaries: Sequence[Arcs]) -> Caps:
    """The caps of arcs, and those of the corners where these come to a point."""
    found = []
    for one in boundaries:
        corner = np.flatnonzero(one.first > SAME_ANGLE)
        at, none = one.at(corner, np.zeros(len(corner))), np.zeros(len(corner))
        found.append(Caps(one.axis, one.angle, one.x, one.y, one.sweep))
        found.append(Caps(at, none, at, at, none + WHOLE))
    return Caps(*[np.concatenate(each) for each in zip(*found, strict=True)])


def round_cap(angle: float) -> Caps:
    """A roller's cap, wherever it is."""
    nowhere = np.zeros((1, 3))
    return Caps(nowhere, np.array([angle]), nowhere, nowhere, np.array([WHOLE]))


class WheelCaps:
    """A wheel's caps, which repeat themselves after ``pitch`` radians about z."""

    def __init__(self, edge: Arcs, pitch: float) -> None:
        self.caps, self.pitch = caps([edge]), pitch
        self.polar, self.azimuth = polar(self.caps.axis), _azimuth(self.caps.axis)

    def touches(
        self,
        others: Caps,
        axis: Array,
        own: Callable[[Array, NDArray[np.intp]], Array],
        wheel: Array,
        most: float,
        close: float,
    ) -> Touch:
        """Contacts with other caps in n poses, the wheel at angles (n,) being turned up to ``most``
        radians back and on.

        The others' axes stand at ``axis``, (n, k, 3); ``own`` takes points (m, 3) and which of the
        n each is for, to the frame that the others are given in.
        """
        apart = self.caps.angle[:, None] + others.angle - close
        ps, qs = np.nonzero((apart > 0.0) & (apart < np.pi))
        away, towards = polar(axis), _azimuth(axis)
        far, d, rho = away[:, qs], apart[ps, qs], self.polar[ps]
        (n, pair), h, g = triangles(d, rho, far, np.sin)
        p, q = ps[pair], qs[pair]
        angle = 2.0 * np.arctan2(h, g)  # between the axes, about z
        turn = towards[n, q] - WAYS * angle - self.azimuth[p]
        on, i, lead = within(turn - wheel[n], self.pitch, most)
        n, p, q, d, turn = n[i], p[i], q[i], d[pair[i]], turn[on, i]
        one, other = about(self.caps.axis[p], turn), axis[n, q]
        angle = self.caps.angle[p]
        point = np.sin(d - angle)[:, None] * one + np.sin(angle)[:, None] * other
        point /= np.sin(d)[:, None]
        good = self.caps.edge(p, about(point, -turn)) & others.edge(q, own(point, n))
        point, other = point[good], other[good]
        along = np.column_stack((-point[:, 1], point[:, 0], np.zeros(len(point))))
        normal = other - (other * point).sum(axis=1)[:, None] * point
        size = np.linalg.norm(normal, axis=1) * np.linalg.norm(along, axis=1)
        cosine = np.abs((normal * along).sum(axis=1)) / np.maximum(size, 1e-300)
        return Touch((n + len(wheel) * on)[good], lead[good], cosine)


def polar(points: Array) -> Array:
    """Angles of directions (..., 3) from z."""
    out: Array = np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])
    return out


def _azimuth(points: Array) -> Array:
    """Angles of directions (..., 3) about z, from x."""
    out: Array = np.arctan2(points[..., 1], points[..., 0])
    return out


def about(points: Array, angle: Array) -> Array:
    """Directions (n, 3), each turned about z by its own angle, radians."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = points.T
    out = np.empty(points.shape)
    out[:, 0], out[:, 1], out[:, 2] = x * c - y * s, x * s + y * c, z
    return out
