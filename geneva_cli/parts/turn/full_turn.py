"""The proof that a machine turns: its parts through a whole turn of the crank.

The wheel is turned as the mechanism says, and pushed back and on from there as far as slot and
lock let it: its play. No parts may overlap, in every dwell something must hold the wheel, and
where the roller comes to a wheel that stands off by its play, it must push it into line and not
against itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from geneva_cli.parts.turn.freedom import EXACT, free_angles, search_deg
from geneva_cli.parts.turn.play import Play, no_play, plays, push_deg, windows
from geneva_cli.parts.turn.smallest import Earlier, Gap, SmallestGaps, smallest_gaps
from geneva_cli.parts.turn.turned import Turned

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

NO_PLAY = 1e-6  # degrees: a play as small as this is rounding
SAME = 1e-7  # of a play: how nearly it is known


class Most(NamedTuple):
    """The greatest of an angle, degrees, and the input angle where it is."""

    deg: float
    at_deg: float


Place = TypeVar("Place", Gap, Most)


class FullTurn(NamedTuple):
    """What a whole turn shows; input angles as ``Mechanism.shown_deg`` says.

    ``dwell`` is the wheel's play, either way, in the middle of a dwell, where the lock holds it
    best; ``hand_over`` the largest where no roller is in its slot; ``motion`` where one is, and
    both ways: a slot that drives from one wall alone is not held to be loose. There ``ahead`` and
    ``behind`` are what the wheel is free one way, whatever the other. ``push`` is the
    largest pressure angle at which a roller pushes the wheel into line. A play as large as
    ``free_deg``, half a step, is none: nothing holds the wheel.
    """

    driving: Gap
    idle: Gap | None
    lock: Gap | None
    dwell: Most
    hand_over: Most
    motion: Most
    ahead: Most
    behind: Most
    push: Most
    free_deg: float
    play: Play

    @property
    def smallest(self) -> Gap:
        """The smallest gap of all."""
        return min((g for g in (self.driving, self.idle, self.lock) if g), key=lambda g: g.mm)

    @property
    def holds(self) -> bool:
        """Whether crank and rollers hold the wheel in the middle of every dwell."""
        return self.dwell.deg < self.free_deg * (1.0 - SAME)


def full_turn(parts: Turned) -> FullTurn:
    """Turn the parts of a machine through a whole turn of its crank.

    Raises NotProved where that takes more than ``gaps.WORK``.
    """
    *_, found = turning(parts)
    return found


def turning(parts: Turned) -> Iterator[FullTurn]:
    """A full turn looked at ever closer: gaps, then plays where they are not yet the greatest, then
    all of it.

    No gap is greater, and no play smaller, in one that comes later; until the last none is told to
    push the wheel. Raises NotProved likewise.
    """
    parts.gaps.begin()
    earlier = _earlier(parts)
    for gaps in smallest_gaps(parts, earlier):
        yield _turn(parts, gaps, Most(0.0, 0.0), no_play(), earlier)
    fits = gaps.least >= -parts.close
    middles = np.array([0.5 * (w.start + w.end) for w in windows(parts) if w.rests])
    dwell = Most(0.0, 0.0)
    if len(middles):
        free = np.degrees(np.maximum(*free_angles(parts, middles, fits)))
        dwell = _most(free, middles, earlier)
    for play in plays(parts, fits):
        found = _turn(parts, gaps, dwell, play, earlier)
        yield found
    push = _most(push_deg(parts, play), play.input_deg[:-1], earlier)
    yield found._replace(push=_shown(parts, push))


def _turn(parts: Turned, gaps: SmallestGaps, dwell: Most, play: Play, earlier: Earlier) -> FullTurn:
    """What is known of a full turn by some gaps and plays."""

    def most_of(values: Array, where: NDArray[np.bool_]) -> Most:
        return _shown(parts, _most(values[where], play.input_deg[where], earlier))

    driving, idle, lock = gaps
    return FullTurn(
        _shown(parts, driving),
        _shown(parts, idle) if idle else None,
        _shown(parts, lock) if parts.crank else None,
        _shown(parts, dwell),
        most_of(play.either, ~play.guided),
        most_of(play.both, play.guided),
        most_of(play.on, play.guided),
        most_of(play.back, play.guided),
        _shown(parts, Most(0.0, 0.0)),
        search_deg(parts),
        play,
    )


def _shown(parts: Turned, found: Place) -> Place:
    return found._replace(at_deg=parts.assembly.shown_deg(found.at_deg))


def _earlier(parts: Turned) -> Earlier:
    """What tells which of two input angles of a turn is the earlier, as they are shown.

    A turn of the input is shown from half a turn before mid-motion on, so that the second half of
    the last dwell comes first; a period of several turns from the first entry.
    """
    *_, last = windows(parts)
    turn, several = parts.assembly.turn_deg, parts.assembly.given.spec.drive.turns > 1
    middle = 0.5 * (last.start + last.end) if last.rests and not several else last.end
    return lambda input_deg: input_deg - turn if input_deg > middle else input_deg


def _most(values: Array, at: Array, earlier: Earlier) -> Most:
    """The greatest and its place: the middle of the first, where it stays as great for a while."""
    size = float(values.max(initial=0.0))
    if not size > NO_PLAY:
        return Most(0.0, 0.0)
    same = values >= size - max(SAME * size, math.degrees(EXACT))
    first = np.flatnonzero(same & ~np.append(False, same[:-1]))
    last = np.flatnonzero(same & ~np.append(same[1:], False))
    return Most(size, min(at[(first + last) // 2].tolist(), key=earlier))
