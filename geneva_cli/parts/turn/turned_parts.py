"""What a full turn asks of the parts of a machine, and the wheel's play in their gaps.

The play is the angle that the wheel can be turned until parts touch. It has some where slot and
lock take over from each other, and in a slot wider than its roller. A wheel that is off by it must
be pushed into line, not blocked.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Mask, Whole, joined, record_taken, rising
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly

if TYPE_CHECKING:
    from geneva_cli.parts.turn.stops import Clearances, Lengths, Pairs, Pose, Region, Shape

# Of the centre distance, 0.2 um in 100 mm: parts that overlap by less count as touching. No cutter
# and no roller is more accurate, nor are curved walls.
CONTACT = 2e-6
AROUND = 5  # parts into which an interval is divided about a peak
MOST = 4  # intervals that are divided in a round for one peak


class Window(NamedTuple):
    """A motion, or the dwell after it: input angles at its ends, and the motion's number.

    ``spans`` divide it: both ends of each, and the roller that is in its slot there, or None.
    """

    start: float
    end: float
    motion: int
    rests: bool
    spans: tuple[tuple[float, float, int | None], ...]


class Intervals(NamedTuple):
    """Intervals of the input angle, and how far crank and wheel are at most from their middles."""

    start: Array  # degrees of the input, (n,)
    end: Array
    crank: Array  # radians
    wheel: Array
    at_start: Pose
    at_middle: Pose
    at_end: Pose


class TurnedShape(NamedTuple):
    """Wheel and crank as they are turned."""

    assembly: Assembly
    sizes: Lengths
    crank: Sequence[Region]
    gaps: Clearances


class TurnedParts(ABC):
    """Wheel, crank and rollers of one machine, which a full turn checks.

    Curves are "arcs" or "cubics" within ``tolerance`` mm; by default they are as accurate as the
    checks need them.
    """

    def __init__(
        self, mechanism: Mechanism, tolerance: float | None = None, curves: str = "arcs"
    ) -> None:
        self.mechanism, self.tolerance, self.curves = mechanism, tolerance, curves

    @property
    @abstractmethod
    def shape(self) -> Shape:
        """Wheel and crank as they are turned. Raises GenevaError where the sizes leave none."""

    @property
    def assembly(self) -> Assembly:
        """The positions of the parts at any input angle."""
        return self.shape.assembly

    @property
    def sizes(self) -> Lengths:
        """The lengths of the parts."""
        return self.shape.sizes

    @property
    def gaps(self) -> Clearances:
        """The clearances between the parts."""
        return self.shape.gaps

    @property
    def locked(self) -> bool:
        """True if the crank has locking surfaces."""
        return len(self.shape.crank) > 0

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding or as the walls' tolerance."""
        return SAME_LENGTH * self.assembly.L

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""
        return CONTACT * self.assembly.L

    @abstractmethod
    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""

    @abstractmethod
    def pairs(self, target: float) -> Pairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""


class Play(NamedTuple):
    """The wheel's play back and on, degrees (2, n), at ascending input angles.

    A slot that drives from one wall has play one way only. A roller's centre is past its mouth's
    corners where ``guided``. ``rollers`` are in the wheel's frame. The pushes are pressure angles,
    degrees (2, n), where a roller stops the wheel; 0 where the lock does.
    """

    input_deg: Array
    ways: Array
    guided: Mask
    rollers: Array  # (m, 2, n), mm, or directions (m, 3, n)
    pushes: Array


def windows(parts: TurnedParts) -> list[Window]:
    """Return the motions and dwells of a turn."""
    assembly, motions, out = parts.assembly, parts.assembly.motions, []
    for i, (engagement, behind) in enumerate(motions):
        after, later = motions[(i + 1) % len(motions)]
        entry, exit_ = behind + engagement.entry_deg, behind + engagement.exit_deg
        following = later + after.entry_deg
        following += assembly.turn_deg if i + 1 == len(motions) else 0.0
        spans: tuple[tuple[float, float, int | None], ...] = ((entry, exit_, i),)
        if engagement.paired:
            # between two rollers gears drive the wheel, from the deepest position to the other's
            first, last = 2 * i, 2 * i + 1
            leaves = entry + (assembly.rollers[first].mid - entry) % assembly.turn_deg
            meets = entry + (assembly.rollers[last].mid - entry) % assembly.turn_deg
            spans = (entry, leaves, first), (leaves, meets, None), (meets, exit_, last)
        out.append(Window(entry, exit_, i, False, spans))
        if following - exit_ > SAME_INPUT_DEG:
            out.append(Window(exit_, following, i, True, ((exit_, following, None),)))
    return out


