"""A table that grows: whole at the end, kept when stopped, continued only for the same request."""

import os
import subprocess
import sys
from contextlib import suppress

import pytest
from repo import get as read
from repo import posix, put

from geneva_cli.errors import GenevaError
from geneva_cli.output.growing import growing

NAMES, KEY = ["a", "b"], "request"
BLOCKS = [[[1, 3], [2, 4]], [[5], [6]], [[7], [8]]]  # columns of three blocks
WHOLE = "a,b\n1,2\n3,4\n5,6\n7,8\n"


@pytest.fixture
def path(tmp_path):
    return str(tmp_path / "rows.csv")


def run(path, blocks, resume=False, key=KEY, ends=True):
    """Add blocks; returns the number of rows that were there, and what was said."""
    with suppress(KeyboardInterrupt), growing(NAMES, key, path, resume) as rows:
        found = rows.done, rows.message
        for block in blocks:
            rows.append(block)
        if not ends:
            raise KeyboardInterrupt
    return found


def change(path, old, new):
    """Damage the state file."""
    with open(path + ".geneva", "rb") as file:
        whole = file.read()
    assert old in whole
    with open(path + ".geneva", "wb") as file:
        file.write(whole.replace(old, new))


def test_it_is_there_only_when_it_is_whole(path):
    put(path, "old")
    os.chmod(path, 0o640)  # Windows knows no groups
    run(path, BLOCKS[:2], ends=False)
    assert read(path) == "old"
    assert run(path, BLOCKS[2:], resume=True) == (
        3,
        "--resume: rows.csv.geneva: continues after row 3",
    )
    assert read(path) == WHOLE
    assert os.name == "nt" or os.stat(path).st_mode & 0o777 == 0o640
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]
    assert run(path, BLOCKS, resume=True)[0] == 0  # nothing is left to be continued


@pytest.mark.parametrize(
    ("old", "new", "kept"),
    [
        (b"7,8\n", b"7,", 2),
        (b"5,6\n", b"\0\0\0\0", 1),
        (b"1,2\n3,4\n", b"", 0),
        (b"3,4", b"3,5", 0),
    ],
)
def test_a_damaged_run_is_continued_from_its_last_whole_block(path, old, new, kept):
    run(path, BLOCKS, ends=False)
    change(path, old, new)
    done, _ = run(path, BLOCKS[kept:], resume=True)
    assert (done, read(path)) == ([0, 2, 3][kept], WHOLE)


@pytest.mark.parametrize("name", ["rows.csv", "rows.parquet"])
def test_a_state_that_is_damaged_meanwhile_does_not_become_the_file(path, name):
    path = path.replace("rows.csv", name)
    refused = pytest.raises(GenevaError, match="changed or damaged while the run wrote it")
    with refused, growing(NAMES, KEY, path) as rows:
        rows.append(BLOCKS[0])
        with open(path + ".geneva", "r+b") as file:
            file.seek(-1, 2)
            file.write(b"!")
        rows.append([["word"], [6]])
    assert os.listdir(os.path.dirname(path)) == [name + ".geneva"]


FOREIGN = {
    "a file of the user": lambda name: put(name, "notes\n"),
    "a pipe": lambda name: os.mkfifo(name),  # a run that opened it would wait for a writer for ever
    "a link": lambda name: (put("secret", "kept"), os.symlink("secret", name)),
}


@posix("pipes and links in folders")
@pytest.mark.parametrize("resume", [False, True])
@pytest.mark.parametrize("kind", FOREIGN)
def test_what_is_not_its_own_is_refused_and_stays(path, kind, resume, monkeypatch):
    monkeypatch.chdir(os.path.dirname(path))
    FOREIGN[kind]("rows.csv.geneva")
    before = {name: os.lstat(name)[:7] for name in os.listdir()}
    with pytest.raises(GenevaError, match=r"rows\.csv\.geneva: not .*rename it"):
        run("rows.csv", BLOCKS, resume)
    assert {name: os.lstat(name)[:7] for name in os.listdir()} == before


HOLD = """
import sys
from geneva_cli.output.growing import growing
with growing(["a", "b"], "request", sys.argv[1]) as rows:
    rows.append([[1], [2]])
    print("held", flush=True)
    sys.stdin.readline()
"""


def test_two_runs_do_not_write_one_file(path):
    """The rows of both were mixed, with NUL bytes between them, and one ended with status 0."""
    command = [sys.executable, "-c", HOLD, path]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, **pipes, encoding="utf-8") as process:
        assert process.stdout.readline() == "held\n"
        for resume in (False, True):
            with pytest.raises(GenevaError, match=r"rows\.csv: another run is writing this"):
                run(path, BLOCKS, resume)
        process.communicate("\n")
    assert (process.returncode, read(path)) == (0, "a,b\n1,2\n")
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]


def test_what_is_refused(path):
    run(path, BLOCKS, ends=False)
    with pytest.raises(GenevaError, match="has the rows of another run"):
        run(path, BLOCKS, True, "another")
    assert read(path + ".geneva").endswith("\n7,8\n")
    put(path)
    refused = pytest.raises(GenevaError, match="is an input")
    with refused, growing(NAMES, KEY, path, False, [path]):
        pass


@pytest.mark.parametrize("stopped", [1, 2])
def test_a_column_of_numbers_gets_words_after_a_stop(path, stopped):
    """A parquet file that is continued has the bytes of one run."""
    blocks = [*BLOCKS, [["word"], [None]]]
    files = []
    for name, kept in (("whole.parquet", 0), ("rows.parquet", stopped)):
        file = path.replace("rows.csv", name)
        if kept:
            run(file, blocks[:kept], ends=False)
        assert run(file, blocks[kept:], resume=True)[0] == sum(len(b[0]) for b in blocks[:kept])
        with open(file, "rb") as whole:
            files.append(whole.read())
    assert files[0] == files[1]
