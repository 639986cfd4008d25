"""The checks of a drawn machine, with what its turn gives in words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.impact_force import strike_text, struck_by
from geneva_cli.extras.outline.machine import DrawnMachine
from geneva_cli.extras.outline.slack import least_slack_mm, most_mm
from geneva_cli.extras.outline.turning import (
    LOOSE,
    Impact,
    SenseResult,
    Turned,
    hardest_impact,
    moving,
    put_back,
    turned,
    turning,
)
from geneva_cli.extras.outline.walls import smallest_wall
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import shown
from geneva_cli.geometry.measure import at
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.free_ranges import one_sector
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.verdict.checks.check import Check, compared
from geneva_cli.verdict.checks.motion_checks import entry_velocity_limit

ROUNDING_DEG = 1e-3  # a smaller play comes from the slack
POINTS = 9  # of each piece, where parts overlap
TURNED_WRONG = 0.25  # of the index: no slot is so loose


def checks(mechanism: Mechanism) -> list[Check]:
    """Return the checks of a machine with drawn outlines, one after the other.

    Raises GenevaError for a drawing that is no outline.
    """
    result = turned(mechanism)
    rows = [_turns(result, mechanism), *_slack(result), _hold(result, mechanism)]
    rows += [*_rests(result, mechanism), *_walls(result.machine)]
    return [*rows, *_entry(result, mechanism), *_drift(result, mechanism)]


def as_built(mechanism: Mechanism) -> list[Check]:
    """Return the checks that our own parts on a crank as built turn, and of their impact.

    Raises GenevaError for parts that are not flat, or whose rollers go round no crank.
    """
    result = turned(mechanism)
    check = _turns(result, mechanism)
    worst = hardest_impact(result)
    if not check.passes or worst is None:
        return [check]
    struck = struck_by(mechanism, result, worst)
    limit = entry_velocity_limit(mechanism)
    row = compared("strike_velocity", abs(struck.jump), "at most", limit, struck.at_deg)
    text = f"roller, clearance and disc strike the wheel{strike_text(struck)}"
    return [check, row if row.passes else row._replace(why=text)]


def warnings(mechanism: Mechanism) -> list[Notice]:
    """Return the warnings about drawings: how they were read."""
    return list(turned(mechanism).machine.notes)


def _turns(result: Turned, mechanism: Mechanism) -> Check:
    z = mechanism.spec.wheel.z
    worst = min(result.senses, key=lambda sense: sense.passed)
    if not result.rest.is_free:
        why = _overlap_text(result.machine, mechanism)
        return Check("turns", 0.0, "at least", float(z), False, why)
    if worst.jam is not None:
        at = _shown_deg(result.machine, worst.jam.crank)
        why = "; ".join(dict.fromkeys(_jam_text(result.machine, s) for s in result.senses if s.jam))
        return Check("turns", float(worst.passed), "at least", float(z), False, why, at)
    if not result.has_indexed:
        index = math.degrees(worst.first.gained)
        why = (
            f"the crank turns, but the wheel goes on by {abs(index):.4g}° only: no roller finds a "
            "slot; check [size], wheel_turn_deg and crank_turn_deg in [outline]"
        )
        return Check("turns", 0.0, "at least", float(z), False, why)
    return Check("turns", float(z), "at least", float(z), True, _summary(result, mechanism))


def _slack(result: Turned) -> Iterator[Check]:
    """Check the least slack with which the wheel turns; a wheel that finds no slot has none."""
    machine = result.machine
    is_missed = result.rest.is_free and not any(sense.jam for sense in result.senses)
    if is_missed and not result.has_indexed:
        return
    value, given = least_slack_mm(result), machine.free.slack
    if value is None:
        why = f"it would not turn with {most_mm(machine):.3g} mm less on every face either"
        yield Check("turning_slack_mm", None, "at most", given, False, why)
    elif value > given:
        why = f"it would turn with {value:.2g} mm less on every face of the wheel or of the crank"
        yield Check("turning_slack_mm", value, "at most", given, False, why)
    else:
        yield Check("turning_slack_mm", value, "at most", given, True)


def _jam_text(machine: DrawnMachine, sense: SenseResult) -> str:
    """Where the wheel jams, and what meets there."""
    assert sense.jam is not None
    crank, wheel = sense.jam.crank, sense.jam.wheel
    way = "forwards" if sense.way > 0 else "backwards"
    text = (
        f"jams {way} at input angle {_shown_deg(machine, crank):.6g}° with the wheel at "
        f"{_from_rest(machine, wheel):.6g}°"
    )
    # just beyond the jam, where the parts overlap a little
    beyond = np.array([crank + 1e-8 * sense.way])
    touching = contacts(machine.free, beyond, np.array([wheel]), near=0.5, lever=-1.0)
    if not touching.is_known[0]:
        return text
    own, theirs = touching.named(0)
    where = shown((float(touching.point[0, 0]), float(touching.point[0, 1])))
    return f"{text}: {theirs} of the crank meets {own} of the wheel at {where} in its own frame"


def _overlap_text(machine: DrawnMachine, mechanism: Mechanism) -> str:
    """Where the crank lies deepest in the wheel, in the middle of the dwell."""
    text = "parts overlap in the middle of the dwell"
    fractions = np.linspace(0.0, 1.0, POINTS)
    points = [at(p, float(t)) for shape in machine.crank for p in shape.segments for t in fractions]
    depth, where = machine.deepest(points)
    if depth > 0.0:
        text += f": the crank is {depth:.3g} mm inside the wheel at {shown(where)} in its frame"
    hint = "check wheel_turn_deg, crank_turn_deg and mirror in [outline]"
    if mechanism.spec.outline.crank is None:
        hint += (
            "; the crank is our own: give its drawing with --crank, or set lock_radius_mm = 0 in "
            "[size] if it has no locking disc"
        )
    return f"{text}; {hint}"


def _from_rest(machine: DrawnMachine, wheel: float) -> float:
    """A wheel's angle in its own step, degrees from the middle of it."""
    step = machine.step / machine.slots_a_turn
    return math.degrees(math.remainder(wheel - machine.rest, step) + machine.rest)


