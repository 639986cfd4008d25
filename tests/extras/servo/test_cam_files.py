"""Electronic cams: each file read back, and drawn as its controller draws it."""

import re

import numpy as np
import pytest
import repo
from scipy.interpolate import BPoly, PPoly
from typer.testing import CliRunner

from geneva_cli import GenevaError, load
from geneva_cli.cli.app import app
from geneva_cli.extras.servo.electronic_cam import cam

DESIGNS = repo.wheels()
SOME = ("turret", "two-pins-z4", "unequal-steps", "side-crank-z6", "gear-sector", "sine-group")
TOLERANCE = 1e-4


def true_motion(design):
    """Master and slave at 40,001 even places of a period, degrees from the first entry."""
    table = design.motion(40_001).to_dict()
    return table["input_deg"] - table["input_deg"][0], table["wheel_deg"] - table["wheel_deg"][0]


def polynomial(table):
    """The slave's function, by SciPy: coefficients from the highest power down."""
    columns = table.to_dict()
    breaks = np.append(columns["begin_deg"], columns["end_deg"][-1])
    return PPoly(np.stack([columns[f"c{k}"] for k in range(5, -1, -1)]), breaks)


def codesys(text):
    """The slave's function from a declaration, by Bernstein polynomials of SciPy."""
    rows = re.findall(r"dX := (.*?), dY := (.*?), dV := (.*?), dA := (.*?)\)", text)
    x, y, v, a = np.array(rows, float).T
    assert f"nElements := {len(x)})" in text
    assert float(re.search(r"xEnd := (.*?),", text)[1]) == x[-1]
    return BPoly.from_derivatives(x, np.stack([y, v, a], axis=1)), x


@pytest.mark.parametrize("file", DESIGNS, ids=lambda file: file.stem)
@pytest.mark.sampled(6)
def test_polynomials_keep_the_tolerance(file):
    """The polynomials, evaluated by SciPy, are within the tolerance and their stated error."""
    design = load(str(file))
    table, rows, error_deg = cam(design, "polynomial", None, TOLERANCE)
    master, slave = true_motion(design)
    off = abs(polynomial(table)(master) - slave)
    assert rows == len(table)
    assert error_deg <= TOLERANCE
    assert off.max() <= error_deg + 1e-12  # rounding is some 1e-13 degrees


@pytest.mark.parametrize("name", SOME)
def test_codesys_points_keep_the_tolerance(name):
    """Between the points, polynomials of degree five by SciPy are as near as the file says."""
    design = load(f"designs/{name}.toml")
    text, rows, error_deg = cam(design, "codesys", None, TOLERANCE)
    function, x = codesys(text)
    master, slave = true_motion(design)
    off = abs(function(master) - slave).max()
    assert rows == len(x)
    assert (np.diff(x) > 0.0).all()
    assert 0.9 * error_deg <= off <= error_deg <= TOLERANCE


def test_a_whole_revolution():
    """Eight turns of the turret's crank turn its wheel once, without a step back."""
    design = load("designs/turret.toml")
    table = design.motion(17, turns=8).to_dict()
    assert table["wheel_deg"][-1] - table["wheel_deg"][0] == pytest.approx(360.0, abs=1e-9)
    assert (np.diff(table["wheel_deg"]) >= 0.0).all()
    for controller in ("polynomial", "codesys"):
        content, _, _ = cam(design, controller, 8, TOLERANCE)
        function = polynomial(content) if controller == "polynomial" else codesys(content)[0]
        assert function(8 * 360.0) == pytest.approx(360.0, abs=1e-9)
        assert function(5 * 360.0 - 1.0) == pytest.approx(225.0, abs=1e-7)
        assert function(5 * 360.0 + 67.5) == pytest.approx(225.0 + 22.5, abs=TOLERANCE)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("siemens", None, 1e-4), "--for siemens: it must be one of polynomial, codesys"),
        (("codesys", 0, 1e-4), "--turns 0: must be at least 1, at most 1000"),
        (("codesys", 1, 0.0), "--tolerance 0: must be at least 1e-12"),
    ],
)
def test_refused(arguments, message):
    """What a controller cannot read is refused, with what it can."""
    with pytest.raises(GenevaError, match=re.escape(message)):
        cam(load("designs/turret.toml"), *arguments)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        ("--for codesys", 0, "degrees of the wheel\n"),
        ("--for codesys --tolerance 1e-9", 1, "more than --tolerance 1e-09"),
        ("--tolerance 1e-12", 0, "degrees of the wheel\n"),
    ],
)
def test_a_tolerance_that_is_not_met_is_said(arguments, status, said, tmp_path):
    """The cam is written all the same; without --tolerance nothing is demanded of it."""
    words = f"motion designs/turret.toml --format cam {arguments} -o {tmp_path / 'cam'}".split()
    result = CliRunner().invoke(app, words)
    assert (result.exit_code, said in result.stderr) == (status, True)
    assert (tmp_path / "cam").stat().st_size > 0
