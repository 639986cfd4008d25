"""The contract that every motion law keeps, and each law against its textbook definition.

Textbook accelerations: VDI 2143; R. L. Norton, Cam Design and Manufacturing Handbook; H. A.
Rothbart, Cam Design Handbook. The witness integrates them at 50 digits.
"""

import math

import numpy as np
import pytest
from witness import LAWS as WITNESS
from witness import krasniqi, mp, near
from words import LAWS, Spec, Wheel, named, points

from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import SineGroup
from geneva_cli.motion.laws.table_law import TableLaw
from geneva_cli.motion.peaks import peaks
from geneva_cli.study.law_values import characteristic

CASES = [*[(name, 0.0) for name in LAWS], *[("sine-group", s) for s in (0.125, -0.125, 0.05, -0.1)]]
GRID = np.linspace(0.0, 1.0, 513)  # exact numbers, and so is 1 - u

pi, root3, root5 = math.pi, math.sqrt(3.0), math.sqrt(5.0)
# C_v, C_a, C_j: greatest sizes of s', s'', s'''
CONSTANTS = {
    "harmonic": (pi / 2, pi**2 / 2, pi**3 / 2),
    "cycloidal": (2.0, 2 * pi, 4 * pi**2),
    "modified-trapezoid": (2.0, 8 * pi / (2 + pi), 32 * pi**2 / (2 + pi)),
    "modified-sine": (4 * pi / (4 + pi), 4 * pi**2 / (4 + pi), 16 * pi**3 / (4 + pi)),
    # the modified sine's, faster by 1 over half its top speed and half, in half the time
    "mcv50": tuple(
        c * 2**k * 2 / (1 + 4 * pi / (4 + pi))
        for k, c in enumerate((4 * pi / (4 + pi), 4 * pi**2 / (4 + pi), 16 * pi**3 / (4 + pi)))
    ),
    "3-4-5": (15 / 8, 10 / root3, 60.0),
    "4-5-6-7": (35 / 16, 84 * root5 / 25, 105 / 2),
    "sine-group": (8 / 3, 2 * pi * root3, 32 * pi**2 / 3),
}


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0]}{case[1] or ''}")
def law(request):
    return named(*request.param)


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0]}{case[1] or ''}")
def pair(request):
    name, shape = request.param
    return named(name, shape), krasniqi(shape) if shape else WITNESS[name]


def test_rest_at_both_ends_exactly(law):
    for u, s in ((0.0, 0.0), (1.0, 1.0)):
        assert law(u, 1).derivatives() == (s, 0.0)
        assert [c[0] for c in law(np.array([u]), 1).derivatives()] == [s, 0.0]


@pytest.mark.sampled(3)
def test_derivatives_against_the_definition(pair):
    law, witness = pair
    joints = set(law.breaks)
    u = [t for t in [*GRID[::4].tolist(), 1e-9, 1e-3, 1 / 3, 0.9, 1 - 1e-6] if t not in joints]
    got = [law(t, 4).derivatives() for t in u]
    exact = [witness(t, 4) for t in u]
    for k in range(5):
        peak = max(abs(float(e[k])) for e in exact)
        for t, g, e in zip(u, got, exact, strict=True):
            error = abs(float(mp.mpf(g[k]) - e[k]))
            # 8 units of the peak; the argument pi u (up to 4 pi u) is rounded, which moves a
            # derivative by its slope; the slope of the fourth is some 4 pi times its own peak
            slope = float(e[k + 1]) if k < 4 else 4 * pi * peak
            assert error <= 8 * math.ulp(peak) + abs(slope * t) * 2.3e-16, (t, k)


def test_derivatives_are_continuous_but_for_the_breaks_named(law):
    """Up to the fourth, and every break named is one: peaks are looked for piece by piece."""
    u = np.linspace(0.0, 1.0, 4001)
    found = set()
    for c in law(u, 4).derivatives():
        jumps = np.flatnonzero(np.abs(np.diff(c)) > 0.05 * np.max(np.abs(c)))
        found |= {float(u[i]) for i in jumps}
    assert sorted(found) == pytest.approx(sorted(law.breaks), abs=1 / 4000)


