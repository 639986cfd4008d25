"""Filling a folder: what killed and stopped runs leave, two runs at once, and foreign lists."""

import os
import signal
import subprocess
import sys
from contextlib import nullcontext

import pytest
from repo import posix

from geneva_cli.errors import GenevaError
from geneva_cli.output.folder import LIST, TEMPORARY, Row, filling_folder

# A run that fills "out" and stops at a point: the n-th call of a function ends it.
RUN = """
import os, signal, sys, time
from geneva_cli.output import folder
from geneva_cli.output.files import write

def at(n, name, act):
    calls, usual = iter(range(1000)), getattr(os, name)
    def counted(*a, **k):
        if next(calls) == n:
            act()
        return usual(*a, **k)
    setattr(os, name, counted)

me, text = os.getpid(), sys.argv[1]
exec(sys.argv[2])
with folder.filling_folder("out", [folder.Row(f, "") for f in "ab"]) as filling:
    for name in "ab":
        write(os.path.join(filling.new, name), [text])
"""
KILL = "lambda: os.kill(me, signal.SIGKILL)"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path / "out"


def run(text, stop=""):
    return subprocess.run([sys.executable, "-c", RUN, text, stop], timeout=60).returncode


def texts(folder):
    return {
        p.name: p.read_text(encoding="utf-8")
        for p in folder.iterdir()
        if p.is_file() and p.name != LIST
    }


@posix("signals that a process sends to itself")
@pytest.mark.long
@pytest.mark.parametrize("n", range(8))
def test_a_killed_run_is_made_good_by_the_next(folder, n):
    """Killed before each renaming: of both new files, the list, both to their places, the list.

    The files are then the old or the new ones, and the next run knows them as its own.
    """
    assert run("old") == 0
    assert run("new", f"at({n}, 'replace', {KILL})") == -signal.SIGKILL
    assert set(texts(folder).values()) <= {"old", "new"}
    assert (folder / TEMPORARY).is_dir()
    assert run("last") == 0
    assert texts(folder) == {"a": "last", "b": "last"}
    assert sorted(os.listdir(folder)) == ["a", "b", LIST]


@posix("signals that a process sends to itself")
@pytest.mark.sampled(3)
@pytest.mark.parametrize(("n", "whole"), [(1, "old"), (2, "new"), (4, "new")])
def test_an_interrupt_leaves_all_old_or_all_new_files(folder, n, whole):
    """It waits while files are moved to their places."""
    assert run("old") == 0
    interrupt = f"at({n}, 'replace', lambda: os.kill(me, signal.SIGINT))"
    assert run("new", interrupt) == 128 + signal.SIGINT
    assert texts(folder) == {"a": whole, "b": whole}
    assert sorted(os.listdir(folder)) == ["a", "b", LIST]


def test_two_runs_at_once(folder):
    busy = pytest.raises(GenevaError, match="another run is writing into this folder")
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
@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["../kept", "/etc/kept", "link"])
def test_a_list_leads_to_no_other_place(folder, tmp_path, name):
    """Neither a name with a folder nor a link makes a run replace or remove what lies elsewhere."""
    assert run("old") == 0
    kept = tmp_path / "kept"
    (folder / "a").rename(kept)
    (folder / "link").symlink_to(kept)
    listed = (folder / LIST).read_text(encoding="utf-8")
    (folder / LIST).write_text(listed.replace("a,", f"{name},"))
    (folder / "b").unlink()
    before = sorted(os.listdir(folder))
    with pytest.raises(GenevaError, match="not written by") if "/" in name else nullcontext():
        with filling_folder("out", []) as filling:
            pass
        assert filling.kept == ["link"]
    assert kept.read_text(encoding="utf-8") == "old"
    assert sorted(os.listdir(folder)) == before
