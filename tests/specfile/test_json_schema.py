"""JSON Schema of a spec: it says what the reader says."""

import random
import tomllib

import fuzz_studies
import pytest
import repo
from fuzz import folder

from geneva_cli.specfile.keys import FILE, schema
from geneva_cli.specfile.template import KINDS, template


def faults(text):
    return [error.message for error in fuzz_studies.validator().iter_errors(tomllib.loads(text))]


@pytest.mark.parametrize("design", sorted(repo.DESIGNS.glob("*.toml")), ids=lambda d: d.stem)
def test_every_design_keeps_to_it(design):
    assert faults(design.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("kind", KINDS)
def test_every_new_spec_keeps_to_it_and_names_it(kind):
    text = template(kind)
    assert text.splitlines()[0] == f"#:schema ./{FILE}"
    assert faults(text) == []


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[wheel]\nz = 2\n",
        '[wheel]\nz = 6\n[drive]\nkind = "side-crank"\n',  # no A
        "[wheel]\nz = 6\n[drive]\nA = 0.3\n",  # of another kind
        "[wheel]\nz = 6\n[motion]\nalpha0_deg = 3\n",  # without a law
        '[wheel]\nz = 6\n[motion]\nlaw = "cycloidal"\nratio = "mached"\n',
        "[wheel]\nz = 6\n[mass]\nmass_kg = 3\n",  # not a list
        "[wheel]\nz = 6\n[load]\nefficiency = 1.5\n",
    ],
)
def test_it_refuses_what_the_reader_refuses(text):
    assert fuzz_studies.schema(text) == "refused" and faults(text)


@pytest.mark.long
def test_it_agrees_with_the_reader_on_mutated_specs():
    rng = random.Random(7)
    with folder():
        ends = [fuzz_studies.schema(fuzz_studies.schema_case(rng)) for _ in range(60)]
    assert 6 < ends.count("machine") < 54


def test_a_key_of_several_kinds_has_the_meaning_of_the_first():
    """An editor shows it before the kind is written."""
    assert schema()["properties"]["drive"]["properties"]["A"]["description"].startswith(
        "side-crank"
    )
