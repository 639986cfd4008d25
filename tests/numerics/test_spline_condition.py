"""What the rounding of its points does to the jerk of a spline, as accuracy.md says."""

import math
import random
from decimal import Decimal

import numpy as np
import pytest
from words import load

from geneva_cli.numerics.spline import at_rest, doubt, periodic
from geneva_cli.verdict.cautions import cautions

WHEEL = "[wheel]\nz = 6\n[motion]\nlaw = 'table'\nfile = 'law.csv'\n"
GEARS = "[wheel]\nz = 6\n[drive]\nkind = 'noncircular-gears'\nratio_file = 'ratio.csv'\n"


def cycloidal(u):
    return u - math.sin(math.tau * u) / math.tau  # peak jerk 4 pi²


@pytest.mark.parametrize("n", [11, 101, 301])
def test_the_jerk_moves_with_the_third_power_of_the_points(n):
    u = [k / (n - 1) for k in range(n)]
    s = [0.0, *[cycloidal(v) for v in u[1:-1]], 1.0]
    found = doubt([Decimal(v) for v in u], s, False, 3)
    share = found.move / (4.0 * math.pi**2)
    # The manual's 0.4 n³ of a double's rounding, 2.2e-16; half of that is half a unit
    assert 0.05 < share / (n**3 * math.ulp(1.0)) < 1.0
    assert found.decimals >= 16


@pytest.mark.parametrize("period", [False, True])
def test_no_rounding_moves_it_farther(period):
    """Random roundings of the same size: all below what is said, and some near it."""
    rng, n = random.Random(4), 13
    x = [Decimal(repr(round((k + rng.uniform(-0.2, 0.2)) / n, 4))) for k in range(n)]
    x[0], x[-1] = Decimal(0), Decimal(1)
    y = [round(1.5 + math.sin(math.tau * float(v)), 3) for v in x]
    said = doubt(x, y, period, 2)
    assert said.decimals == 3
    at = np.linspace(0.0, 1.0, 501)
    most = 0.0
    for _ in range(300):
        off = [Decimal(rng.choice((-1, 1))) * Decimal("0.0005") for _ in x]
        off[0] = off[-1] = Decimal(0)
        pieces = (periodic if period else at_rest)(x, off).rounded()
        most = max(most, 2.0 * float(np.abs(pieces(at, 2)[2]).max()))
    # 1.1: it is looked for at the knots and half-way between, the random ones at 501 places
    assert 0.3 * said.move < most < 1.1 * said.move


@pytest.mark.parametrize(("digits", "warned"), [(4, True), (12, False)])
def test_the_user_is_told(tmp_path, digits, warned):
    rows = [f"{k / 40!r},{cycloidal(k / 40):.{digits}f}" for k in range(41)]
    (tmp_path / "law.csv").write_text("\n".join(rows))
    rows = [f"{k},{1 - 0.3 * math.cos(math.radians(k % 360)):.{digits}f}" for k in range(0, 361, 5)]
    (tmp_path / "ratio.csv").write_text("\n".join(rows))
    for text in (WHEEL, GEARS):
        (tmp_path / "spec.toml").write_text(text)
        said = [c for c in cautions(load(str(tmp_path / "spec.toml"))) if "decimals" in c]
        assert bool(said) == warned
        if warned:
            assert f"given to {digits} decimals; jerk is known to about" in said[0]
