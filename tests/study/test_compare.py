"""Designs side by side, as a table and as curves; and figures of CSV files."""

import json
import os

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli import GenevaError
from geneva_cli.cli.app import app
from geneva_cli.figure import JOINED, POINTS
from geneva_cli.study.compare import compare, designs_of, of_table

pytestmark = pytest.mark.usefixtures("made_once")


def path(name):
    return str(repo.DESIGNS / name)


def compared(paths, settings=(), vary=(), **options):
    return compare(designs_of(paths, settings, vary), varied=bool(vary), **options)


def by_quantity(table):
    return {row["quantity"]: row for row in table.to_rows()}


def test_the_papers_ratios():
    """Polyudov and Kandyak: at A = 0.6, z = 6 the plain crank's velocity, acceleration and kinetic
    power are 1.600, 2.583 and 4.164 times as high."""
    found = by_quantity(compared([path("side-crank-z6.toml")], vary=["drive.A=0.6,0"], ratio=True))
    ratios = [found[f"{name}.max"]["drive.A=0"] for name in ("velocity", "acceleration", "power")]
    assert [round(r, 3) for r in ratios] == [1.6, 2.583, 4.164]


def test_what_nothing_bounds_is_none():
    """Two pins of which one dwell has no length, and a wall as sharp as its roller: in the report's
    json null, and no fault of the program."""
    pins = by_quantity(compared([path("two-pins-z4.toml")]))
    assert "timing.k" not in pins and "acceleration.max" in pins
    limited = ["limits.contact_stress_max_MPa=500"]
    stress = "checks.contact_stress_max_MPa"
    found = by_quantity(compared([path("press-345.toml")], limited, picks=[stress, "passes"]))
    assert list(found) == ["checks.passes"] and found["checks.passes"]["press-345"] is False


@pytest.mark.long
def test_rounding_is_no_difference(tmp_path):
    """Forces go with 1/L and speeds with L: pv is that of any centre distance, but for a unit in
    the last place; a nanometre of 100 mm is more than rounding."""
    spec = tmp_path / "loaded.toml"
    spec.write_text(
        '[wheel]\nz = 6\n[drive]\nkind = "side-crank"\nA = 0.3\n[size]\nface_width_mm = 10\n'
        "[load]\ninertia_kgm2 = 0.4\ntorque_Nm = 5\n"
    )
    found = by_quantity(compared([str(spec)], vary=["size.center_distance_mm=100,90,100.000001"]))
    pv, L = found["life.pv_max_W_m2"], found["sizes.center_distance_mm"]
    values = [pv[f"{key}"] for key in pv if key not in ("quantity", "differs")]
    assert max(values) <= min(values) * (1.0 + 1e-12) and len(set(values)) > 1
    assert not pv["differs"] and L["differs"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            {"picks": ["acceleration.mx"]},
            'no quantity of a design (did you mean "acceleration.max"?',
        ),
        ({"vary": ["drive.A=0,2"]}, "--vary drive.A=2: A = 2 must be above -1, below 1"),
        ({"vary": ["drive.A=0", "drive.A=0.5"]}, "--vary drive.A: given twice"),
        ({"settings": ["outline.wheel=wheel.dxf"]}, "a comparison is of our own parts"),
        (
            {"vary": ["drive.A=0..1:0.001"]},
            "1,001 designs; at most 100 can be compared",
        ),
    ],
)
def test_what_cannot_be_compared(arguments, said):
    with pytest.raises(GenevaError) as error:
        compared([path("side-crank-z6.toml")], **arguments)
    assert said in str(error.value)


SPEC = str(repo.DESIGNS / "side-crank-z6.toml")


def run(*arguments):
    return CliRunner().invoke(app, list(map(str, arguments)))


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def put(text):
    with open("rows.csv", "w", encoding="utf-8", newline="") as file:
        file.write(text)
    return "rows.csv"


def test_ascending_numbers_make_a_curve_divided_where_a_row_has_none():
    table = put("z,timing.dwell_s\n5,2\n6,\n7,1\n")
    (panel,) = of_table(table, "z", ["dwell_s"]).panels
    (curve,) = panel.curves
    assert (panel.y.name, curve.style) == ("timing.dwell_s", JOINED)
    assert [x for x, _ in curve.pieces] == [[5.0], [7.0]]
    (curve,) = of_table(put("a,b\n2,1\n1,2\n"), "a", ["b"]).panels[0].curves
    assert curve.style == POINTS


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("arguments", "wants"),
    [
        ([SPEC, "--pick", "velocty"], 'velocty: no quantity of a cycle (did you mean "velocity"?)'),
        ([SPEC, "--x", "a"], "--x and --y are for a .csv"),
        ([SPEC, "-o", "no/such/folder.svg"], "cannot write: No such file or directory"),
        ([SPEC, "rows.csv"], "a csv is plotted by itself"),
        (["rows.csv", "--x", "a", "--y", "b", "-o", "rows.csv"], "is an input"),
    ],
)
def test_refused(arguments, wants):
    """One line, exit status 2, and nothing is left behind."""
    put("a,b\n1,2\n")
    found = run("plot", *arguments)
    assert found.exit_code == 2 and found.stdout == ""
    assert wants in found.stderr and found.stderr.count("\n") == 1
    assert os.listdir() == ["rows.csv"]


def test_a_quantity_that_one_design_lacks_is_left_out_with_a_word():
    loaded = str(repo.DESIGNS / "turret.toml")
    found = run("plot", SPEC, loaded, "--pick", "pin_force_N", "-o", "a.svg")
    assert found.exit_code == 0
    assert f"{SPEC}: warning: no curve of pin_force_N: no force is known" in found.stderr
    with open("a.svg", encoding="utf-8") as file:
        assert 'class="curve c1"' in file.read()


def test_one_spec_through_values_is_a_curve_for_each():
    """The same curves as of the key set over the file; several files have none to vary."""
    found = run("plot", SPEC, "--vary", "drive.A=0,0.6", "--pick", "velocity", "--format", "json")
    assert found.exit_code == 0, found.output
    alone = run("plot", SPEC, "--set", "drive.A=0", "--pick", "velocity", "--format", "json")
    rows, own = (json.loads(one.stdout)["rows"] for one in (found, alone))
    assert {row["curve"] for row in rows} == {"drive.A=0", "drive.A=0.6"}
    first = {(row["input_deg"], row["value"]) for row in rows if row["curve"] == "drive.A=0"}
    moving = {(row["input_deg"], row["value"]) for row in own if abs(row["input_deg"]) <= 60.0}
    assert len(moving) > 20 and moving <= first  # it begins to rest elsewhere in the window
    refused = run("plot", SPEC, SPEC, "--vary", "drive.A=0,0.6")
    assert refused.exit_code == 2 and "--vary is for one SPEC" in refused.output
