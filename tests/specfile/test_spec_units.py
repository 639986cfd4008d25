"""Values with a unit: read in the unit of their key, against the constants of SciPy."""

import math
import re
import tomllib

import fuzz_studies
import pytest
from scipy import constants as si
from typer.testing import CliRunner

from geneva_cli import GenevaError, load
from geneva_cli.cli.app import app
from geneva_cli.names import UNITS as OF_KEYS
from geneva_cli.spec.units import UNITS, in_unit_of, pattern, unit_key
from geneva_cli.specfile.keys import all_keys

# What one of a unit is in SI units and radians, from another source than the table: CODATA's
# conversion factors in scipy.constants, and products of them.
# fmt: off
ONE = {
    "m": 1.0, "mm": si.milli, "cm": si.centi, "um": si.micro, "in": si.inch, "ft": si.foot,
    "kg": 1.0, "g": si.gram, "t": si.metric_ton, "lb": si.pound, "oz": si.ounce, "s": 1.0,
    "ms": si.milli, "min": si.minute, "h": si.hour, "Hz": 1.0, "deg": si.degree,
    "arcmin": si.arcminute, "rad": 1.0, "rev": 2.0 * math.pi, "rpm": 2.0 * math.pi / si.minute,
    "N": 1.0, "kN": si.kilo, "lbf": si.pound_force, "kgf": si.kilogram_force, "Nm": 1.0, "J": 1.0,
    "Pa": 1.0, "MPa": si.mega, "GPa": si.giga, "bar": si.bar, "psi": si.psi,
    "ksi": si.kilo * si.psi, "W": 1.0, "kW": si.kilo, "hp": si.horsepower,
}
# fmt: on
# Products and quotients, and the key's unit in SI units and radians.
PRODUCTS = [
    ("inertia_kgm2", "lb ft2", si.pound * si.foot**2),
    ("torque_Nm", "ft-lbf", si.pound_force * si.foot),
    ("density_kgm3", "g/cm³", si.gram / si.centi**3),
    ("stiffness_Nm_rad", "lbf in/rad", si.pound_force * si.inch),
    ("pv_max_W_m2", "kW/m2", si.kilo),
    ("n_rpm", "rad/s", si.minute / (2.0 * math.pi)),
]
# Two roundings in the constants of SciPy and one in the quotient of two of them.
CLOSE = 4.0 * 2.0**-53


def same_kind():
    """Pairs of units of one kind, each as a key's unit and as a written one."""
    endings = {unit_key("a" + end): "a" + end for end in OF_KEYS}
    for units in UNITS.values():
        for own in units:
            if own in endings:
                yield from ((endings[own], own, other) for other in units)


def test_units_against_codata():
    for key, own, unit in same_kind():
        for number in (-1e6, 0.1, 3.0, 1.7e5):
            expected = number * (ONE[unit] / ONE[own])
            assert in_unit_of(key, f"{number!r} {unit}") == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(("key", "unit", "one"), PRODUCTS)
def test_products_of_units(key, unit, one):
    # six roundings in a product of powers
    assert in_unit_of(key, f"3.5 {unit}") == pytest.approx(3.5 * one, rel=8.0 * 2.0**-53)
    assert re.fullmatch(pattern(), f"3.5 {unit}")


@pytest.mark.parametrize(
    ("text", "mm"),
    [
        ("8 in", 203.2),
        ("0.3 in", 7.62),
        ("3/8 in", 9.525),
        ("1 1/2 in", 38.1),
        ("-1 1/2 in", -38.1),
        ("5 µm", 0.005),
    ],
)
def test_a_length_is_the_nearest_float(text, mm):
    assert in_unit_of("radius_mm", text) == mm


@pytest.mark.parametrize(
    ("key", "text", "wants"),
    [
        ("a_mm", "8 lb", "must be in mm or cm, m, in, ft"),
        ("a_mm", "8 inn", "must be in mm or cm, m, in, ft"),
        ("a_mm", '8"', "must be in mm or cm, m, in, ft"),
        ("a_mm", "12,5 mm", "with a point"),
        ("a_mm", "8", '; with a unit it is a text such as "10 mm"'),
        ("a_mm", "1/0 in", "too large"),
        ("inertia_kgm2", "3 kg", "must be in kg m², or units of that kind"),
    ],
)
def test_what_is_wrong_is_said(key, text, wants):
    with pytest.raises(GenevaError, match=re.escape(wants)) as error:
        in_unit_of(key, text)
    assert key in str(error.value) and "  " not in str(error.value)


SPEC = """\
[wheel]
z = 6
steps_deg = ["1/6 rev", 60]
[drive]
n_rpm = "2 rad/s"
[size]
center_distance_mm = "8 in"
[[mass]]
shape = "disc"
mass_kg = "3 lb"
diameter_mm = "1 1/2 in"
[material.wheel]
youngs_modulus_GPa = "29e3 ksi"
"""


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(SPEC)
    return path


def test_a_spec_is_read_and_its_values_are_shown(spec):
    design = load(str(spec), ["size.roller_radius_mm=1/2 in"])
    assert design.spec.drive.n_rpm == pytest.approx(60.0 / math.pi, rel=1e-15)
    assert design.spec.size.roller_radius_mm == 12.7
    assert design.spec.wheel.steps_deg == (60.0, 60.0)
    assert design.spec.mass[0].mass_kg == pytest.approx(3.0 * 0.45359237, rel=1e-15)
    assert design.spec.material_wheel.youngs_modulus_GPa == pytest.approx(199.947961, rel=1e-8)


def test_the_schema_takes_units_where_the_reader_does():
    assert fuzz_studies.validator().is_valid(tomllib.loads(SPEC))
    assert not fuzz_studies.validator().is_valid(tomllib.loads(SPEC.replace("8 in", "8 inhc")))
    assert not fuzz_studies.validator().is_valid(tomllib.loads('[wheel]\nz = "6 mm"\n'))


@pytest.mark.parametrize(
    ("value", "wants"),
    [
        ("12,5 mm  # wide", 'write "12.5 mm" in quotation marks'),
        ("60 rpm", 'write "60 rpm" in quotation marks'),
    ],
)
def test_a_bare_value_gets_a_hint(tmp_path, value, wants):
    path = tmp_path / "bare.toml"
    path.write_text(f"[wheel]\nz = 6\n[drive]\nn_rpm = {value}\n")
    result = CliRunner().invoke(app, ["peaks", str(path)])
    assert result.exit_code == 2
    assert "bare.toml:4: not TOML: " in result.stderr and wants in result.stderr


def test_every_key_with_a_unit_takes_others_but_for_counts():
    """Hardness is of no unit of the table."""
    left = {k.key for k in all_keys() if k.unit and not unit_key(k.key)}
    assert left == {"flank_hardness_HRC"}
