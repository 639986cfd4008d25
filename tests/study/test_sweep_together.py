"""Checks of a sweep's designs, which take loads and strength from their batch."""

import os

import pytest
from sampling import some

from geneva_cli.specfile.reader import read
from geneva_cli.study.sweep.plan import plan
from geneva_cli.study.sweep.run import sweep
from geneva_cli.study.sweep.values import axis
from geneva_cli.verdict.checks.registry import checks_before_turn, checks_of_turn

DESIGNS = os.path.join(os.path.dirname(__file__), os.pardir, os.pardir, "designs")
LIMITED = (
    "limits.pin_force_max_N=4000",
    "limits.contact_stress_max_MPa=900",
    "limits.pv_max_W_m2=1e9",
    "load.friction=0.05",
)
CHECKED = ("checks.passes", "checks.failed")
CASES = {
    "press-straight.toml": ("size.center_distance_mm=400,430,460", LIMITED),
    "press-curved.toml": ("load.torque_Nm=0,300,500", LIMITED),
    "turret.toml": ("size.roller_radius_mm=8,12,99", ()),
    "cam-geneva.toml": ("size.center_distance_mm=400,440", ()),
    "elliptical-gears.toml": ("drive.eccentricity=0.1,0.2,0.3", ()),
    "internal-z6.toml": ("load.inertia_kgm2=1,5,9", ()),
    "spherical-z6.toml": ("size.roller_radius_mm=3,4", ()),
    "modified-trapezoid-z5.toml": ("size.center_distance_mm=90,110", ()),
    "two-rollers-side-crank.toml": ("size.roller_radius_mm=3,4", ()),
}


@pytest.mark.parametrize("name", some(CASES, ("press-curved.toml", "turret.toml")))
def test_the_checks_of_a_batch_are_those_of_each_design(name):
    """Whatever a batch computes for all is what each design finds alone, apart from rounding."""
    varied, keys = CASES[name]
    text = read(os.path.join(DESIGNS, name), keys)
    picks = [f"checks.{check}" for check in (*checks_before_turn(), *checks_of_turn())]
    checked = sweep(text, plan([axis(varied)], None, 0), picks=[*picks, *CHECKED])
    together = checked.rows(0, len(checked.plan))
    for row in together:
        alone = checked.row(row[:1])
        for column, one, other in zip(checked.names, row, alone, strict=True):
            if isinstance(one, float) and isinstance(other, float):
                # a stress at a shallow peak is one to its last digits; a gap to the walls' accuracy
                assert one == pytest.approx(other, rel=1e-9, abs=1e-9), column
            else:
                assert one == other, column


def test_a_design_that_cannot_be_built_spoils_no_batch():
    text = read(os.path.join(DESIGNS, "turret.toml"))
    picks = ["checks.pin_stress_MPa", "checks.passes"]
    checked = sweep(text, plan([axis("load.efficiency=0.5,2,0.9")], None, 0), picks=picks)
    first, refused, last = checked.rows(0, 3)
    assert refused[1:3] == [None, None] and "efficiency" in refused[3]
    assert first[2] is last[2] is True and first[1] == pytest.approx(last[1], rel=1e-14)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("name", "varied"),
    [
        ("modified-trapezoid-z5.toml", "drive.n_rpm=30,60,90"),
        ("modified-trapezoid-z5.toml", "size.center_distance_mm=90,110,110"),
        ("modified-trapezoid-z5.toml", "motion.alpha0_deg=0,0,5"),
        ("press-straight.toml", "load.inertia_kgm2=1,100"),  # larger sizes under the larger load
        ("press-straight.toml", "limits.velocity_max=1,2,9"),
    ],
)
def test_designs_with_equal_parts_have_one_turn(name, varied):
    """It is computed once for all designs whose parts are equal, and for no others."""
    text = read(os.path.join(DESIGNS, name))
    checked = sweep(text, plan([axis(varied)], None, 0), picks=["checks.gap_mm", *CHECKED])
    together = checked.rows(0, len(checked.plan))
    assert together == [checked.row(row[:1]) for row in together]
