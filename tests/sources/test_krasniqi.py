"""[Krasniqi] F. Krasniqi, "Improvements of kinetic properties and lifespan of Maltic cross through
curved canal, at Bongiani pressing machine", University of Prishtina.

Its law as series (17), (18) and in closed form, its curve (4), its timing (16), and its misprints
asserted as misprints. Its Table 1 (forces read off a graph) is no test of anything: no consistent
reading reproduces it.

lambda means three things there: the law's shape in (17), (18) and Table 1, here ``shape``; L/R in
(4); R/L elsewhere.
"""

import math

import numpy as np
import pytest
from witness import mp, near

from geneva_cli.motion.laws.standard import SineGroup
from geneva_cli.motion.path_and_slot import pitch, retraces
from geneva_cli.motion.timing import timings

SHAPES = (-0.25, -0.15, -0.05, 0.0, 0.05, 0.15, 0.25)  # the rows of Table 1, and 0
U = [k / 40 for k in range(41)]


def series_17(u, shape):
    """(17), the position: from -1/2 to 1/2, x = pi u."""
    x, s = mp.pi * mp.mpf(u), mp.mpf(shape)
    sines = (
        2 * s * mp.sin(x)
        + mp.sin(2 * x) / 2
        - s * mp.sin(3 * x)
        - mp.sin(4 * x) / 16
        + s * mp.sin(5 * x) / 5
    )
    return x / mp.pi - mp.mpf(1) / 2 - 4 / (3 * mp.pi) * sines


def series_18(u, shape, fifth=5, factor=4 * mp.pi / 3):
    """(18), the acceleration; printed with 4 for the fifth sine and 4 pi^2/3 before the braces."""
    x, s = mp.pi * mp.mpf(u), mp.mpf(shape)
    amplitudes = (2 * s, 2, -9 * s, -1, fifth * s)
    return factor * sum(a * mp.sin((k + 1) * x) for k, a in enumerate(amplitudes))


@pytest.mark.parametrize("shape", SHAPES)
def test_closed_form_is_the_series(shape):
    law = SineGroup(lambda_=shape)
    for u in U:
        position, _, acceleration, _ = law(u).derivatives()
        # 2e-16 and 8e-15: half a unit of 1, and 4 units of the acceleration, 11 to 21 here
        assert position == pytest.approx(float(series_17(u, shape) + mp.mpf(1) / 2), abs=2.3e-16)
        assert acceleration == pytest.approx(float(series_18(u, shape)), abs=1.5e-14)


@pytest.mark.parametrize(("shape", "least"), [(0.13, None), (0.15, -0.004), (0.25, -0.139)])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_misprint_table_1_has_laws_that_turn_back(engagement, shape, least, sign):
    """Rows +-0.15 and +-0.25 turn the wheel back: 6 slots in 120 degrees, as there."""
    s = engagement(6, law="sine-group", lambda_=sign * shape)
    velocity = s.motion(np.linspace(-60.0, 60.0, 20001), 1).c[1]
    assert np.min(velocity) < 0.0
    if least is not None:
        assert np.min(velocity) == pytest.approx(least, abs=5e-4)  # as printed


@pytest.mark.parametrize("alpha0", [-60.0, -20.0, 0.0, 15.0, 60.0])
def test_16_work_coefficient(machine, alpha0):
    """phi_l = pi - 2 pi/z - alpha_0 and k = phi_l/(2 pi - phi_l), (12) to (16)."""
    t = timings(machine(6, law="cycloidal", alpha0_deg=alpha0))[0]
    motion = 180.0 - 60.0 - alpha0
    assert t.motion_deg == motion
    assert t.k == near(motion / (360.0 - motion), 4e-16)


def curve_4(R, shape, z, degs):
    """(4) without its constant rotation: M = L e^(i psi) - R e^(i (psi + phi)), L = 1."""
    psi = [2 * mp.pi / z * series_17(d / 120 + 0.5, shape) for d in degs]
    phi = [mp.mpf(d) * mp.pi / 180 for d in degs]
    return [mp.expj(p) - R * mp.expj(p + f) for p, f in zip(psi, phi, strict=True)]


