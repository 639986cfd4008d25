"""The wheel's play through a turn: the angle that it can be turned until parts touch.

Slot and lock hold the wheel alternately. Where one takes over from the other, and in a slot that is
wider than its roller, the wheel has some play. The play must be small. A wheel that is off by its
play must be pushed into line, not blocked.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import reduce
from itertools import groupby
from operator import or_
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole, rising
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.parts.turn.machine_parts import MachineParts, rim_lever
from geneva_cli.parts.turn.pairs import Stop, Window, smallest_clearance

AROUND = 5  # parts into which an interval is divided about a peak
SMALL = 1e-3  # degrees: the interval over which a roller's speed is computed
MOST = 4  # intervals that are divided in a round for one peak


class Play(NamedTuple):
    """The wheel's play back and on, degrees, at ascending input angles.

    ``resting`` is True where the wheel rests, ``guided`` where a roller's centre is past the
    mouth's corners of its slot. ``speed`` is the roller's in the wheel's frame, mm per degree.
    ``back_push`` and ``on_push`` are pressure angles, degrees, where a roller stops the wheel; 0
    where the lock does.
    """

    input_deg: Array
    back: Array
    on: Array
    resting: Mask
    guided: Mask
    speed: Array
    back_push: Array
    on_push: Array

    @property
    def both(self) -> Array:
        """The smaller play of both directions: a slot that drives from one wall has none."""
        return np.minimum(self.back, self.on)

    @property
    def either(self) -> Array:
        """The larger play of both directions."""
        return np.maximum(self.back, self.on)


def windows(parts: MachineParts) -> Iterator[Window]:
    """Yield the motions and dwells of a turn."""
    assembly, motions = parts.assembly, parts.assembly.motions
    for i, (engagement, behind) in enumerate(motions):
        after, later = motions[(i + 1) % len(motions)]
        turns = assembly.span_deg if i + 1 == len(motions) else 0.0
        entry, exit_ = behind + engagement.entry_deg, behind + engagement.exit_deg
        following = later + turns + after.entry_deg
        yield Window(entry, exit_, i, False)
        if following - exit_ > SAME_INPUT_DEG:
            yield Window(exit_, following, i, True)


def play_of(parts: MachineParts, fits: bool, refined: bool = True) -> Play:
    """Return the play at a grid of positions, refined where it is greatest or closes fastest.

    ``fits`` says that no parts overlap in the positions of the ideal motion.
    """
    play = _play_at(parts, _places(parts), fits)
    # 9 rounds: 5**-9 of some degrees is a millionth
    for _ in range(9 if refined else 0):
        near = (_peaks(parts, play), _changes(parts, play), _closing(parts, play))
        more = _cut(play, rising(np.concatenate(near)))
        if not len(more):
            break
        play = _merged(play, _play_at(parts, more, fits))
    return play


def push_deg(parts: MachineParts, play: Play) -> Array:
    """Return the pressure angle, degrees, at which the wheel is pushed into line; 0 if it is not.

    It belongs to the intervals between positions. Where the play shrinks as the crank turns,
    something pushes the wheel. If a roller at the mouth of its slot does, this is the angle between
    their common normal and the direction in which the wheel's corner moves. A play that ends
    abruptly means that a corner blocks: 90 degrees.
    """
    step = np.diff(play.input_deg)
    moved = 0.5 * (play.speed[1:] + play.speed[:-1]) * step
    free = ~(play.guided[:-1] | play.guided[1:])
    pushes = np.zeros(len(step))
    for edge, push in ((play.back, play.back_push), (play.on, play.on_push)):
        closing = rim_lever(parts) * np.radians(-np.diff(edge))
        # a rim that moves more than 30 times the roller's travel is not pushed by the roller
        angle = np.where(closing > 30.0 * moved, 90.0, push[1:])
        known = np.radians(edge[:-1]) > touching(parts)
        pushes = np.maximum(pushes, np.where(free & known & (closing > 0.0), angle, 0.0))
    return pushes


def _places(parts: MachineParts) -> Array:
    """Return input angles of a turn, dense where lock and roller change over."""
    # 24 positions on either side of entry and exit
    close = np.concatenate(([0.0], np.geomspace(0.01, 1.0, 24)))
    places = []
    for a, b, _, rests in windows(parts):
        # lock and roller change over within 15 degrees of entry and exit
        near = close * min(15.0, 0.5 * (b - a))
        # 5 positions in the rest of a dwell, and 15 in the rest of a motion,
        # an odd number, so that mid-motion is one
        places += [a + near, np.linspace(a, b, (5 if rests else 15) + 2)[1:-1], b - near]
    return rising(np.concatenate(places))


def _play_at(parts: MachineParts, at: Array, fits: bool) -> Play:
    assembly = parts.assembly
    back, on = wheel_stops(parts, at, fits)
    resting, guided = np.zeros(len(at), dtype=bool), np.zeros(len(at), dtype=bool)
    speed = np.zeros(len(at))
    last = assembly.start_deg + assembly.span_deg
    for motion, spans in groupby(windows(parts), key=lambda window: window.motion):
        inside = [
            (w, (at >= w.start - SAME_INPUT_DEG) & (at <= w.end + SAME_INPUT_DEG)) for w in spans
        ]
        here = np.flatnonzero(reduce(or_, [mask for _, mask in inside]))
        if not len(here):
            continue
        x = at[here]
        low, high = np.maximum(x - SMALL, assembly.start_deg), np.minimum(x + SMALL, last)
        before, after = np.split(parts.in_wheel(motion, np.concatenate((low, high))), 2)
        moved = np.linalg.norm(after - before, axis=1) / (high - low)
        speed[here] = np.maximum(speed[here], moved)
        for window, mask in inside:
            if window.rests:
                resting |= mask
            elif mask.any():
                guided[mask] |= parts.past_mouth(motion, at[mask]) > -SAME_INPUT_DEG * assembly.L
    known = touching(parts)
    back_push, on_push = (np.where(s.lead > known, np.degrees(s.pressure), 0.0) for s in (back, on))
    return Play(
        at,
        np.degrees(back.lead),
        np.degrees(on.lead),
        resting,
        guided & ~resting,
        speed,
        back_push,
        on_push,
    )


def _merged(a: Play, b: Play) -> Play:
    order = np.argsort(np.concatenate((a.input_deg, b.input_deg)), kind="stable")
    return Play(*[np.concatenate(both)[order] for both in zip(a, b, strict=True)])


def _cut(play: Play, intervals: Whole) -> Array:
    """Return positions that divide intervals, numbered by their first ends, into equal parts."""
    i = intervals[(intervals >= 0) & (intervals < len(play.input_deg) - 1)]
    low, high = play.input_deg[i], play.input_deg[i + 1]
    # intervals below 1e-6 degrees are not divided
    wide = (high - low > 1e-6)[:, None]
    fraction = np.arange(1, AROUND) / AROUND
    return (low[:, None] + (high - low)[:, None] * fraction)[wide.ravel()].ravel()


def _peaks(parts: MachineParts, play: Play) -> Whole:
    """Return the intervals next to the greatest plays, in slots and elsewhere."""
    either, held, most = math.degrees(touching(parts)), _held_deg(parts), search_deg(parts)
    edges = np.array((play.back, play.back, play.on, play.on, play.both, play.both))
    where = np.array((play.guided, ~play.guided) * 3)
    least = np.array(((either,), (either,), (either,), (either,), (held,), (either,)))
    value = np.where(where & (edges < most) & (edges > least), edges, -1.0)
    padded = np.full((len(value), value.shape[1] + 2), -1.0)
    padded[:, 1:-1] = value
    before, after = padded[:, :-2], padded[:, 2:]
    # around a local maximum below 0.8 of the greatest no greater play is expected
    great = np.maximum(0.8 * value.max(axis=1, keepdims=True), 0.0)
    row, top = np.nonzero((value > great) & (value >= before) & (value >= after))
    order = np.lexsort((-value[row, top], row))  # in each row the greatest first
    row, top = row[order], top[order]
    top = top[np.arange(len(row)) - np.searchsorted(row, row) < MOST]
    return np.concatenate((top - 1, top))


def _changes(parts: MachineParts, play: Play) -> Whole:
    """Return the intervals in which the roller changes from one wall of its slot to the other."""
    ends = [np.maximum(edge[:-1], edge[1:]) for edge in (play.back, play.on)]
    guided, most = play.guided[:-1] & play.guided[1:], np.minimum(*ends)
    known = max(_held_deg(parts), play.both[play.guided].max(initial=0.0))
    top = np.flatnonzero(guided & (most > known))
    return top[np.argsort(-most[top], kind="stable")][:MOST]


def _held_deg(parts: MachineParts) -> float:
    """Return the largest play between the walls of a slot that their tolerance alone may give."""
    # walls hold up to a pressure angle of 84 degrees, whose cosine is 1/10
    return math.degrees(10.0 * parts.close / rim_lever(parts))


def _closing(parts: MachineParts, play: Play) -> Whole:
    """Return the intervals in which the wheel's play closes fastest, and their neighbours."""
    angle = push_deg(parts, play)
    top = np.argsort(-angle, kind="stable")[: MOST if angle.max() > 0.0 else 0]
    return np.concatenate((top - 1, top, top + 1))