def play_of(parts: TurnedParts, fits: bool) -> tuple[Play, Array]:
    """Return the play at a grid of positions, refined where it is greatest or closes fastest.

    With it go the pressure angles, degrees, at which the wheel is pushed into line between them.
    """
    lever = parts.assembly.plane_motion.lever(parts.sizes.rim)  # of the rim
    # The largest play, radians, that may be rounding, as tangent parts separate slowly: the angle
    # at which two circles of the rim's radius overlap by ``close``.
    least = math.sqrt(2.0 * parts.close / lever)
    # 24 positions on either side of entry and exit, where lock and roller change over
    close, grid = np.concatenate(([0.0], np.geomspace(0.01, 1.0, 24))), []
    every = windows(parts)
    for a, b, _, rests, _ in every:
        near = close * min(15.0, 0.5 * (b - a))
        # in the rest of a motion an odd number, so that mid-motion is one
        grid += [a + near, np.linspace(a, b, (5 if rests else 15) + 2)[1:-1], b - near]
    play = _play_at(parts, every, rising(np.concatenate(grid)), fits, least)
    for left in range(9, -1, -1):  # rounds: 5**-9 of some degrees is a millionth
        # Where the play shrinks as the crank turns, a roller at the mouth of its slot pushes the
        # wheel's corner along their common normal. A play that ends abruptly means that a corner
        # blocks: 90 degrees.
        steps = np.linalg.norm(np.diff(play.rollers), axis=1)
        travel = parts.gaps.plane_motion.scale * steps.max(axis=0)
        closing = lever * np.radians(-np.diff(play.ways))
        # a rim that moves more than 30 times a roller's travel is not pushed by the roller
        angle = np.where(closing > 30.0 * travel, 90.0, play.pushes[:, 1:])
        free = ~(play.guided[:-1] | play.guided[1:])
        known = free & (np.radians(play.ways[:, :-1]) > least) & (closing > 0.0)
        pushes = np.where(known, angle, 0.0).max(axis=0)
        if not left:
            break
        # where the play closes fastest, with the neighbours
        top = np.argsort(-pushes, kind="stable")[: MOST if pushes.max() > 0.0 else 0]
        i = rising(np.concatenate((*_peaks(parts, play, lever, least), top - 1, top, top + 1)))
        i = i[(i >= 0) & (i < len(play.input_deg) - 1)]
        low, wide = play.input_deg[i], np.diff(play.input_deg)[i]
        cut = wide > 1e-6  # narrower intervals are not divided
        more = (low[cut, None] + wide[cut, None] * (np.arange(1, AROUND) / AROUND)).ravel()
        if not len(more):
            break
        play = joined((play, _play_at(parts, every, more, fits, least)))
        play = record_taken(play, np.argsort(play.input_deg, kind="stable"))
    return play, pushes


def _play_at(parts: TurnedParts, every: list[Window], at: Array, fits: bool, least: float) -> Play:
    """Return the play at input angles (n,), in the motions and dwells of the turn."""
    gaps = parts.gaps
    pose, (leads, pressures) = gaps.pose(at), wheel_stops(parts, at, fits)
    resting, guided = np.zeros(len(at), dtype=bool), np.zeros(len(at), dtype=bool)
    for start, end, motion, rests, _ in every:
        here = (at >= start - SAME_INPUT_DEG) & (at <= end + SAME_INPUT_DEG)
        if rests:
            resting |= here
        elif here.any():
            guided[here] |= parts.past_mouth(motion, at[here]) > -SAME_INPUT_DEG * gaps.assembly.L
    rollers = gaps.plane_motion.into(pose.pins, pose.wheel[:, None]).transpose(1, 2, 0)
    pushes = np.where(leads > least, np.degrees(pressures), 0.0)
    return Play(at, np.degrees(leads), guided & ~resting, rollers, pushes)


def _peaks(
    parts: TurnedParts, play: Play, lever: float, least: float
) -> tuple[Whole, Whole, Whole]:
    """Return the intervals in which the play may be greatest, in slots and elsewhere.

    Besides those about the greatest plays they are those in which the roller changes from one wall
    of its slot to the other: the smaller play may have a narrow peak there. Where both change
    steadily, it is at most the smaller of their greater ends.
    """
    # walls hold up to a pressure angle of 84 degrees, whose cosine is 1/10: a smaller play between
    # the walls of a slot may be that of their tolerance alone
    held = math.degrees(10.0 * parts.close / lever)
    either, both = math.degrees(least), play.ways.min(axis=0)
    edges = np.repeat((*play.ways, both), 2, axis=0)
    where = np.array((play.guided, ~play.guided) * 3)
    above = np.reshape((either, either, either, either, held, either), (6, 1))
    # beyond half a step the place is lost
    known = where & (edges < math.degrees(parts.assembly.half_step)) & (edges > above)
    value = np.where(known, edges, -1.0)
    padded = np.pad(value, ((0, 0), (1, 1)), constant_values=-1.0)
    # around a local maximum below 0.8 of the greatest no greater play is expected
    great = np.maximum(0.8 * value.max(axis=1, keepdims=True), 0.0)
    row, top = np.nonzero((value > great) & (value >= padded[:, :-2]) & (value >= padded[:, 2:]))
    order = np.lexsort((-value[row, top], row))  # in each row the greatest first
    row, top = row[order], top[order]
    top = top[np.arange(len(row)) - np.searchsorted(row, row) < MOST]
    most = np.maximum(play.ways[:, :-1], play.ways[:, 1:]).min(axis=0)
    floor = max(held, both[play.guided].max(initial=0.0))
    change = np.flatnonzero(play.guided[:-1] & play.guided[1:] & (most > floor))
    return top - 1, top, change[np.argsort(-most[change], kind="stable")][:MOST]


def wheel_stops(parts: TurnedParts, at: Array, fits: bool = False) -> tuple[Array, Array]:
    """Return how far the wheel turns back and on at input angles (n,), radians: (2, n).

    With it go the pressure angles of rollers that stop it; see ``Stops.first``. ``fits`` says that
    no parts overlap there. Gears hold the wheel both ways, without backlash.
    """
    gaps, close = parts.gaps, parts.close
    pose, held = gaps.pose(at), parts.assembly.geared(at)
    if not fits:  # parts that overlap from the start leave no play
        held |= gaps.locking(pose, near=close) < -close
        held |= (gaps.rollers(pose, near=close) < -close).any(axis=1)
    leads, pressures = gaps.stops.first(pose, parts.assembly.half_step, close)
    leads[:, held] = pressures[:, held] = 0.0
    return leads, pressures
