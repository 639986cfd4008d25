"""Pareto fronts against the definition, pair by pair."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geneva_cli.study.sweep.constraints import front


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
