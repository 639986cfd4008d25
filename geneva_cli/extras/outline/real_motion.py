"""The motion that drawn outlines give: a table over a turn of the crank, and its peaks.

It is piecewise: at rest, or pushed by one contact after the other. Velocity, acceleration and jerk
follow from the geometry of the contact. At the beginning of a push the velocity may leap: that is
an impact, at which the acceleration has no bound.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.impact_force import Struck, struck_by
from geneva_cli.extras.outline.machine import crank_jet
from geneva_cli.extras.outline.turning import LOOSE, Turned, hardest_impact, moving, turned
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import (
    check_samples,
    checked_angles,
    inputs,
    motion_columns,
    rates_at_speed,
    times_s,
)
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.jet import Jet, composed
from geneva_cli.parts.turn.lazy_turn import LazyTurn, Push
from geneva_cli.table import Table, record_table

FINE = 33  # places about a peak, in each round of the search
ROUNDS = 6
FIELDS = ("max", "at_deg", "entry", "exit")
QUANTITIES = ("velocity", "acceleration", "jerk", "power")


def steady_turn(result: Turned) -> LazyTurn:
    """Return the last turn of the crank forwards, after which the wheel rests as before.

    Raises GenevaError if the wheel jams or is not turned.
    """
    if not result.turns:
        raise GenevaError(
            "the wheel does not turn, so there is no motion: `geneva check` says where it jams",
            ("outline",),
        )
    turns = result.senses[0].turns
    if result.rest.high - result.rest.low < LOOSE:
        return turns[0]
    steps = (len(turns) - 1) * result.machine.step
    last = turns[-1]
    pushes = tuple(
        p._replace(begin_wheel=p.begin_wheel - steps, end_wheel=p.end_wheel - steps)
        for p in last.pushes
    )
    moved = (last.wheel - steps, last.low - steps, last.high - steps)
    return LazyTurn(last.crank, *moved, pushes, last.jam)


def motion(mechanism: Mechanism, samples: int, at_deg: Sequence[float] | None = None) -> Table:
    """Return ``samples`` rows, evenly spaced in the input angle, over a period from the entry.

    With ``at_deg`` they are at those input angles from mid-motion instead. Raises GenevaError for a
    number of samples out of range, angles that are no numbers, and if the wheel does not turn.
    """
    if at_deg is None:
        check_samples(samples)
        input_deg = inputs(mechanism, samples, 0, samples)
    else:
        input_deg = checked_angles(at_deg)
    result = turned(mechanism)
    turn = steady_turn(result)
    theta, whole = crank_jet(mechanism, input_deg)
    laps = np.floor((theta.c[0] - turn.crank[0]) / math.tau)
    wheel, rates = at_crank(result, turn, theta.c[0] - math.tau * laps)
    velocity, acceleration, jerk = by_input(wheel, rates, theta)
    shown = np.degrees(wheel + (whole + laps) * turn.gained)
    columns = [times_s(mechanism, input_deg), input_deg, shown, velocity, acceleration, jerk]
    of_velocity, of_acceleration = rates_at_speed(mechanism).values()
    columns += [velocity * of_velocity, acceleration * of_acceleration]
    return Table(motion_columns(mechanism), columns)


def at_crank(result: Turned, turn: LazyTurn, crank: Array) -> tuple[Array, list[Array]]:
    """Return the wheel's angle and three derivatives by the crank's, at crank angles of a turn.

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
            there = ranges.around(i, wheel[k])
            if not there.is_free:
                wheel[k] = min(there.low, there.high, key=lambda end: abs(end - wheel[k]))
        found = contacts(free, crank[inside], wheel[inside]).motion(crank[inside])
        for rate, own in zip(rates, found[1:], strict=True):
            rate[inside] = own
    return wheel, rates


def by_input(wheel: Array, rates: Sequence[Array], crank: Jet) -> tuple[Array, ...]:
    """Return velocity, acceleration and jerk by the input's angle, from those by the crank's."""
    outer = Jet((wheel, rates[0], rates[1] / 2.0, rates[2] / 6.0))
    return composed(outer, crank).arrays()[1:]


