"""The full turn: a collision check of the parts through a whole turn of the crank.

From its place in the ideal motion the wheel is pushed back and on until slot or lock stop it: that
is its play. If it is off by that as the roller arrives, the roller must push it into line.
"""

import math
from collections.abc import Callable
from functools import partial
from operator import attrgetter, itemgetter
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import Array, rising
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG, SAME_LENGTH
from geneva_cli.parts.turn.turned_parts import TurnedParts, play_of, wheel_stops, windows

POSITIONS = 10_000  # at most: about 0.1 s of the parts alone; a turn that needs more is not proved
DIP = 1e-9  # mm: gaps that differ by less count as equal
FINER = 9  # positions in each refinement of a smallest gap
EXACT = 1e-10  # radians: smaller angles are rounding
SAME = 1e-7  # of a play: its relative accuracy
DRIVING, IDLE, LOCK = "roller and slot", "idle roller and wheel", "locking disc and wheel"

First: TypeAlias = Callable[[Array], float]  # the earliest of some input angles, as it is shown


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and its position."""

    mm: float
    at_deg: float  # input angle
    parts: str


class Most(NamedTuple):
    """The greatest value of an angle, degrees, and the input angle where it occurs."""

    deg: float
    at_deg: float


class FullTurn(NamedTuple):
    """The results of a full turn, at input angles as ``Mechanism.shown_deg`` gives them.

    ``gaps`` has the smallest gap of each pair of parts: of driving rollers, of idle ones, and of
    the locking disc. ``dwell`` is the wheel's play in either direction in the middle of a dwell,
    where the lock holds it best. ``hand_over`` is the largest play while no roller is in its
    slot. ``motion`` is the largest play in both directions while a roller is in its slot; a slot
    that drives from one wall only does not count as play. ``ahead`` and ``behind`` are the largest
    play there in each direction alone. ``push`` is the largest pressure angle at which a roller
    pushes the wheel into line. ``contact`` is where a roller first meets a wheel at rest: its
    offset from the slot's middle beyond the clearance, mm, and the input angle. A play of
    ``free_deg``, half a step, means that nothing holds the wheel.
    """

    gaps: dict[str, Gap]
    dwell: Most
    hand_over: Most
    motion: Most
    ahead: Most
    behind: Most
    push: Most
    contact: tuple[float, float]
    free_deg: float

    @property
    def smallest(self) -> Gap:
        """The smallest of all gaps."""
        return min(self.gaps.values(), key=attrgetter("mm"))

    @property
    def holds(self) -> bool:
        """True if something holds the wheel in every dwell."""
        return self.dwell.deg < self.free_deg * (1.0 - SAME)


def full_turn(parts: TurnedParts) -> FullTurn:
    """Return the results of a whole turn of the crank; raises GenevaError beyond ``POSITIONS``."""
    # One turn of the input is shown from half a turn before mid-motion, so that the second half of
    # the last dwell comes first. A period of several turns is shown from the first entry.
    assembly, every = parts.assembly, windows(parts)
    several, last = assembly.full.spec.turns > 1, every[-1]
    middle = 0.5 * (last.start + last.end) if last.rests and not several else last.end

    def first(places: Array) -> float:
        """Return the earliest of some input angles, as it is shown."""
        earlier = np.where(places > middle, places - assembly.turn_deg, places)
        return assembly.shown_deg(float(places[np.argmin(earlier)]))

    at, pairs = _positions(parts), [DRIVING]
    pairs += [IDLE] if len(assembly.rollers) > 1 else []
    pairs += [LOCK] if parts.locked else []
    gaps = dict(zip(pairs, map(partial(_least, parts, at=at, first=first), pairs), strict=True))
    fits = min(gaps.values()).mm >= -parts.close
    starts, ends, _, rests, _ = zip(*every, strict=True)
    resting = 0.5 * np.add(starts, ends)[np.array(rests)]
    leads, _ = wheel_stops(parts, resting, fits)
    dwell = _most(np.degrees(leads.max(axis=0)), resting, first)
    play, push_deg = play_of(parts, fits)
    inside = play.guided
    hand_over = _most(play.ways.max(axis=0)[~inside], play.input_deg[~inside], first)
    guided_deg, (back, on) = play.input_deg[inside], play.ways[:, inside]
    motion = _most(np.minimum(back, on), guided_deg, first)
    ahead, behind = _most(on, guided_deg, first), _most(back, guided_deg, first)
    push = _most(push_deg, play.input_deg[:-1], first)
    # of the first motion of each kind, the first contact that is farthest off its slot's middle
    kinds = [*map(itemgetter(0), assembly.motions)]
    each = map(partial(_contact, parts), map(kinds.index, dict.fromkeys(kinds)))
    contact = max(each, key=itemgetter(0))
    met, free_deg = (contact[0], assembly.shown_deg(contact[1])), math.degrees(assembly.half_step)
    return FullTurn(gaps, dwell, hand_over, motion, ahead, behind, push, met, free_deg)


def _most(values: Array, at: Array, first: First) -> Most:
    """Return the greatest value and its position; in a plateau, the middle of the first one."""
    size = float(values.max(initial=0.0))
    # a play of 1e-6 degrees is rounding
    if not size > 1e-6:
        return Most(0.0, first(np.zeros(1)))
    same = values >= size - max(SAME * size, math.degrees(EXACT))
    edges = np.diff(same, prepend=False, append=False)
    begins, ends = np.flatnonzero(edges).reshape(-1, 2).T
    return Most(size, first(at[(begins + ends - 1) // 2]))


def _positions(parts: TurnedParts) -> Array:
    """Return input angles so dense that no part moves far between two; raises GenevaError."""
    assembly, sizes = parts.assembly, parts.sizes
    grid = np.linspace(assembly.start_deg, assembly.start_deg + assembly.turn_deg, 721)
    crank, wheel = np.unwrap(assembly.crank(grid)), assembly.wheel(grid)
    lever = assembly.plane_motion.lever(sizes.rim)
    travel = sizes.arm * np.abs(np.diff(crank)) + lever * np.abs(np.diff(wheel))
    total = np.concatenate(([0.0], np.cumsum(travel)))
    # parts move a quarter of the thinnest feature between two positions
    count = math.ceil(total[-1] / (min(sizes.roller, max(sizes.horn, 0.2 * sizes.roller)) * 0.25))
    if count > POSITIONS:
        text = f"the full turn takes {count:,} positions, more than {POSITIONS:,}"
        raise GenevaError(f"{text}: use a larger roller or horn")
    even = np.interp(np.linspace(0.0, total[-1], count + 1), total, grid)
    # A rim that is too large collides for less than a degree about entry and exit.
    ends = []
    for engagement, mid in assembly.motions:
        ends += [mid + engagement.entry_deg, mid + engagement.exit_deg]
    offsets = np.geomspace(0.01, 15.0, 24)  # degrees of the input, on either side
    near = (np.array(ends)[:, None] + np.concatenate((-offsets, [0.0], offsets))).ravel()
    near = assembly.start_deg + (near - assembly.start_deg) % assembly.turn_deg
    return rising(np.concatenate((even, near)))


def _gap(parts: TurnedParts, pair: str, at: Array) -> Array:
    """Return the gap of the lock, or of the rollers that move the wheel, or of idle ones, mm."""
    gaps, assembly = parts.gaps, parts.assembly
    pose = gaps.pose(at)
    if pair == LOCK:
        return gaps.locking(pose)
    driving = np.empty((len(at), len(assembly.rollers)), dtype=bool)
    for i, (engagement, behind) in enumerate(assembly.rollers):
        away = assembly.from_mid(at, behind)
        since, until = away - engagement.entry_deg, engagement.exit_deg - away
        driving[:, i] = np.minimum(since, until) >= -SAME_INPUT_DEG
    meanwhile = driving.any(axis=1, keepdims=True) & ~driving
    return np.where(meanwhile == (pair == IDLE), gaps.rollers(pose), np.inf).min(axis=1)


def _least(parts: TurnedParts, pair: str, at: Array, first: First) -> Gap:
    """Return a pair's smallest gap at the positions ``at``, refined around each local minimum."""
    values = _gap(parts, pair, at)
    here, before, after = values[1:-1], values[:-2], values[2:]
    dips = (here < before - DIP) & (here <= after) | (here <= before) & (here < after - DIP)
    top = 1 + np.flatnonzero(dips)
    # A smaller gap can only lie between positions whose gaps are already near to the smallest.
    top = top[np.argsort(values[top])][:12]
    low, high, row = at[top - 1], at[top + 1], np.arange(len(top))
    size, finest, places = float(values.min()), np.empty(0), np.empty(0)
    for _ in range(6 if len(top) else 0):
        x = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
        v = _gap(parts, pair, x.ravel()).reshape(x.shape)
        i = np.argmin(v, axis=1)
        size = min(size, float(v.min()))
        finest, places = v[row, i], x[row, i]
        low, high = x[row, np.maximum(i - 1, 0)], x[row, np.minimum(i + 1, FINER - 1)]
    # Where a gap stays equal for a while, its position is the first one.
    same = values <= size + parts.close
    begins = at[same & np.diff(same, prepend=False)]
    return Gap(size, first(np.append(begins, places[finest <= size + parts.close])), pair)


