"""Numbers for people in inches and pounds: each is the SI number by the constants of SciPy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from repo import DESIGNS
from scipy import constants as si
from typer.testing import CliRunner

from geneva_cli import load
from geneva_cli.cli.app import app
from geneva_cli.names import UNITS
from geneva_cli.output.inches import (
    document_in_inches,
    figure_in_inches,
    table_in_inches,
    text_in_inches,
    value_in_inches,
)
from geneva_cli.study.document import document
from geneva_cli.table import Table, pieces

# What one of a unit is in SI units.
ONE = {
    "mm": si.milli,
    "µm": si.micro,
    "m": 1.0,
    "in": si.inch,
    "thou": si.mil,
    "ft": si.foot,
    "m/s": 1.0,
    "in/s": si.inch,
    "m/s²": 1.0,
    "in/s²": si.inch,
    "m/s³": 1.0,
    "in/s³": si.inch,
    "mm/1e6": si.milli,
    "in/1e6": si.inch,
    "N": 1.0,
    "lbf": si.pound_force,
    "N m": 1.0,
    "J": 1.0,
    "lbf in": si.pound_force * si.inch,
    "N m/rad": 1.0,
    "lbf in/rad": si.pound_force * si.inch,
    "MPa": si.mega,
    "GPa": si.giga,
    "ksi": si.kilo * si.psi,
    "kg": 1.0,
    "lb": si.pound,
    "kg m²": 1.0,
    "lb in²": si.pound * si.inch**2,
    "kg/m³": 1.0,
    "lb/in³": si.pound / si.inch**3,
}
INCH = {"in", "thou", "ft", "in/s", "in/1e6", "lbf", "lbf in", "lbf in/rad", "ksi"}
INCH |= {"in/s²", "in/s³", "lb", "lb in²", "lb/in³"}
# six roundings in a product of the constants, and one in the number
CLOSE = 8.0 * 2.0**-53
TURRET = str(DESIGNS / "turret.toml")


@pytest.mark.sampled(10)
@pytest.mark.parametrize("unit", sorted({*UNITS.values()} - INCH))
@given(number=st.floats(-1e6, 1e6))
def test_a_number_is_the_same_quantity(unit, number):
    value, other = value_in_inches(number, unit)
    assert (other in INCH) == (unit in ONE)
    if other != unit:
        assert value == pytest.approx(number * ONE[unit] / ONE[other], rel=CLOSE, abs=1e-300)


def run(*words):
    return CliRunner().invoke(app, [*words])


def test_a_long_table_is_converted_in_pieces():
    columns = pieces(70_000, 2, lambda a, b: [np.arange(a, b) * 25.4, np.arange(a, b) * 1.0])
    table = Table(("x_mm", "input_deg"), columns)
    other = table_in_inches(table)
    assert other.names == ("x_in", "input_deg")
    *_, last = other.rows()
    assert last == (pytest.approx(69_999.0, rel=1e-15), 69_999.0)


def test_a_figure_is_scaled():
    figure = load(TURRET).figure(["pin_force_N", "velocity"])
    force, speed = figure_in_inches(figure).panels
    assert force.y.unit == "lbf" and speed == figure.panels[1]
    peak = max(m.y for m in force.curves[0].marks)
    assert peak * si.pound_force == pytest.approx(202.5396, rel=1e-6)  # the digits of the tutorial


@pytest.mark.long
@pytest.mark.parametrize(
    ("words", "wants"),
    [
        (["check", TURRET], "crank shaft stress 8.907 ksi at"),
        (["loads", TURRET], "2.456 to 158.9 lbf in, rms 51.47"),
        (["profile", TURRET, "--samples", "3", "--format", "md"], "left_x_in"),
        (["compare", TURRET, "--pick", "sizes.center_distance_mm"], "sizes.center_distance_in"),
    ],
)
def test_commands_show_them(words, wants):
    assert wants in run(*words, "--units", "inch").stdout
    assert run(*words).stdout == run(*words, "--units", "mm").stdout


@pytest.mark.parametrize(
    ("words", "wants"),
    [
        (["loads", TURRET, "--format", "json"], "json is for programs, and in SI units"),
        (["sweep", TURRET, "--vary", "wheel.z=6,8"], "csv and parquet are for programs"),
        (["compare", TURRET, "--ratio"], "ratios have no unit"),
    ],
)
def test_what_stays_in_si_units_is_refused(words, wants):
    result = run(*words, "--units", "inch")
    assert result.exit_code == 2 and wants in result.stderr


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("is 0.3024 kg m², 25.2 % of", f"is {0.3024 / ONE['lb in²']:.4g} lb in², 25.2 % of"),
        ("at Ø 12 mm, 0.045 to 1.2 mm,", "at Ø 0.4724 in, 0.001772 to 0.04724 in,"),
        ("mass_kg = 15.6 and 2 m/s²", f"mass_kg = 15.6 and {2.0 / ONE['in/s²']:.4g} in/s²"),
        ("H11/c11 of ISO 286 in 5 min", "H11/c11 of ISO 286 in 5 min"),
    ],
)
def test_a_sentence_is_in_inches(text, shown):
    assert text_in_inches(text) == shown


def test_a_document_keeps_the_keys_of_the_spec():
    page = document(load(TURRET))
    other = document_in_inches(page)
    texts = repr(other.blocks)
    assert "'size.center_distance_mm', '250', 'mm'" in texts  # the spec's own key and value
    assert "Fact(name='Centre distance', value=9.8425196" in texts
    for block, before in zip(other.blocks, page.blocks, strict=True):
        assert type(block) is type(before)
