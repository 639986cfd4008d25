"""The checks of a drawn machine, with what its turn gives in words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import DrawnMachine
from geneva_cli.extras.outline.turning import (
    LOOSE,
    SenseResult,
    Turned,
    hardest_impact,
    least_slack_mm,
    most_slack_mm,
    moving,
    put_back,
    struck_by,
    turned,
    turning,
)
from geneva_cli.extras.outline.walls import smallest_wall
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import shown
from geneva_cli.geometry.shapes import at
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.free_ranges import one_sector
from geneva_cli.spec.defaults import wall_min
from geneva_cli.verdict.checks import Check, compared
from geneva_cli.verdict.checks.motion_checks import entry_velocity_limit

ROUNDING_DEG = 1e-3  # a smaller play comes from the slack
POINTS = 9  # of each piece, where parts overlap
TURNED_WRONG = 0.25  # of the index: no slot is so loose


def checks(mechanism: Mechanism) -> list[Check]:
    """The checks of a machine with drawn outlines, one after the other."""
    result = turned(mechanism)
    machine, rows = result.machine, [_turns(result, mechanism)]
    is_missed = result.rest.is_free and not any(sense.jam for sense in result.senses)
    if result.has_indexed or not is_missed:  # a wheel that finds no slot has no slack
        least, given, why = least_slack_mm(result), machine.free.slack, ""
        if least is None:
            most = most_slack_mm(machine)
            why = f"it would not turn with {most:.3g} mm less on every face either"
        elif least > given:
            less = f"{least:.2g} mm less on every face"
            why = f"it would turn with {less} of the wheel or of the crank"
        rows.append(Check("turning_slack_mm", least, "at most", given, not why, why))
    holds = result.is_held or mechanism.spec.wheel.held_by is not None
    rows.append(Check("dwell_hold", float(holds), "at least", 1.0, holds))
    rows += [*_rests(result), *_walls(machine), *_entry(result, mechanism)]
    if result.turns and not put_back(machine, result.rest):
        # a wheel that keeps its place rests at the same place after each index
        play, drift = result.rest.high - result.rest.low, max(abs(s.drift) for s in result.senses)
        value, limit = math.degrees(drift), math.degrees(play)
        rows.append(Check("drift_deg", value, "at most", limit, drift <= play))
    return rows


def as_built(mechanism: Mechanism) -> list[Check]:
    """The checks that our own parts on a crank as built turn, and of their impact."""
    result = turned(mechanism)
    check, worst = _turns(result, mechanism), hardest_impact(result)
    if not check.passes or worst is None:
        return [check]
    struck, limit = struck_by(mechanism, result, worst), entry_velocity_limit(mechanism)
    row = compared("strike_velocity", abs(struck.jump), "at most", limit, struck.at_deg)
    text = f"roller, clearance and disc strike the wheel{struck.text}"
    return [check, row if row.passes else row._replace(why=text)]


def warnings(mechanism: Mechanism) -> list[Notice]:
    """The warnings about drawings: how they were read."""
    return list(turned(mechanism).machine.notes)


def _turns(result: Turned, mechanism: Mechanism) -> Check:
    machine, z = result.machine, float(mechanism.spec.wheel.z)
    worst = min(result.senses, key=lambda sense: sense.passed)
    if not result.rest.is_free:
        why = "parts overlap in the middle of the dwell"
        pieces = [piece for shape in machine.crank for piece in shape.segments]
        places = np.linspace(0.0, 1.0, POINTS).tolist()
        depth, where = machine.deepest([at(piece, t) for piece in pieces for t in places])
        if depth > 0.0:
            why += f": the crank is {depth:.3g} mm inside the wheel at {shown(where)} in its frame"
        why += "; check wheel_turn_deg, crank_turn_deg and mirror in [outline]"
        if mechanism.spec.outline.crank is None:
            why += (
                "; the crank is our own: give its drawing with --crank, or set lock_radius_mm = 0 "
                "in [size] if it has no locking disc"
            )
        return Check("turns", 0.0, "at least", z, False, why)
    if worst.jam is not None:
        at_deg = _shown_deg(machine, worst.jam.crank)
        why = "; ".join(dict.fromkeys(_jam_text(machine, s) for s in result.senses if s.jam))
        return Check("turns", float(worst.passed), "at least", z, False, why, at_deg)
    if not result.has_indexed:
        index = math.degrees(worst.first.gained)
        why = (
            f"the crank turns, but the wheel goes on by {abs(index):.4g}° only: no roller finds a "
            "slot; check [size], wheel_turn_deg and crank_turn_deg in [outline]"
        )
        return Check("turns", 0.0, "at least", z, False, why)
    return Check("turns", z, "at least", z, True, _summary(result))


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


def _from_rest(machine: DrawnMachine, wheel: float) -> float:
    """A wheel's angle in its own step, degrees from the middle of it."""
    step = machine.step / len(machine.assembly.motions)
    return math.degrees(math.remainder(wheel - machine.rest, step) + machine.rest)


