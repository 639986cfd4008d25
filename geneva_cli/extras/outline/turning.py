"""Whether the wheel of a drawn machine turns: both senses, every slot, every place of rest."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import DrawnMachine, drawn_machine
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.turn.free_ranges import Range
from geneva_cli.parts.turn.lazy_turn import Jam, LazyTurn, Push, Turner

SETTLED = 1e-9  # radians: the wheel rests where it rested a turn before
FEW_TRIALS = 2
TRIALS = 8  # places of rest that are tried over the free range
HALVINGS = 10  # of the space between two of them
LATE = 1e-3  # radians: a push that moves the wheel less is not counted as an impact
LOOSE = 1e-5  # radians: a smaller range of places of rest is one place
HELD_MIDDLE = ("detent", "pin")  # they put the wheel back to the middle of its dwell
SENSES = (1, -1)
JUST = 1e-12  # radians after a push begins


class Impact(NamedTuple):
    """The velocity of the wheel, of the crank's, just after a push begins, and where it does."""

    velocity: float
    crank: float  # radians
    wheel: float
    way: int


class SenseResult(NamedTuple):
    """The motion in one sense: ``turns`` has one turn of the crank after the other."""

    way: int
    turns: tuple[LazyTurn, ...]
    passed: int  # slots without a jam
    drift: float  # radians in the last turn

    @property
    def jam(self) -> Jam | None:
        """Where it jams."""
        return self.turns[-1].jam

    @property
    def first(self) -> LazyTurn:
        """The first turn of the crank."""
        return self.turns[0]


class Turned(NamedTuple):
    """What a turn of the wheel gives. Angles are radians of the crank and of the wheel."""

    machine: DrawnMachine
    turner: Turner
    senses: tuple[SenseResult, SenseResult]
    rest: Range  # where the wheel may stand in the dwell
    is_held: bool  # the outlines hold the wheel in the dwell

    @property
    def turns(self) -> bool:
        """True if it turns in both senses, from the middle of its dwell on."""
        passes = all(sense.jam is None for sense in self.senses)
        return self.rest.is_free and passes and self.has_indexed

    @property
    def has_indexed(self) -> bool:
        """True if the wheel has gone on by more than half of a step in each sense."""
        return all(goes_on(self.machine, sense.first, sense.way) for sense in self.senses)


@lru_cache(maxsize=4)
def turned(mechanism: Mechanism) -> Turned:
    """Return the turn of a machine with drawn outlines. Raises GenevaError as its drawings do."""
    machine = drawn_machine(mechanism)
    turner = Turner(machine.free, machine.start)
    rest = turner.rest(machine.rest)
    # an outline wholly inside the wheel meets none of its edges
    depth, _ = machine.deepest([contour.segments[0].start for contour in machine.crank])
    if depth > 2.0 * machine.free.slack:
        rest = rest._replace(is_free=False)
    half = 0.5 * math.tau / mechanism.spec.wheel.z
    low, high = max(rest.low, machine.rest - half), min(rest.high, machine.rest + half)
    is_held = rest.is_free and high - low < 2.0 * half * (1.0 - 1e-9)
    is_put_back = put_back(machine, Range(rest.is_free, low, high))
    senses = tuple(one_sense(turner, machine, way, is_put_back) for way in SENSES)
    limited = Range(rest.is_free, low, high)
    return Turned(machine, turner, (senses[0], senses[1]), limited, is_held)


def goes_on(machine: DrawnMachine, turn: LazyTurn, way: int) -> bool:
    """Return whether a turn of the crank brings the wheel on by more than half of its step."""
    return turn.jam is None and way * turn.gained > 0.5 * machine.step


def put_back(machine: DrawnMachine, rest: Range) -> bool:
    """Return whether the wheel begins each turn of the crank in the middle of its dwell."""
    held_by = machine.assembly.mechanism.spec.wheel.held_by
    return held_by in HELD_MIDDLE or rest.high - rest.low < LOOSE


