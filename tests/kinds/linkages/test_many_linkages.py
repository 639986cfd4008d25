"""Linkages of many designs at once: the wheels that each finds alone, and none else."""

import numpy as np
import pytest
from test_path_wheels import FOUR_BAR
from words import Drive, Keys, Spec, Wheel

from geneva_cli.errors import GenevaError
from geneva_cli.motion.batch import taken
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build

# Batch and single run the same search. The functions of math and numpy differ by units in the last
# place, over the slope with which the index angle passes the wanted one. A motion takes the pin's
# direction from differences of rounded numbers.
NEAR = 1e-13
MOTION = 1e-11
SLIDER_CRANK = {
    "crank_mm": (20.0, 90.0),
    "rod_mm": (80.0, 160.0),
    "point_mm": (20.0, 200.0),
    "point_deg": (-180.0, 180.0),
    "height_mm": (-30.0, 30.0),
}


def four_bar(z=4, **keys):
    lengths = (40.0, 90.0, 100.0, 100.0, 161.51903573811165, -36.13836508095113)
    return Spec(Wheel(z), Drive("four-bar"), Keys("four-bar", *lengths, **keys))


def slider_crank(z=8):
    keys = {"crank_mm": 40.0, "rod_mm": 100.0, "point_mm": 80.0, "point_deg": 90.0}
    return Spec(Wheel(z), Drive("slider-crank"), Keys("slider-crank", **keys))


def alone(spec, varied, i):
    try:
        return build(spec.with_keys({key: values[i].item() for key, values in varied.items()}))
    except GenevaError:
        return None


def drawn(ranges, n, seed):
    random = np.random.default_rng(seed)
    return {f"drive.{key}": random.uniform(*ends, n) for key, ends in ranges.items()}


@pytest.mark.long
@pytest.mark.parametrize("kind", ["four-bar", "slider-crank", "entry"])
def test_a_batch_finds_the_wheels_of_single_designs_and_refuses_the_same(kind):
    n = 30
    spec, varied = four_bar(), drawn(FOUR_BAR, n, 1)
    if kind == "slider-crank":
        spec, varied = slider_crank(), drawn(SLIDER_CRANK, n, 2)
    elif kind == "entry":
        spec = four_bar(entry_deg=0.0)
        varied["drive.entry_deg"] = np.random.default_rng(4).uniform(-180.0, 180.0, n)
    found, singles = many(spec, varied), [alone(spec, varied, i) for i in range(n)]
    assert found.refused.tolist() == [one is None for one in singles]
    assert len(found.which) > 8
    machine, singles = found.machine, [one for one in singles if one is not None]
    engagement, share = machine.engagements[0], np.linspace(0.0, 1.0, 17)
    x = engagement.entry_deg + engagement.motion_deg * share
    motion = [np.broadcast_to(c, x.shape) for c in engagement.motion(x, 3).derivatives()]
    turns = np.broadcast_to(engagement.carrier(x).c[0], x.shape)
    for row, one in enumerate(singles):
        e = one.engagements[0]
        assert engagement.entry_deg[row, 0] == pytest.approx(e.entry_deg, rel=NEAR)
        assert machine.center_distance_mm[row, 0] == pytest.approx(one.center_distance_mm, rel=NEAR)
        own = e.entry_deg + e.motion_deg * share
        every = [*e.motion(own, 3).derivatives(), e.carrier(own).c[0]]
        for mine, expected in zip((*motion, turns), every, strict=True):
            # a motion passes on what moves its ends as it does a small turn of the input
            scale = 1.0 + np.abs(expected).max()
            assert mine[row] == pytest.approx(expected, rel=0.0, abs=MOTION * scale)
    for at, angle in ((x[:, :1], -engagement.half_step), (x[:, -1:], engagement.half_step)):
        assert engagement.motion(at, 1).c[0] == pytest.approx(angle, abs=1e-15)


def test_double_roots():
    """The worked reference has one, and so do its images of other sizes; beside it, two or none."""
    size = np.array([0.5, 1.0, 2.0, 1.0, 1.0])
    spec = four_bar(entry_deg=123.3)
    lengths = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm")
    varied = {f"drive.{key}": vars(spec.drive)[key] * size for key in lengths}
    varied["drive.point_mm"] *= np.array([1.0, 1.0, 1.0, 1.0 + 1e-4, 1.0 - 1e-4])
    found = many(spec, varied)
    singles = [alone(spec, varied, i) for i in range(5)]
    assert found.refused.tolist() == [one is None for one in singles]
    assert found.refused.tolist()[:3] == [False] * 3
    for i in range(3):
        distance = found.machine.center_distance_mm[i, 0]
        assert distance == pytest.approx(singles[i].center_distance_mm, rel=1e-14)
        jump = taken(found.machine, np.arange(len(found.which)) == i).engagements[0]
        assert abs(jump.motion(jump.entry_deg, 2).c[2][0, 0]) < 1e-12


def test_the_gentlest_wheel_is_found_past_a_sharp_bend():
    """Between two samples 1.9 degrees apart the path turns by 147 degrees. The mean of the rates at
    both predicted the turn by chance, to a degree. So the bend was not sampled again, and the
    wheel that the roller enters there was lost. The next had 2.7 times its peak velocity.
    """
    keys = Keys("four-bar", 31.0213, 103.372, 110.8588, 111.988, 106.3246, -99.57)
    engagement = build(Spec(Wheel(8), Drive("four-bar"), keys)).engagements[0]
    x = np.linspace(engagement.entry_deg, engagement.entry_deg + engagement.motion_deg, 361)
    assert engagement.motion(x, 1).c[1].max() == pytest.approx(0.4077, abs=1e-3)
    assert engagement.motion_deg == pytest.approx(170.38, abs=0.02)


def test_designs_that_cannot_turn_leave_the_others_alone():
    """The lines' angles are one sum over all designs, whose NaN would reach those behind them."""
    found = many(four_bar(), {"drive.crank_mm": np.array([1000.0, 40.0])})
    assert found.refused.tolist() == [True, False]
    alone_mm = build(four_bar()).center_distance_mm
    assert found.machine.center_distance_mm.item() == pytest.approx(alone_mm, rel=NEAR)
