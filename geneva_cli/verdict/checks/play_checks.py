"""A whole turn: gaps, the wheel's play, what ``[tolerance]`` needs, and the proof of the gap.

A play is an angle, or the travel of a rack: each check has a name for either unit.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.full_turn import FullTurn, Most
from geneva_cli.parts.turn.turn_certificate import UNKNOWN, Certificate, certificate
from geneva_cli.verdict.checks.check import Check, compared

DRY_FRICTION = 0.3  # of a sliding pair that nobody greases: steel on steel or PLA on PLA


def smallest_gap(name: str, parts: Parts, turn: FullTurn) -> Check:
    """The smallest gap between wheel and crank, mm, negative where they overlap."""
    smallest, touch = turn.smallest, parts.contact
    value = 0.0 if abs(smallest.mm) <= touch else smallest.mm
    return compared(name, value, "at least", 0.0, smallest.at_deg, touch)


def idle_roller(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The smallest gap between the wheel and a roller that does not drive it."""
    idle, touch = turn.idle, parts.contact
    if idle is None:
        return None
    gap = max(idle.mm, 0.0) if idle.mm >= -touch else idle.mm
    return compared(name, gap, "at least", 0.0, idle.at_deg, touch)


def dwell_hold(name: str, parts: Parts, turn: FullTurn) -> Check:
    """Check that something holds the wheel: its lock, or ``held_by`` of the spec."""
    holds = parts.assembly.full.spec.wheel.held_by is not None or turn.holds
    return Check(name, float(holds), "at least", 1.0, holds)


def play(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The play in the dwell, between lock and slot, or of the roller in its slot.

    Each has a name for either unit of a machine's output. With the first two the next roller must
    still enter its slot.
    """
    what, _, unit = name.rpartition("_")
    output = parts.assembly.full.output
    if unit != output.unit or (what != "motion_play" and not parts.locked):
        return None
    found = {"dwell_play": turn.dwell, "hand_over_play": turn.hand_over, "motion_play": turn.motion}
    limit = motion_play_max(parts) if what == "motion_play" else finds_slot(parts)
    shown = found[what]._replace(deg=output.from_deg(found[what].deg))
    return _at_most(name, shown, output.from_deg(limit))


def hand_over_pressure(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The pressure angle at which the roller meets a wheel that has turned through that play."""
    limit = slips_deg(parts.assembly.full.spec.load.friction)
    return _at_most(name, turn.push, limit) if parts.locked else None


def slips_deg(friction: float) -> float:
    """The pressure angle from which friction alone holds a roller on a corner, degrees.

    Without a coefficient it is that of dry steel or plastic.

    >>> round(slips_deg(0.0), 2), slips_deg(1.0)
    (73.3, 45.0)
    """
    return 90.0 - math.degrees(math.atan(friction or DRY_FRICTION))


def hand_over_offset(name: str, parts: Parts, turn: FullTurn) -> Check:
    """The offset from the slot's middle, beyond its clearance, of a roller that first touches.

    It is not 0 where the mouth does not reach the roller at entry or exit.
    """
    offset, at_deg = turn.contact
    return compared(name, offset, "at most", 0.0, at_deg if offset else None)


def limited_play(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The play in the motion or in the dwell that a key of ``[limits]`` bounds."""
    limit = parts.assembly.full.spec.limits.as_dict()[name]
    if limit is None:
        return None
    if name == "index_play_max_deg":
        return _at_most(name, turn.motion, limit)
    return _at_most(name, turn.dwell, limit) if parts.locked else _not_locked(name, limit)


def dwell_position(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The greatest error of the resting wheel within the tolerances, where it is bounded."""
    machine = parts.assembly.full
    limit = machine.spec.limits.dwell_position_max_deg
    if limit is None:
        return None
    from geneva_cli.verdict.tolerance import worst_dwell_deg

    try:
        worst = worst_dwell_deg(machine, parts)
    except GenevaError as error:
        return Check(name, None, "at most", limit, None, str(error))
    return _not_locked(name, limit) if worst is None else compared(name, worst, "at most", limit)


def _not_locked(name: str, limit: float) -> Check:
    why = "not computed, because no drawn locking disc holds the wheel at rest"
    return Check(name, None, "at most", limit, None, why)


def motion_play_max(parts: Parts) -> float:
    """The play, degrees to either side, up to which a slot determines the wheel's motion."""
    step = min(2.0 * math.degrees(engagement.half_step) for engagement in parts.assembly.kinds)
    # Where the driving wall changes, the wheel falls behind by twice the play, a tenth of its step,
    # and strikes the other wall: such a slot does not determine the motion.
    return 0.05 * step


def _at_most(name: str, play: Most, limit: float) -> Check:
    return compared(name, play.deg, "at most", limit, play.at_deg if play.deg else None)


def finds_slot(parts: Parts) -> float:
    """The play, degrees, with which the roller would just meet the mouth of its slot."""
    sizes, moves = parts.sizes, parts.assembly.plane_motion
    return math.degrees(moves.half_span(sizes.half_width, sizes.rim))


def toleranced(name: str, parts: Parts, turn: FullTurn) -> Check | None:
    """The clearance per side of slots or lock, against what the tolerances need."""
    machine = parts.assembly.full
    own = machine.spec.size.allowances
    if not (machine.spec.tolerance.is_given and machine.output.turns):
        return None
    # a spec without tolerances is checked without their modules
    from geneva_cli.loads.tolerance.motion_error import used
    from geneva_cli.verdict.tolerance import needed_mm

    slot_mm, lock_mm = needed_mm(machine, parts, used(machine))
    if name == "tolerance_slot_mm":
        return compared(name, own.slot_clearance_mm, "at least", slot_mm)
    if lock_mm is None:  # no disc holds the wheel
        return None
    return compared(name, own.lock_clearance_mm, "at least", lock_mm)


def least_gap(name: str, parts: Parts, to_mm: float | None) -> Check | None:
    """The proved lower bound of the gap, mm; None where parts are known to overlap.

    ``to_mm`` is how far below the smallest gap the bound may be: by default 1 um, or twice the
    overlap that counts as touching, if that is more.
    """
    gap = parts.turned.turn.smallest.mm
    if gap < -parts.contact:
        return None
    to_mm = to_mm or max(1e-3, 2.0 * parts.contact)
    unproved = Check(name, None, "at least", -to_mm, None)
    found = certificate(parts, gap, to_mm)
    if found.open:
        start, end, known, _ = found.open
        unproved = unproved._replace(why=_open(found))
        if known < -max(to_mm, parts.contact):
            return unproved._replace(value=known, at_deg=0.5 * (start + end), passes=False)
        return unproved
    why = f"collision-free, proved to {1e3 * to_mm:.3g} µm ({found.intervals:,} intervals)"
    return compared(name, found.least_mm, "at least", -to_mm)._replace(why=why)


def _open(found: Certificate) -> str:
    assert found.open is not None
    start, end, gap, least = found.open
    bound = "no bound is known" if least <= -0.5 * UNKNOWN else f"at least {least:.4g} mm"
    return (
        f"sampled collision check; the proof is open from {start:.9g} to {end:.9g}° between "
        f"{found.between}, after {found.intervals:,} intervals. There the gap is {gap:.4g} mm in "
        f"the middle and {bound} throughout"
    )
