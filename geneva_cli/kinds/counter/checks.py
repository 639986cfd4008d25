"""Checks of a counter's driver and pinion in mesh, over a turn of the driver."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.verdict.checks.check import Check, compared, refused

if TYPE_CHECKING:
    from geneva_cli.kinds.counter.play import CounterPlay


def free(name: str, mechanism: Mechanism) -> Check | None:
    """The least angle by which the pinion is free ahead or behind, negative where parts overlap."""
    try:
        play = _play(mechanism)
    except GenevaError as error:
        return refused(name, error)
    if play is None:
        return None
    least = np.minimum(play.ahead_deg, play.behind_deg)
    # radians: rounding, and ends of lines that the search misses; a smaller overlap is touching
    touch = 1e-8 * (1.0 + mechanism.engagements[0].motion.jump) / DEGREE
    place = int((least <= least.min() + touch).argmax())  # the first of several equal ones
    value = 0.0 if abs(least[place]) <= touch else float(least[place])
    at_deg = mechanism.shown_deg(float(play.input_deg[place]))
    return compared(name, value, "at least", 0.0, at_deg, touch)


def greatest_play(name: str, mechanism: Mechanism) -> Check | None:
    """The greatest free angle of the pinion in a turn: half the angle between teeth at most."""
    most = 90.0 / mechanism.spec.wheel.z
    return _play_at_most(name, mechanism, most, lambda play: int(play.whole_deg.argmax()))


def lock(name: str, mechanism: Mechanism) -> Check | None:
    """The free angle of the pinion at rest: a tenth of its step at most."""
    return _play_at_most(name, mechanism, 36.0 / mechanism.spec.wheel.z, lambda play: 0)


def _play_at_most(
    name: str, mechanism: Mechanism, most: float, which: Callable[[CounterPlay], int]
) -> Check | None:
    """The free angle at a place; None for other wheels, and where no teeth fit."""
    try:
        play = _play(mechanism)
    except GenevaError:
        return None  # the check of the overlap reports the error
    if play is None:
        return None
    place = which(play)
    at_deg = mechanism.shown_deg(float(play.input_deg[place]))
    value = max(0.0, float(play.whole_deg[place]))
    return compared(name, value, "at most", most, at_deg)


def _play(mechanism: Mechanism) -> CounterPlay | None:
    """The free angles over a turn; None for other wheels."""
    if not mechanism.engagements[0].motion.jump:
        return None
    from geneva_cli.kinds.counter.play import counter_play

    return counter_play(mechanism)
