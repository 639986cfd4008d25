"""Without its folder, its line, its designs and its tests, nothing misses a kind or an extra.

Each is deleted in a copy of the program. There the quick tests of the core pass, and so does
`check` of some designs.
"""

import os
import re
import shutil
import subprocess
import sys

import pytest
from repo import DESIGNS, ROOT
from sampling import some

from geneva_cli.kinds import FOLDERS
from geneva_cli.spec.load_named import load_named

EXTRAS = ("certify", "servo")
ROOMS = ["numerics", "geometry", "motion", "drives", "loads", "specfile", "output", "parts"]
ROOMS += ["verdict", "study", "cli", "test_design.py"]
# A machine of each sort that the core has: what `check` says of it needs all rooms.
CHECKED = ("press-straight", "press-curved", "internal-z6", "side-crank-z6", "cam-geneva")


def words(folder):
    """What the specs of a kind's designs say: its name, or the wheel whose parts it draws."""
    kinds = load_named(f"kinds.{folder}:KINDS")
    return {kind.adds_to if kind.parts and kind.adds_to else kind.name for kind in kinds}


def designs(folder):
    """The designs of a kind: their specs say one of its words."""
    said = "|".join(words(folder))
    needs = re.compile(rf'^(gearing|kind) = "({said})"|^({said}) = true', re.MULTILINE)
    return [p for p in DESIGNS.glob("*.toml") if needs.search(p.read_text(encoding="utf-8"))]


def copy_without(room, name, to):
    """A copy of the repository in a folder, without a kind or an extra."""
    for folder in ("geneva_cli", "tests", "designs"):
        shutil.copytree(ROOT / folder, to / folder)
    shutil.copy(ROOT / "pyproject.toml", to)
    shutil.rmtree(to / "geneva_cli" / room / name)
    shutil.rmtree(to / "tests" / room / name)
    if room == "kinds":
        for design in designs(name):
            (to / "designs" / design.name).unlink()
    listed = to / "geneva_cli" / room / "__init__.py"
    text = listed.read_text(encoding="utf-8")
    listed.write_text(text.replace(f'    "{name}",\n', ""), encoding="utf-8")


def run(folder, *words):
    python = [sys.executable, *words]
    place = {**os.environ, "PYTHONPATH": str(folder)}
    return subprocess.run(
        python, cwd=folder, env=place, capture_output=True, text=True, check=False
    )


EVERY = [("kinds", name) for name in FOLDERS] + [("extras", name) for name in EXTRAS]


@pytest.mark.parametrize(("room", "name"), some(EVERY, []))
def test_the_core_works_without(room, name, tmp_path):
    copy_without(room, name, tmp_path)
    checked = [f"designs/{design}.toml" for design in CHECKED]
    shown = run(tmp_path, "-m", "geneva_cli", "check", *checked)
    assert (shown.returncode, shown.stderr) == (0, "")
    tested = run(tmp_path, "-m", "pytest", *(f"tests/{room}" for room in ROOMS))
    assert tested.returncode == 0, tested.stdout
