"""Requirements that gate: times, plays and the position in the dwell, as limits of a spec."""

import math

import pytest

from geneva_cli import Crank, Design, External, Limits, Motion, Size, Tolerance
from geneva_cli.motion.registry import law
from geneva_cli.study.sweep.constraints import constraint
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_table import with_limits
from geneva_cli.verdict.checks import Check, checks


def check_of(design: Design, name: str, parts: bool = False) -> Check:
    (check,) = (c for c in checks(design.mechanism, parts=parts) if c.name == name)
    return check


def test_times_by_hand() -> None:
    """Six slots move for a third of a turn: at 30 rpm for 2/3 s, and they rest for 4/3 s."""
    slow = Crank(n_rpm=30.0)
    at_limit = Limits(dwell_min_s=4.0 / 3.0, motion_max_s=2.0 / 3.0, cycle_max_s=2.0)
    design = Design(External(6), slow, limits=at_limit)
    for name, value in at_limit.as_dict().items():
        if value is not None:
            check = check_of(design, name)
            assert check.passes and check.value == pytest.approx(value, rel=1e-14)
    beyond = Limits(dwell_min_s=1.34, motion_max_s=0.66, cycle_max_s=1.99)
    mechanism = Design(External(6), slow, limits=beyond).mechanism
    failing = [c.name for c in checks(mechanism, parts=False) if not c.passes]
    assert failing == ["dwell_min_s", "motion_max_s", "cycle_max_s"]


def test_times_of_unequal_steps_and_of_a_law() -> None:
    """Steps of 72 and 48 degrees move for 108 and 132; both dwell for 60 of the rest.

    An extra dwell of 30 degrees leaves 90 of a law's 120: a quarter of a second at 60 rpm.
    """
    limits = Limits(motion_max_s=1.0, dwell_min_s=0.1)
    steps = Design(External(6, steps_deg=(72.0, 48.0)), limits=limits)
    assert check_of(steps, "motion_max_s").value == pytest.approx(132.0 / 360.0, rel=1e-12)
    assert check_of(steps, "dwell_min_s").value == pytest.approx(60.0 / 360.0, rel=1e-12)
    motion = Motion(law("cycloidal")(), alpha0_deg=30.0, ratio="matched")
    curved = Design(External(6), motion=motion, limits=limits)
    assert check_of(curved, "motion_max_s").value == pytest.approx(0.25, rel=1e-14)


def test_plays_by_hand() -> None:
    """At mid-motion the roller is L - R from the wheel's axis: the play is asin(c/(L - R))."""
    clearance, refined_deg = 0.1, 1e-6  # the search ends within it
    by_hand = math.degrees(math.asin(clearance / 50.0))
    sizes = Size(slot_clearance_mm=clearance, lock_clearance_mm=0.05)
    limits = Limits(index_play_max_deg=by_hand + refined_deg, dwell_play_max_deg=0.01)
    rows = {c.name: c for c in checks(Design(External(6), size=sizes, limits=limits).mechanism)}
    play, locked = rows["index_play_max_deg"], rows["dwell_play_max_deg"]
    assert play.passes and play.value == pytest.approx(by_hand, abs=refined_deg)
    assert play.at_deg == pytest.approx(0.0, abs=1e-3)
    assert locked.passes is False
    assert locked.value == rows["dwell_play_deg"].value


def test_the_position_in_the_dwell_by_hand() -> None:
    """Without clearances the lock is exact, and each slot is off by its own tolerance."""
    name, limits = "dwell_position_max_deg", Limits(dwell_position_max_deg=0.02)
    exact = Design(External(6), tolerance=Tolerance(slot_angle_deg=0.02), limits=limits)
    check = check_of(exact, name, parts=True)
    assert check.passes and check.value == pytest.approx(0.02, rel=1e-12)
    several = Tolerance(slot_angle_deg=0.02, lock_radius_mm=0.01, center_distance_mm=0.01)
    loose = Size(lock_clearance_mm=0.05)
    design = Design(External(6), size=loose, tolerance=several, limits=limits)
    check = check_of(design, name, parts=True)
    assert check.passes is False
    assert check.value == design.tolerance(samples=16).to_dict()["dwell_position.worst_deg"]


def test_what_cannot_be_computed_says_so() -> None:
    limits = Limits(dwell_play_max_deg=1.0)
    unlocked = Design(External(6, held_by="pin"), size=Size(lock_radius_mm=0.0), limits=limits)
    check = check_of(unlocked, "dwell_play_max_deg", parts=True)
    assert check.passes is None and "no drawn locking disc" in check.why
    many = Design(External(400), size=Size(roller_radius_mm=0.1), limits=limits)
    assert "not turned" in check_of(many, "dwell_play_max_deg", parts=True).why


def test_synth_writes_what_was_required_as_limits() -> None:
    bounds = ("jerk.max <= 5", "velocity.max >= 0.1", "timing.motion_s <= 0.7")
    target = read_target(dwell_s="0.8..", motion_s="..0.6", cycle="1.5", z="8", subject_to=bounds)
    own = Limits(cycle_max_s=2.0, jerk_max=3.0)
    spec = with_limits(target, Design(External(8), limits=own).spec)
    written = {key: value for key, value in spec.limits.as_dict().items() if value is not None}
    assert written == {"jerk_max": 3.0, "dwell_min_s": 0.8, "motion_max_s": 0.6, "cycle_max_s": 1.5}
    assert constraint("velocity.max >= 0.1").sign == ">="  # no key holds a least velocity
