"""The full turn: a collision check of the parts through a whole turn of the crank.

At each position the wheel stands where the mechanism puts it. From there it is pushed back and on
until slot or lock stop it: that is its play. No parts may overlap, and in every dwell something
must hold the wheel. If the wheel is off by its play as the roller arrives, the roller must push it
into line and not jam.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeVar

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask
from geneva_cli.parts.turn.first_contact import FirstContact, first_contact
from geneva_cli.parts.turn.free_angles import EXACT, free_angles, search_deg
from geneva_cli.parts.turn.machine_parts import MachineParts
from geneva_cli.parts.turn.play import Play, play_of, push_deg, windows
from geneva_cli.parts.turn.smallest import Earlier, Gap, smallest_gaps

SAME = 1e-7  # of a play: its relative accuracy


class Most(NamedTuple):
    """The greatest value of an angle, degrees, and the input angle where it occurs."""

    deg: float
    at_deg: float


Place = TypeVar("Place", Gap, Most, FirstContact)


class FullTurn(NamedTuple):
    """The results of a full turn, at input angles as ``Mechanism.shown_deg`` gives them.

    ``dwell`` is the wheel's play in either direction in the middle of a dwell, where the lock holds
    it best. ``hand_over`` is the largest play while no roller is in its slot. ``motion`` is the
    largest play in both directions while a roller is in its slot; a slot that drives from one wall
    only does not count as play. ``ahead`` and ``behind`` are the largest play there in each
    direction alone. ``push`` is the largest pressure angle at which a roller pushes the wheel into
    line. ``contact`` is the first contact of a roller with a wheel at rest. A play of ``free_deg``,
    half a step, means that nothing holds the wheel.
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
    contact: FirstContact
    free_deg: float
    play: Play

    @property
    def smallest(self) -> Gap:
        """The smallest gap of all."""
        return min((g for g in (self.driving, self.idle, self.lock) if g), key=lambda g: g.mm)

    @property
    def holds(self) -> bool:
        """True if crank and rollers hold the wheel in the middle of every dwell."""
        return self.dwell.deg < self.free_deg * (1.0 - SAME)


def full_turn(parts: MachineParts, refined: bool = True) -> FullTurn:
    """Return the results of turning the parts through a whole turn of the crank.

    Without ``refined`` those of a first grid of positions: gaps are not smaller there, and plays
    not larger. Raises WorkLimit where that takes more work than ``gaps.WORK``.
    """
    parts.gaps.begin()
    earlier = _earlier(parts)
    gaps = smallest_gaps(parts, earlier, refined)
    fits = gaps.least >= -parts.close
    middles = np.array([0.5 * (w.start + w.end) for w in windows(parts) if w.rests])
    dwell = Most(0.0, 0.0)
    if len(middles):
        free = np.degrees(np.maximum(*free_angles(parts, middles, fits)))
        dwell = _most(free, middles, earlier)
    play = play_of(parts, fits, refined)

    def most_of(values: Array, where: Mask) -> Most:
        return _shown(parts, _most(values[where], play.input_deg[where], earlier))

    driving, idle, lock = gaps
    return FullTurn(
        _shown(parts, driving),
        _shown(parts, idle) if idle else None,
        _shown(parts, lock) if parts.locked else None,
        _shown(parts, dwell),
        most_of(play.either, ~play.guided),
        most_of(play.both, play.guided),
        most_of(play.on, play.guided),
        most_of(play.back, play.guided),
        _shown(parts, _most(push_deg(parts, play), play.input_deg[:-1], earlier)),
        _shown(parts, first_contact(parts)),
        search_deg(parts),
        play,
    )


def _shown(parts: MachineParts, place: Place) -> Place:
    return place._replace(at_deg=parts.assembly.shown_deg(place.at_deg))


def _earlier(parts: MachineParts) -> Earlier:
    """Return a sort key of input angles: the order in which they are shown.

    One turn of the input is shown from half a turn before mid-motion, so that the second half of
    the last dwell comes first. A period of several turns is shown from the first entry.
    """
    *_, last = windows(parts)
    turn, several = parts.assembly.turn_deg, parts.assembly.full.spec.turns > 1
    middle = 0.5 * (last.start + last.end) if last.rests and not several else last.end
    return lambda input_deg: input_deg - turn if input_deg > middle else input_deg


def _most(values: Array, at: Array, earlier: Earlier) -> Most:
    """Return the greatest value and its position; in a plateau, the middle of the first one."""
    size = float(values.max(initial=0.0))
    # a play of 1e-6 degrees is rounding
    if not size > 1e-6:
        return Most(0.0, 0.0)
    same = values >= size - max(SAME * size, math.degrees(EXACT))
    first = np.flatnonzero(same & ~np.append(False, same[:-1]))
    last = np.flatnonzero(same & ~np.append(same[1:], False))
    return Most(size, min(at[(first + last) // 2].tolist(), key=earlier))
