"""Bores and hubs of spherical machines."""

import pytest

from geneva_cli import Design, Size, Spherical
from geneva_cli.verdict.checks import single_check


def standing_check(name, **size):
    """A check of a spherical machine's parts at rest: shafts at 75 degrees."""
    design = Design(Spherical(5, axes_deg=75.0), size=Size(100.0, 5.0, **size))
    return single_check(design.mechanism, name)


@pytest.mark.parametrize(
    ("size", "wall"),
    [
        ({"wheel_bore_mm": 20.0, "wheel_hub_mm": 20.4}, 0.2),
        # DIN 6885-1: the keyway of a bore of 20 mm is 2.8 mm deep
        ({"wheel_bore_mm": 20.0, "wheel_hub_mm": 27.0, "wheel_keyway": "DIN 6885-1"}, 0.7),
    ],
)
def test_the_wall_of_a_spherical_hub_is_checked_around_its_bore(size, wall):
    check = standing_check("wheel_bore_wall_mm", **size)
    assert check.value == pytest.approx(wall, rel=1e-12)  # halves of the numbers above
    assert check.limit == 0.5  # L/200
    assert check.passes is (wall >= 0.5)
