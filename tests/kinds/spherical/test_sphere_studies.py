"""Spheres in studies: the tolerance of their locks, and rollers that synth gives them."""

import mpmath as mp
import pytest

from geneva_cli import Design, Size, Spherical, Tolerance


@pytest.mark.long
def test_the_clearance_of_a_lock_on_a_sphere(axes_deg=60.0):
    """Radii of disc and recess, from the crank's axis, are L sin of their angles."""
    given = Tolerance(lock_radius_mm=0.01, recess_radius_mm=0.015)
    arm = Design(Spherical(6, axes_deg=axes_deg)).mechanism.ratio * 100.0
    disc = 0.85 * arm
    size = Size(lock_radius_mm=disc, slot_clearance_mm=0.01, lock_clearance_mm=0.0)
    design = Design(Spherical(6, axes_deg=axes_deg), size=size, tolerance=given)
    found = design.tolerance(64).to_dict()
    with mp.workdps(50):
        needed = 100 * (mp.asin((mp.mpf(disc) + 0.025) / 100) - mp.asin(disc / 100))
    assert found["clearances.lock_needed_mm"] == pytest.approx(float(needed), rel=1e-12)
    assert found["clearances.turns"] is False
    for share, turns in ((1.001, True), (0.999, False)):
        one = design.with_("size.lock_clearance_mm", share * float(needed)).tolerance(64).to_dict()
        assert one["clearances.turns"] is turns
