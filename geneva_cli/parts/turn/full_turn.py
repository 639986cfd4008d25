"""The full turn: a collision check of the parts through a whole turn of the crank.

No parts may overlap, and in every dwell something must hold the wheel. From its place in the ideal
motion the wheel is pushed back and on until slot or lock stop it: that is its play. If it is off by
that as the roller arrives, the roller must push it into line and not jam.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, rising, scalar
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG, SAME_LENGTH
from geneva_cli.parts.turn.pairs import TurnedParts, WorkLimit
from geneva_cli.parts.turn.play import (
    EXACT,
    Play,
    free_angles,
    play_of,
    push_deg,
    search_deg,
    windows,
)

POSITIONS = 10_000  # at most: about 0.1 s of the parts alone; a turn that needs more is not proved
DIP = 1e-9  # mm: gaps that differ by less count as equal
FINER = 9  # positions in each refinement of a smallest gap
SAME = 1e-7  # of a play: its relative accuracy

Earlier: TypeAlias = Callable[[float], float]


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and its position."""

    mm: float
    at_deg: float  # input angle
    parts: str


class FirstContact(NamedTuple):
    """A roller's offset from the slot's middle beyond the clearance, mm, and its input angle."""

    offset_mm: float
    at_deg: float


class Most(NamedTuple):
    """The greatest value of an angle, degrees, and the input angle where it occurs."""

    deg: float
    at_deg: float


Place = TypeVar("Place", Gap, Most, FirstContact)


