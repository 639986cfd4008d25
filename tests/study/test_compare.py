"""Designs side by side: the same rows for every machine, and the numbers of their own reports."""

import os

import pytest

from geneva_cli import GenevaError
from geneva_cli.study.compare import compare

pytestmark = pytest.mark.usefixtures("made_once")
HERE = os.path.dirname(__file__)
DESIGNS = os.path.join(HERE, os.pardir, os.pardir, "designs")


def path(name):
    return os.path.join(DESIGNS, name)


def by_quantity(table):
    return {row["quantity"]: row for row in table.to_rows()}


def test_the_papers_ratios():
    """Polyudov and Kandyak: at A = 0.6, z = 6 the plain crank's velocity, acceleration and kinetic
    power are 1.600, 2.583 and 4.164 times as high."""
    found = by_quantity(compare([path("side-crank-z6.toml")], vary=["drive.A=0.6,0"], ratio=True))
    ratios = [found[f"{name}.max"]["drive.A=0"] for name in ("velocity", "acceleration", "power")]
    assert [round(r, 3) for r in ratios] == [1.6, 2.583, 4.164]


def test_what_nothing_bounds_is_none():
    """Two pins of which one dwell has no length, and a wall as sharp as its roller: in the report's
    json null, and no fault of the program."""
    pins = by_quantity(compare([path("two-pins-z4.toml")]))
    assert "timing.k" not in pins and "acceleration.max" in pins
    limited = ["limits.contact_stress_max_MPa=500"]
    stress = "checks.contact_stress_max_MPa"
    found = by_quantity(compare([path("press-345.toml")], limited, picks=[stress, "passes"]))
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
    found = by_quantity(compare([str(spec)], vary=["size.center_distance_mm=100,90,100.000001"]))
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
        ({"settings": ["outline.wheel=wheel.dxf"]}, "a comparison is of formulas, and turns no"),
        (
            {"vary": ["drive.A=0..1:0.001"]},
            "1,001 designs; at most 100 can be compared",
        ),
    ],
)
def test_what_cannot_be_compared(arguments, said):
    with pytest.raises(GenevaError) as error:
        compare([path("side-crank-z6.toml")], **arguments)
    assert said in str(error.value)