def _shown_deg(machine: DrawnMachine, crank: float) -> float:
    return machine.assembly.shown_deg(math.degrees(crank))


def _summary(result: Turned) -> str:
    machine, turn = result.machine, result.senses[0].first
    index = math.degrees(turn.gained) / len(machine.assembly.motions)
    is_moving = turn.is_moving
    free = np.degrees(turn.high - turn.low)
    rest = math.degrees(result.rest.high - result.rest.low)
    first = turn.pushes[0]
    begin, end = (
        _shown_deg(machine, x) for x in (first.begin, max(moving(turn), default=first).end)
    )
    play, in_motion = (
        f"{x:.4g}° of play" if x > ROUNDING_DEG else "no play"
        for x in (rest, float(free[is_moving].max(initial=0.0)))
    )
    held = f"{play} in the dwell" if result.is_held else "nothing holds it in the dwell"
    text = (
        f"turns both ways through every slot: index {index:.7g}°, moved from {begin:.5g} to "
        f"{end:.5g}° of the input, {held}, {in_motion} in motion"
    )
    widest = float(free[~is_moving].max(initial=0.0))
    if result.is_held and widest > rest + ROUNDING_DEG:
        text += f", at most {widest:.4g}° while it rests"
    lag = lag_deg(result)
    if lag > ROUNDING_DEG:
        text += f"; it lags up to {lag:.3g}° behind the ideal motion"
    if lag > TURNED_WRONG * index:
        text += ": are wheel_turn_deg and crank_turn_deg in [outline] right?"
    return text


def lag_deg(result: Turned) -> float:
    """How far the wheel lags behind the ideal motion at most, degrees."""
    turn, worst, passed = result.senses[0].first, 0.0, 0.0
    at_deg = np.degrees(turn.crank)
    for engagement, mid in result.machine.assembly.motions:
        inside = (at_deg - mid > engagement.entry_deg) & (at_deg - mid < engagement.exit_deg)
        ideal = engagement.motion(at_deg[inside] - mid, 0).arrays()[0]
        behind = passed + ideal - turn.wheel[inside]
        worst = max(worst, math.degrees(float(np.max(behind, initial=0.0))))
        passed += 2.0 * engagement.half_step
    return worst


def _rests(result: Turned) -> Iterator[Check]:
    """Check the places of rest from which the wheel turns, where it may stand in a range."""
    is_free, low, high = result.rest
    if high - low < LOOSE or not is_free:
        return
    begin, end = turning(result) or (result.machine.rest, result.machine.rest)
    is_put_back = put_back(result.machine, result.rest)
    limit = 0.0 if is_put_back else math.degrees(high - low)
    whole = end - begin > (high - low) * (1.0 - 1e-6)
    value = math.degrees(high - low if whole else end - begin)
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
    sector = one_sector(Polyarc(machine.wheel), math.tau / spec.wheel.z, machine.free.slack)
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
    machine, worst = result.machine, hardest_impact(result)
    if worst is None or not result.rest.is_free:
        return
    struck, limit = struck_by(mechanism, result, worst), entry_velocity_limit(mechanism)
    row = compared("entry_velocity_max", abs(struck.jump), "at most", limit, struck.at_deg)
    if row.passes:
        yield row
        return
    R, ideal = machine.roller.distance, machine.roller.ideal_distance
    text = f"the wheel is set in motion at {_from_rest(machine, worst.wheel):.5g}°"
    if abs(R - ideal) > 1e-4 * ideal:
        text += f"; R is {R:.5g} mm, and {ideal:.5g} would enter without an impact"
    with suppress(GenevaError):
        own = parts_of(mechanism).flat.outlines.sizes.rim
        sign, wheel = machine.assembly.sign, machine.free.whole
        corners = np.hypot(wheel.x0, wheel.y0)
        rim = float(corners.max() if sign > 0.0 else corners.min())
        if sign * (own - rim) > 1e-3:
            text += f"; the rim is at {rim:.5g} mm, and must reach {own:.4g}"
    yield row._replace(why=f"{text}{struck.text}")
