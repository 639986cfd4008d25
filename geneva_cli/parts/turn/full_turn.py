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

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, Mask, scalar
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG, SAME_LENGTH
from geneva_cli.parts.turn.machine_parts import MachineParts
from geneva_cli.parts.turn.play import (
    EXACT,
    Play,
    free_angles,
    play_of,
    push_deg,
    search_deg,
    windows,
)
from geneva_cli.parts.turn.smallest import Earlier, Gap, smallest_gaps

POSITIONS = 65  # from an end of a motion to its middle, a degree or so of the input apart
# From entry to exit, of a slot's middle. Its chords are within 1e-6 of the centre distance, half of
# what counts as touching.
SAMPLES = 721


class FirstContact(NamedTuple):
    """A roller's offset from the slot's middle beyond the clearance, mm, and its input angle."""

    offset_mm: float
    at_deg: float


def first_contact(parts: MachineParts) -> FirstContact:
    """Return the first contact that is farthest off its slot's middle."""
    motions: dict[Engagement, int] = {}
    for i, (engagement, _) in enumerate(parts.assembly.motions):
        motions.setdefault(engagement, i)
    contacts = [
        _contact(parts, i, _tighter_end(parts, engagement)) for engagement, i in motions.items()
    ]
    return max(contacts, key=lambda contact: contact.offset_mm)


def _tighter_end(parts: MachineParts, engagement: Engagement) -> float:
    """Return the end of a motion that limits the rim, as in ``mouth``: -1 for entry, 1 for exit."""
    ahead = scalar(engagement.exit_reach) - scalar(engagement.entry_reach)
    farther = -1.0 if engagement.slot.offset else parts.assembly.sign
    return 1.0 if farther * ahead < -SAME_LENGTH else -1.0


def _contact(parts: MachineParts, motion: int, end: float) -> FirstContact:
    """Return the first contact of a motion's roller at entry (-1) or, in reverse, at exit (1)."""
    assembly, gaps = parts.assembly, parts.gaps
    engagement, mid = assembly.motions[motion]
    start = mid + engagement.end_deg(end)
    rest = assembly.wheel(np.array([start]))
    before = sum(len(one.engagement.passages) for one in assembly.motions[:motion])
    own = slice(before, before + len(engagement.passages))

    def margin(at: Array) -> Array:
        """Return the gaps of the motion's rollers to the wheel at rest, mm."""
        pose = gaps.pose(at)
        gap: Array = gaps.rollers(pose, rest - pose.wheel)[:, own].min(axis=1)
        return gap - parts.close

    if margin(np.array([start]))[0] <= 0.0:  # the roller is in the slot's middle there
        return FirstContact(0.0, start)
    at = np.linspace(start, mid, POSITIONS)
    meets = margin(at) <= 0.0
    first = int(np.argmax(meets)) if meets.any() else POSITIONS - 1
    x = boundary_by_sections(margin, at[first - 1], at[first])
    place = np.array([x])
    if parts.past_mouth(motion, place)[0] >= 0.0:  # a wall meets it, no corner
        return FirstContact(0.0, x)
    roller = parts.in_wheel(motion, place, rest - assembly.wheel(place))
    whole = mid + np.linspace(engagement.entry_deg, engagement.exit_deg, SAMPLES)
    middle = parts.in_wheel(motion, whole)
    off = _distance(roller[0], middle) - (parts.sizes.half_width - parts.sizes.roller)
    return FirstContact(off if off > parts.contact else 0.0, x)


def _distance(point: Array, line: Array) -> float:
    """Return the distance of a point from a line through points (n, k)."""
    start, step = line[:-1], np.diff(line, axis=0)
    # a roller that stops takes steps of no length
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    along = np.clip(((point - start) * step).sum(axis=1) / square, 0.0, 1.0)
    return float(np.linalg.norm(start + along[:, None] * step - point, axis=1).min())


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
    """Return a sort key of input angles: the order in which they are shown."""
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


BESIDE = np.geomspace(0.01, 6.0, 14)  # degrees of the input on either side of a position


def gap_about(parts: MachineParts, shown_deg: float) -> float:
    """Return the smallest gap of any two parts, mm, at positions around one input angle.

    A few positions take the place of a whole turn, in a search for a size that clears the parts.
    """
    pose = parts.gaps.pose(_about(parts, shown_deg))
    gap = float(parts.gaps.rollers(pose).min())
    return min(gap, float(parts.gaps.locking(pose).min())) if parts.locked else gap


def play_about(parts: MachineParts, shown_deg: float) -> float:
    """Return the largest play, degrees, around an input angle while no roller is in its slot."""
    at = _about(parts, shown_deg)
    free = np.ones(len(at), dtype=bool)
    for start, end, motion, rests in windows(parts):
        here = np.flatnonzero((at >= start - SAME_INPUT_DEG) & (at <= end + SAME_INPUT_DEG))
        if len(here) and not rests:
            free[here] &= parts.past_mouth(motion, at[here]) <= -SAME_INPUT_DEG * parts.assembly.L
    if not free.any():
        return 0.0
    return math.degrees(float(np.maximum(*free_angles(parts, at[free])).max()))


def _about(parts: MachineParts, shown_deg: float) -> Array:
    """Return input angles around one, within the turn that starts at the first entry."""
    start, turn = parts.assembly.start_deg, parts.assembly.turn_deg
    place = parts.assembly.place_deg(shown_deg)
    offsets: Array = place + np.concatenate((-BESIDE, [0.0], BESIDE)) - start
    return start + offsets % turn
