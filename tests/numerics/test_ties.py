"""The middle of samples of which some are near a pole."""

import numpy as np

from geneva_cli.numerics.greatest import quartiles


def test_quartiles_of_many_rows():
    rows = np.random.default_rng(2).normal(size=(200, 9))
    rows[:, 1:][np.random.default_rng(3).random((200, 8)) < 0.4] = np.nan
    expected = np.nanquantile(rows, (0.25, 0.75), axis=1)
    # both round one interpolation
    np.testing.assert_allclose(quartiles(rows), expected, rtol=0.0, atol=1e-15)
