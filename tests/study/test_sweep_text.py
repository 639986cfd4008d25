"""What --vary, --subject-to, --pareto and --best understand, and the designs that they make."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geneva_cli.errors import GenevaError
from geneva_cli.study.sweep.constraints import (
    Constraint,
    Objective,
    constraint,
    front,
    objective,
    refuse_unsound,
)
from geneva_cli.study.sweep.run import BLOCK, plan
from geneva_cli.study.sweep.values import VariedKey, axis

GRID = [axis("wheel.z=3..7"), axis("drive.A=0,0.3"), axis("motion.law=cycloidal,3-4-5")]


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("wheel.z=9..4:-2", (9, 7, 5)),
        ("wheel.z=3..5,8", (3, 4, 5, 8)),
        ("drive.A=0..0.2:0.1,0.5", (0.0, 0.1, 0.2, 0.5)),
        ("drive.A=-.5,0", (-0.5, 0)),
        ('motion.law="cycloidal,3-4-5"', ("cycloidal", "3-4-5")),
    ],
)
def test_values(text, values):
    found = axis(text)
    assert (found.key, tuple(found.values)) == (text.partition("=")[0], values)
    assert [type(v) for v in found.values] == [type(v) for v in values]


@given(st.integers(-1000, 1000), st.integers(1, 2000), st.integers(1, 4))
def test_a_range_is_its_decimals(low, count, digits):
    """Each value is the double that its decimal numeral reads as, whatever sums would give."""
    unit = 10**digits
    text = f"size.x={low / unit}..{(low + count) / unit}:{1 / unit}"
    assert tuple(axis(text).values) == tuple((low + i) / unit for i in range(count + 1))


def test_a_random_draw_takes_a_span_or_whole_numbers_by_the_key():
    assert axis("drive.A=0..0.9", random=True) == VariedKey("drive.A", (0.0, 0.9), span=True)
    assert tuple(axis("wheel.z=5..7", random=True).values) == (5, 6, 7)
    assert axis("drive.n_rpm=5..7", random=True) == VariedKey("drive.n_rpm", (5.0, 7.0), span=True)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("drive.A", "it must be KEY=VALUES"),
        ("A=1,2", "several tables have this key; write drive.A or drive.before.A"),
        ("drive.A=0..0.9", "a range of fractions needs its step: LOW..HIGH:STEP"),
        ("drive.A=0..1:0", "a step of 0 does not lead from 0 to 1"),
        ("drive.A=0..1:1e-12", "1e+12 values; at most 100,000,000"),
        ("drive.A=1,,2", "neither a number nor a word"),
        ("drive.A=nan,1", "no finite number"),
        ("drive.A=..1:0.1", '"" is no number; a range is'),
    ],
)
def test_what_is_no_value_is_refused(text, said):
    with pytest.raises(GenevaError) as error:
        axis(text)
    assert said in str(error.value)
    assert str(error.value).startswith("--vary ")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("acceleration.max<=5", Constraint("acceleration.max", "<=", 5.0)),
        (" loads.pin_force_N.max >= 1e3 ", Constraint("loads.pin_force_N.max", ">=", 1000.0)),
    ],
)
def test_bounds(text, found):
    assert constraint(text) == found
    assert constraint(str(found)) == found


def test_a_bound_is_kept_but_for_rounding():
    bound = constraint("dwell_s >= 0.8")
    kept = (0.8, 0.9, 0.8 * (1 - 1e-15), True)  # yes is 1
    assert [bound.kept(v) for v in (*kept, 0.79, False, None, "x")] == [True] * 4 + [False] * 4
    assert constraint("tau <= 2").margin(1.0) == 0.5


@pytest.mark.parametrize(
    "text", ["dwell_s > 0.8", "dwell_s >= many", "dwell_s >= nan", ">= 3", "", "a >= 1 2"]
)
def test_no_bound(text):
    with pytest.raises(GenevaError, match="--subject-to"):
        constraint(text)


def test_contradictions():
    with pytest.raises(GenevaError, match=r"nothing is both timing\.k >= 2 and timing\.k <= 1"):
        refuse_unsound([*map(constraint, ("k >= 2", "tau <= 1", "k <= 1"))], {}, "")
    refuse_unsound([*map(constraint, ("k >= 2", "tau <= 1", "k <= 2"))], {}, "")


def test_objectives():
    assert objective("min:acceleration.max", "--best") == Objective(1.0, "acceleration.max")
    assert objective(" max:dwell_s", "--best").sign == -1.0
    for text in ("acceleration.max", "least:a", "min:", ""):
        with pytest.raises(GenevaError, match=r"--best .*min:FIELD or max:FIELD"):
            objective(text, "--best")


def test_a_grid_is_the_product_in_order():
    found = plan(GRID, None, 0)
    whole = list(itertools.product(*[a.values for a in GRID]))
    assert [*map(tuple, found.designs(0, len(found)))] == whole
    assert [*map(tuple, found.designs(7, 11))] == whole[7:11]


def test_a_cloud_fills_its_box_and_takes_words_alike():
    axes = [VariedKey("drive.A", (-0.5, 0.9), span=True), axis("wheel.z=3..6")]
    rows = [*plan(axes, 4096, 7).designs(0, 4096)]
    A = np.array([a for a, _ in rows])
    assert -0.5 <= A.min() < -0.49 and 0.89 < A.max() <= 0.9
    # Sobol: each quarter of the second axis holds a quarter of a power of two, exactly
    assert [sum(z == k for _, z in rows) for k in (3, 4, 5, 6)] == [1024] * 4


def test_a_cloud_is_the_same_wherever_it_is_cut():
    axes = [VariedKey("drive.A", (0.0, 1.0), span=True), axis("wheel.z=3,4")]
    found = plan(axes, 2 * BLOCK + 9, 3)
    whole = [*found.designs(0, len(found))]
    assert [*found.designs(BLOCK - 5, BLOCK + 5)] == whole[BLOCK - 5 : BLOCK + 5]
    assert [*found.designs(len(found) - 3, len(found))] == whole[-3:]
    assert len({*map(tuple, whole)}) == len(whole)


@pytest.mark.parametrize(
    ("axes", "random", "seed", "said"),
    [
        ([], None, 0, "--vary is missing"),
        (GRID[:1], 0, 0, "--random 0"),
        (GRID[:1], 10**12, 0, "--random 1000000000000"),
        (GRID[:1], 5, -1, "--seed -1"),
    ],
)
def test_no_plan(axes, random, seed, said):
    with pytest.raises(GenevaError) as error:
        plan(axes, random, seed)
    assert said in str(error.value)


# Pareto fronts against the definition, pair by pair


def dominates(a, b):
    return all(x <= y for x, y in zip(a, b, strict=True)) and a != b


@given(
    st.integers(1, 3).flatmap(lambda n: st.lists(st.tuples(*[st.integers(0, 6)] * n), min_size=1))
)
def test_no_other_row_beats_what_is_left_and_one_beats_the_rest(rows):
    found = front(np.array(rows, dtype=float))
    kept = [i for i, a in enumerate(rows) if not any(dominates(b, a) for b in rows)]
    assert found.tolist() == kept


@pytest.mark.sampled(12)
@pytest.mark.parametrize("costs", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("levels", [3, 30, 10**9])
def test_fronts_of_many_rows(costs, levels):
    """More rows than are compared all at once, with few and with many equal costs."""
    rows = np.random.default_rng(costs).integers(0, levels, (1200, costs)).astype(float)
    rows[::7, -1] = np.inf
    better = [((rows <= row).all(axis=1) & (rows != row).any(axis=1)).any() for row in rows]
    assert front(rows).tolist() == np.flatnonzero(~np.array(better)).tolist()


def test_rows_without_a_number_are_none_of_them():
    costs = np.array([(1.0, 2.0), (np.nan, 0.0), (2.0, 1.0), (2.0, 2.0)])
    assert front(costs).tolist() == [0, 2]
    assert front(-costs[:, :1]).tolist() == [2, 3]
    assert front(np.array([[np.nan]])).tolist() == []