def _contact(parts: TurnedParts, motion: int) -> tuple[float, float]:
    """Return the first contact of a motion's own rollers: offset, mm, and input angle.

    It is at entry or, in reverse, at exit: where the roller comes nearer to the rim's inside.
    """
    assembly, gaps, close = parts.assembly, parts.gaps, parts.close
    engagement, mid = assembly.motions[motion]
    earlier = map(attrgetter("engagement.passages"), assembly.motions[:motion])
    before = sum(map(len, earlier))
    own = range(before, before + len(engagement.passages))
    ends = engagement.exit_deg, engagement.entry_deg
    ahead = float(engagement.reach(ends[0])) - float(engagement.reach(ends[1]))
    # the mouth of an offset slot has a corner for each end, and the rim is at the farther one
    farther = -1.0 if engagement.slot.offset else assembly.sign
    later = farther * ahead < -SAME_LENGTH
    start = mid + (engagement.exit_deg if later else engagement.entry_deg)
    rest = assembly.wheel(np.array([start]))

    def margin(at: Array) -> Array:
        """Return the gaps of the rollers to the wheel at rest, mm, more than ``close``."""
        pose = gaps.pose(at)
        return gaps.rollers(pose, rest - pose.wheel)[:, own].min(axis=1) - close

    if margin(np.array([start]))[0] <= 0.0:  # the roller is in the slot's middle there
        return 0.0, start
    at = np.linspace(start, mid, 65)  # a degree or so of the input apart
    meets = margin(at) <= 0.0
    first = int(np.argmax(meets)) if meets.any() else len(at) - 1
    x = boundary_by_sections(margin, at[first - 1], at[first])
    place = np.array([x])
    if parts.past_mouth(motion, place)[0] >= 0.0:  # a wall meets it, no corner
        return 0.0, x
    number, moves = own[-1] if later else own[0], gaps.plane_motion
    (roller,) = moves.scale * moves.into(gaps.pose(place).pins[:, number], rest)
    # 720 chords are within 1e-6 of the centre distance, half of what counts as touching
    passage, behind = assembly.rollers[number]
    pose = gaps.pose(behind + np.linspace(passage.entry_deg, passage.exit_deg, 721))
    line = moves.scale * moves.into(pose.pins[:, number], pose.wheel)
    begins, step = line[:-1], np.diff(line, axis=0)
    # a roller that stops takes steps of no length
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    along = np.clip(((roller - begins) * step).sum(axis=1) / square, 0.0, 1.0)
    off = float(np.linalg.norm(begins + along[:, None] * step - roller, axis=1).min())
    off -= parts.sizes.half_width - parts.sizes.roller
    return off if off > parts.contact else 0.0, x
