"""Splines against mpmath, and what the rounding of points does to a jerk (accuracy.md)."""

import math

import numpy as np
import pytest
import spline_witness
from witness import mp
from words import load

from geneva_cli.numerics.spline import at_rest, doubt
from geneva_cli.verdict.motion_warnings import motion_warnings

WHEEL = "[wheel]\nz = 6\n[motion]\nlaw = 'table'\nfile = 'law.csv'\n"


def cycloidal(u):
    return u - math.sin(math.tau * u) / math.tau  # peak jerk 4 pi²


@pytest.mark.long
@pytest.mark.parametrize("count", [7, 8, 21])
def test_splines_are_those_of_mpmath(count):
    """All derivatives between points that are uneven by some hundreds to one."""
    rng = np.random.default_rng(count)
    x = np.concatenate(([0.0], np.sort(rng.random(count - 2)), [1.0])).tolist()
    y = [v * v * (3.0 - 2.0 * v) for v in x]
    y[-1] = 1.0
    with mp.workdps(60):
        exact = spline_witness.Spline([mp.mpf(v) for v in x], [mp.mpf(v) for v in y])
        known = exact.pieces()
    found = at_rest(x, y)
    assert found(np.array(x), 0)[0] == pytest.approx(y, rel=0, abs=1e-14)
    closest = min(np.diff(x))
    for i, (a, b) in enumerate(zip(x, x[1:], strict=False)):
        for t in (0.1, 0.6):
            at = a + t * (b - a)
            with mp.workdps(60):
                true = spline_witness.derivatives(known[i], mp.mpf(at) - mp.mpf(a))
            for k, (value, wanted) in enumerate(zip(found(at, 5), true, strict=True)):
                # 1e-16 of the points, which a k-th derivative over the closest two multiplies; the
                # inverse of the equations adds three digits
                assert abs(math.factorial(k) * value - float(wanted)) < 1e-13 / closest**k, (i, k)
            for one, other in zip(found(at, 5), found(np.array([at]), 5), strict=True):
                assert one == other[0]
    assert found(0.0, 2) == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("n", [11, 101, 301])
def test_the_jerk_moves_with_the_third_power_of_the_points(n):
    u = [k / (n - 1) for k in range(n)]
    s = [0.0, *[cycloidal(v) for v in u[1:-1]], 1.0]
    found = doubt(u, s, 3)
    share = found[1] / (4.0 * math.pi**2)
    # The manual's 0.4 n³ of a double's rounding, 2.2e-16; half of that is half a unit
    assert 0.05 < share / (n**3 * math.ulp(1.0)) < 1.0
    assert found[0] >= 16


@pytest.mark.parametrize(("digits", "warned"), [(4, True), (12, False)])
def test_the_user_is_told(tmp_path, digits, warned):
    rows = [f"{k / 40!r},{cycloidal(k / 40):.{digits}f}" for k in range(41)]
    (tmp_path / "law.csv").write_text("\n".join(rows))
    (tmp_path / "spec.toml").write_text(WHEEL, encoding="utf-8")
    said = [c for c in motion_warnings(load(str(tmp_path / "spec.toml"))) if "decimals" in c]
    assert bool(said) == warned
    if warned:
        assert f"have {digits} decimals, so the jerk is known only to about" in said[0]
