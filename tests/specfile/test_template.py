"""Specs that ``geneva new`` writes: valid, complete, and true to the keys."""

from pathlib import Path

import pytest
import tomli

from geneva_cli import load
from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Motion
from geneva_cli.spec.schema import SpecTable, fields
from geneva_cli.spec.tables import Limits, Load, Size
from geneva_cli.specfile.template import KINDS, template

LAWS = [registry.law(name) for name in registry.LAWS]
WORDS = {"wheel": "gearing", "drive": "kind", "motion": "law"}  # the keys that name a kind


def words(kind: str) -> tuple[str, str]:
    """The gearing and the drive that a template sets."""
    tree = tomli.loads(template(kind))
    return tree["wheel"].get("gearing", "external"), tree["drive"].get("kind", "crank")


def tables(kind: str) -> list[type[SpecTable]]:
    """The classes whose fields are the keys of a template, all laws among them."""
    gearing, drive = words(kind)
    return [registry.gearing(gearing), registry.drive(drive), *LAWS, Motion, Size, Load, Limits]


def test_every_drive_but_the_plain_crank_has_an_example() -> None:
    assert {*registry.DRIVES} - {*KINDS} == {"crank"}


@pytest.mark.sampled(16)
@pytest.mark.parametrize("kind", KINDS)
def test_a_new_spec_passes_and_is_exported_as_it_is(kind: str, tmp_path: Path) -> None:
    """A drawing of the wheel, and its slots as a table."""
    file = tmp_path / "spec.toml"
    file.write_text(template(kind), encoding="utf-8")
    design = load(str(file))
    assert all(c.passes is not False for c in design.checks)
    assert len(design.slot()) >= 3
    assert design.drawing("wheel").layers


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_is_there(kind: str) -> None:
    text = template(kind)
    keys = set(WORDS.items())
    for table in tables(kind):
        keys |= {(table.TABLE, field.key) for field in fields(table)}
    assert {name for name, _ in keys} == {"wheel", "drive", "motion", "size", "load", "limits"}
    for name, key in keys:
        _, _, table = text.partition(f"\n[{name}]\n")
        table, _, _ = ("\n" + table).partition("\n[")
        assert f"\n{key} = " in table or f"\n# {key} = " in table, (name, key)


@pytest.mark.parametrize("kind", KINDS)
def test_a_short_spec_is_the_whole_one_without_what_it_leaves_out(
    kind: str, tmp_path: Path
) -> None:
    """Both describe the same machine."""
    text, file = template(kind, whole=False), tmp_path / "spec.toml"
    specs = []
    for written in (text, template(kind)):
        file.write_text(written, encoding="utf-8")
        specs.append(load(str(file)).spec)
    assert specs[0] == specs[1]
    assert len([line for line in text.splitlines() if line and not line.startswith("[")]) <= 30