def one_sense(
    turner: Turner, machine: DrawnMachine, way: int, is_put_back: bool, exact: bool = True
) -> SenseResult:
    """Turn the crank until the wheel has made a turn, jams, or rests as a turn before.

    Something may put it back to the middle of its dwell after each turn of the crank. Without
    ``exact`` the angles at which pushes begin and end are those of the grid.
    """
    z, rest = machine.assembly.mechanism.spec.wheel.z, machine.rest
    is_alike = machine.free.period < 6.0  # one sector stands for all
    every = max(1, round(z / machine.slots_a_turn))
    out: list[LazyTurn] = []
    at, drift = rest, 0.0
    for k in range(every):
        turn = turner.turn(at, 1, way, exact)
        out.append(turn)
        if turn.jam is not None or not len(turn.wheel):
            return SenseResult(way, tuple(out), k * machine.slots_a_turn, drift)
        drift = float(turn.wheel[-1]) - at - way * machine.step
        at = float(turn.wheel[-1])
        if is_put_back:
            at = rest + (k + 1) * way * machine.step
        if is_alike and (is_put_back or abs(drift) < SETTLED):
            break
    return SenseResult(way, tuple(out), z, drift)


def turning(result: Turned) -> tuple[float, float] | None:
    """Return the places of rest around the middle from which the wheel turns; None without any.

    It tries many turns, which costs more than everything else of a drawing.
    """
    machine, turner = result.machine, result.turner
    is_free, low, high = result.rest
    if not is_free:
        return None

    def goes(rest: float) -> bool:
        turns = ((turner.turn(rest, 1, way, exact=False), way) for way in SENSES)
        return all(goes_on(machine, *turn) for turn in turns)

    middle = min(max(machine.rest, low), high)
    # a lock leaves a short range, and a detent puts the wheel back; else it may stand anywhere
    is_loose = high - low > 0.1 * machine.step and not put_back(machine, result.rest)
    trials = TRIALS if is_loose else FEW_TRIALS
    places = np.linspace(low, high, trials + 1)
    places[0], places[-1] = low + 1e-9 * (high - low), high - 1e-9 * (high - low)
    if high - low < LOOSE:
        return (low, high) if goes(middle) else None
    good = [goes(float(place)) for place in places]
    if not any(good):
        return (middle, middle) if goes(middle) else None
    first = min((i for i, ok in enumerate(good) if ok), key=lambda i: abs(places[i] - middle))
    ends = []
    for step in (-1, 1):
        i = first
        while 0 <= i + step <= trials and good[i + step]:
            i += step
        inside, outside = float(places[i]), float(places[min(max(i + step, 0), trials)])
        for _ in range(HALVINGS if inside != outside else 0):
            half = 0.5 * (inside + outside)
            inside, outside = (half, outside) if goes(half) else (inside, half)
        ends.append(inside)
    return ends[0], ends[1]


def moving(turn: LazyTurn) -> list[Push]:
    """Return the pushes of a turn that move the wheel, not those within its play."""
    return [push for push in turn.pushes if push.moved > LATE]


def impacts(result: Turned) -> list[Impact]:
    """Return the impacts of both senses: the velocities at which pushes begin."""
    out: list[Impact] = []
    for sense in result.senses:
        for turn in sense.turns:
            out += [_impact(result.machine, push, sense.way) for push in moving(turn)]
    return out


def hardest_impact(result: Turned) -> Impact | None:
    """Return the hardest impact, the one forwards of two that are equal; None without any."""
    every = impacts(result)
    return max(every, key=lambda one: (round(abs(one.velocity), 4), one.way), default=None)


def _impact(machine: DrawnMachine, push: Push, way: int) -> Impact:
    impact = Impact(math.nan, push.begin, push.begin_wheel, way)
    crank, wheel = after(impact)
    _, velocity, *_ = contacts(machine.free, crank, wheel).motion(crank)
    return impact._replace(velocity=float(velocity[0]))


def after(impact: Impact) -> tuple[Array, Array]:
    """Return crank and wheel angles just after an impact, radians, (1,) each."""
    return np.array([impact.crank + impact.way * JUST]), np.array([impact.wheel])
