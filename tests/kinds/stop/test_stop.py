"""A Geneva stop: its closed form against the collision engine."""

import math

import numpy as np
import pytest

from geneva_cli import Design, External, Limits, Load, Size
from geneva_cli.kinds.stop.parts import clearances_before, wheel_stop
from geneva_cli.parts.turn.gaps import Gaps

STOPPED = {z: Design(External(z, stop=True)) for z in (3, 4, 5, 6, 8, 12)}


def stops_of(design):
    """The stops of a design whose parts can be built."""
    stop = wheel_stop(design.parts.outlines)
    assert stop is not None
    return stop


@pytest.mark.sampled(6)
@pytest.mark.parametrize("z", STOPPED)
def test_the_collision_engine_touches_first_at_the_closed_form(z):
    """Bisection of the engine's gap between free and blocked, at both ends."""
    outlines, stop = STOPPED[z].parts.outlines, stops_of(STOPPED[z])
    gaps = Gaps(outlines.assembly, outlines.sizes, outlines.wheel, outlines.crank)
    for sense, end in ((1.0, stop.last_deg), (-1.0, stop.first_deg)):
        low, high = end - 5.0 * sense, end + 1.0 * sense  # degrees
        for _ in range(50):
            middle = 0.5 * (low + high)
            gap = gaps.locking(gaps.pose(np.array([middle - 360.0 * (z // 2)])))[0]
            low, high = (middle, high) if gap > 0.0 else (low, middle)
        # 1e-12 L of rounding in a gap that falls by half of L a radian
        assert low == pytest.approx(end, abs=1e-9)


@pytest.mark.parametrize("z", STOPPED)
def test_the_lever_is_the_rate_at_which_the_gap_closes(z):
    """Virtual work: the gap falls by h per radian of the crank, wherever the wheel is."""
    stop, step = stops_of(STOPPED[z]), 0.5  # degrees, between positions of the way to a stop
    way = clearances_before(STOPPED[z].parts.outlines, stop)
    for closing in way:
        near, far = closing[-2], closing[-3]
        # the slope at the stop from two gaps: the curvature cancels, the third order is 1e-4
        rate = (4.0 * near - far) / (2.0 * math.radians(step))
        assert rate == pytest.approx(stop.lever_mm, rel=1e-4)


def test_a_watch_makes_four_turns_and_what_lies_beyond():
    """Five slots by hand: rk = 48.78 and the rim 81.06 mm at L = 100 give gamma = 53.45 deg."""
    d = STOPPED[5]
    stop, sizes = stops_of(d), d.parts.sizes
    gamma = math.acos((100.0**2 + sizes.lock**2 - sizes.rim**2) / (200.0 * sizes.lock))
    beyond = 2.0 * (54.0 - math.degrees(gamma))  # the arc of the relief begins at alpha_e = 54
    assert stop.turns == pytest.approx(4.0 + beyond / 360.0, abs=1e-12)
    assert stop.turns == pytest.approx(4.003, abs=5e-4)


def test_force_and_stress_by_hand():
    """F = T/h, and Hertz of steel on steel, 0.418 sqrt(F E/(b R))."""
    size = Size(face_width_mm=10.0, lock_edge_mm=1.0)
    d = Design(External(5, stop=True), size=size, load=Load(winding_torque_Nm=2.0))
    values = d.report.table.to_dict()
    force = 2000.0 / stops_of(d).lever_mm
    assert values["stop.force_N"] == pytest.approx(force, rel=1e-12)
    radius = 1.0 / (1.0 + 1.0 / d.parts.sizes.rim)
    usual = 0.418 * math.sqrt(force * 210e3 / (10.0 * radius))
    assert values["stop.contact_stress_MPa"] == pytest.approx(usual, rel=2e-3)  # 0.418 has 3 digits


def test_a_stop_that_gives_way_gets_advice():
    """A rounder edge lowers its stress. A word for it once stood for nothing: a fault of 70."""
    limits, load = Limits(stop_stress_max_MPa=600.0), Load(winding_torque_Nm=2.0)
    size = Size(face_width_mm=10.0, lock_edge_mm=0.1)
    d = Design(External(5, stop=True), load=load, limits=limits, size=size)
    (failing,) = [check for check in d.checks if check.passes is False]
    assert failing.name == "stop_stress_max_MPa"
    key, _, value = failing.nearest.partition(" = ")
    assert key == "lock_edge_mm"
    rounder = size.replace(lock_edge_mm=float(value))
    assert Design(External(5, stop=True), load=load, limits=limits, size=rounder).passes
    # without the key nothing would say what the stress is, which is no way to pass
    low = Limits(stop_stress_max_MPa=60.0)
    none = Design(External(5, stop=True), load=load, limits=low, size=size)
    assert [c.nearest for c in none.checks if c.passes is False] == [""]


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
def test_checks_can_fail():
    limits, load = Limits(stop_stress_max_MPa=100.0), Load(winding_torque_Nm=2.0)
    sharp = Design(External(5, stop=True), load=load, limits=limits, size=Size(face_width_mm=10.0))
    by_name = {check.name: check for check in sharp.checks}
    assert by_name["stop_stress_max_MPa"].passes is None
    rounded = Size(face_width_mm=10.0, lock_edge_mm=0.1)
    d = Design(External(5, stop=True), load=load, limits=limits, size=rounded)
    by_name = {check.name: check for check in d.checks}
    assert by_name["stop_stress_max_MPa"].passes is False
    assert by_name["stop_turns"].passes
    assert by_name["stop_overlap_mm"].passes
    rim = sharp.parts.sizes.rim
    for overlap_mm, failing in (
        (0.1, ["stop_overlap_mm"]),
        (1e-5, ["stop_turns", "stop_overlap_mm"]),
    ):
        small = Size(lock_radius_mm=100.0 - rim + overlap_mm)
        checks = Design(External(5, stop=True), size=small).checks
        assert [c.name for c in checks if c.passes is False and "stop" in c.name] == failing
