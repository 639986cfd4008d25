"""What the last place of its points does to the jerk of a spline: README's Accuracy says it."""

import numpy as np
import pytest

from geneva_cli.spline import at_rest


@pytest.mark.parametrize("n", [11, 101, 301])
def test_the_jerk_moves_with_the_third_power_of_the_points(n):
    u = np.linspace(0.0, 1.0, n)
    s = u - np.sin(2.0 * np.pi * u) / (2.0 * np.pi)  # the cycloidal law, peak jerk 4 pi²
    s[0], s[-1] = 0.0, 1.0
    moved = s.copy()
    moved[1:-1] += np.where(np.arange(n - 2) % 2, 1.0, -1.0) * np.spacing(s[1:-1])
    x = np.linspace(0.0, 1.0, 4001)
    one, other = (at_rest(u.tolist(), y.tolist()).derivative(3)(x) for y in (s, moved))
    share = np.max(np.abs(one - other)) / (4.0 * np.pi**2)
    # 0.4 n³ as written; points that move to and fro in turn move it most, up to twice as far
    assert 0.1 < share / (n**3 * np.spacing(1.0)) < 2.0
