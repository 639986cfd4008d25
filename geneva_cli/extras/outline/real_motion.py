"""The motion that drawn outlines give: a table over a turn of the crank, and its peaks.

It is at rest, or pushed by one contact after the other. At the beginning of a push the velocity may
leap: that is an impact, at which the acceleration has no bound.
"""

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import crank_jet
from geneva_cli.extras.outline.turning import Turned, moving, struck_by, turned
from geneva_cli.motion import motion_table
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import QUANTITIES
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.jet import Jet, composed
from geneva_cli.parts.turn.lazy_turn import LazyTurn, Push, pushed
from geneva_cli.table import Table, record_table
from geneva_cli.verdict.quantities.groups import only

FINE = 33  # places about a peak, in each round of the search
ROUNDS = 6


def steady_turn(result: Turned) -> LazyTurn:
    """The last turn of the crank forwards, after which the wheel rests as before."""
    if not result.turns:
        raise GenevaError(
            "the wheel does not turn, so there is no motion: `geneva check` says where it jams",
            ("outline",),
        )
    turns = result.senses[0].turns
    steps, last = (len(turns) - 1) * result.machine.step, turns[-1]
    pushes = tuple(Push(a, x - steps, b, y - steps) for a, x, b, y in last.pushes)
    moved = (last.wheel - steps, last.low - steps, last.high - steps)
    return LazyTurn(last.crank, *moved, pushes, last.jam)


def motion(mechanism: Mechanism, samples: int, at_deg: Sequence[float] | None = None) -> Table:
    """``samples`` rows, evenly spaced in the input angle over a period, or at ``at_deg``."""
    if at_deg is None:
        motion_table.check_samples(samples)
        input_deg = motion_table.inputs(mechanism, samples, 0, samples)
    else:
        input_deg = motion_table.checked_angles(at_deg)
    result = turned(mechanism)
    turn = steady_turn(result)
    theta, whole = crank_jet(mechanism, input_deg)
    laps = np.floor((theta.c[0] - turn.crank[0]) / math.tau)
    wheel, rates = at_crank(result, turn, theta.c[0] - math.tau * laps)
    shown = np.degrees(wheel + (whole + laps) * turn.gained)
    columns = motion_table.columns_of(mechanism, input_deg, shown, _by_input(wheel, rates, theta))
    return Table(motion_table.motion_columns(mechanism), columns)


def at_crank(result: Turned, turn: LazyTurn, crank: Array) -> tuple[Array, list[Array]]:
    """The wheel's angle and three derivatives by the crank's, at crank angles of a turn.

    While it rests the derivatives are 0. At either end of a push they are those inside it.
    """
    free = result.machine.free
    before = np.clip(np.searchsorted(turn.crank, crank, side="right") - 1, 0, None)
    wheel = turn.wheel[before].copy()
    rates = [np.zeros(len(crank)) for _ in range(3)]
    for push in turn.pushes:
        inside = np.flatnonzero((crank >= push.begin) & (crank <= push.end))
        if not len(inside):
            continue
        ranges = free.at(crank[inside])
        for i, k in enumerate(inside):
            wheel[k] = pushed(ranges.around(i, wheel[k]), wheel[k])
        found = contacts(free, crank[inside], wheel[inside]).motion(crank[inside])
        for rate, own in zip(rates, found[1:], strict=True):
            rate[inside] = own
    return wheel, rates


def _by_input(wheel: Array, rates: Sequence[Array], crank: Jet) -> tuple[Array, ...]:
    """Velocity, acceleration and jerk by the input's angle, from those by the crank's."""
    outer = Jet((wheel, rates[0], rates[1] / 2.0, rates[2] / 6.0))
    return composed(outer, crank).derivatives()[1:]


def peaks(mechanism: Mechanism) -> Table:
    """The greatest velocity, acceleration, jerk and power, as ``geneva peaks`` prints them."""
    result = turned(mechanism)
    turn, place = steady_turn(result), result.machine.assembly

    def quantities(crank: Array) -> dict[str, Array]:
        """The quantities at crank angles in pushes, by the input's angle."""
        wheel, rates = at_crank(result, turn, crank)
        input_deg = np.array([place.to_input(math.degrees(x)) for x in crank.tolist()])
        velocity, acceleration, jerk = _by_input(wheel, rates, crank_jet(mechanism, input_deg)[0])
        rows = velocity, acceleration, jerk, velocity * acceleration
        return dict(zip(QUANTITIES, rows, strict=True))

    pushes = moving(turn)
    best = dict.fromkeys(QUANTITIES, (0.0, math.nan))
    for push in pushes:
        rows = turn.crank[(turn.crank >= push.begin) & (turn.crank <= push.end)]
        even = np.unique(np.concatenate((rows, (push.begin, push.end))))
        even[[0, -1]] = inside(push)
        known = quantities(even)
        for name in QUANTITIES:
            grid, row = even, known[name]
            for k in range(ROUNDS):
                if k:
                    row = quantities(grid)[name]
                top = int(np.argmax(np.abs(row)))
                size = abs(float(row[top]))
                if size > best[name][0]:
                    best[name] = size, float(grid[top])
                grid = np.linspace(grid[max(top - 1, 0)], grid[min(top + 1, len(grid) - 1)], FINE)
    at_ends = quantities(np.array((inside(pushes[0])[0], inside(pushes[-1])[1])))
    values: dict[str, object] = {"spec": mechanism.spec.path, "title": mechanism.spec.title or None}
    for name, (size, at) in best.items():
        values[f"{name}.max"] = size
        values[f"{name}.at_deg"] = place.shown_deg(math.degrees(at))
        if name != "power":
            entry, exit_ = at_ends[name].tolist()
            values |= {f"{name}.entry": abs(entry), f"{name}.exit": abs(exit_)}
    begin, end = (place.to_input(math.degrees(x)) for x in (pushes[0].begin, pushes[-1].end))
    values |= {"motion_deg": end - begin, "dwell_deg": 360.0 * mechanism.spec.turns - (end - begin)}
    values["stations"] = None
    struck = struck_by(mechanism, result)
    names = ("jump", "at_deg", "force_N", "moment_Nms")
    values |= {f"impact.{name}": struck and only(getattr(struck.impact, name)) for name in names}
    return record_table(values)


def inside(push: Push) -> tuple[float, float]:
    """Crank angles just inside a push, radians, where only its own contact touches."""
    return push.begin + 1e-9, push.end - 1e-7