def _shown_deg(machine: DrawnMachine, crank: float) -> float:
    return machine.assembly.shown_deg(math.degrees(crank))


def _summary(result: Turned, mechanism: Mechanism) -> str:
    """What the turn gives, in words."""
    machine, turn = result.machine, result.senses[0].first
    index = math.degrees(turn.gained) / machine.slots_a_turn
    is_moving = turn.is_moving
    free = np.nan_to_num(np.degrees(turn.high - turn.low))
    rest = math.degrees(result.rest.high - result.rest.low)
    first = turn.pushes[0]
    last = max(moving(turn), default=first)
    begin, end = (_shown_deg(machine, x) for x in (first.begin, last.end))
    text = (
        f"turns both ways through every slot: index {index:.7g}°, moved from {begin:.5g} to "
        f"{end:.5g}° of the input, "
    )
    held = f"{_play(rest)} in the dwell" if result.is_held else "nothing holds it in the dwell"
    text += f"{held}, {_play(float(free[is_moving].max(initial=0.0)))} in motion"
    widest = float(free[~is_moving].max(initial=0.0))
    if result.is_held and widest > rest + ROUNDING_DEG:
        text += f", at most {widest:.4g}° while it rests"
    lag = lag_deg(result)
    if lag > ROUNDING_DEG:
        text += f"; it lags up to {lag:.3g}° behind the ideal motion"
    if lag > TURNED_WRONG * index:
        text += ": are wheel_turn_deg and crank_turn_deg in [outline] right?"
    return text


def _play(value_deg: float) -> str:
    return f"{value_deg:.4g}° of play" if value_deg > ROUNDING_DEG else "no play"


def lag_deg(result: Turned) -> float:
    """Return how far the wheel lags behind the ideal motion at most, degrees."""
    turn, worst = result.senses[0].first, 0.0
    at = np.degrees(turn.crank)
    passed = 0.0
    for engagement, mid in result.machine.assembly.motions:
        inside = (at - mid > engagement.entry_deg) & (at - mid < engagement.exit_deg)
        ideal = engagement.motion(at[inside] - mid, 0).arrays()[0]
        behind = passed + ideal - turn.wheel[inside]
        worst = max(worst, math.degrees(float(np.max(behind, initial=0.0))))
        passed += 2.0 * engagement.half_step
    return worst


