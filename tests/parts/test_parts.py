"""The slots of a sphere, as a report has them."""

import math

import pytest
import repo

import geneva_cli


@pytest.mark.parametrize(("name", "axes"), [("spherical-z6", 90.0), ("spherical-60deg", 60.0)])
def test_the_slots_of_a_sphere_are_meridians_of_it(name, axes):
    """theory.md 1.3: sin th = sin S sin b, mouth at d = atan2(sin S cos b, cos S), bottom S - th.

    To 1e-9 of degrees: a few roundings of numbers of this size.
    """
    S, b = math.radians(axes), math.pi / 6
    design = geneva_cli.load(str(repo.DESIGNS / f"{name}.toml"))
    values = design.report.table.to_dict()
    assert values["sizes.sphere_radius_mm"] == design.mechanism.center_distance_mm
    mouth = math.degrees(math.atan2(math.sin(S) * math.cos(b), math.cos(S)))
    bottom = math.degrees(S - math.asin(math.sin(S) * math.sin(b)))
    assert values["sizes.slot_mouth_polar_deg"] == pytest.approx(mouth, abs=1e-9)
    assert values["sizes.slot_bottom_polar_deg"] == pytest.approx(bottom, abs=1e-9)
