"""The list of keys: whole, findable, and true of what the reader takes."""

import pytest

from geneva_cli import GenevaError, load
from geneva_cli.motion import registry
from geneva_cli.names import UNITS
from geneva_cli.spec.schema import REQUIRED, fields
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.keys import about, all_keys

KINDS = [
    *[("wheel", registry.gearing(name)) for name in registry.GEARINGS],
    *[("drive", registry.drive(name)) for name in registry.DRIVES],
    *[("motion", registry.law(name)) for name in registry.LAWS],
    *PLAIN.items(),
]


def test_every_key_of_every_kind_is_listed():
    listed = {(k.table.strip("[]"), k.key, k.required, k.meaning) for k in all_keys()}
    for table, cls in KINDS:
        for field in fields(cls):
            assert (table, field.key, field.default is REQUIRED, field.meaning) in listed


def test_every_key_with_a_unit_in_its_name_says_it():
    """The part after the last underscore is a unit, or a word that is none."""
    words = {"angles", "max", "min", "variation", "ratio", "factor", "efficiency", "held", "file"}
    for key in all_keys():
        last = key.key.rpartition("_")[2]
        if f"_{last}" in UNITS:
            assert key.unit, key
        elif "_" in key.key and last in words:
            assert key.unit is None, key
    units = {key.key: key.unit for key in all_keys()}
    assert units["stiffness_Nm_rad"] == "N m/rad"


def test_found_by_table_by_key_and_by_both():
    assert {k.table for k in about("shaft")} == {"shaft"}
    assert {k.table for k in about("material")} == {"material.wheel", "material.roller"}
    assert {k.table for k in about("mass")} == {"[mass]"}
    assert [k.goes_with for k in about("drive.A")] == [
        "kind = side-crank",
        "kind = noncircular-gears",
    ]
    assert about("n_rpm")[0].default == "60.0"
    with pytest.raises(GenevaError, match='did you mean "friction"'):
        about("frction")


@pytest.mark.parametrize(
    "key", [k for k in all_keys() if k.default and k.table and not k.goes_with]
)
def test_a_default_is_what_the_reader_takes_for_a_missing_key(key, tmp_path):
    """Written out, it makes the same spec."""
    table = key.table.strip("[]")
    if table == "mass":
        body = '[[mass]]\nshape = "disc"\nmass_kg = 1\ndiameter_mm = 9\n'
        line = f"{body}{key.key} = {key.default}\n"
    else:
        body = ""
        line = f"[{table}]\n{key.key} = {key.default}\n" if table != "wheel" else ""
    wheel = "[wheel]\nz = 6\n" + (f"{key.key} = {key.default}\n" if table == "wheel" else "")
    if table == "motion":
        body, line = '[motion]\nlaw = "cycloidal"\n', line.replace("]\n", ']\nlaw = "cycloidal"\n')
    specs = []
    for name, text in (("with", wheel + line), ("without", "[wheel]\nz = 6\n" + body)):
        path = tmp_path / f"{name}.toml"
        path.write_text(text, encoding="utf-8")
        specs.append(load(str(path)).spec.replace(path="", files=()))
    assert specs[0] == specs[1]
