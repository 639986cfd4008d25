"""Without its folder, its line, its designs and its tests, nothing misses a kind or an extra.

Each is deleted in a copy of the program. There `check` of some designs passes, and so do the quick
tests of the core: a sample of its rooms' tests. Tests elsewhere that name the kind are the kind's.
"""

import inspect
import os
import re
import shutil
import subprocess
import sys
import zlib

import pytest
from repo import DESIGNS, ROOT
from sampling import some

from geneva_cli import extras, kinds
from geneva_cli.kept import load_named

ROOMS = ["motion", "test_design.py"]
REST = ["numerics", "geometry", "drives", "loads", "specfile", "output", "parts", "verdict"]
ROOMS += some([*REST, "study", "cli"], [])
MANUAL = ["test_manual.py", "test_reference_pages.py", "test_explain.py"]
# A machine of each sort that the core has: what `check` says of it needs all rooms.
CHECKED = ("press-straight", "press-curved", "internal-z6", "side-crank-z6", "cam-geneva")
ONE_OF = some(10, 20)  # tests, so that a kind takes a minute, or 10 s
LEFT_OUT = "GENEVA_LEFT_OUT"  # what names the kind that a copy lacks, as a regular expression


def keys(folder):
    """A kind in a spec: its name, the wheel whose parts it draws, or a key of its name."""
    for kind in load_named(f"kinds.{folder}:KINDS"):
        if kind.adds_to and not kind.parts:
            yield rf"\b{kind.name} ?= ?[Tt]rue"
        else:
            yield f'"{kind.adds_to or kind.name}"'


def designs(folder):
    """The designs of a kind: their specs name it."""
    named = re.compile("|".join(keys(folder)))
    return [p for p in DESIGNS.glob("*.toml") if named.search(p.read_text(encoding="utf-8"))]


def names(room, folder):
    """What names a kind in a test: its module or design, its name in any writing, its key."""
    yield rf"{room}\.{folder}"
    if room == "extras":
        own = load_named(f"extras.{folder}:LAWS")
    else:
        yield from (rf"\b{path.stem}\b" for path in designs(folder))
        yield from keys(folder)
        own = [kind.name for kind in load_named(f"kinds.{folder}:KINDS") if not kind.adds_to]
    yield from (name.replace("-", "[-_ ]?") for name in own)


def copy_without(room, folder, to):
    """A copy of the repository, without a kind or an extra."""
    for name in ("geneva_cli", "tests", "designs"):
        shutil.copytree(ROOT / name, to / name)
    shutil.copy(ROOT / "pyproject.toml", to)
    shutil.rmtree(to / "geneva_cli" / room / folder)
    shutil.rmtree(to / "tests" / room / folder)
    if room == "kinds":
        for design in designs(folder):
            (to / "designs" / design.name).unlink()
    listed = to / "geneva_cli" / room / "__init__.py"
    text = listed.read_text(encoding="utf-8")
    listed.write_text(text.replace(f'    "{folder}",\n', ""), encoding="utf-8")


def pytest_collection_modifyitems(items):
    """Leave out the tests that name the missing kind, and all but a sample of the others."""
    named = re.compile(os.environ[LEFT_OUT], re.IGNORECASE)
    lot = [zlib.crc32(f"{named.pattern}{item.nodeid}".encode()) % ONE_OF for item in items]
    items[:] = [
        item
        for item, number in zip(items, lot, strict=True)
        if not number
        and not named.search(item.name)
        and not named.search(inspect.getsource(item.function))
    ]


def run(folder, *words, **more):
    to = {**os.environ, "PYTHONPATH": f"{folder}{os.pathsep}{folder / 'tests'}", **more}
    python = [sys.executable, "-m", *words]
    return subprocess.run(
        python, cwd=folder, env=to, capture_output=True, encoding="utf-8", check=False
    )


EVERY = [("kinds", name) for name in kinds.FOLDERS] + [("extras", name) for name in extras.FOLDERS]


@pytest.mark.parametrize(("room", "folder"), some(EVERY, [("kinds", "spherical")]))
def test_the_core_works_without(room, folder, tmp_path):
    copy_without(room, folder, tmp_path)
    checked = run(tmp_path, "geneva_cli", "check", *(f"designs/{d}.toml" for d in CHECKED))
    assert (checked.returncode, checked.stderr) == (0, "")
    # this file is the plugin that leaves tests out
    options = ["--assert=plain", "-ptest_without"]
    options += [f"--ignore=tests/cli/{file}" for file in MANUAL]
    left_out = {LEFT_OUT: "|".join(names(room, folder)), "GENEVA_STRESS": ""}
    tested = run(tmp_path, "pytest", *options, *(f"tests/{name}" for name in ROOMS), **left_out)
    assert tested.returncode == 0, tested.stdout
