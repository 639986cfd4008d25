"""Stops of a turning wheel on a sphere, in closed form.

The region to the left of an arc lies in a cap about the arc's axis. A roller is a cap, and a corner
is a cap of no size. Two caps touch where the angle between their axes is the sum of their angles. A
hollow is the rim of a cap of more than half the sphere, so this also holds for parts inside it. As
the wheel turns, the axes of its caps move on circles about its own axis. So a stop is a spherical
triangle of known sides.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.sphere_arcs import SphereArcs
from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.turn.pairs import SLACK
from geneva_cli.parts.turn.touch import WAYS, Touch, triangles, within

ALL_ROUND = 7.0  # radians, more than a whole turn: the sweep of an edge without ends


class Caps(NamedTuple):
    """k caps about axes (k, 3), of angles (k,), and the part of each rim that is an edge."""

    axis: Array
    angle: Array
    x: Array  # (k, 3), normal to the axis, towards the start of the edge
    y: Array  # (k, 3), normal to both, onwards along the edge
    sweep: Array  # length of the edge, radians about the axis

    def edge(self, which: Whole, points: Array) -> Mask:
        """Return True where points (n, 3) on the rims of caps lie on their edges."""
        along = (points * self.x[which]).sum(axis=1)
        across = (points * self.y[which]).sum(axis=1)
        turn = np.remainder(np.arctan2(across, along) + SLACK, 2.0 * np.pi)
        return turn <= self.sweep[which] + 2.0 * SLACK


def caps(boundaries: Sequence[SphereArcs]) -> Caps:
    """Return the caps of arcs, and caps of the convex corners between them."""
    columns = []
    for one in boundaries:
        corner = np.flatnonzero(one.first > SAME_ANGLE)
        at, none = one.at(corner, np.zeros(len(corner))), np.zeros(len(corner))
        columns.append(Caps(one.axis, one.angle, one.x, one.y, one.sweep))
        columns.append(Caps(at, none, at, at, none + ALL_ROUND))
    return Caps(*[np.concatenate(each) for each in zip(*columns, strict=True)])


def round_cap(angle: float) -> Caps:
    """Return a roller's cap, at no position in particular."""
    nowhere = np.zeros((1, 3))
    return Caps(nowhere, np.array([angle]), nowhere, nowhere, np.array([ALL_ROUND]))


class WheelCaps:
    """A wheel's caps, which repeat after ``pitch`` radians about z."""

    def __init__(self, edge: SphereArcs, pitch: float) -> None:
        self.caps, self.pitch = caps([edge]), pitch
        self.polar, self.azimuth = polar(self.caps.axis), _azimuth(self.caps.axis)

    def touches(
        self,
        others: Caps,
        axis: Array,
        own: Callable[[Array, Whole], Array],
        wheel: Array,
        most: float,
        close: float,
    ) -> Touch:
        """Return contacts with other caps in n poses, within ``most`` radians back and on.

        ``wheel`` is the wheel's angle in each pose, (n,). The axes of the other caps are ``axis``,
        (n, k, 3). ``own`` transforms points (m, 3), each with the index of its pose, to the frame
        in which the other caps are defined.
        """
        apart = self.caps.angle[:, None] + others.angle - close
        ps, qs = np.nonzero((apart > 0.0) & (apart < np.pi))
        away, towards = polar(axis), _azimuth(axis)
        far, d, rho = away[:, qs], apart[ps, qs], self.polar[ps]
        (n, pair), h, g = triangles(d - rho, rho, far, np.sin)
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
    """Return the angles of directions (..., 3) from z."""
    return np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])


def _azimuth(points: Array) -> Array:
    """Return the angles of directions (..., 3) about z, from x."""
    return np.arctan2(points[..., 1], points[..., 0])


def about(points: Array, angle: Array) -> Array:
    """Return directions (n, 3), each turned about z by its own angle, radians."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = points.T
    out = np.empty(points.shape)
    out[:, 0], out[:, 1], out[:, 2] = x * c - y * s, x * s + y * c, z
    return out
