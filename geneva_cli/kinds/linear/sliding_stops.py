"""Stops of a sliding rack against rollers and crank, in closed form.

As the rack slides along y, the centres of its arcs keep their x. So a contact of two arcs is a
triangle with a right angle, whose other two sides are known (``stops``).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.contact_pieces import Lines
from geneva_cli.parts.turn.pairs import Pose
from geneva_cli.parts.turn.stops import NearbyArcs, Stops
from geneva_cli.parts.turn.touch import WAYS, Touch, within


class SlidingStops(Stops):
    """Stops of one machine's rack, which slides by L a radian."""

    def _at_rounds(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        own, (other, x, y, turn) = self.rounds, self._seen(others, pose)
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
        yield Touch((n + len(x) * on)[good], lead[good], np.abs(uy)[good]), q[good]

    def _at_lines(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        own, (other, x, y, turn) = self.lines, self._seen(others, pose)
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
        # a line stops the rack one way
        on, i, lead = self._within(travel[n, pair], most, ny[p] * WAYS > 0.0)
        n, p, q = n[i], p[i], q[i]
        good = other.face(q, 0.0 * lead - 1.0, 0.0 * lead, own.normal[p] - turn[n])
        yield Touch((n + len(x) * on)[good], lead[good], np.abs(ny[p])[good]), q[good]

    def _at_edges(self, edges: Lines, pose: Pose, most: float, close: float) -> Iterator[Touch]:
        own = self.rounds
        qs, ps = np.nonzero(np.broadcast_to(own.sense > 0.0, (len(edges.off), len(own.sense))))
        normal = (edges.normal + pose.crank[:, None])[:, qs]
        nx, ny = np.cos(normal), np.sin(normal)
        level = edges.off[qs] + self.L * nx + own.radius[ps] - close
        with np.errstate(divide="ignore", invalid="ignore"):
            place = (level - nx * own.x[ps]) / ny  # of the arc's centre along the travel
        along = nx * place - ny * own.x[ps] + ny * self.L
        on_line = (along >= edges.start[qs]) & (along <= edges.end[qs]) & (np.abs(ny) > 1e-9)
        n, pair = np.nonzero(on_line)
        travel = place[n, pair] - own.y[ps[pair]] - self.L * pose.wheel[n]
        on, i, lead = self._within(travel, most, ny[n, pair] * WAYS < 0.0)
        n, pair = n[i], pair[i]
        good = own.face(ps[pair], 0.0 * lead - 1.0, 0.0 * lead, normal[n, pair])
        yield Touch((n + len(pose.wheel) * on)[good], lead[good], 0.0 * lead[good])

    def _seen(self, others: NearbyArcs, pose: Pose) -> NearbyArcs:
        """Return the arcs as the rack sees them, which has moved along y."""
        return others._replace(y=others.y - self.L * pose.wheel[:, None])

    def _within(
        self, travel: Array, most: float, way: Mask | bool = True
    ) -> tuple[Whole, Whole, Array]:
        """Return contacts that the rack reaches by sliding less than ``most`` radians.

        ``way`` masks back and on, (2, n); see ``touch.within``.
        """
        return within(travel / self.L, self.pitch, most, way)
