"""A whole turn: sound machines pass, spoilt ones do not, and both for the right amount.

The witnesses: polygons of shapely at some positions of a turn, and closed forms for contacts.
"""

import math

import numpy as np
import pytest
from test_outline import STRAIGHT, L, made
from turn_witness import overlapping

from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.full_turn import DRIVING, LOCK, FullTurn, full_turn


def finds_slot(found: Parts) -> float:
    """The play, degrees, up to which a roller still comes to the slot and not to the horn."""
    return math.degrees(math.asin(found.sizes.half_width / found.sizes.rim))


def passes(found: Parts, turn: FullTurn) -> bool:
    held = not found.outlines.crank or turn.hand_over.deg <= finds_slot(found)
    return turn.smallest.mm >= -found.close and held


SOUND = [
    *[STRAIGHT[i] for i in (1, 4, 6, 12, 14)],
    {"z": 7, "lock_clearance_mm": 0.01, "slot_clearance_mm": 0.01},
]


def test_the_wheel_goes_on_before_the_first_entry_and_after_a_turn() -> None:
    """One roller, six slots: a closed form of the motion, and a step a turn."""
    assembly = made(6).assembly
    at = np.linspace(-1000.0, 1000.0, 4001)
    away = (at + 180.0) % 360.0 - 180.0
    steps = np.round((at - away) / 360.0)
    phi = np.radians(away)
    moving = np.abs(away) <= 60.0
    motion = np.where(moving, np.arctan2(0.5 * np.sin(phi), 1.0 - 0.5 * np.cos(phi)), 0.0)
    rest = np.where(moving, 0.0, np.copysign(math.pi / 6.0, away))
    expected = motion + rest + math.pi / 3.0 * steps
    assert np.abs(assembly.wheel(at) - expected).max() < 1e-13


@pytest.mark.sampled(6)
@pytest.mark.parametrize("case", SOUND, ids=str)
def test_straight_slots_turn_with_their_clearances(case: dict) -> None:
    """What touches without clearance has exactly the clearance with it: slot and lock. Only inside,
    and at the far mouth of an offset slot, the wall, which the clearance moves, runs past the foot
    of the perpendicular from the crank's axis: by s = (w^2 - r^2) / (2 d), d being how far the foot
    is from the wheel's axis, which takes s^2 / (2 (R - r)) or 4e-7 mm of 0.1."""
    found = made(**case)
    turn = full_turn(found)
    assert passes(found, turn)
    past = 5e-7 if found.assembly.sign < 0.0 or "offset" in case else 0.0
    gap = case.get("slot_clearance_mm", 0.0)
    assert turn.gaps[DRIVING].mm == pytest.approx(gap, abs=found.close + past)
    assert turn.gaps[LOCK].mm == pytest.approx(case.get("lock_clearance_mm", 0.0), abs=found.close)
    at_deg = found.assembly.start_deg + found.assembly.turn_deg * np.arange(60) / 60
    assert not any(overlapping(found, at_deg))


def opening(rim: float, radius: float) -> float:
    """Half the angle over which a circle about the crank's axis opens the rim."""
    return math.acos((L * L + rim * rim - radius * radius) / (2.0 * L * rim))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("z", "c"), [(3, 0.1), (4, 0.01), (6, 0.1), (8, 0.01)])
def test_play_in_the_dwell(z: int, c: float) -> None:
    """The recess's corner comes to the disc: from the rim's opening for rk + c to that for rk. To
    first order c / (L sin beta), beta the angle at which the corner is seen from the crank."""
    found = made(z, lock_clearance_mm=c)
    size = found.sizes
    exact = opening(size.rim, size.recess) - opening(size.rim, size.lock)
    seen = math.asin(size.rim / size.recess * math.sin(opening(size.rim, size.recess)))
    assert exact == pytest.approx(c / (L * math.sin(seen)), rel=2.0 * c / size.lock)
    # the search ends after 20 halvings of a step that is a few times the play
    assert full_turn(found).dwell.deg == pytest.approx(math.degrees(exact), rel=1e-4)


def test_play_in_the_dwell_of_an_internal_wheel() -> None:
    """There the recess reaches round the disc, and the locking sector's edge comes to it: to first
    order c / (L sin(half the sector)), which is 90 deg - b at the most."""
    found = made(6, "internal", lock_clearance_mm=0.1, roller_radius_mm=2.0)
    half = 0.5 * found.outlines.crank[0].segments[0].sweep
    assert half <= math.radians(60.0) + 1e-12
    wanted = math.degrees(0.1 / (L * math.sin(half)))
    # the next order: the play's way over the sector's width
    assert full_turn(found).dwell.deg == pytest.approx(wanted, rel=0.1 / found.sizes.lock)


# --- spoilt machines


@pytest.mark.sampled(5)
@pytest.mark.parametrize(("z", "by"), [(4, 0.2), (6, 0.02), (6, 0.2), (6, 1.0), (9, 0.2)])
def test_a_rim_too_large_fouls_the_roller_before_it_enters(z: int, by: float) -> None:
    """The wall that faces the crank runs past the foot of the perpendicular from its axis, by s;
    the roller's inner side, R - r from the axis, meets its corner: hypot(R - r, s) - (R - r), which
    is s^2 / (2 (R - r)) or half a micrometre for 0.2 mm."""
    R, r = L * math.sin(math.pi / z), 5.0
    plain = made(z, roller_radius_mm=r, lock_clearance_mm=0.3)
    found = made(z, roller_radius_mm=r, lock_clearance_mm=0.3, wheel_radius_mm=plain.sizes.rim + by)
    s = math.sqrt((plain.sizes.rim + by) ** 2 - r * r) - L * math.cos(math.pi / z)
    turn = full_turn(found)
    # the place of the smallest gap is found to a share of the half degree that it lasts
    assert turn.gaps[DRIVING].mm == pytest.approx(R - r - math.hypot(R - r, s), rel=1e-3, abs=1e-12)
    assert turn.smallest.mm < -found.close
