"""Layers of sheets: their names are the manual's."""

import io
import re
from pathlib import Path

import ezdxf
import pytest
import repo

from geneva_cli import load
from geneva_cli.output.dxf import sheet_chunks

pytestmark = pytest.mark.usefixtures("made_once")
TOLERANCE = 0.05  # mm: coarse walls are quick, and have the same layers
FORMATS = Path(repo.ROOT, "geneva_cli/manual/reference/formats.md")


def listed():
    """The names of layers in the manual's page of formats."""
    text = FORMATS.read_text(encoding="utf-8")
    table = text.partition("| layer | content |")[2].partition("\n\n")[0]
    first = [line.split("|")[1] for line in table.splitlines()[2:]]
    return set(re.findall(r"`([A-Z]+)`", " ".join(first)))


@pytest.mark.long
@pytest.mark.parametrize("name", ["turret", "four-bar-z4"])
def test_a_sheets_layers_have_the_manuals_names(name):
    text = "".join(sheet_chunks(load(str(repo.DESIGNS / f"{name}.toml")).sheet(TOLERANCE)))
    document = ezdxf.read(io.StringIO(text))
    own = {layer.dxf.name for layer in document.layers} - {"0", "Defpoints"}
    assert own <= listed()
    assert "CENTER" in own
