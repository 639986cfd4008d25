"""The checks of a drawn machine, with what its turn gives in words."""

import math
from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.extras.outline import turning
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import DrawnMachine
from geneva_cli.extras.outline.turning import LOOSE, SenseResult, Struck, Turned, struck_by, turned
from geneva_cli.extras.outline.walls import smallest_wall
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import shown
from geneva_cli.geometry.shapes import at
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.defaults import wall_min
from geneva_cli.verdict.checks import Check, compared
from geneva_cli.verdict.checks.motion_checks import entry_velocity_limit

ROUNDING_DEG = 1e-3  # a smaller play comes from the slack
POINTS = 9  # of each piece, where parts overlap


def checks(mechanism: Mechanism) -> list[Check]:
    """The checks of a machine with drawn outlines, one after the other."""
    result = turned(mechanism)
    machine, rows = result.machine, [_turns(result, mechanism)]
    is_missed = result.rest.is_free and not any(sense.jam for sense in result.senses)
    if result.has_indexed or not is_missed:  # a wheel that finds no slot has no slack
        least, given, why = turning.least_slack_mm(result), machine.free.slack, ""
        if least is None:
            most = turning.most_slack_mm(machine)
            why = f"it would not turn with {most:.3g} mm less on every face either"
        elif least > given:
            why = (
                f"it would turn with {least:.2g} mm less on every face of the wheel or of the crank"
            )
        rows.append(Check("turning_slack_mm", least, "at most", given, not why, why))
    holds = result.is_held or mechanism.spec.wheel.held_by is not None
    rows.append(compared("dwell_hold", float(holds), "at least", 1.0))
    rows += [*_rests(result), *_walls(machine), *_entry(result, mechanism)]
    if result.turns and not turning.put_back(machine, result.rest):
        # a wheel that keeps its place rests at the same place after each index
        drift = math.degrees(max(abs(sense.drift) for sense in result.senses))
        play = math.degrees(result.rest.high - result.rest.low)
        rows.append(compared("drift_deg", drift, "at most", play))
    return rows


def as_built(mechanism: Mechanism) -> list[Check]:
    """The checks that our own parts on a crank as built turn, and of their impact."""
    result = turned(mechanism)
    check, struck = _turns(result, mechanism), struck_by(mechanism, result)
    if not check.passes or struck is None:
        return [check]
    words = "roller, clearance and disc strike the wheel"
    return [check, _struck("strike_velocity", mechanism, struck, lambda: words)]


def _struck(name: str, mechanism: Mechanism, struck: Struck, words: Callable[[], str]) -> Check:
    """The check of an impact's velocity, over the input's."""
    limit, (at_deg, jump, *_) = entry_velocity_limit(mechanism), struck.impact
    speed, reason = abs(jump).item(), lambda: words() + struck.text
    return compared(name, speed, "at most", limit, at_deg.item(), reason=reason)


def warnings(mechanism: Mechanism) -> list[Notice]:
    """The warnings about drawings: how they were read."""
    return list(turned(mechanism).machine.notes)


def _turns(result: Turned, mechanism: Mechanism) -> Check:
    machine, z, passed, at_deg = result.machine, float(mechanism.spec.wheel.z), 0.0, None
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
            why += "; the crank is our own: give its drawing with --crank, or set "
            why += "lock_radius_mm = 0 in [size] if it has no locking disc"
    elif worst.jam is not None:
        passed, at_deg = float(worst.passed), _shown_deg(machine, worst.jam.crank)
        why = "; ".join(dict.fromkeys(_jam_text(machine, s) for s in result.senses if s.jam))
    elif not result.has_indexed:
        index = abs(math.degrees(worst.first.gained))
        why = (
            f"the crank turns, but the wheel goes on by {index:.4g}° only: no roller finds a "
            "slot; check [size], wheel_turn_deg and crank_turn_deg in [outline]"
        )
    else:
        return Check("turns", z, "at least", z, True, _summary(result))
    return Check("turns", passed, "at least", z, False, why, at_deg)


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
    own, theirs = touching.wheel.named(0), touching.crank.named(0)
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
    index, is_moving = math.degrees(turn.gained) / len(machine.assembly.motions), turn.is_moving
    free = np.degrees(turn.high - turn.low)
    rest = math.degrees(result.rest.high - result.rest.low)
    first, last = turn.pushes[0], max(turning.moving(turn), default=turn.pushes[0])
    begin, end = _shown_deg(machine, first.begin), _shown_deg(machine, last.end)
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
    return text


