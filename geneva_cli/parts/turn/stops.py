"""What stops a wheel or rack in the plane: rollers and crank, whose outlines it meets.

Outlines consist of lines, arcs and corners. A corner is an arc of radius 0, a roller is a full
circle. Two arcs touch when the distance of their centres is the sum of their radii, or the
difference if one of them is hollow. An arc and a line touch when the centre is one radius away from
the line. So each contact is a triangle of known sides. No stop needs a search, and none is missed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.parts.turn.contact_pieces import Lines, Rounds, lines, rounds
from geneva_cli.parts.turn.pairs import Pose, Stop
from geneva_cli.parts.turn.touch import Touch, first_stops


class NearbyArcs(NamedTuple):
    """The arcs that wheel or rack may meet, in n poses: the rollers first, then the crank's."""

    rounds: Rounds
    x: Array  # (n, k), the centres
    y: Array
    turn: Array  # (n,), the crank's angle against its own frame


class Stops(ABC):
    """Stops of one machine's wheel or rack against its rollers and its crank.

    ``outline`` is that of the wheel or rack, or one sector of it that repeats after ``pitch``
    radians. The crank is in its own frame, with its axis at (L, 0). ``pairs`` is the number of
    pairs of pieces that one roller and the crank can form with the outline.
    """

    def __init__(
        self, outline: Polyarc, pitch: float, crank: Polyarc | None, L: float, roller: float
    ) -> None:
        self.pitch, self.L, self.roller = pitch, L, roller
        self.rounds, self.lines = rounds(outline), lines(outline)
        self.crank = rounds(crank) if crank else None
        self.edges = lines(crank) if crank else None
        self.pairs = (len(self.rounds.x) + len(self.lines.off)) * (1 + len(crank or ()))

    @abstractmethod
    def _at_rounds(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        """Yield contacts of arcs with arcs, and the index of the other arc of each.

        Both are convex, or one of them lies in the other's hollow.
        """

    @abstractmethod
    def _at_lines(
        self, others: NearbyArcs, pose: Pose, most: float, close: float
    ) -> Iterator[tuple[Touch, Whole]]:
        """Yield contacts of own lines with convex arcs, and the index of each arc."""

    @abstractmethod
    def _at_edges(self, edges: Lines, pose: Pose, most: float, close: float) -> Iterator[Touch]:
        """Yield contacts of own convex arcs with the crank's lines."""

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
