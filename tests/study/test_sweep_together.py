"""Checks of a sweep's designs, which take loads and strength from their batch."""

import os

import pytest

from geneva_cli.specfile.reader import read
from geneva_cli.study.sweep.run import plan, sweep
from geneva_cli.study.sweep.values import axis

DESIGNS = os.path.join(os.path.dirname(__file__), os.pardir, os.pardir, "designs")
CHECKED = ("checks.passes", "checks.failed")


def test_a_design_that_cannot_be_built_spoils_no_batch():
    text = read(os.path.join(DESIGNS, "turret.toml"))
    picks = ["checks.pin_stress_MPa", "checks.passes"]
    checked = sweep(text, plan([axis("load.efficiency=0.5,2,0.9")], None, 0), picks=picks)
    first, refused, last = checked.rows_of(checked.plan.columns(0, 3))
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
    together = [*checked.rows_of(checked.plan.columns(0, len(checked.plan)))]
    assert together == [checked.row(row[:1]) for row in together]
