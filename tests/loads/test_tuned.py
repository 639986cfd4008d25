"""The tuned law: a load on an elastic shaft is at rest when the wheel is."""

import math

import mpmath
import numpy as np
import pytest
from swings import shares
from words import law, load

from geneva_cli import Design, External, Motion, Tuned
from geneva_cli.errors import GenevaError
from geneva_cli.loads.vibration.panels import law_shape

mp = mpmath.mp.clone()
mp.dps = 50
Y = {
    "4-5-6-7": lambda u: u**4 * (35 - u * (84 - u * (70 - 20 * u))),
    "sine-group": lambda u: (
        u + (-2 * mp.sin(2 * mp.pi * u) / 3 + mp.sin(4 * mp.pi * u) / 12) / mp.pi
    ),
}
CASES = [(of, ratio, damping) for of in Y for ratio in (0.9, 3.0, 10.3) for damping in (0.0, 0.07)]


@pytest.mark.parametrize(("of", "ratio", "damping"), CASES)
def test_no_residual_at_its_own_ratio(of, ratio, damping):
    """And 1 % beside it ten million times more."""
    form = law_shape(Tuned(period_ratio=ratio, of=of, damping_ratio=damping))
    at, beside = shares(form, np.array([ratio, 1.01 * ratio]), damping)
    assert at <= 1e-15
    assert beside > 1e-8
    undamped = shares(form, np.array([ratio]), damping + 0.01)[0]
    assert undamped > 1e-8


@pytest.mark.parametrize(("of", "ratio", "damping"), CASES)
def test_the_law_by_its_definition(of, ratio, damping):
    """s = y + 2 zeta y'/Omega + y''/Omega², and its derivatives by mpmath's differences."""
    tuned = Tuned(period_ratio=ratio, of=of, damping_ratio=damping)
    omega, zeta = 2 * mp.pi * mp.mpf(ratio), mp.mpf(damping)

    def s(u):
        terms = mp.taylor(Y[of], u, 2)
        return terms[0] + 2 * zeta * terms[1] / omega + 2 * terms[2] / omega**2

    for u in (0.0, 0.1, 0.37, 0.5, 0.75, 1.0):
        exact = [s(mp.mpf(u) + mp.mpf("1e-12") * k) for k in (-1, 0, 1)]
        found = tuned(u, 3).derivatives()
        assert found[0] == pytest.approx(float(exact[1]), abs=2e-15)
        assert found[1] == pytest.approx(float((exact[2] - exact[0]) / mp.mpf("2e-12")), abs=1e-8)


def test_the_load_moves_along_its_law():
    """Without damping by y itself: r = y - psi solves r'' + wn² r = -psi'' at any place."""
    tuned, y = Tuned(period_ratio=2.5), law("4-5-6-7")
    omega = 2.0 * math.pi * 2.5
    for u in np.linspace(0.0, 1.0, 11):
        s, of = tuned(float(u), 2).derivatives(), y(float(u), 2).derivatives()
        r, bent = of[0] - s[0], of[2] - s[2]
        assert bent + omega**2 * r == pytest.approx(-s[2], abs=1e-12)


SPEC = """
[wheel]
z = 6
[drive]
kind = "{kind}"
n_rpm = 60
[motion]
law = "tuned"
{own}
[load]
inertia_kgm2 = 0.4
[shaft]
stiffness_Nm_rad = {k}
"""


@pytest.mark.parametrize(
    ("own", "said"),
    [
        ("", "needs period_ratio"),
        ('period_ratio = 3\nof = "table"', "must be one of"),
        ("period_ratio = 3\ndamping_ratio = 1", "below 1"),
    ],
)
def test_what_is_refused(tmp_path, own, said):
    path = tmp_path / "tuned.toml"
    path.write_text(SPEC.format(kind="crank", own=own, k=1000))
    with pytest.raises(GenevaError, match=said) as error:
        load(path)
    assert str(error.value).startswith(f"{path}:")


def test_a_low_ratio_turns_the_wheel_back():
    """As its warning says: below 0.78, where s' = y' + y'''/Omega² falls below 0 in the middle."""
    low = 0.5 * math.sqrt(52.5 / 2.1875) / math.pi
    assert low == pytest.approx(0.7797, abs=1e-4)
    for ratio, back in ((0.99 * low, True), (1.01 * low, False)):
        assert (Tuned(period_ratio=ratio)(0.5, 1).c[1] < 0.0) is back
    design = Design(External(6), motion=Motion(Tuned(period_ratio=0.7)))
    assert any("turns back" in text and "tuned" in text for text in design.warnings)
