"""Tables that are lists or stand in another: read, complained of by their line, written back."""

import pytest

from geneva_cli import GenevaError, design
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.specfile.writer import spec_lines

TURRET = """\
[wheel]
z = 8
[support]
friction = 0.1
radius_mm = 125
[[mass]]
shape = "disc"
diameter_mm = 300
mass_kg = 11.026

[[mass]]
shape = "block"
length_mm = 40
width_mm = 30
thickness_mm = 20
density_kgm3 = 7850
count = 6
radius_mm = 100
[material.wheel]
youngs_modulus_GPa = 3.2
"""


@pytest.fixture
def turret(tmp_path):
    def with_(old, new):
        path = tmp_path / "turret.toml"
        path.write_text(TURRET.replace(old, new, 1))
        return design.load(str(path))

    return with_


def test_lists_and_tables_in_tables_are_read(turret):
    spec = turret("", "").spec
    assert [one.shape for one in spec.mass] == ["disc", "block"]
    assert spec.mass[1].count == 6
    assert [of(spec).youngs_modulus_GPa for of in (wheel_material, roller_material)] == [3.2, 210.0]


def test_what_is_written_is_read_back(turret, tmp_path):
    spec = turret("", "").spec
    path = tmp_path / "again.toml"
    path.write_text("\n".join(spec_lines(spec)))
    again = design.load(str(path)).spec
    assert again.replace(path="", files=()) == spec.replace(path="", files=())


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ('shape = "block"', 'shape = "blok"', 12, 'number 2: shape = "blok" must be one of'),
        ("mass_kg = 11.026", "", 6, "number 1: set either mass_kg, or density_kgm3 with all sizes"),
        ("thickness_mm = 20\n", "", 15, "number 2: density_kgm3 needs thickness_mm"),
        ("mass_kg = 11.026", "mass_kg = 1\nbore_mm = 3", 10, "diameter_mm: remove bore_mm"),
        ("[material.wheel]", "[material.whel]", 19, "unknown key whel in [material]"),
        ("youngs_modulus_GPa = 3.2", "youngs_modulus_GPa = -1", 20, "must be above 0"),
    ],
)
def test_errors_name_the_line(turret, old, new, line, said):
    with pytest.raises(GenevaError) as error:
        turret(old, new)
    assert f"turret.toml:{line}: " in str(error.value)
    assert said in str(error.value)


def test_one_of_a_list_is_changed(turret):
    changed = turret("", "").with_("mass.1.count", 4).with_("material.wheel.density_kgm3", 1190.0)
    assert [one.count for one in changed.spec.mass] == [1, 4]
    assert changed.spec.material_wheel.density_kgm3 == 1190.0
    with pytest.raises(GenevaError, match=r"no \[mass.2\]"):
        changed.with_("mass.2.count", 4)
