"""Bores and hubs of spherical machines."""

import pytest
from drawing_witness import polygon
from shapely.geometry import Point

from geneva_cli import Design, Size, Spherical
from geneva_cli.geometry.plates import plates
from geneva_cli.parts.parts import parts_of
from geneva_cli.verdict.checks import single_check


def standing_check(name, **size):
    """A check of a spherical machine's parts at rest: shafts at 75 degrees."""
    design = Design(Spherical(5, axes_deg=75.0), size=Size(100.0, 5.0, **size))
    return single_check(design.mechanism, name)


def test_a_shaft_fits_a_spherical_hub():
    """Its bore is in the hub alone, whose round outside is in the shell."""

    size = Size(80.0, 5.0, wheel_bore="hex", wheel_bore_mm=10.0, wheel_hub_mm=16.0, crank_bore="D")
    design = Design(Spherical(6), size=size)
    members = parts_of(design.mechanism).members
    every = [one for member in members for one in plates(member.part)]
    hubs = {one.name: one for one in every if one.holes}
    assert len(hubs["wheel's hub"].holes[0].segments) == 6
    assert len(hubs["arm's hub"].holes[0].segments) == 3
    outside = Point(0.0, 0.0).buffer(8.0)
    assert outside.contains(polygon(hubs["wheel's hub"].holes[0]))


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