def _hold(result: Turned, mechanism: Mechanism) -> Check:
    """Check that the outlines hold the wheel in the dwell, or ``held_by`` of the spec."""
    holds = result.is_held or mechanism.spec.wheel.held_by is not None
    return Check("dwell_hold", float(holds), "at least", 1.0, holds)


def _rests(result: Turned, mechanism: Mechanism) -> Iterator[Check]:
    """Check the places of rest from which the wheel turns, where it may stand in a range."""
    low, high = result.rest.low, result.rest.high
    if high - low < LOOSE or not result.rest.is_free:
        return
    begin, end = turning(result) or (result.machine.rest, result.machine.rest)
    is_put_back = put_back(result.machine, result.rest)
    limit = 0.0 if is_put_back else math.degrees(high - low)
    value = math.degrees(end - begin)
    if end - begin > (high - low) * (1.0 - 1e-6):
        value = math.degrees(high - low)
    ok = value > 0.0 if is_put_back else value >= limit
    text = "from no place of rest it turns"
    if value:
        a, b = math.degrees(begin), math.degrees(end)
        text = f"turns if it rests between {a:.5g} and {b:.5g}°"
        text += f", and may stand between {math.degrees(low):.5g} and {math.degrees(high):.5g}°"
    must_be = "above" if is_put_back else "at least"
    yield Check("turning_rests_deg", value, must_be, limit, ok, "" if ok else text)


def _walls(machine: DrawnMachine) -> Iterator[Check]:
    """Check the smallest wall of a drawn wheel; an internal one without its ring has none."""
    spec, place = machine.assembly.mechanism.spec, machine.assembly
    if spec.outline.wheel is None or (place.sign < 0.0 and len(machine.wheel) == 1):
        return
    outline = Polyarc(machine.wheel)
    sector = one_sector(outline, math.tau / spec.wheel.z, machine.free.slack)
    wall = smallest_wall(machine.wheel, sector)
    if wall is None:
        return
    least = wall_min(spec.size, place.L)
    passes = keeps(wall.thickness, "at least", least)
    start, end = (shown((z.real, z.imag)) for z in (wall.start, wall.end))
    why = "" if passes else f"thinnest from {start} to {end}"
    yield Check("wall_mm", wall.thickness, "at least", least, passes, why)


def _entry(result: Turned, mechanism: Mechanism) -> Iterator[Check]:
    """Check the velocity, over the input's, with which the wheel is set in motion."""
    worst = hardest_impact(result)
    if worst is None or not result.rest.is_free:
        return
    struck, limit = struck_by(mechanism, result, worst), entry_velocity_limit(mechanism)
    row = compared("entry_velocity_max", abs(struck.jump), "at most", limit, struck.at_deg)
    text = f"{_ideal_text(result, mechanism, worst)}{strike_text(struck)}"
    yield row if row.passes else row._replace(why=text)


def _ideal_text(result: Turned, mechanism: Mechanism, worst: Impact) -> str:
    """What would enter without an impact."""
    roller = result.machine.roller
    R, ideal = roller.distance, roller.ideal_distance
    text = f"the wheel is set in motion at {_from_rest(result.machine, worst.wheel):.5g}°"
    if abs(R - ideal) > 1e-4 * ideal:
        text += f"; R is {R:.5g} mm, and {ideal:.5g} would enter without an impact"
    with suppress(GenevaError):
        own = parts_of(mechanism).flat.outlines.sizes.rim
        sign, wheel = result.machine.assembly.sign, result.machine.free.whole
        corners = np.hypot(wheel.x0, wheel.y0)
        rim = float(corners.max() if sign > 0.0 else corners.min())
        if sign * (own - rim) > 1e-3:
            text += f"; the rim is at {rim:.5g} mm, and must reach {own:.4g}"
    return text


def _drift(result: Turned, mechanism: Mechanism) -> Iterator[Check]:
    """Check that a wheel which keeps its place rests at the same place after each index."""
    play = result.rest.high - result.rest.low
    if put_back(result.machine, result.rest) or not result.turns:
        return
    drift = max(abs(sense.drift) for sense in result.senses)
    drift_deg, limit = math.degrees(drift), math.degrees(play)
    yield Check("drift_deg", drift_deg, "at most", limit, drift <= play)
