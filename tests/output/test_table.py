"""A table as a Python user has it: by name, as rows."""

import numpy as np
import pytest

from geneva_cli.table import PIECE, Table, pieces, record_table, rows_table


def test_a_table_made_piece_by_piece_is_whole_in_a_dict():
    length = 2 * PIECE + 3
    made = Table(
        ("n", "n2"), pieces(length, 2, lambda a, b: (np.arange(a, b), np.arange(a, b) ** 2))
    )
    at = made.to_dict()
    assert (at["n"] == np.arange(length)).all()
    assert (at["n2"] == np.arange(length) ** 2).all()


def test_a_piece_that_is_kept_cannot_be_written():
    """What was done to a slice changed the next slice of the same rows."""
    (column,) = pieces(PIECE + 3, 1, lambda i, j: [np.arange(i, j, dtype=float)])
    some = column[5:8]
    with pytest.raises(ValueError, match="read-only"):
        some *= 57.3
    assert column[5:8].tolist() == [5.0, 6.0, 7.0]


def test_a_record_is_its_values_and_its_tables_rows():
    rows = rows_table(["name", "passes"], [("dwell_deg", True), ("ratio", False)])
    assert record_table({"z": 6, "checks": rows}).to_dict() == {
        "z": 6,
        "checks": [{"name": "dwell_deg", "passes": True}, {"name": "ratio", "passes": False}],
    }