def peaks(mechanism: Mechanism) -> Table:
    """Return the greatest velocity, acceleration, jerk and power, as ``geneva peaks`` prints them.

    They are those inside the pushes; the hardest impact at a beginning is apart, as ``impact``.
    """
    result = turned(mechanism)
    turn = steady_turn(result)
    values: dict[str, object] = {"spec": mechanism.spec.path, "title": mechanism.spec.title or None}
    pushes = moving(turn)
    ends = np.array((inside(pushes[0])[0], inside(pushes[-1])[1]))
    best: dict[str, tuple[float, float]] = dict.fromkeys(QUANTITIES, (0.0, math.nan))
    for push in pushes:
        rows = turn.crank[(turn.crank >= push.begin) & (turn.crank <= push.end)]
        grid = np.unique(np.concatenate((rows, (push.begin, push.end))))
        grid[[0, -1]] = inside(push)
        known = _quantities(result, turn, mechanism, grid)
        for name in QUANTITIES:
            found = _peak(result, turn, mechanism, name, (grid, known[name]))
            if found[0] > best[name][0]:
                best[name] = found
    at_ends = _quantities(result, turn, mechanism, ends)
    for name, (size, at) in best.items():
        values[f"{name}.max"] = size
        values[f"{name}.at_deg"] = result.machine.assembly.shown_deg(math.degrees(at))
        first, last = at_ends[name]
        values[f"{name}.entry"] = abs(float(first))
        values[f"{name}.exit"] = abs(float(last))
    begin, end = (_input_deg(result, x) for x in (pushes[0].begin, pushes[-1].end))
    values["motion_deg"] = end - begin
    values["dwell_deg"] = mechanism.whole_deg - (end - begin)
    values["stations"] = None
    worst = hardest_impact(result)
    struck = None if worst is None else struck_by(mechanism, result, worst)
    for name in Struck._fields:
        values[f"impact.{name}"] = None if struck is None else getattr(struck, name)
    fields = {**dict.fromkeys(QUANTITIES, FIELDS), "power": FIELDS[:2]}
    names = [f"{name}.{field}" for name in QUANTITIES for field in fields[name]]
    ordered = ("spec", "title", *names, "motion_deg", "dwell_deg", "stations")
    ordered += tuple(f"impact.{name}" for name in Struck._fields)
    return record_table({name: values[name] for name in ordered})


def inside(push: Push) -> tuple[float, float]:
    """Return crank angles just inside a push, radians, where only its own contact touches."""
    return push.begin + 1e-9, push.end - 1e-7


def _input_deg(result: Turned, crank: float) -> float:
    """The input angle at a crank angle, degrees, which rises from turn to turn."""
    return result.machine.assembly.to_input(math.degrees(crank))


def _quantities(
    result: Turned, turn: LazyTurn, mechanism: Mechanism, crank: Array
) -> dict[str, Array]:
    """The quantities at crank angles in pushes, by the input's angle."""
    wheel, rates = at_crank(result, turn, crank)
    input_deg = np.array([_input_deg(result, float(x)) for x in crank])
    inner, _ = crank_jet(mechanism, input_deg)
    velocity, acceleration, jerk = by_input(wheel, rates, inner)
    power = velocity * acceleration
    return dict(zip(QUANTITIES, (velocity, acceleration, jerk, power), strict=True))


def _peak(
    result: Turned,
    turn: LazyTurn,
    mechanism: Mechanism,
    name: str,
    known: tuple[Array, Array],
) -> tuple[float, float]:
    """Return the greatest size of a quantity over a push, and its crank angle.

    ``known`` are its values over the push, with their crank angles before them.
    """
    grid, values = known
    best = (0.0, float(grid[0]))
    for k in range(ROUNDS):
        if k:
            values = _quantities(result, turn, mechanism, grid)[name]
        size = np.abs(values)
        top = int(np.argmax(size))
        if size[top] > best[0]:
            best = float(size[top]), float(grid[top])
        low, high = grid[max(top - 1, 0)], grid[min(top + 1, len(grid) - 1)]
        grid = np.linspace(low, high, FINE)
    return best
