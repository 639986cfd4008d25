"""The designs of a sweep by their numbers: whole grids, clouds, and shares of both."""

import itertools

import numpy as np
import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.study.sweep.run import BLOCK, plan
from geneva_cli.study.sweep.values import VariedKey, axis

GRID = [axis("wheel.z=3..7"), axis("drive.A=0,0.3"), axis("motion.law=cycloidal,3-4-5")]


def test_a_grid_is_the_product_in_order():
    found = plan(GRID, None, 0)
    whole = list(itertools.product(*[a.values for a in GRID]))
    assert found.rows(0, len(found)) == whole
    assert found.rows(7, 11) == whole[7:11]


def test_a_cloud_fills_its_box_and_takes_words_alike():
    axes = [VariedKey("drive.A", (-0.5, 0.9), span=True), axis("wheel.z=3..6")]
    rows = plan(axes, 4096, 7).rows(0, 4096)
    A = np.array([a for a, _ in rows])
    assert -0.5 <= A.min() < -0.49 and 0.89 < A.max() <= 0.9
    # Sobol: each quarter of the second axis holds a quarter of a power of two, exactly
    assert [sum(z == k for _, z in rows) for k in (3, 4, 5, 6)] == [1024] * 4


def test_a_cloud_is_the_same_wherever_it_is_cut():
    found = plan(
        [VariedKey("drive.A", (0.0, 1.0), span=True), axis("wheel.z=3,4")], 2 * BLOCK + 9, 3
    )
    whole = found.rows(0, len(found))
    assert found.rows(BLOCK - 5, BLOCK + 5) == whole[BLOCK - 5 : BLOCK + 5]
    assert found.rows(len(found) - 3, len(found)) == whole[-3:]
    assert len(set(whole)) == len(whole)


@pytest.mark.parametrize(
    ("axes", "random", "seed", "said"),
    [
        ([], None, 0, "--vary is missing"),
        ([axis("wheel.z=3")], 0, 0, "--random 0"),
        ([axis("wheel.z=3")], 10**12, 0, "--random 1000000000000"),
        ([axis("wheel.z=3")], 5, -1, "--seed -1"),
    ],
)
def test_no_plan(axes, random, seed, said):
    with pytest.raises(GenevaError) as error:
        plan(axes, random, seed)
    assert said in str(error.value)
