"""[Lecture] "Malteski mehanizmi", lecture slides (Serbian): timing tables, and what is misprinted.

In its notation 2 phi_1 is the wheel's step, 2 alpha_1 the crank's motion angle, 2 alpha_0 its dwell
angle, k the ratio of motion time t_1 to dwell time t_0. The misprints are asserted as misprints:
the printed formula gives a wrong value, ours the right one.
"""

from fractions import Fraction

import pytest
from witness import near

from geneva_cli.motion.timing import timings

Z = range(3, 25)


def timing(machine, *args, **keys):
    return timings(machine(*args, **keys))[0]


@pytest.mark.parametrize(("gearing", "two"), [("external", 2), ("internal", -2)])
@pytest.mark.parametrize("z", Z)
def test_timing(machine, z, gearing, two):
    """2 phi_1 = 360/z, 2 alpha_1 = 180 - 360/z, k = (z-2)/(z+2); inside with the other sign."""
    t = timing(machine, z, gearing)
    # 4e-16 and 1e-13 degrees: each figure is one or two roundings of an exact fraction
    assert t.index_deg == near(360 / z, 4e-16)
    assert t.motion_deg == pytest.approx(180 - two * 180 / z, abs=1e-13)
    assert t.dwell_deg == pytest.approx(180 + two * 180 / z, abs=1e-13)
    assert t.k == near(float(Fraction(z - two, z + two)), 1e-15)
    assert t.tau == near(float(Fraction(z - two, 2 * z)), 1e-15)


@pytest.mark.parametrize(
    ("z", "k", "k_inside"),
    [
        (3, 0.2, 5.0),
        (4, 0.33, 3.0),
        (5, 0.43, 2.33),
        (6, 0.5, 2.0),
        (8, 0.6, 1.67),
        (10, 0.67, 1.5),
    ],
)
def test_work_coefficients_to_two_digits(machine, z, k, k_inside):
    assert round(timing(machine, z).k, 2) == k
    assert round(timing(machine, z, "internal").k, 2) == k_inside


@pytest.mark.parametrize("gearing", ["external", "internal"])
def test_times_at_60_rpm_are_fractions_of_a_second(machine, gearing):
    """t_1 = alpha_1/(pi n/60) at n = 60 rpm: the share of the turn, in seconds."""
    for z in Z:
        t = timing(machine, z, gearing)
        assert t.cycle_s == 1.0
        assert t.motion_s == near(t.motion_deg / 360.0, 4e-16)
        assert t.motion_s + t.dwell_s == near(1.0, 4e-16)


def test_misprint_k_above_1_does_not_need_an_internal_wheel(machine):
    """Several rollers outside do it too: z = 4, m = 3 gives k = 3; z = 5, m = 3 gives 9."""
    for z, k in ((4, 3.0), (5, 9.0)):
        # 1e-14: dwell is a difference of two angles ten times as large
        assert timing(machine, z, rollers=3).k == near(k, 1e-14)
