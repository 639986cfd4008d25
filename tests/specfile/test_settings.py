"""``--set KEY=VALUE``: read as the file is, over it, and complained of by the option's name."""

import pytest

from geneva_cli import GenevaError, load

SPEC = """\
[wheel]
z = 6
[drive]
n_rpm = 30
[[mass]]
shape = "point"
mass_kg = 2
radius_mm = 50
"""


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(SPEC)
    return str(path)


@pytest.mark.parametrize("more", ["drive.n_rpm=1", "[drive]\nn_rpm = 1"])
def test_a_second_line_is_refused_and_not_dropped(spec, more):
    with pytest.raises(GenevaError, match="it sets more than one key"):
        load(spec, [f"wheel.z=6\n{more}"])


def test_a_key_is_set_over_the_files_and_beside_it(spec):
    changed = load(spec, ["drive.n_rpm=90", "size.center_distance_mm=250", "mass.0.count=4"]).spec
    assert changed.drive.n_rpm == 90.0
    assert changed.size.center_distance_mm == 250.0
    assert changed.mass[0].count == 4
    assert load(spec).spec.drive.n_rpm == 30.0


def test_a_key_of_one_table_needs_no_table(spec):
    spec_ = load(spec, ["z=8", "n_rpm = 104", "law=cycloidal"]).spec
    assert (spec_.wheel.z, spec_.drive.n_rpm, spec_.motion.law.NAME) == (8, 104.0, "cycloidal")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("wheel.z=2", "--set wheel.z=2: z = 2 must be at least 3"),
        ("wheel.zz=3", "--set wheel.zz=3: unknown key zz in [wheel] (did you mean"),
        ("size.roller=3", 'key roller in [size] (did you mean "roller_radius_mm"?)'),
        ("SIZE.roller_radius_mm=3", 'unknown table [SIZE] (did you mean "size"?)'),
        ("mass.1.count=3", "--set mass.1.count=3: the spec has 1 [[mass]], counted from 0"),
        ("center_distance_mm=509", "write size.center_distance_mm or tolerance.center_distance_mm"),
        ("rpm=3", '--set rpm=3: no table has this key (did you mean "n_rpm"?)'),
        ("wheel.z=", "it must be KEY=VALUE"),
    ],
)
def test_an_error_names_the_option(spec, given, said):
    with pytest.raises(GenevaError) as error:
        load(spec, [given])
    assert said in str(error.value)
    assert "spec.toml" not in str(error.value)
