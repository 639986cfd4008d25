"""The linear Geneva: closed forms, the limit of wheels of many slots, loads by equilibrium.

A rack whose roller runs on a circle of radius R moves by y = R sin a at the crank angle a from
mid-motion. Values over R have no unit.
"""

import math

import mpmath
import numpy as np
import pytest
from load_states import integrals

from geneva_cli import Design, Linear, Load, Size

ULP = np.finfo(float).eps
RACK = Design(Linear(6))
SIZE = Size(center_distance_mm=50.0, roller_radius_mm=6.0, face_width_mm=12.0)
# the slot alone; test_guide_friction.py has the guide
LOAD = Load(mass_kg=4.0, force_N=30.0, friction=0.1, guide_friction=0.0)
LOADED = Design(Linear(6), size=SIZE, load=LOAD)


def exact(input_deg: float) -> list[mpmath.mpf]:
    """Travel over R and its derivatives, to 50 digits."""
    with mpmath.workdps(50):
        a = mpmath.mpf(input_deg) * mpmath.pi / 180
        return [mpmath.sin(a), mpmath.cos(a), -mpmath.sin(a), -mpmath.cos(a)]


def test_motion_is_a_sine_to_the_last_place():
    """All peaks are 1, and the condition number is at most pi/2: 4 units of the peak are a lot."""
    motion = RACK.mechanism.engagements[0].motion
    x = np.concatenate([np.linspace(-90.0, 90.0, 181), [-89.999999, 1e-9, 89.9999]])
    for at_deg, row in zip(x.tolist(), zip(*motion(x, 3).derivatives(), strict=True), strict=True):
        for value, true in zip(row, exact(at_deg), strict=True):
            assert abs(mpmath.mpf(float(value)) - true) <= 4 * ULP


def test_the_speed_next_to_rest_keeps_its_digits():
    """It is sin d at d after entry: the angle of entry is exact, so that relative digits stay."""
    motion = RACK.mechanism.engagements[0].motion
    for d in (1e-12, 1e-6, 1e-3):
        at_deg = -90.0 + d
        true = exact(at_deg)[1]
        assert float(motion(at_deg, 1).derivatives()[1]) == pytest.approx(float(true), rel=4 * ULP)


def test_timing_and_peaks():
    t, p = RACK.timing, RACK.peaks
    assert (t.motion_deg, t.dwell_deg, t.k, t.index_deg, t.index_mm) == (180, 180, 1, None, 200)
    assert p.velocity == (1.0, 0.0)
    assert p.acceleration == (1.0, -90.0)
    assert p.jerk == (1.0, 0.0)
    assert p.power == pytest.approx((0.5, -45.0), rel=1e-12)  # sin a cos a
    assert p.ends[0] == p.ends[1] == 1.0


def test_the_input_does_the_work_of_force_and_friction():
    """The force does 2 R F in a step, and inertia none."""
    (work,) = integrals(LOADED.cycle, lambda at: at.input_torque_Nm)
    lost = LOADED.loads_table.to_dict()["life.friction_work_J"]
    assert work == pytest.approx(2.0 * 0.05 * 30.0 + lost, rel=1e-12)
    free = LOADED.with_("load.friction", 0.0)
    assert integrals(free.cycle, lambda at: at.input_torque_Nm)[0] == pytest.approx(3.0, rel=1e-12)


def test_greatest_loads():
    """At entry m R w² and F add up; a rack has no torque of a wheel."""
    values = LOADED.report.table.to_dict()
    force = 4.0 * 0.05 * (2.0 * math.pi) ** 2 + 30.0
    assert values["loads.rack_force_N.max"] == pytest.approx(force, rel=1e-13)
    assert values["loads.pin_force_N.max"] == pytest.approx(force, rel=1e-13)
    assert values["loads.torque_Nm.max"] is None
    assert values["acceleration.max_m_s2"] == pytest.approx(0.05 * (2.0 * math.pi) ** 2, rel=1e-14)
    assert values["velocity.max_rad_s"] is None
    assert values["timing.index_mm"] == 100.0
    assert values["timing.index_deg"] is None
    loads = LOADED.loads_table.to_dict()
    assert loads["wheel_torque_Nm.max"] is None
    assert loads["sizing.inertia_kgm2"] is None
    assert loads["rack_speed_m_s.max"] == pytest.approx(0.05 * 2.0 * math.pi, rel=1e-14)
