"""What --vary understands, and what it says of the rest."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from geneva_cli.errors import GenevaError
from geneva_cli.study.sweep.values import VariedKey, axis


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("wheel.z=4..9:2", (4, 6, 8)),
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


def test_a_span_is_for_random_draws_only():
    assert axis("drive.A=0..0.9", random=True) == VariedKey("drive.A", (0.0, 0.9), span=True)
    with pytest.raises(GenevaError, match=r"a range of fractions needs its step: LOW\.\.HIGH:STEP"):
        axis("drive.A=0..0.9")


def test_what_is_between_follows_from_the_key():
    """A key that takes whole numbers alone has whole numbers drawn, another all between."""
    assert tuple(axis("wheel.z=5..7", random=True).values) == (5, 6, 7)
    assert axis("drive.n_rpm=5..7", random=True) == VariedKey("drive.n_rpm", (5.0, 7.0), span=True)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("drive.A", "it must be KEY=VALUES"),
        ("A=1,2", "several tables have this key; write drive.A or drive.before.A"),
        ("drive.A=0..1:0", "a step of 0 does not lead from 0 to 1"),
        ("drive.A=0..1:1e-12", "1e+12 values; at most 100,000,000"),
        ("drive.A=1,,2", "neither a number nor a word"),
        ("drive.A=nan,1", "no finite number"),
        ("drive.A=..1:0.1", '"" is no number; a range is'),
    ],
)
def test_what_is_none_is_refused(text, said):
    with pytest.raises(GenevaError) as error:
        axis(text)
    assert said in str(error.value)
    assert str(error.value).startswith("--vary ")
