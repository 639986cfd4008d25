"""What is said of the release beside the code: one version everywhere."""

import re

from repo import ROOT

import geneva_cli


def test_the_citation_and_the_changes_name_this_version():
    version = geneva_cli.__version__
    citation = (ROOT / ".github/CITATION.cff").read_text(encoding="utf-8")
    changes = (ROOT / ".github/CHANGELOG.md").read_text(encoding="utf-8")
    assert f"\nversion: {version}\n" in citation
    assert re.search(r"^## (\S+?),? ", changes, re.M)[1] == version


def test_files_that_contributing_names_are_there() -> None:
    """Files and folders in backquotes, from the top or from the package."""
    text = (ROOT / ".github/CONTRIBUTING.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w.]+(?:/[\w.]+)*/?(?:\.(?:py|md|yml|toml))?)`", text))
    made = {"build/", ".venv/bin"}  # by make, which may run elsewhere
    # the example of a kind, which another test carries out in a copy
    made |= {name for name in named if "kinds/reduced" in name}
    paths = {name for name in named if "/" in name} - made
    assert len(paths) > 5
    tops = (ROOT, ROOT / "geneva_cli")
    assert {path for path in paths if not any((top / path).exists() for top in tops)} == set()
