"""The wrong formulas of public code that `geneva help numbers` names: each number, by the program.

The machine has six slots, L = 100 mm, and a roller of 10 mm, the default of that distance.
"""

import math

import numpy as np
import pytest

from geneva_cli import Design, External, Size
from geneva_cli.errors import GenevaError
from geneva_cli.verdict.checks import checks

C, A, P, B = 100.0, 50.0, 10.0, 100.0 * math.cos(math.pi / 6.0)
PLAIN = Design(External(6))


def failing(size: Size) -> set[str]:
    rows = checks(Design(External(6), size=size).mechanism)
    return {row.name for row in rows if row.passes is False}


def test_the_locking_radius_that_is_the_mouth() -> None:
    """C cos 30° = 86.6 is where the roller enters, and no disc inside a crank of 50."""
    engagement = PLAIN.mechanism.engagements[0]
    x, y = engagement.path(engagement.entry_deg, 0)
    assert C * math.hypot(x.c[0], y.c[0]) == pytest.approx(86.6025403784, abs=1e-9)
    design = Design(External(6), size=Size(lock_radius_mm=B))
    with pytest.raises(GenevaError, match="it must be below 50"):
        _ = design.mechanism


def test_the_acceleration_whose_denominator_is_not_squared() -> None:
    x, l = np.radians(np.linspace(0.0, 60.0, 600_001)), 0.5
    once = l * (1.0 - l * l) * np.sin(x) / (1.0 - 2.0 * l * np.cos(x) + l * l)
    squared = once / (1.0 - 2.0 * l * np.cos(x) + l * l)
    assert once.max() == pytest.approx(0.5, abs=1e-9)
    assert math.degrees(x[once.argmax()]) == pytest.approx(36.87, abs=0.01)
    peak = PLAIN.peaks.acceleration
    assert squared.max() == pytest.approx(peak.max, rel=1e-9)
    assert math.degrees(x[squared.argmax()]) == pytest.approx(-peak.at_deg, abs=1e-3)


def test_the_stop_arc_whose_factor_became_a_power() -> None:
    """a - 1.5 p leaves a horn as thick as the pin beside a slot as wide; the power has a unit."""
    assert pytest.approx(18.4, abs=0.05) == A - P**1.5
    inch = 25.4
    assert inch * (A / inch - (P / inch) ** 1.5) == pytest.approx(43.7, abs=0.05)
    mechanism = Design(External(6), size=Size(lock_radius_mm=A - 1.5 * P)).mechanism
    rows = {row.name: row for row in checks(mechanism)}
    assert rows["horn_mm"].value == pytest.approx(P, rel=1e-12)
    assert all(row.passes for row in rows.values())
    assert pytest.approx(13.6, abs=0.05) == 50.0 ** (2.0 / 3.0)  # the pin that leaves no disc


def test_the_crank_by_the_sine_of_the_wheel() -> None:
    """b tan 30° is the crank that the program takes; one of b sin 30° never crosses the axis."""
    assert PLAIN.mechanism.ratio * C == pytest.approx(B * math.tan(math.pi / 6.0), rel=1e-15)
    wrong = B * math.sin(math.pi / 6.0)
    assert wrong == pytest.approx(43.3, abs=0.05)
    assert "entry_velocity_max" in failing(Size(center_distance_mm=C, crank_radius_mm=wrong))


def test_the_rim_that_does_not_reach_the_roller() -> None:
    rim = C - A + 2.0 * P + 4.0
    assert rim == 74.0
    assert "hand_over_offset_mm" in failing(Size(wheel_radius_mm=rim))
    assert not failing(Size(wheel_radius_mm=B))