@pytest.mark.parametrize("name", CONSTANTS)
def test_constants(machine, name):
    found = characteristic(named(name))
    m = machine(6, law=name)
    s = m.engagements[0]
    of_machine = peaks(s)
    rate = math.radians(s.motion_deg)
    for k, (quantity, constant) in enumerate(
        zip(("velocity", "acceleration", "jerk"), CONSTANTS[name], strict=True)
    ):
        # 1e-14 relative: eight units in the last place of each of the witness's constants
        assert found[quantity] == near(constant, 1e-14)
        # the same law in a machine of 6 slots and 120 degrees: (2 pi/z) C/phi_l^k
        got = getattr(of_machine, quantity).max * rate ** (k + 1) / (2.0 * s.half_step)
        assert got == near(constant, 1e-14)


def test_constants_to_the_digits_of_the_books():
    assert CONSTANTS["4-5-6-7"][1] == pytest.approx(7.5132, abs=5e-5)
    assert CONSTANTS["modified-sine"] == pytest.approx((1.76, 5.528, 69.47), abs=5e-3)
    assert CONSTANTS["modified-trapezoid"] == pytest.approx((2.0, 4.888, 61.43), abs=5e-3)
    assert CONSTANTS["mcv50"][:2] == pytest.approx((1.27526, 8.01268), abs=5e-6)
    assert CONSTANTS["sine-group"] == pytest.approx((2.667, 10.883, 105.28), abs=5e-3)


def test_a_tilted_law_is_half_way_later():
    """s(u) = 1/2 by mpmath, from the witness's closed form of s."""
    witness = krasniqi(0.1)
    wanted = float(mp.findroot(lambda u: witness(u, 0)[0] - mp.mpf(0.5), 0.6))
    assert SineGroup(0.1).half_way == pytest.approx(wanted, abs=2e-16)


# ---------------------------------------------------------------- the law "table"


def table_spec(folder, u, s, name="points.csv"):
    lines = [f"{a!r},{b!r}" for a, b in zip(u, s, strict=True)]
    (folder / name).write_text("u,s\n" + "\n".join(lines) + "\n")
    law = TableLaw(points(folder / name, TableLaw, "points"))
    return Spec(Wheel(6), motion=Motion(law), path=str(folder / "spec.toml"))


@pytest.fixture
def sampled(tmp_path):
    u = [k / 100 for k in range(101)]
    s = [float(WITNESS["4-5-6-7"](t, 0)[0]) for t in u]
    s[0], s[-1] = 0.0, 1.0
    return table_spec(tmp_path, u, s)


def test_table_reproduces_what_was_sampled(sampled):
    law = sampled.motion.law
    u = np.linspace(0.0, 1.0, 207)
    got = law(u, 3).derivatives()
    exact = np.array([[float(v) for v in WITNESS["4-5-6-7"](t, 3)] for t in u.tolist()]).T
    # A quintic spline with knots h apart errs by c h^(6-k) times the sixth derivative, which is
    # 50400 at the ends; the constants c are those of splines, rounded up.
    for k, c in enumerate((2e-4, 5e-4, 3e-3, 2e-2)):
        assert np.max(np.abs(got[k] - exact[k])) < c * 50400 * 0.01 ** (6 - k), k


def test_table_passes_through_every_point(tmp_path):
    u = [0.0, 0.11, 0.23, 0.42, 0.5, 0.71, 0.9, 1.0]
    s = [0.0, 0.01, 0.08, 0.35, 0.52, 0.83, 0.99, 1.0]
    law = table_spec(tmp_path, u, s).motion.law
    for a, b in zip(u, s, strict=True):
        assert law(a, 0).c[0] == pytest.approx(b, abs=1e-14)  # the linear system's rounding
    assert law(np.array(u), 0).c[0] == pytest.approx(s, abs=1e-14)
