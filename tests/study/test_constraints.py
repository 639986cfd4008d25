"""What --subject-to understands."""

import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.study.sweep.constraints import Constraint, constraint, refuse_contradictions


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("dwell_s >= 0.8", Constraint("timing.dwell_s", ">=", 0.8)),
        ("acceleration.max<=5", Constraint("acceleration.max", "<=", 5.0)),
        (" loads.pin_force_N.max <= 1e3 ", Constraint("loads.pin_force_N.max", "<=", 1000.0)),
    ],
)
def test_bounds(text, found):
    assert constraint(text) == found
    assert constraint(str(found)) == found


def test_kept_but_for_rounding():
    bound = constraint("dwell_s >= 0.8")
    kept = (0.8, 0.9, 0.8 * (1 - 1e-15), True)  # yes is 1
    assert [bound.kept(v) for v in (*kept, 0.79, False, None, "x")] == [True] * 4 + [False] * 4
    assert bound.standing(0.8) and not bound.standing(0.81)
    assert constraint("tau <= 2").margin(1.0) == 0.5


@pytest.mark.parametrize(
    "text",
    ["dwell_s", "dwell_s > 0.8", "dwell_s >= many", "dwell_s >= nan", ">= 3", "", "a >= 1 2"],
)
def test_no_bound(text):
    with pytest.raises(GenevaError, match="--subject-to"):
        constraint(text)


def test_contradictions():
    with pytest.raises(GenevaError, match=r"nothing is both timing\.k >= 2 and timing\.k <= 1"):
        refuse_contradictions([constraint("k >= 2"), constraint("tau <= 1"), constraint("k <= 1")])
    refuse_contradictions([constraint("k >= 2"), constraint("tau <= 1"), constraint("k <= 2")])
