"""Specs that ``geneva new`` writes: valid, complete, and true to the keys."""

from pathlib import Path

import pytest
import tomli

from geneva_cli.machine.drives import KINDS as DRIVES
from geneva_cli.specfile.reader import TABLES, fields, kind_keys, load
from geneva_cli.specfile.template import KINDS, template
from geneva_cli.verdict.checks import checks


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_spec_loads_and_passes(kind: str, tmp_path: Path) -> None:
    file = tmp_path / "spec.toml"
    file.write_text(template(kind), encoding="utf-8")
    assert all(c.passes is not False for c in checks(load(str(file))))


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_is_there(kind: str) -> None:
    text = template(kind)
    for name, table in TABLES.items():
        assert f"[{name}]" in text
        for field in fields(table):
            assert f"\n{field.key} = " in text or f"\n# {field.key} = " in text
    drive = KINDS[kind][1].get("drive", {}).get("kind", "crank")
    for field in fields(kind_keys(drive)):
        assert f"\n{field.key} = " in text or f"\n# {field.key} = " in text


def test_every_kind_of_drive_has_a_template() -> None:
    """So that every key of `[drive]` is in one of them, beside the others of its kind."""
    begun = {given.get("drive", {}).get("kind", "crank") for _, given in KINDS.values()}
    assert begun == set(DRIVES)


def test_the_defaults_shown_are_the_defaults() -> None:
    """Uncommented, the keys with a default still describe the same machine."""
    lines = template("external").splitlines()
    shown = [
        x[2:] if x.startswith("# ") and " = " in x and "..." not in x else x for x in lines[2:]
    ]
    tree = tomli.loads("\n".join(shown))
    for name, table in TABLES.items():
        for field in fields(table):
            if field.key in tree[name] and field.default is not ...:
                assert tree[name][field.key] == field.default
