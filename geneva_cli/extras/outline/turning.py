"""Whether the wheel of a drawn machine turns, in both senses, and what strikes it."""

import math
from functools import lru_cache
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from geneva_cli.extras.outline.contact import Contact, contacts
from geneva_cli.extras.outline.machine import DrawnMachine, crank_jet, drawn_machine
from geneva_cli.loads.impacts.shock_force import Impacts, hardest, impulse_Nms
from geneva_cli.loads.strength.pin_arm_key import PinSize, pin_diameter_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.machine_sizes import built
from geneva_cli.parts.turn.free_ranges import Range
from geneva_cli.parts.turn.lazy_turn import STEPS, Jam, LazyTurn, Push, Turner
from geneva_cli.verdict.quantities.groups import only

SETTLED = 1e-9  # radians: the wheel rests where it rested a turn before
FEW_TRIALS, TRIALS = 2, 8  # places of rest that are tried over the free range
HALVINGS = 10  # of the space between two of them, and of the range of slacks
LOOSE = 1e-5  # radians: a smaller range of places of rest is one place
HELD_MIDDLE = ("detent", "pin")  # they put the wheel back to the middle of its dwell
SENSES = (1, -1)
LATE = 1e-3  # radians: a push that moves the wheel less is not counted as an impact
JUST = 1e-12  # radians after a push begins
SAME = 1e-3  # of the roller's radius: the arc that touches is the roller's, less the slack
MOST = 0.02  # of L, and at most half a roller's radius: with more slack it is another wheel


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
    has_indexed: bool  # it has gone on by more than half of a step in each sense
    turns: bool  # in both senses, from the middle of its dwell on


@lru_cache(maxsize=4)
def turned(mechanism: Mechanism) -> Turned:
    """The turn of a machine with drawn outlines. Raises GenevaError as its drawings do."""
    return _turned(drawn_machine(mechanism))