EXACT = 1e-10  # radians: smaller angles are rounding


def search_deg(parts: MachineParts) -> float:
    """Return the largest play that is searched for: half a step, in degrees.

    Beyond it the wheel's position is lost.
    """
    return math.degrees(min(engagement.half_step for engagement, _ in parts.assembly.motions))


def free_angles(parts: MachineParts, at: Array, fits: bool = False) -> tuple[Array, Array]:
    """Return the angles that the wheel can be turned back and on at input angles (n,), radians."""
    back, on = wheel_stops(parts, at, fits)
    return back.lead, on.lead


def wheel_stops(parts: MachineParts, at: Array, fits: bool = False) -> tuple[Stop, Stop]:
    """Return the stops of the wheel, turned back and turned on at input angles (n,)."""
    gaps, close = parts.gaps, parts.close
    pose, held = gaps.pose(at), parts.assembly.geared(at)
    if not fits:  # parts that overlap from the start leave no play
        held |= smallest_clearance(gaps, pose, np.zeros(len(at)), close) < -close
    back, on = gaps.stops(pose, math.radians(search_deg(parts)), close)
    for each in (*back, *on):
        each[held] = 0.0
    return back, on


def touching(parts: MachineParts) -> float:
    """Return the largest play, radians, that may be rounding: tangent parts separate slowly.

    It is the angle at which two circles of the rim's radius overlap by ``close``.
    """
    return math.sqrt(2.0 * parts.close / rim_lever(parts))
