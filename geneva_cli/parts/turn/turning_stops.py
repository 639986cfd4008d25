"""Stops of a turning wheel against rollers and crank, in closed form.

As the wheel turns, the centres of its arcs move on circles about the wheel's axis. So do the feet
of the perpendiculars to its lines. So a contact is a triangle of three known sides (``stops``).
Each triangle has two solutions; the parts approach each other in one of them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.numerics.arrays import Whole
from geneva_cli.parts.turn.contact_pieces import Lines, spans
from geneva_cli.parts.turn.pairs import Pose
from geneva_cli.parts.turn.stops import NearbyArcs, Stops
from geneva_cli.parts.turn.touch import WAYS, Touch, triangles, within

BLOCK = 1 << 15  # pairs of pieces that are computed together, so that they fit into the cache


class TurningStops(Stops):
    """Stops of one machine's wheel, which turns about the origin."""

    def __init__(
        self, outline: Polyarc, pitch: float, crank: Polyarc | None, L: float, roller: float
    ) -> None:
        super().__init__(outline, pitch, crank, L, roller)
        self.far = np.hypot(self.rounds.x, self.rounds.y)
        self.ahead = np.arctan2(self.rounds.y, self.rounds.x)
        self.excess, self.low, self.high = spans(outline, self.rounds, self.far, self.ahead)

    def _at_rounds(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        own, other = self.rounds, others.rounds
        ours, theirs = own.sense[:, None], other.sense * other.radius - close
        both = ours + other.sense
        way = np.where(both > 0.0, 1.0, -1.0)
        apart = way * (ours * own.radius[:, None] + theirs)
        nearby = self.excess[:, None] + way * theirs
        excess = np.where(way == ours, nearby, apart - self.far[:, None])
        ps, qs = np.nonzero((both >= 0.0) & (apart > 0.0))
        ds, es, hollow = apart[ps, qs], excess[ps, qs], both[ps, qs] == 0.0
        away, towards = np.hypot(others.x, others.y), np.arctan2(others.y, others.x)
        count, step = len(pose.wheel), max(1, BLOCK // max(1, len(ps)))
        for block in range(0, count, step):
            # the distance from the wheel's axis decides which pairs can touch
            sigma = away[block : block + step]
            low, high = sigma - other.radius, sigma + other.radius
            row, pair = np.nonzero((low[:, qs] <= self.high[ps]) & (high[:, qs] >= self.low[ps]))
            s, r, d = sigma[row, qs[pair]], self.far[ps[pair]], ds[pair]
            # the angle between the centres, seen from the wheel's axis
            meet, h, g = triangles(es[pair], r, s, lambda length: length)
            n, pair, s, r, d = row[meet] + block, pair[meet], s[meet], r[meet], d[meet]
            p, q, sign = ps[pair], qs[pair], np.where(hollow[pair], WAYS, -WAYS)
            angle = sign * (2.0 * np.arctan2(h, g))
            turn = towards[n, q] + angle - self.ahead[p] - pose.wheel[n]
            on, i, lead = within(turn, self.pitch, most)
            angle, sign = angle[on, i], sign[on, i]
            n, p, q, s, r, d, h, g = n[i], p[i], q[i], s[i], r[i], d[i], h[i], g[i]
            # the direction from the wheel's arc to the other, where x points to the other
            x = ((s - r) + 2.0 * r * h * h) / d
            y = -2.0 * sign * r * h * g / d
            # few of these are on the arc itself, rather than on the rest of its circle
            fits = np.flatnonzero(own.face(p, x, y, self.ahead[p] - angle, other.sense[q]))
            n, p, q, on = (which[fits] for which in (n, p, q, on))
            s, x, y, lead = (values[fits] for values in (s, x, y, lead))
            good = other.face(q, x, y, towards[n, q] - others.turn[n], -own.sense[p])
            lever = own.sense[p] * other.radius[q]
            touch = np.hypot(s - lever * x, lever * y)
            cosine = np.abs(y) * s / touch
            yield Touch((n + count * on)[good], lead[good], cosine[good]), q[good]

    def _at_lines(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        own, other = self.lines, others.rounds
        ps, qs = np.nonzero(np.broadcast_to(other.sense > 0.0, (len(own.off), len(other.sense))))
        level = own.off[ps] + other.radius[qs] - close
        away, towards = np.hypot(others.x, others.y), np.arctan2(others.y, others.x)
        count, step = len(pose.wheel), max(1, BLOCK // max(1, len(ps)))
        for block in range(0, count, step):
            sigma = away[block : block + step, qs]
            row, pair = np.nonzero(np.abs(level) <= sigma)
            n, p, q, s = row + block, ps[pair], qs[pair], sigma[row, pair]
            angle = -WAYS * np.arccos(level[pair] / s)  # from the normal to the arc's centre
            normal, along = towards[n, q] - angle, s * np.sin(angle)
            on_line = (along >= own.start[p]) & (along <= own.end[p])
            turn = normal - own.normal[p] - pose.wheel[n]
            on, i, lead = within(turn, self.pitch, most, on_line)
            n, p, q, along = n[i], p[i], q[i], along[on, i]
            good = other.face(q, -1.0 + 0.0 * lead, 0.0 * lead, normal[on, i] - others.turn[n])
            cosine = np.abs(along) / np.hypot(along, own.off[p])
            yield Touch((n + count * on)[good], lead[good], cosine[good]), q[good]

    def _at_edges(self, edges: Lines, pose: Pose, most: float, close: float) -> Iterator[Touch]:
        own, normal = self.rounds, edges.normal + pose.crank[:, None]
        # relative to the wheel's axis
        off, shift = edges.off + self.L * np.cos(normal), -self.L * np.sin(normal)
        start, end = edges.start + shift, edges.end + shift
        qs, ps = np.nonzero(np.broadcast_to(own.sense > 0.0, (len(edges.off), len(own.sense))))
        level = own.radius[ps] - close
        count, step = len(pose.wheel), max(1, BLOCK // max(1, len(ps)))
        for block in range(0, count, step):
            high = off[block : block + step, qs] + level
            row, pair = np.nonzero(np.abs(high) <= self.far[ps])
            n, p, q, r = row + block, ps[pair], qs[pair], self.far[ps[pair]]
            angle = WAYS * np.arccos(high[row, pair] / r)  # from the normal to the arc's centre
            along, turn = r * np.sin(angle), self.ahead[p] - angle
            on_line = (along >= start[n, q]) & (along <= end[n, q])
            on, i, lead = within(normal[n, q] - turn - pose.wheel[n], self.pitch, most, on_line)
            n, p = n[i], p[i]
            good = own.face(p, -1.0 + 0.0 * lead, 0.0 * lead, turn[on, i])
            yield Touch((n + count * on)[good], lead[good], 0.0 * lead[good])
