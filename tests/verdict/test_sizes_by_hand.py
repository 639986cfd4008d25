"""Checks whose values a designer can work out on paper, from the theory's own formulas."""

import math

import numpy as np
import pytest
from strength_checks import standing_checks
from words import Motion, Spec, Wheel

from geneva_cli.motion.mechanism import build
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import Limits, Size
from geneva_cli.verdict.checks import checks

L, r, rk = 100.0, 4.0, 40.0
HUBS = {"wheel_bore_mm": 20.0, "wheel_hub_mm": 30.0, "crank_bore_mm": 6.0, "crank_hub_mm": 10.0}


@pytest.mark.parametrize("z", [4, 6, 7])
def test_walls_and_shafts_of_a_plain_wheel(z: int) -> None:
    """Of the triangle of entry: R = L sin b, the rim sqrt(L² cos² b + r²), the relief's scaled."""
    b = math.pi / z
    R = L * math.sin(b)
    lock = rk * R / 50.0
    size = Size(L, r, lock_radius_mm=lock, **HUBS)
    parts = parts_of(build(Spec(Wheel(z), size=size)))
    found = parts.outlines
    assert found.relief == "arc"
    rows = {c.name: c.value for c in standing_checks(parts)}
    end = found.sizes.slot_end  # the theory leaves it to the maker, below L - R - r
    assert end <= L - R - r
    by_hand = {
        "wall_between_slots_mm": 2.0 * (end + r) * math.sin(b) - 2.0 * r,
        "horn_mm": R - r - lock,
        "crank_shaft_mm": L - math.hypot(L * math.cos(b), r) - 5.0,
        "crank_hub_mm": lock / R * (L - L * math.cos(b)) - 5.0,
        "wheel_shaft_mm": end - 15.0,
    }
    # the wall is a distance of outlines, to a millionth of L
    assert {name: rows[name] for name in by_hand} == pytest.approx(by_hand, abs=2e-6 * L)


def values(z: int, **keys: float | str) -> dict[str, float]:
    """All checks of a plain wheel that have to do with its parts."""
    parts = parts_of(build(Spec(Wheel(z), size=Size(**keys))))
    return {c.name: c.value for c in standing_checks(parts) if c.value is not None}


def test_a_hub_that_is_not_built_takes_no_space() -> None:
    """The gaps of shafts alone: L - rim - bore/2, depth - bore/2, slot's end - bore/2, arm's end.

    The arm passes the wheel's axis at L - R less its eye. Default hubs are 1.5 and 1.6 bores wide.
    """
    b, rim = math.pi / 6.0, math.hypot(L * math.cos(math.pi / 6.0), r)
    keys = {"center_distance_mm": L, "roller_radius_mm": r, "lock_radius_mm": rk}
    rows = values(6, crank_bore_mm=17.0, wheel_bore_mm=50.0, arm_eye_mm=46.0, **keys)
    by_hand = {
        "crank_shaft_mm": L - rim - 8.5,
        "crank_hub_mm": rk / 50.0 * (L - L * math.cos(b)) - 8.5,
        "arm_to_hub_mm": L - 50.0 - 25.0 - 23.0,
    }
    assert {name: rows[name] for name in by_hand} == pytest.approx(by_hand, abs=2e-6 * L)
    assert rows["wheel_shaft_mm"] == pytest.approx(rows["wheel_bore_wall_mm"], abs=1e-12)
    assert min(by_hand.values()) > 0.0
    built = values(6, crank_bore_mm=17.0, crank_hub_mm=19.0, wheel_bore_mm=50.0, **keys)
    assert built["crank_hub_mm"] == pytest.approx(by_hand["crank_hub_mm"] - 1.0, abs=2e-6 * L)


@pytest.mark.parametrize(
    ("keys", "relief"),
    [
        ({"crank_bore_mm": 40.5}, "arc"),
        ({"crank_bore_mm": 41.5}, "sector"),
        ({"crank_hub_mm": 42.5}, "arc"),
        ({"crank_hub_mm": 43.5}, "sector"),
    ],
)
def test_the_default_relief_clears_bore_and_hub(keys: dict[str, float], relief: str) -> None:
    """L = 200, r = 10: rk = 80, so an arc is 0.8 · 200 (1 - cos 30°) = 21.44 mm deep, less 1 mm.

    A sector is L - sqrt(L² cos² 30° + r²) - L/200 = 25.51 mm deep.
    """
    size = Size(center_distance_mm=200.0, roller_radius_mm=10.0, **keys)
    parts = parts_of(build(Spec(Wheel(6), size=size)))
    assert parts.outlines.relief == relief
    rows = {c.name: c.passes for c in standing_checks(parts)}
    assert rows["crank_bore_wall_mm"]
    assert rows["crank_hub_mm"]


def curved(law: str, ratio: float) -> Spec:
    """Six slots, a law over the natural 120 degrees."""
    return Spec(Wheel(6), motion=Motion(law, ratio=ratio), size=Size(L, r))


def krasniqi(x: np.ndarray) -> np.ndarray:
    """The sine group's share of the step, written out."""
    return (x - 2.0 / 3.0 * np.sin(2.0 * x) + np.sin(4.0 * x) / 12.0) / math.pi


def test_branches_of_a_curved_slot() -> None:
    """2 rho sin(theta - psi) at most, of a slot whose way in leads its way out."""
    parts = parts_of(build(curved("sine-group", 0.5)))
    rows = {c.name: c for c in standing_checks(parts)}
    phi = np.linspace(-math.pi / 3.0, 0.0, 400_001)
    psi = (krasniqi(math.pi * (phi / (2.0 * math.pi / 3.0) + 0.5)) - 0.5) * math.pi / 3.0
    x, y = 1.0 - 0.5 * np.cos(phi), 0.5 * np.sin(phi)
    apart = 2.0 * L * np.hypot(x, y) * np.sin(np.arctan2(y, x) - psi)
    most = max(apart.max(), -apart.min())
    assert most == pytest.approx(0.091 * L, rel=0.01)  # as published
    values = [rows[f"branches_{side}_mm"].value for side in ("apart", "crossed")]
    # of 400 places: the greatest is flat, so that a step h beside it costs h²
    assert max(values) == pytest.approx(most, rel=1e-4)
    assert rows["branches_apart_mm"].limit == rows["branches_crossed_mm"].limit == 2.0 * r


def test_the_pressure_angle_of_a_curved_slot() -> None:
    """From tan mu = rho (theta' - psi')/rho', sampled densely."""
    spec = curved("3-4-5", 0.4838709677419355).replace(limits=Limits(pressure_angle_max_deg=45.0))
    rows = {c.name: c for c in checks(build(spec), parts=False)}
    l, whole, step = 0.4838709677419355, 2.0 * math.pi / 3.0, math.pi / 3.0
    phi = np.linspace(-whole / 2.0, -1e-4, 400_001)
    u = phi / whole + 0.5
    psi1 = 30.0 * u**2 * (1.0 - u) ** 2 * step / whole
    D = 1.0 - 2.0 * l * np.cos(phi) + l * l
    theta1 = l * (np.cos(phi) - l) / D
    slope = l * np.sin(phi) / np.sqrt(D)
    mu = np.degrees(np.arctan(np.abs(np.sqrt(D) * (theta1 - psi1) / slope)))
    found = rows["pressure_angle_deg"]
    assert found.value == pytest.approx(mu.max(), rel=1e-6)
    assert abs(found.at_deg) == pytest.approx(math.degrees(-phi[mu.argmax()]), abs=0.01)
    assert found.limit == 45.0
