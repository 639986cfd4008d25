"""A whole turn: gaps, the wheel's play, what ``[tolerance]`` needs, and the proof of the gap.

A play is an angle, or the travel of a rack: each check has a name for either unit.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from operator import attrgetter

from geneva_cli.errors import GenevaError
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.full_turn import FullTurn
from geneva_cli.parts.turn.turn_certificate import UNKNOWN, certificate
from geneva_cli.verdict.checks import Check, compared

DRY_FRICTION = 0.3  # of a sliding pair that nobody greases: steel on steel or PLA on PLA


def slips_deg(friction: float) -> float:
    """The pressure angle from which friction alone holds a roller on a corner, degrees.

    Without a coefficient it is that of dry steel or plastic.

    >>> round(slips_deg(0.0), 2), slips_deg(1.0)
    (73.3, 45.0)
    """
    return 90.0 - math.degrees(math.atan(friction or DRY_FRICTION))


def motion_play_max(parts: Parts) -> float:
    """The play, degrees to either side, up to which a slot determines the wheel's motion."""
    # Where the driving wall changes, the wheel falls behind by twice the play, a tenth of its step,
    # and strikes the other wall: such a slot does not determine the motion.
    half = min(map(attrgetter("half_step"), parts.assembly.kinds))
    return 0.05 * (2.0 * math.degrees(half))


def turning(names: Collection[str], parts: Parts, turn: FullTurn) -> Iterator[Check]:
    """What holds the wheel, gaps between wheel and crank, and how far the wheel is free."""
    machine, touch = parts.assembly.full, parts.contact
    output, unit = machine.output, machine.output.unit
    holds = machine.spec.wheel.held_by is not None or turn.holds
    yield Check("dwell_hold", float(holds), "at least", 1.0, holds)
    smallest, idle = turn.smallest, turn.idle  # negative where they overlap
    gap = 0.0 if abs(smallest.mm) <= touch else smallest.mm
    yield compared("gap_mm", gap, "at least", 0.0, smallest.at_deg, touch)
    if idle is not None:  # a roller that does not drive the wheel
        gap = max(idle.mm, 0.0) if idle.mm >= -touch else idle.mm
        yield compared("idle_roller_mm", gap, "at least", 0.0, idle.at_deg, touch)
    plays = {f"motion_play_{unit}": (turn.motion, motion_play_max(parts))}
    if parts.locked:
        # the play with which the roller would just meet the mouth of its slot
        sizes, moves = parts.sizes, parts.assembly.plane_motion
        finds = math.degrees(moves.half_span(sizes.half_width, sizes.rim))
        plays[f"dwell_play_{unit}"] = turn.dwell, finds
        plays[f"hand_over_play_{unit}"] = turn.hand_over, finds
    for name in names:
        if name in plays:
            play, limit = plays[name]
            value, at_deg = output.from_deg(play.deg), play.at_deg if play.deg else None
            yield compared(name, value, "at most", output.from_deg(limit), at_deg)
        elif name == "hand_over_pressure_deg" and parts.locked:
            # at which the roller meets a wheel that has turned through that play
            push, slips = turn.push, slips_deg(machine.spec.load.friction)
            yield compared(name, push.deg, "at most", slips, push.at_deg if push.deg else None)
        elif name == "hand_over_offset_mm":
            # from the slot's middle, beyond its clearance, of a roller that first touches: not 0
            # where the mouth does not reach the roller at entry or exit
            offset, at_deg = turn.contact
            yield compared(name, offset, "at most", 0.0, at_deg if offset else None)


def within_tolerances(names: Collection[str], parts: Parts, turn: FullTurn) -> Iterator[Check]:
    """Plays that ``[limits]`` bounds, and the clearances per side that ``[tolerance]`` needs."""
    machine = parts.assembly.full
    limits, own = machine.spec.limits, machine.spec.size.allowances
    unlocked = "not computed, because no drawn locking disc holds the wheel at rest"
    for name, play in (("index_play_max_deg", turn.motion), ("dwell_play_max_deg", turn.dwell)):
        limit = limits.as_dict()[name]
        if limit is None:
            continue
        if parts.locked or play is turn.motion:
            yield compared(name, play.deg, "at most", limit, play.at_deg if play.deg else None)
        else:
            yield Check(name, None, "at most", limit, None, unlocked)
    limit = limits.dwell_position_max_deg
    if limit is not None and "dwell_position_max_deg" in names:
        from geneva_cli.verdict.tolerance import worst_dwell_deg

        # the greatest error of the resting wheel
        why = unlocked
        try:
            worst = worst_dwell_deg(machine, parts)
        except GenevaError as error:
            worst, why = None, str(error)
        unknown = Check("dwell_position_max_deg", None, "at most", limit, None, why)
        yield unknown if worst is None else compared(unknown.name, worst, "at most", limit)
    if machine.spec.tolerance.is_given and machine.output.turns:
        # a spec without tolerances is checked without their modules
        from geneva_cli.loads.tolerance.motion_error import used
        from geneva_cli.verdict.tolerance import needed_mm

        slot_mm, lock_mm = needed_mm(machine, parts, used(machine))
        yield compared("tolerance_slot_mm", own.slot_clearance_mm, "at least", slot_mm)
        if lock_mm is not None:  # a disc holds the wheel
            yield compared("tolerance_lock_mm", own.lock_clearance_mm, "at least", lock_mm)


def proof(names: Collection[str], parts: Parts, to_mm: float | None) -> Iterator[Check]:
    """The proved lower bound of the gap, mm; none where parts are known to overlap.

    ``to_mm`` is how far below the smallest gap the bound may be: by default 1 um, or twice the
    overlap that counts as touching, if that is more.
    """
    gap, name = parts.turned.turn.smallest.mm, "gap_proved_mm"
    if gap < -parts.contact:
        return
    to_mm = to_mm or max(1e-3, 2.0 * parts.contact)
    found = certificate(parts, gap, to_mm)
    if not found.open:
        why = f"collision-free, proved to {1e3 * to_mm:.3g} µm ({found.intervals:,} intervals)"
        yield compared(name, found.least_mm, "at least", -to_mm)._replace(why=why)
        return
    start, end, known, least = found.open
    bound = "no bound is known" if least <= -0.5 * UNKNOWN else f"at least {least:.4g} mm"
    why = (
        f"sampled collision check; the proof is open from {start:.9g} to {end:.9g}° between "
        f"{found.between}, after {found.intervals:,} intervals. There the gap is {known:.4g} mm in "
        f"the middle and {bound} throughout"
    )
    check = Check(name, None, "at least", -to_mm, None, why)
    if known < -max(to_mm, parts.contact):
        check = check._replace(value=known, at_deg=0.5 * (start + end), passes=False)
    yield check
