"""The best of a sweep: against closed forms, brute force and the built design itself."""

import numpy as np
import pytest
import repo
from scipy.optimize import brentq

from geneva_cli import GenevaError, load
from geneva_cli.parts.parts import Parts
from geneva_cli.study.sweep.best import best_spec
from geneva_cli.study.sweep.request import Outcome, request

SPEC = str(repo.DESIGNS / "side-crank-z6.toml")


def best(tmp_path, *vary, **asked):
    """The lines of the winning spec, and the design read back from it."""
    found = request(SPEC, vary, random=asked.pop("random", 32), jobs=1, **asked)
    lines = best_spec(Outcome(found), found.goal, found.blocks())
    path = tmp_path / "best.toml"
    path.write_text("\n".join(lines))
    return lines, load(str(path))


@pytest.mark.long
def test_the_bound_that_binds_is_met_exactly(tmp_path):
    """Peak acceleration falls with A, and so does the dwell: the best A leaves a dwell of 0.55 s.

    The witness solves the dwell's own equation: half the motion is phi + asin(A sin phi) with phi
    = 60 deg, and the dwell is what is left of a turn in a second."""
    lines, design = best(
        tmp_path, "drive.A=-0.5..0.9", best="min:acceleration.max", subject_to=["dwell_s >= 0.55"]
    )
    half = np.radians(60.0)
    A = brentq(lambda A: 1.0 - (half + np.arcsin(A * np.sin(half))) / np.pi - 0.55, 0.0, 0.9)
    assert pytest.approx(A, abs=1e-7) == design.spec.drive.A
    # checks forgive 1e-9, and the least of what is forgiven is not the best
    assert 0.55 <= design.timing.dwell_s <= 0.55 * (1.0 + 1e-11)
    assert any("timing.dwell_s >= 0.55" in line and "(binds)" in line for line in lines)


@pytest.mark.long
def test_of_the_best_alone_is_told_what_is_asked_for_beside(tmp_path, monkeypatch):
    """Its gaps take a full turn of the parts, which need not be made of a thousand designs."""
    turned = []
    plain = Parts.turn.func
    monkeypatch.setattr(Parts, "turn", property(lambda model: turned.append(model) or plain(model)))
    asked = {"pick": "smallest_gap_mm,drive.kind", "check": True, "best": "max:dwell_s"}
    lines, design = best(tmp_path, "drive.A=-0.2..0.5", **asked)
    assert len({*map(id, turned)}) == 1
    said = dict(line[2:].split(": ") for line in lines if line.startswith("# ") and ": " in line)
    (gap,) = (check.value for check in design.checks if check.name == "gap_mm")
    assert float(said["parts.smallest_gap_mm"]) == gap
    assert (said["drive.kind"], said["checks.passes"]) == ("side-crank", "yes")


@pytest.mark.long
def test_it_is_no_worse_than_any_of_a_fine_grid(tmp_path):
    """Two bounds at once, of which one binds."""
    bounds = ["motion_deg <= 150", "velocity.max <= 0.8"]
    _, design = best(tmp_path, "drive.A=-0.5..0.9", best="min:jerk.max", subject_to=bounds)
    grid = request(SPEC, ["drive.A=-0.5..0.9:0.01"], pick="jerk.max", subject_to=bounds, jobs=1)
    rows = [row for block in grid.chosen(grid.blocks()) for row in block]
    at = grid.names.index("jerk.max")
    assert design.peaks.jerk.max <= min(row[at] for row in rows)
    assert 150 * (1 - 1e-11) <= design.timing.motion_deg <= 150
    assert design.peaks.velocity.max <= 0.8


def test_bounds_that_contradict_each_other_are_told(tmp_path):
    """A motion of 200 deg and a velocity of 0.8, which is at most 0.575 there."""
    bounds = ["motion_deg >= 200", "velocity.max >= 0.8"]
    said = r"motion_deg >= 200 is kept by [\d,]+; velocity.max >= 0.8 is kept by"
    with pytest.raises(GenevaError, match=said):
        best(tmp_path, "drive.A=-0.5..0.9", best="min:jerk.max", subject_to=bounds)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"best": "min:jerk.max", "subject_to": ["dwell_s >= 5"]}, "is kept by 0 (nearest"),
        ({"best": "min:jerk.max", "pareto": "min:jerk.max"}, "choose one of them"),
        (
            {"best": "min:jerk.max", "subject_to": ["dwell_s >= 2", "timing.dwell_s <= 1"]},
            "nothing is both",
        ),
        ({"pareto": "jerk.max"}, "min:FIELD or max:FIELD"),
    ],
)
def test_what_has_no_best(asked, said):
    with pytest.raises(GenevaError) as error:
        found = request(SPEC, ["drive.A=0,0.5"], jobs=1, **asked)
        best_spec(Outcome(found), found.goal, found.blocks())
    assert said in str(error.value)
