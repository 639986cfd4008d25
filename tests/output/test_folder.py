"""Filling a folder: what killed and stopped runs leave, two runs at once, and foreign lists."""

import os
import signal
import subprocess
import sys
from contextlib import nullcontext

import pytest
from repo import get, posix, put

from geneva_cli.errors import GenevaError
from geneva_cli.output.folder import LIST, Row, filling_folder

# A run that fills "out" and stops at a point: the n-th renaming ends it.
RUN = """
import os, signal, sys
from geneva_cli.output import files, folder

text, number, at = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
usual, calls = os.replace, iter(range(1000))
def replace(*paths):
    if next(calls) == at:
        os.kill(os.getpid(), number)
    return usual(*paths)
os.replace = replace
with folder.filling_folder("out", [folder.Row(f, "") for f in "ab"]) as (new, kept):
    for name in "ab":
        files.write(os.path.join(new, name), [text])
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path / "out"


def run(text, number=0, at=-1):
    command = [sys.executable, "-c", RUN, text, str(int(number)), str(at)]
    return subprocess.run(command, timeout=60).returncode


def texts():
    return {get(f"out/{name}") for name in "ab"}


@posix("signals that a process sends to itself")
@pytest.mark.sampled(2)
@pytest.mark.parametrize("at", range(7))
def test_a_killed_run_is_made_good_by_the_next(folder, at):
    """Killed before each renaming: of both new files, the list, it and both to their places.

    The files are then the old or the new ones, and the next run knows them as its own.
    """
    assert run("old") == 0
    assert run("new", signal.SIGKILL, at) == -signal.SIGKILL
    assert texts() <= {"old", "new"}
    assert run("last") == 0
    assert texts() == {"last"}
    assert sorted(os.listdir(folder)) == ["a", "b", LIST]


@posix("signals that a process sends to itself")
@pytest.mark.sampled(2)
@pytest.mark.parametrize(("at", "status"), [(1, 130), (4, 0)])
def test_an_interrupt_leaves_all_old_or_all_new_files(folder, at, status):
    """It is ignored while files are moved to their places."""
    assert run("old") == 0
    assert run("new", signal.SIGINT, at) == status
    assert texts() == {"old" if status else "new"}
    assert sorted(os.listdir(folder)) == ["a", "b", LIST]


def test_two_runs_at_once(folder):
    busy = pytest.raises(GenevaError, match=r"contents\.csv: another run is writing this")
    with filling_folder("out", []), busy, filling_folder("out", []):
        pass
    assert os.listdir(folder) == [LIST]


def test_an_error_removes_only_a_folder_that_is_new(folder):
    for kept in (False, True):
        if kept:
            folder.mkdir()
        with pytest.raises(ZeroDivisionError), filling_folder("out", [Row("a", "")]):
            raise ZeroDivisionError
        assert folder.exists() == kept


@posix("links without the rights of an administrator")
@pytest.mark.parametrize("name", ["../kept", "link"])
def test_a_list_leads_to_no_other_place(folder, name):
    """Neither a name with a folder nor a link makes a run replace or remove what lies elsewhere."""
    assert run("old") == 0
    os.rename("out/a", "kept")
    os.symlink(os.path.abspath("kept"), "out/link")
    put(f"out/{LIST}", get(f"out/{LIST}").replace("a,", f"{name},"))
    before = sorted(os.listdir(folder))
    with pytest.raises(GenevaError, match="not written by") if "/" in name else nullcontext():
        with filling_folder("out", [Row("b", "")]) as (new, kept):
            put(os.path.join(new, "b"), "new")
        assert kept == ["link"]
    assert get("kept") == "old"
    assert sorted(os.listdir(folder)) == before
