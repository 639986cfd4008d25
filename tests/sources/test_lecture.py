"""[Lecture] "Malteski mehanizmi", lecture slides (Serbian): timing tables, and what is misprinted.

In its notation 2 phi_1 is the wheel's step, 2 alpha_1 the crank's motion angle, 2 alpha_0 its dwell
angle, k the ratio of motion time t_1 to dwell time t_0. The misprints are asserted as misprints:
the printed formula gives a wrong value, ours the right one.
"""

import math
from fractions import Fraction

import pytest
from witness import near

from geneva_cli.analysis.timing import timings

Z = range(3, 25)


def timing(machine, *args, **keys):
    return timings(machine(*args, **keys))[0]


@pytest.mark.parametrize("z", Z)
def test_external_timing(machine, z):
    """2 phi_1 = 360/z, 2 alpha_1 = 180 - 360/z, k = (z-2)/(z+2)."""
    t = timing(machine, z)
    # 4e-16 and 1e-13 degrees: each figure is one or two roundings of an exact fraction
    assert t.index_deg == near(360 / z, 4e-16)
    assert t.motion_deg == pytest.approx(180 - 360 / z, abs=1e-13)
    assert t.dwell_deg == pytest.approx(180 + 360 / z, abs=1e-13)
    assert t.k == near(float(Fraction(z - 2, z + 2)), 1e-15)
    assert t.tau == near(float(Fraction(z - 2, 2 * z)), 1e-15)


@pytest.mark.parametrize("z", Z)
def test_internal_timing(machine, z):
    """2 phi_1 = 360/z, 2 alpha_1 = 180 + 360/z, k = (z+2)/(z-2) > 1."""
    t = timing(machine, z, "internal")
    assert t.index_deg == near(360 / z, 4e-16)
    assert t.motion_deg == pytest.approx(180 + 360 / z, abs=1e-13)
    assert t.dwell_deg == pytest.approx(180 - 360 / z, abs=1e-13)
    assert t.k == near(float(Fraction(z + 2, z - 2)), 1e-15)
    assert t.tau == near(float(Fraction(z + 2, 2 * z)), 1e-15)


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


def test_misprint_internal_step(machine):
    """Printed for internal wheels: 2 phi_1 = pi - 2 pi/z. Right: 2 pi/z, as in its own table."""
    for z in Z:
        ours, printed = timing(machine, z, "internal").index_deg, 180 - 360 / z
        assert ours == near(360 / z, 4e-16)
        assert (ours == near(printed, 1e-9)) == (z == 4)  # at 4 slots both are 90 degrees


def test_misprint_internal_entry_triangle(machine):
    """Printed: alpha_1 + phi_1 = pi/2. Right: alpha_1 - phi_1 = alpha_0 + phi_1 = pi/2."""
    for z in Z:
        t = timing(machine, z, "internal")
        alpha_1, alpha_0, phi_1 = t.motion_deg / 2, t.dwell_deg / 2, t.index_deg / 2
        assert alpha_1 - phi_1 == near(90.0, 1e-15)
        assert alpha_0 + phi_1 == near(90.0, 1e-15)
        assert 90.0 - alpha_1 == near(-phi_1, 1e-14)  # the printed one: a negative step
        outside = timing(machine, z)
        assert outside.motion_deg / 2 + phi_1 == near(90.0, 1e-15)  # it belongs there


def test_misprint_kinematics_are_shown_without_restriction(engagement):
    """tan phi = l sin a/(1 - l cos a) and i hold outside only; inside l -> -l, psi -> -psi."""
    for z in (3, 4, 6, 12):
        l = math.sin(math.pi / z)
        for deg in (-25.0, 10.0, 29.0):
            a = math.radians(deg)
            tan_phi = l * math.sin(a) / (1 - l * math.cos(a))
            i = l * (math.cos(a) - l) / (1 - 2 * l * math.cos(a) + l * l)
            outside = engagement(z).motion(deg).derivatives()
            inside = engagement(z, "internal").motion(deg).derivatives()
            # 1e-13: at z = 3 the textbook denominator loses two digits
            assert math.tan(outside[0]) == near(tan_phi, 1e-13)
            assert outside[1] == near(i, 1e-13)
            assert abs(math.tan(inside[0]) / tan_phi - 1) > 0.1
            m = -l
            assert -math.tan(inside[0]) == near(m * math.sin(a) / (1 - m * math.cos(a)), 1e-14)
            assert -inside[1] == near(
                m * (math.cos(a) - m) / (1 - 2 * m * math.cos(a) + m * m), 1e-14
            )


def test_misprint_law_of_sines_is_the_external_one(engagement):
    """R/L = sin psi/sin(a + psi) outside; inside sin psi/sin(a - psi)."""
    for z in (3, 5, 8):
        l, a = math.sin(math.pi / z), math.radians(20.0)
        outside = engagement(z).motion(20.0, 0).c[0]
        inside = engagement(z, "internal").motion(20.0, 0).c[0]
        assert math.sin(outside) / math.sin(a + outside) == near(l, 1e-14)
        assert math.sin(inside) / math.sin(a - inside) == near(l, 1e-14)
        assert abs(math.sin(inside) / math.sin(a + inside) / l - 1) > 0.1


def test_misprint_k_above_1_does_not_need_an_internal_wheel(machine):
    """Several rollers outside do it too: z = 4, m = 3 gives k = 3; z = 5, m = 3 gives 9."""
    for z, k in ((4, 3.0), (5, 9.0)):
        # 1e-14: dwell is a difference of two angles ten times as large
        assert timing(machine, z, rollers=3).k == near(k, 1e-14)
