"""Stops of a sliding rack against roller and crank, in closed form.

As for a wheel (``collisions.stops``), outlines consist of lines, arcs and corners. As the rack
slides along y, the centres of its arcs keep their x. Two arcs touch when the distance of their
centres is the sum of their radii, or the difference if one of them is hollow: a triangle with a
right angle. An arc and a line touch when the centre is one radius away from the line.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.collisions.machine_parts import Pose, Stop
from geneva_cli.collisions.pieces import Rounds, lines, rounds
from geneva_cli.collisions.touch import WAYS, Touch, first_stops, within
from geneva_cli.curves.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Mask, Whole


class SlidingStops:
    """Stops of one machine's rack against its roller and its crank.

    ``rack`` is the part of the rack's outline that repeats after ``pitch`` radians. The rack slides
    by ``radius`` a radian, and the crank's axis is at (``radius``, 0). ``pairs`` is the number of
    pairs of pieces that one roller and the crank can form with the rack.
    """

    def __init__(
        self, rack: Polyarc, pitch: float, crank: Polyarc | None, radius: float, roller: float
    ) -> None:
        self.pitch, self.radius, self.roller = pitch, radius, roller
        self.rounds, self.lines = rounds(rack), lines(rack)
        self.crank = rounds(crank) if crank else None
        self.edges = lines(crank) if crank else None
        self.pairs = (len(self.rounds.x) + len(self.lines.off)) * (1 + len(crank or ()))

    def first(self, pose: Pose, most: float, close: float) -> tuple[Stop, Stop]:
        """Return the stops of the rack, moved back and on from n poses; see ``Stops.first``."""
        rollers = [
            touch
            for pin in np.moveaxis(pose.pins, 1, 0)
            for touch in self._against(self._roller, pin, 0.0 * pose.crank, pose, most, close)
        ]
        crank: list[Touch] = []
        if self.crank is not None:
            axis = np.tile((self.radius, 0.0), (len(pose.wheel), 1))
            crank += self._against(self.crank, axis, pose.crank, pose, most, close)
            crank.append(self._at_edges(pose, most, close))
        return first_stops(rollers, crank, len(pose.wheel), most)

    @property
    def _roller(self) -> Rounds:
        one, no = np.ones(1), np.zeros(1)
        return Rounds(no, no, self.roller * one, one, one, no, no, -one, no)

    def _against(
        self, other: Rounds, origin: Array, turn: Array, pose: Pose, most: float, close: float
    ) -> Iterator[Touch]:
        """Yield contacts with arcs whose frame is at n origins, turned by n angles."""
        c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
        x = origin[:, :1] + other.x * c - other.y * s
        y = origin[:, 1:] + other.x * s + other.y * c - self.radius * pose.wheel[:, None]
        yield self._at_rounds(other, x, y, turn, (most, close))
        yield self._at_lines(other, x, y, turn, (most, close))

    def _at_rounds(
        self, other: Rounds, x: Array, y: Array, turn: Array, limits: tuple[float, float]
    ) -> Touch:
        """Return contacts of the rack's arcs with arcs whose centres are at (n, k) points.

        Both are convex, or one of them lies in the other's hollow.
        """
        own, (most, close) = self.rounds, limits
        both = own.sense[:, None] + other.sense
        convex = np.where(both > 0.0, 1.0, -1.0)
        radii = own.sense[:, None] * own.radius[:, None] + other.sense * other.radius
        apart = convex * (radii - close)
        ps, qs = np.nonzero((both >= 0.0) & (apart > 0.0))
        d, sign = apart[ps, qs], convex[ps, qs]
        across = x[:, qs] - own.x[ps]
        n, pair = np.nonzero(np.abs(across) <= d)
        p, q, d, across = ps[pair], qs[pair], d[pair], across[n, pair]
        # along the travel from the rack's centre to the other, at the contact
        along = WAYS * sign[pair] * np.sqrt((d - across) * (d + across))
        on, i, lead = self._within(y[n, q] - own.y[p] - along, most)
        n, p, q = n[i], p[i], q[i]
        ux, uy = across[i] / d[i], along[on, i] / d[i]
        good = own.face(p, ux, uy, 0.0 * lead, other.sense[q])
        good &= other.face(q, ux, uy, -turn[n], -own.sense[p])
        return Touch((n + len(x) * on)[good], lead[good], np.abs(uy)[good])

    def _at_lines(
        self, other: Rounds, x: Array, y: Array, turn: Array, limits: tuple[float, float]
    ) -> Touch:
        """Return contacts of the rack's lines with convex arcs; a line stops the rack one way."""
        own, (most, close) = self.lines, limits
        nx, ny = np.cos(own.normal), np.sin(own.normal)
        # the rack slides along lines whose normals are across its travel, up to their rounding
        stops = np.abs(ny) > 1e-9
        p, q = np.nonzero(stops[:, None] & (other.sense > 0.0))
        level = own.off[p] + other.radius[q] - close
        travel = y[:, q] - (level - nx[p] * x[:, q]) / ny[p]
        along = nx[p] * (y[:, q] - travel) - ny[p] * x[:, q]
        on_line = (along >= own.start[p]) & (along <= own.end[p])
        n, pair = np.nonzero(on_line)
        p, q = p[pair], q[pair]
        on, i, lead = self._within(travel[n, pair], most, ny[p] * WAYS > 0.0)
        n, p, q = n[i], p[i], q[i]
        good = other.face(q, 0.0 * lead - 1.0, 0.0 * lead, own.normal[p] - turn[n])
        return Touch((n + len(x) * on)[good], lead[good], np.abs(ny[p])[good])

    def _at_edges(self, pose: Pose, most: float, close: float) -> Touch:
        """Return contacts of the rack's convex arcs with the crank's lines."""
        own, edges = self.rounds, self.edges
        assert edges is not None
        qs, ps = np.nonzero(np.broadcast_to(own.sense > 0.0, (len(edges.off), len(own.sense))))
        normal = (edges.normal + pose.crank[:, None])[:, qs]
        nx, ny = np.cos(normal), np.sin(normal)
        level = edges.off[qs] + self.radius * nx + own.radius[ps] - close
        with np.errstate(divide="ignore", invalid="ignore"):
            place = (level - nx * own.x[ps]) / ny  # of the arc's centre along the travel
        along = nx * place - ny * own.x[ps] + ny * self.radius
        on_line = (along >= edges.start[qs]) & (along <= edges.end[qs]) & (np.abs(ny) > 1e-9)
        n, pair = np.nonzero(on_line)
        travel = place[n, pair] - own.y[ps[pair]] - self.radius * pose.wheel[n]
        on, i, lead = self._within(travel, most, ny[n, pair] * WAYS < 0.0)
        n, pair = n[i], pair[i]
        good = own.face(ps[pair], 0.0 * lead - 1.0, 0.0 * lead, normal[n, pair])
        return Touch((n + len(pose.wheel) * on)[good], lead[good], 0.0 * lead[good])

    def _within(
        self, travel: Array, most: float, way: Mask | bool = True
    ) -> tuple[Whole, Whole, Array]:
        """Return contacts that the rack reaches by sliding less than ``most`` radians.

        ``way`` masks back and on, (2, n); see ``touch.within``.
        """
        return within(travel / self.radius, self.pitch, most, way)