@pytest.mark.parametrize("shape", [0.0, 0.05, -0.1])
@pytest.mark.parametrize("ratio", [0.4, 0.5, 0.6])
def test_4_is_our_pitch_curve(engagement, shape, ratio):
    """With lambda = L/R, and mirrored: there the wheel turns the other way."""
    s = engagement(6, law="sine-group", lambda_=shape, ratio=ratio)
    degs = [-60.0, -44.0, -20.0, -1.0, 0.0, 7.0, 30.0, 59.0, 60.0]
    for deg, M in zip(degs, curve_4(mp.mpf(ratio), shape, 6, degs), strict=True):
        x, y = (v.c[0] for v in s.slot(deg, 0))
        # 4e-16: sums of three products of sizes up to 1.6
        assert x == pytest.approx(float(M.real), abs=4.5e-16)
        assert y == pytest.approx(-float(M.imag), abs=4.5e-16)


@pytest.mark.parametrize(
    ("law", "z", "motion_deg"),
    [
        ("cycloidal", 4, 74.56),
        ("cycloidal", 6, 120.0),
        ("cycloidal", 8, 145.18),
        ("sine-group", 4, 99.41),
        ("sine-group", 6, 160.0),
        ("sine-group", 8, 193.57),
    ],
)
def test_mid_condition_at_the_usual_radius(machine, law, z, motion_deg):
    """psi1(0) = l/(1-l) with l = sin(pi/z): phi_l = (2 pi/z) C_v (1-l)/l."""
    alpha0 = 180.0 - 360.0 / z - motion_deg
    m = machine(z, law=law, alpha0_deg=alpha0, ratio="matched")
    # the motion angle is printed to half a hundredth of a degree, of some hundred
    assert m.ratio == near(math.sin(math.pi / z), 1e-4)


def test_misprint_geometry_of_6_slots_at_half_radius(engagement):
    """Its own machine: psi1(0) = 4/3, not l/(1-l) = 1: at mid-motion the pressure angle is 90°."""
    s = engagement(6, law="sine-group")
    assert s.motion(0.0).derivatives()[1] == near(4.0 / 3.0, 4e-16)
    assert not retraces(s)
    assert math.degrees(pitch(s, 0.0).pressure) == pytest.approx(90.0, abs=1e-12)
    x, y = s.slot(0.0, 1)
    assert x.c[1] == 0.0
    assert y.c[1] == near(0.5 - 0.5 * 4.0 / 3.0, 1e-14)


@pytest.mark.parametrize("law", ["cycloidal", "3-4-5", "sine-group"])
@pytest.mark.parametrize("ratio", [0.45, 0.55])
def test_slot_geometry_in_closed_form(engagement, law, ratio):
    """|M'|, curvature and pressure angle of the centre line, from section 5.3 of the notes."""
    s, R = engagement(6, law=law, ratio=ratio), ratio
    for deg in (-59.0, -40.0, -15.0, -2.0, 5.0, 33.0, 58.0):
        phi = math.radians(deg)
        _, p1, p2, _ = s.motion(deg).derivatives()
        speed2 = (p1 - (1 + p1) * R) ** 2 + 4 * p1 * (1 + p1) * R * math.sin(phi / 2) ** 2
        turn = (
            p1**3
            + (1 + p1) ** 3 * R * R
            - p1 * (1 + p1) * (1 + 2 * p1) * R * math.cos(phi)
            + p2 * R * math.sin(phi)
        )
        rho = math.sqrt(1 - 2 * R * math.cos(phi) + R * R)
        at = pitch(s, deg)
        # 1e-12: |M'| is a difference that shrinks to a fiftieth near mid-motion, and enters squared
        assert at.speed == near(math.sqrt(speed2), 1e-12)
        # the notes' wheel is the mirror image of ours: it turns the other way
        assert -at.turning == near(turn / speed2, 1e-11)
        lever = R * abs(math.sin(phi)) / math.sqrt(speed2)
        assert math.cos(at.pressure) == pytest.approx(lever / rho, abs=1e-12)