def lag_deg(result: Turned) -> float:
    """How far the wheel lags behind the ideal motion at most, degrees."""
    turn, place = result.senses[0].first, result.machine.assembly
    at_deg, moves = np.degrees(turn.crank), np.zeros(len(turn.crank), dtype=bool)
    for motion in place.motions:
        moves |= (motion.entry < at_deg) & (at_deg < motion.exit)
    behind = place.wheel(at_deg) - turn.wheel
    return math.degrees(float(behind[moves].max(initial=0.0)))


def _rests(result: Turned) -> Iterator[Check]:
    """Check the places of rest from which the wheel turns, where it may stand in a range."""
    is_free, *ends = result.rest
    low, high = map(math.degrees, ends)
    if ends[1] - ends[0] < LOOSE or not is_free:
        return
    places = turning.turning(result) or (result.machine.rest, result.machine.rest)
    begin, end = map(math.degrees, places)
    whole = end - begin > (high - low) * (1.0 - 1e-6)
    value, text = high - low if whole else end - begin, "from no place of rest it turns"
    if value:
        text = f"turns if it rests between {begin:.5g} and {end:.5g}°"
        text += f", and may stand between {low:.5g} and {high:.5g}°"
    is_put_back = turning.put_back(result.machine, result.rest)
    bound = ("above", 0.0) if is_put_back else ("at least", high - low)
    yield compared("turning_rests_deg", value, *bound, reason=lambda: text)


def _walls(machine: DrawnMachine) -> Iterator[Check]:
    """Check the smallest wall of a drawn wheel; an internal one without its ring has none."""
    spec, place = machine.assembly.mechanism.spec, machine.assembly
    if spec.outline.wheel is None or (place.sign < 0.0 and len(machine.wheel) == 1):
        return
    sector = Polyarc(machine.wheel).one_sector(math.tau / spec.wheel.z, machine.free.slack)
    if wall := smallest_wall(machine.wheel, sector):
        start, end = (shown((z.real, z.imag)) for z in wall[1:])
        text, least = f"thinnest from {start} to {end}", wall_min(spec.size, place.L)
        yield compared("wall_mm", wall[0], "at least", least, reason=lambda: text)


def _entry(result: Turned, mechanism: Mechanism) -> Iterator[Check]:
    """Check the velocity, over the input's, with which the wheel is set in motion."""
    machine, struck = result.machine, struck_by(mechanism, result)
    if struck is None or not result.rest.is_free:
        return

    def words() -> str:
        R, L = math.hypot(*machine.roller.centre), machine.assembly.L
        ideal = mechanism.ratio * L
        if mechanism.engagements[0].built:  # radial slots on a crank that was built for others
            ideal = L * math.sin(math.pi / mechanism.spec.wheel.z)
        why = f"the wheel is set in motion at {_from_rest(machine, struck.wheel):.5g}°"
        if abs(R - ideal) > 1e-4 * ideal:
            why += f"; R is {R:.5g} mm, and {ideal:.5g} would enter without an impact"
        with suppress(GenevaError):
            own = parts_of(mechanism).flat.outlines.sizes.rim
            sign, wheel = machine.assembly.sign, machine.free.stops.outline
            corners = np.hypot(wheel.x0, wheel.y0)
            rim = float(corners.max() if sign > 0.0 else corners.min())
            if sign * (own - rim) > 1e-3:
                why += f"; the rim is at {rim:.5g} mm, and must reach {own:.4g}"
        return why

    yield _struck("entry_velocity_max", mechanism, struck, words)
