"""Stops of a turning wheel against rollers and crank, in closed form.

Outlines consist of lines, arcs and corners. A corner is an arc of radius 0, a roller is a full
circle. As the wheel turns, the centres of its arcs move on circles about the wheel's axis. So do
the feet of the perpendiculars to its lines. Two arcs touch when the distance of their centres is
the sum of their radii, or the difference if one of them is hollow. An arc and a line touch when the
centre is one radius away from the line. All of these are triangles of three known sides. So no stop
needs a search, and none is missed. Each triangle has two solutions; the parts approach each other
in one of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.collisions.machine_parts import Pose, Stop
from geneva_cli.collisions.pieces import Lines, Rounds, lines, rounds, spans
from geneva_cli.collisions.touch import WAYS, Touch, first_stops, triangles, within
from geneva_cli.curves.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Whole

BLOCK = 1 << 15  # pairs of pieces that are computed together, so that they fit into the cache


class NearbyArcs(NamedTuple):
    """The arcs that the wheel may meet, in n poses: the rollers first, then the crank's arcs."""

    rounds: Rounds
    x: Array  # (n, k), the centres
    y: Array
    turn: Array  # (n,), the crank's angle against its own frame


class Stops:
    """Stops of one machine's wheel against its rollers and its crank.

    ``wheel`` is the wheel's outline, or one sector of it that repeats after ``pitch`` radians. The
    crank is in its own frame, with its axis at (L, 0). ``pairs`` is the number of pairs of pieces
    that one roller and the crank can form with the wheel.
    """

    def __init__(
        self, wheel: Polyarc, pitch: float, crank: Polyarc | None, L: float, roller: float
    ) -> None:
        self.pitch, self.L = pitch, L
        self.rounds, self.lines = rounds(wheel), lines(wheel)
        self.far = np.hypot(self.rounds.x, self.rounds.y)
        self.ahead = np.arctan2(self.rounds.y, self.rounds.x)
        self.excess, self.low, self.high = spans(wheel, self.rounds, self.far, self.ahead)
        self.roller = roller
        self.crank = rounds(crank) if crank else None
        self.edges = lines(crank) if crank else None
        self.pairs = (len(self.far) + len(self.lines.off)) * (1 + len(crank or ()))

    def first(self, pose: Pose, most: float, close: float) -> tuple[Stop, Stop]:
        """Return the stops of the wheel, turned back and turned on from n poses.

        The parts overlap by at most ``close`` mm at first, and the wheel turns until some overlap
        by more. Where nothing stops it, it turns by ``most`` radians, which is less than the pitch.
        """
        count = pose.pins.shape[1]
        others = self._nearby(pose)
        rolling: list[Touch] = []
        locking: list[Touch] = []
        for at in (self._at_rounds, self._at_lines):
            for touch, which in at(others, pose, most, close):
                rolling.append(touch.at(which < count))
                locking.append(touch.at(which >= count))
        if self.edges is not None:
            locking += self._at_edges(self.edges, pose, most, close)
        return first_stops(rolling, locking, len(pose.wheel), most)

    def _nearby(self, pose: Pose) -> NearbyArcs:
        x, y = pose.pins[..., 0], pose.pins[..., 1]
        one, no = np.ones(x.shape[1]), np.zeros(x.shape[1])
        rollers = Rounds(no, no, self.roller * one, one, one, no, no, -one, no)
        if self.crank is None:
            return NearbyArcs(rollers, x, y, 0.0 * pose.crank)
        own = self.crank
        c, s = np.cos(pose.crank)[:, None], np.sin(pose.crank)[:, None]
        x = np.concatenate((x, self.L + (own.x * c - own.y * s)), axis=1)
        y = np.concatenate((y, own.x * s + own.y * c), axis=1)
        arcs = Rounds(*[np.concatenate(both) for both in zip(rollers, own, strict=True)])
        return NearbyArcs(arcs, x, y, pose.crank)

    def _at_rounds(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        """Yield contacts of arcs with arcs, and the index of the other arc of each.

        Both are convex, or one of them lies in the other's hollow.
        """
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
            good = own.face(p, x, y, self.ahead[p] - angle, other.sense[q])
            good &= other.face(q, x, y, towards[n, q] - others.turn[n], -own.sense[p])
            lever = own.sense[p] * other.radius[q]
            touch = np.hypot(s - lever * x, lever * y)
            cosine = np.abs(y) * s / touch
            yield Touch((n + count * on)[good], lead[good], cosine[good]), q[good]

    def _at_lines(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        """Yield contacts of the wheel's lines with convex arcs, and the index of each arc."""
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
        """Yield contacts of the wheel's convex arcs with the crank's lines."""
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