def _turned(machine: DrawnMachine, exact: bool = True) -> Turned:
    """The turn of a machine; without ``exact`` pushes begin and end on a coarser grid."""
    turner = Turner(machine.free, machine.start, STEPS if exact else STEPS // 2)
    is_free, low, high = turner.rest(machine.rest)
    # an outline wholly inside the wheel meets none of its edges
    depth, _ = machine.deepest([contour.segments[0].start for contour in machine.crank])
    is_free = is_free and depth <= 2.0 * machine.free.slack
    half = 0.5 * math.tau / machine.assembly.mechanism.spec.wheel.z
    rest = Range(is_free, max(low, machine.rest - half), min(high, machine.rest + half))
    is_held = is_free and rest.high - rest.low < 2.0 * half * (1.0 - 1e-9)
    is_put_back = put_back(machine, rest)
    forwards, backwards = (_one_sense(turner, machine, way, is_put_back, exact) for way in SENSES)
    both = forwards, backwards
    has_indexed = all(_goes_on(machine, sense.first, sense.way) for sense in both)
    turns = is_free and has_indexed and not any(sense.jam for sense in both)
    return Turned(machine, turner, both, rest, is_held, has_indexed, turns)


def _goes_on(machine: DrawnMachine, turn: LazyTurn, way: int) -> bool:
    """Whether a turn of the crank brings the wheel on by more than half of its step."""
    return turn.jam is None and way * turn.gained > 0.5 * machine.step


def put_back(machine: DrawnMachine, rest: Range) -> bool:
    """Whether the wheel begins each turn of the crank in the middle of its dwell."""
    held_by = machine.assembly.mechanism.spec.wheel.held_by
    return held_by in HELD_MIDDLE or rest.high - rest.low < LOOSE


def _one_sense(
    turner: Turner, machine: DrawnMachine, way: int, is_put_back: bool, exact: bool
) -> SenseResult:
    """Turn the crank until the wheel has made a turn, jams, or rests as a turn before."""
    z, a_turn = machine.assembly.mechanism.spec.wheel.z, len(machine.assembly.motions)
    is_alike = machine.free.period < 6.0  # one sector stands for all
    out: list[LazyTurn] = []
    at, drift = machine.rest, 0.0
    for k in range(max(1, round(z / a_turn))):
        turn = turner.turn(at, way, exact)
        out.append(turn)
        if turn.jam is not None or not len(turn.wheel):
            return SenseResult(way, tuple(out), k * a_turn, drift)
        drift = float(turn.wheel[-1]) - at - way * machine.step
        at = float(turn.wheel[-1])
        if is_put_back:
            at = machine.rest + (k + 1) * way * machine.step
        if is_alike and (is_put_back or abs(drift) < SETTLED):
            break
    return SenseResult(way, tuple(out), z, drift)


def turning(result: Turned) -> tuple[float, float] | None:
    """The places of rest around the middle from which the wheel turns; None without any."""
    machine, turner = result.machine, result.turner
    _, low, high = result.rest

    def goes(rest: float) -> bool:
        return all(_goes_on(machine, turner.turn(rest, way, exact=False), way) for way in SENSES)

    middle = min(max(machine.rest, low), high)
    # a lock leaves a short range, and a detent puts the wheel back; else it may stand anywhere
    is_loose = high - low > 0.1 * machine.step and not put_back(machine, result.rest)
    space = 1e-9 * (high - low)  # beside what blocks
    places = np.linspace(low + space, high - space, (TRIALS if is_loose else FEW_TRIALS) + 1)
    good = np.array([goes(float(place)) for place in places])
    if not good.any():
        return (middle, middle) if goes(middle) else None
    first = int(np.argmin(np.where(good, np.abs(places - middle), np.inf)))
    ends = []
    for way in (slice(first, None, -1), slice(first, None)):
        some, bad = places[way].tolist(), np.flatnonzero(~good[way])
        k = int(bad[0]) if len(bad) else len(some)  # of the nearest place from which it does not
        ends.append(boundary(goes, some[k - 1], some[min(k, len(some) - 1)], HALVINGS))
    return ends[0], ends[1]


def most_slack_mm(machine: DrawnMachine) -> float:
    """The greatest slack that is tried, mm."""
    return min(MOST * machine.assembly.L, 0.5 * machine.roller.radius)


def least_slack_mm(result: Turned) -> float | None:
    """The least slack with which the wheel turns, mm: that which it has if it turns.

    It is known within 2 %, and turns with what is returned. None if it does not turn with 0.02 L,
    or half a roller's radius.
    """
    machine = result.machine

    def turns(slack: float) -> bool:
        """Whether it turns in both senses from the middle of its dwell."""
        return _turned(machine._replace(free=machine.free.with_slack(slack)), exact=False).turns

    low, high = machine.free.slack, most_slack_mm(machine)
    if result.turns:
        return low
    if high <= low or not turns(high):
        return None
    least = boundary(lambda x: turns(math.exp(x)), math.log(high), math.log(low), HALVINGS)
    return math.exp(least)


class Struck(NamedTuple):
    """An impact, and the angles of crank and wheel at it, radians."""

    impact: Impacts
    crank: float
    wheel: float

    @property
    def text(self) -> str:
        """The force in words, or the impulse of what is no roller; empty without an inertia."""
        force_N, moment_Nms = only(self.impact.force_N), only(self.impact.moment_Nms)
        if force_N is not None:
            return f"; the roller strikes it with {force_N:.4g} N"
        if moment_Nms is not None:
            return f"; it is struck by a moment impulse of {moment_Nms:.4g} N m s"
        return ""


def moving(turn: LazyTurn) -> list[Push]:
    """The pushes of a turn that move the wheel, not those within its play."""
    return [push for push in turn.pushes if push.moved > LATE]


def struck_by(mechanism: Mechanism, result: Turned) -> Struck | None:
    """The hardest impact, the one forwards of two that are equal; None without any.

    It has the force of an elastic impact, and the moment of a plastic one.
    """
    machine, hits = result.machine, list[tuple[float, int, float, Push, Contact]]()
    for sense in result.senses:
        for push in (push for turn in sense.turns for push in moving(turn)):
            after = np.array([push.begin + sense.way * JUST])
            touching = contacts(machine.free, after, np.array([push.begin_wheel]))
            velocity = float(touching.motion(after)[1][0])
            hits.append((round(abs(velocity), 4), sense.way, velocity, push, touching))
    if not hits:
        return None
    *_, velocity, push, touching = max(hits, key=itemgetter(0, 1))
    place, crank_deg, pin = machine.assembly, math.degrees(push.begin), None
    rates, _ = crank_jet(mechanism, np.array([place.to_input(crank_deg)]))
    jump = velocity * float(rates.derivatives()[1][0])
    if impulse_Nms(mechanism, abs(jump)) > 0.0:
        sizes, radius = built(mechanism), machine.roller.radius
        width = sizes.face_width_mm or sizes.wheel_thickness_mm
        # whether the roller strikes, and not the disc
        off = abs(float(touching.crank.radius[0]) - radius)
        if width and touching.is_known[0] and off < SAME * radius + machine.free.slack:
            pin = PinSize(sizes.pin_mm or pin_diameter_mm(mechanism), width)
    shown = np.array([[place.shown_deg(crank_deg)], [jump], [np.nan]])
    return Struck(hardest(mechanism, [shown], pin), push.begin, push.begin_wheel)
