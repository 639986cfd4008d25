"""What is said of the release beside the code: one version everywhere."""

import re

from repo import ROOT
from typer.main import get_command

import geneva_cli
from geneva_cli.app import app


def test_the_citation_and_the_changes_name_this_version():
    version = geneva_cli.__version__
    citation = (ROOT / ".github/CITATION.cff").read_text()
    changes = (ROOT / ".github/CHANGELOG.md").read_text()
    assert f"\nversion: {version}\n" in citation
    assert re.search(r"^## (\S+?),? ", changes, re.M)[1] == version


def test_the_changes_name_every_command():
    changes = (ROOT / ".github/CHANGELOG.md").read_text()
    commands = set(get_command(app).commands)
    assert {name for name in commands if f"`{name}`" not in changes} == set()
