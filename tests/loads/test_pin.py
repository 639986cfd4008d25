"""The roller's pin: its bending moments by a beam equation, its stress all over the section."""

import math

import mpmath
import pytest

from geneva_cli.loads.strength.pin_arm_key import least_size_mm, pin_stress_MPa
from geneva_cli.spec.tables import Size


@pytest.mark.sampled(5)
@pytest.mark.parametrize(("width", "gap"), [(18.0, 0.0), (18.0, 2.5), (5.0, 20.0)])
@pytest.mark.parametrize("held", ["cantilever", "supported", "fixed"])
def test_moments_follow_from_the_beam_equation(held, width, gap):
    """E I y'''' = q integrated at 30 digits over the span, the ends as they are held.

    y'' = M along the pin: integrals of the load, and two constants that make the ends' deflections
    and slopes (or moments) 0. The greatest |M| is looked for at a thousand places.
    """
    with mpmath.workdps(30):
        b, g = mpmath.mpf(width), mpmath.mpf(gap)
        span = b + (g if held == "cantilever" else 2 * g)

        def load(x, n):  # the n-fold integral of the load q = 1/b on (g, g + b) from the left
            def part(t):
                return t**n / mpmath.factorial(n) if t > 0 else mpmath.mpf(0)

            return (part(x - g) - part(x - g - b)) / b

        # M(x) = m0 + v0 x + load(x, 2), y = m0 x²/2 + v0 x³/6 + load(x, 4) + s0 x
        s = span
        if held == "cantilever":  # free at the right: no moment, no shear
            v0 = -load(s, 1)
            m0 = -v0 * s - load(s, 2)
        elif held == "supported":
            m0 = mpmath.mpf(0)
            v0 = -load(s, 2) / s
        else:  # y(s) = y'(s) = 0
            m0, v0 = mpmath.lu_solve(
                mpmath.matrix([[s * s / 2, s**3 / 6], [s, s * s / 2]]),
                mpmath.matrix([-load(s, 4), -load(s, 3)]),
            )
        places = [s * i / 1000 for i in range(1001)]
        most = max(abs(m0 + v0 * x + load(x, 2)) for x in places)
    bending, _, _ = pin_stress_MPa(Size(pin_held=held, pin_gap_mm=gap), width, 12.0, 1.0)
    assert bending * math.pi * 12.0**3 / 32.0 == pytest.approx(float(most), rel=1e-14)


@pytest.mark.parametrize("ratio", [0.1, 0.9, 1.0, 1.6, 1.7, 1.8, 3.0])
def test_the_equivalent_stress_is_the_greatest_of_the_section(ratio):
    """Against every height of the section: both extremes of a convex function, so to rounding."""
    # a cantilever's bending stress is 3 b/d of its shear stress
    bending, shear, equivalent = pin_stress_MPa(Size(), 8.0 * ratio / 3.0, 8.0, 1.0)
    assert bending == pytest.approx(ratio * shear, rel=1e-14)
    every = [i / 2000 for i in range(2001)]
    most = max(math.sqrt((ratio * u) ** 2 + 3.0 * (1.0 - u * u) ** 2) for u in every)
    assert equivalent == pytest.approx(most * shear, rel=1e-14)


def test_a_pin_by_hand():
    """1 kN on 18 mm and a pin of 12 mm: M = 9 N m; 53.05 MPa; shear 11.79 MPa."""
    bending, shear, equivalent = pin_stress_MPa(Size(250.0, 12.0), 18.0, 12.0, 1000.0)
    assert bending == pytest.approx(32.0 * 9000.0 / (math.pi * 1728.0), rel=1e-15)
    assert shear == pytest.approx(4.0 / 3.0 * 1000.0 / (math.pi * 36.0), rel=1e-15)
    assert equivalent == pytest.approx(53.0516, rel=1e-6)  # as printed


@pytest.mark.parametrize("width", [2.0, 60.0])  # sheared off; bent
def test_the_least_diameter_has_the_allowed_stress(width):
    d = float(least_size_mm(lambda d: pin_stress_MPa(Size(), width, d, 800.0)[2] <= 150.0, 12.0))
    assert pin_stress_MPa(Size(), width, d, 800.0)[2] == pytest.approx(150.0, rel=1e-12)