class FullTurn(NamedTuple):
    """The results of a full turn, at input angles as ``Mechanism.shown_deg`` gives them.

    ``driving``, ``idle`` and ``lock`` are the smallest gaps of driving rollers, of idle ones and of
    the locking disc. ``dwell`` is the wheel's play in either direction in the middle of a dwell,
    where the lock holds it best. ``hand_over`` is the largest play while no roller is in its slot.
    ``motion`` is the largest play in both directions while a roller is in its slot; a slot that
    drives from one wall only does not count as play. ``ahead`` and ``behind`` are the largest play
    there in each direction alone. ``push`` is the largest pressure angle at which a roller pushes
    the wheel into line. ``contact`` is the first contact of a roller with a wheel at rest. A play
    of ``free_deg``, half a step, means that nothing holds the wheel.
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


def full_turn(parts: TurnedParts) -> FullTurn:
    """Return the results of a whole turn of the crank; raises WorkLimit beyond ``POSITIONS``."""
    # One turn of the input is shown from half a turn before mid-motion, so that the second half of
    # the last dwell comes first. A period of several turns is shown from the first entry.
    assembly, every = parts.assembly, [*windows(parts)]
    several, last = assembly.full.spec.turns > 1, every[-1]
    middle = 0.5 * (last.start + last.end) if last.rests and not several else last.end

    def earlier(input_deg: float) -> float:
        return input_deg - assembly.turn_deg if input_deg > middle else input_deg

    def shown(place: Place) -> Place:
        return place._replace(at_deg=assembly.shown_deg(place.at_deg))

    gaps = _smallest_gaps(parts, earlier)
    fits = min(gap.mm for gap in gaps if gap) >= -parts.close
    middles, dwell = np.array([0.5 * (w.start + w.end) for w in every if w.rests]), Most(0.0, 0.0)
    if len(middles):
        free = np.degrees(np.maximum(*free_angles(parts, middles, fits)))
        dwell = _most(free, middles, earlier)
    play = play_of(parts, fits)
    # of each kind of motion, the first contact that is farthest off its slot's middle
    kinds = {engagement: i for i, (engagement, _) in reversed([*enumerate(assembly.motions)])}
    contacts = [_contact(parts, i) for i in sorted(kinds.values())]

    def most_of(values: Array, where: Mask) -> Most:
        return shown(_most(values[where], play.input_deg[where], earlier))

    driving, idle, lock = gaps
    return FullTurn(
        shown(driving),
        shown(idle) if idle else None,
        shown(lock) if parts.locked else None,
        shown(dwell),
        most_of(play.either, ~play.guided),
        most_of(play.both, play.guided),
        most_of(play.on, play.guided),
        most_of(play.back, play.guided),
        shown(_most(push_deg(parts, play), play.input_deg[:-1], earlier)),
        shown(max(contacts, key=lambda one: one.offset_mm)),
        search_deg(parts),
        play,
    )


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


def _smallest_gaps(parts: TurnedParts, earlier: Earlier) -> tuple[Gap, Gap | None, Gap]:
    """Return the smallest gaps of driving rollers, of idle ones if there are any, of the lock."""
    gaps, assembly, sizes = parts.gaps, parts.assembly, parts.sizes
    # positions so dense that parts move a quarter of the thinnest feature between two
    grid = np.linspace(assembly.start_deg, assembly.start_deg + assembly.turn_deg, 721)
    crank, wheel = np.unwrap(assembly.crank(grid)), assembly.wheel(grid)
    travel = sizes.arm * np.abs(np.diff(crank)) + parts.rim_lever * np.abs(np.diff(wheel))
    total = np.concatenate(([0.0], np.cumsum(travel)))
    count = math.ceil(total[-1] / (min(sizes.roller, max(sizes.horn, 0.2 * sizes.roller)) * 0.25))
    if count > POSITIONS:
        raise WorkLimit(
            f"the full turn is not proved: it takes {count:,} positions, more than {POSITIONS:,}; "
            "a larger roller or horn takes fewer"
        )
    even = np.interp(np.linspace(0.0, total[-1], count + 1), total, grid)
    # A rim that is too large collides for less than a degree about entry and exit.
    ends = np.array([b + e for s, b in assembly.motions for e in (s.entry_deg, s.exit_deg)])
    offsets = np.geomspace(0.01, 15.0, 24)  # degrees of the input, on either side
    near = (ends[:, None] + np.concatenate((-offsets, [0.0], offsets))).ravel()
    near = assembly.start_deg + (near - assembly.start_deg) % assembly.turn_deg
    at = rising(np.concatenate((even, near)))

    def rollers(x: Array, idle: bool) -> Array:
        """Return the gaps of the rollers that move the wheel at input angles, or of the others."""
        columns = []
        for engagement, behind in assembly.rollers:
            away = assembly.from_mid(x, behind)
            since, until = away - engagement.entry_deg, engagement.exit_deg - away
            columns.append(np.minimum(since, until) >= -SAME_INPUT_DEG)
        driving = np.column_stack(columns)
        meanwhile = driving.any(axis=1, keepdims=True) & ~driving
        return np.where(meanwhile == idle, gaps.rollers(gaps.pose(x)), np.inf).min(axis=1)

    def least(gap: Callable[[Array], Array], names: str) -> Gap:
        return _least(gap, at, parts.close, earlier)._replace(parts=names)

    idle = None
    if len(assembly.rollers) > 1:
        idle = least(lambda x: rollers(x, True), "idle roller and wheel")
    return (
        least(lambda x: rollers(x, False), "roller and slot"),
        idle,
        least(lambda x: gaps.locking(gaps.pose(x)), "locking disc and wheel"),
    )


def _least(gap: Callable[[Array], Array], at: Array, close: float, earlier: Earlier) -> Gap:
    """Return the smallest gap at the positions ``at``, refined around each local minimum."""
    values = gap(at)
    here, before, after = values[1:-1], values[:-2], values[2:]
    dips = (here < before - DIP) & (here <= after) | (here <= before) & (here < after - DIP)
    top = 1 + np.flatnonzero(dips)
    # A smaller gap can only lie between positions whose gaps are already near to the smallest.
    top = top[np.argsort(values[top])][:12]
    low, high, row = at[top - 1], at[top + 1], np.arange(len(top))
    size, places = float(values.min()), []
    for _ in range(6 if len(top) else 0):
        x = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
        v = gap(x.ravel()).reshape(x.shape)
        i = np.argmin(v, axis=1)
        size = min(size, float(v.min()))
        finest, places = v[row, i], x[row, i]
        low, high = x[row, np.maximum(i - 1, 0)], x[row, np.minimum(i + 1, FINER - 1)]
    # Where a gap stays equal for a while, its position is the first one.
    same = values <= size + close
    first = at[same & ~np.append(False, same[:-1])].tolist()
    if len(top):
        first += places[finest <= size + close].tolist()
    return Gap(size, min(first, key=earlier), "")


def _contact(parts: TurnedParts, motion: int) -> FirstContact:
    """Return the first contact of a motion's roller, at entry or, in reverse, at exit.

    It is at the end where the roller comes nearer to the rim's inside.
    """
    assembly, gaps = parts.assembly, parts.gaps
    engagement, mid = assembly.motions[motion]
    ends = engagement.exit_deg, engagement.entry_deg
    ahead = scalar(engagement.reach(ends[0])) - scalar(engagement.reach(ends[1]))
    # the mouth of an offset slot has a corner for each end, and the rim is at the farther one
    farther = -1.0 if engagement.slot.offset else assembly.sign
    start = mid + engagement.end_deg(1.0 if farther * ahead < -SAME_LENGTH else -1.0)
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
    at = np.linspace(start, mid, 65)  # a degree or so of the input apart
    meets = margin(at) <= 0.0
    first = int(np.argmax(meets)) if meets.any() else len(at) - 1
    x = boundary_by_sections(margin, at[first - 1], at[first])
    place = np.array([x])
    if parts.past_mouth(motion, place)[0] >= 0.0:  # a wall meets it, no corner
        return FirstContact(0.0, x)
    roller = parts.in_wheel(motion, place, rest - assembly.wheel(place))
    # 720 chords are within 1e-6 of the centre distance, half of what counts as touching
    whole = mid + np.linspace(engagement.entry_deg, engagement.exit_deg, 721)
    line = parts.in_wheel(motion, whole)
    begins, step = line[:-1], np.diff(line, axis=0)
    # a roller that stops takes steps of no length
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    along = np.clip(((roller[0] - begins) * step).sum(axis=1) / square, 0.0, 1.0)
    off = float(np.linalg.norm(begins + along[:, None] * step - roller[0], axis=1).min())
    off -= parts.sizes.half_width - parts.sizes.roller
    return FirstContact(off if off > parts.contact else 0.0, x)
