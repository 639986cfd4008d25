"""Tables by name and as rows; lines of csv, with every number as Python's repr writes it."""

import csv
import sys

import numpy as np
import pytest

from geneva_cli.output.delimited import FEW, text_of
from geneva_cli.table import BLOCK, Table, record_table, rows_table

SIZES = 10.0 ** np.arange(-320, 309)
# ends of the ranges in which numerals have no exponent, and their neighbours
ENDS = (1e-4, 1e-5, 1e15, 1e16, 2.0**53)
EDGES = [x for end in ENDS for x in np.nextafter(end, (0.0, end, 1e99))]


def numbers():
    random = np.random.default_rng(3)
    bits = random.integers(0, 2**63, 3 * FEW, dtype=np.uint64).view(np.float64)
    usual = random.uniform(-200.0, 200.0, 3 * FEW)
    few = np.array([*SIZES, *EDGES, 0.0, -0.0, 5e-324, 1.7976931348623157e308, 0.1, 1.0])
    whole = np.concatenate([bits[np.isfinite(bits)], usual, few, -few, np.round(usual, 3)])
    return whole[: len(whole) - len(whole) % 2].reshape(-1, 2)


@pytest.mark.parametrize("without", [False, True])
def test_numbers_are_written_as_repr_does(without, monkeypatch):
    """Also where orjson is missing, as in a browser."""
    if without:
        monkeypatch.setitem(sys.modules, "orjson", None)
    block = numbers()
    assert block.size > FEW
    lines = [f"{x + 0.0!r},{y + 0.0!r}\n" for x, y in block.tolist()]
    assert text_of([*block.T]) == "".join(lines)


def test_what_is_no_number_stands_between_them():
    """Words that are equal in all rows or not, whole numbers, no value, truth, and infinity."""
    count = FEW
    x = np.linspace(0.5, 1.5, count)
    x[7] = np.inf
    words = ["one, two"] * count
    some = [None, "=b", True, 4] * (count // 4)
    columns = [words, x, np.arange(count), some, [None] * count]
    rows = [*csv.reader(text_of(columns, infinity="").splitlines())]
    assert [row[0] for row in rows] == words
    assert [row[1] for row in rows] == [repr(v) if np.isfinite(v) else "" for v in x.tolist()]
    assert [row[2] for row in rows] == [str(i) for i in range(count)]
    assert [row[3] for row in rows] == ["", "'=b", "true", "4"] * (count // 4)
    assert {row[4] for row in rows} == {""}
    alone = text_of([words, x, [None] * count], infinity="").splitlines()
    assert alone[7] == '"one, two",,' and alone[8] == f'"one, two",{x[8].item()!r},'
    assert text_of([np.array([1.0, np.inf])]) == "1.0\ninf\n"
    assert text_of([[1, 1], ["a", "a"]]) == "1,a\n1,a\n"


def test_a_long_table_is_whole_in_a_dict():
    length = 2 * BLOCK + 3
    later = length, lambda a, b: (np.arange(a, b), np.arange(a, b) ** 2)
    at = Table(("n", "n2"), (), later=later).to_dict()
    assert (at["n"] == np.arange(length)).all()
    assert (at["n2"] == np.arange(length) ** 2).all()


def test_a_record_is_its_values_and_its_tables_rows():
    rows = rows_table(["name", "passes"], [("dwell_deg", True), ("ratio", False)])
    assert record_table({"z": 6, "checks": rows}).to_dict() == {
        "z": 6,
        "checks": [{"name": "dwell_deg", "passes": True}, {"name": "ratio", "passes": False}],
    }
