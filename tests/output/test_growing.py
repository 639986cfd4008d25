"""A file that grows: whole at the end, kept when stopped, gone on from only for the same."""

import os
import subprocess
import sys
from contextlib import closing

import pytest
from repo import get as read
from repo import posix, put

from geneva_cli.errors import GenevaError
from geneva_cli.output.growing import GrowingFile

HEADER, KEY = "a,b\n", "request"


@pytest.fixture
def path(tmp_path):
    return str(tmp_path / "rows.csv")


def add(file, text):
    file.append(text.encode(), text.count("\n"))


def begun(path, *blocks, header=HEADER):
    """What a stopped run leaves."""
    with closing(GrowingFile(path, header, KEY, False)) as file:
        for block in blocks:
            add(file, block)


def change(path, old, new):
    """Damage the state file; returns it."""
    with open(path + ".geneva", "rb") as file:
        whole = file.read()
    assert old in whole
    with open(path + ".geneva", "wb") as file:
        file.write(whole.replace(old, new))


def resumed(path, *blocks, header=HEADER):
    """The rows that were there, what was said, and the file after ``blocks`` are added."""
    with closing(GrowingFile(path, header, KEY, True)) as file:
        done, message = file.done, file.message
        for block in blocks:
            add(file, block)
        file.finish()
    return done, message, read(path)


def test_it_is_there_only_when_it_is_whole(path):
    with open(path, "w", encoding="utf-8") as file:
        file.write("old")
    os.chmod(path, 0o640)  # Windows knows no groups
    with closing(GrowingFile(path, HEADER, KEY, False)) as file:
        add(file, "1,2\n")
        assert read(path) == "old"
        file.finish()
    assert read(path) == "a,b\n1,2\n"
    assert os.name == "nt" or os.stat(path).st_mode & 0o777 == 0o640
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]


def test_a_stopped_run_is_gone_on_from_its_last_whole_block(path):
    begun(path, "1,2\n3,4\n", "5,6\n")
    change(path, b"5,6\n", b"5,")  # stopped while it was written
    done, message, rows = resumed(path, "5,6\n")
    assert (done, rows) == (2, "a,b\n1,2\n3,4\n5,6\n")
    assert message == (
        "--resume: rows.csv.geneva is incomplete or damaged after row 2; continues there"
    )


THREE = ["1,2\n3,4\n", "5,6\n", "7,8\n"]  # blocks of rows


def test_a_block_that_is_lost_doubled_or_moved_is_noticed(path):
    begun(path, *THREE)
    with open(path + ".geneva", "rb") as file:
        start, *blocks = file.read().split(b"block ")
    blocks = [b"block " + block for block in blocks]
    for order, kept in (([0, 1, 3], 2), ([0, 1, 1, 2, 3], 2), ([0, 2, 1, 3], 0), ([1, 3], 2)):
        with open(path + ".geneva", "wb") as file:
            file.write(start + b"".join(blocks[i] for i in order))
        with closing(GrowingFile(path, HEADER, KEY, True)) as file:
            assert file.done == kept


def test_a_state_that_is_cut_meanwhile_does_not_become_the_file(path):
    with closing(GrowingFile(path, HEADER, KEY, False)) as file:
        for block in THREE:
            add(file, block)
        change(path, b"7,8\n", b"7,")
        with pytest.raises(GenevaError, match="somebody has changed this file"):
            file.finish()
    assert os.listdir(os.path.dirname(path)) == ["rows.csv.geneva"]
    assert resumed(path, *THREE[2:])[2] == HEADER + "".join(THREE)


FOREIGN = {
    "a file of the user": lambda name: put(name, "notes\n"),
    "a folder": os.mkdir,
    "a pipe": lambda name: os.mkfifo(name),  # a run that opened it would wait for a writer for ever
    "a link": lambda name: (put("secret", "kept"), os.symlink("secret", name)),
}


@pytest.mark.parametrize("resume", [False, True])
@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=posix("pipes and links in folders") if i > 1 else ())
        for i, kind in enumerate(FOREIGN)
    ],
)
def test_what_is_not_its_own_is_refused_and_stays(path, kind, resume, monkeypatch):
    """A user's file of that name was overwritten or deleted, a link followed."""
    monkeypatch.chdir(os.path.dirname(path))
    FOREIGN[kind]("rows.csv.geneva")

    def standing():  # all but the time of the last access, as the file is read
        each = {name: os.lstat(name) for name in os.listdir()}
        return {n: (s.st_mode, s.st_ino, s.st_size, s.st_mtime_ns) for n, s in each.items()}

    before = standing()
    with pytest.raises(GenevaError, match=r"rows\.csv\.geneva: .* something else has it"):
        GrowingFile(path, HEADER, KEY, resume)
    assert standing() == before


HOLD = """
import sys
from contextlib import closing
from geneva_cli.output.growing import GrowingFile
with closing(GrowingFile(sys.argv[1], "a,b\\n", "request", False)) as file:
    file.append(b"1,2\\n", 1)
    print("held", flush=True)
    sys.stdin.readline()
    file.finish()
"""


@pytest.fixture
def other_run(path):
    """A run of another process that has written a row."""
    command = [sys.executable, "-c", HOLD, path]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, **pipes, encoding="utf-8") as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


@pytest.mark.parametrize("resume", [False, True])
def test_two_runs_do_not_write_one_file(path, other_run, resume):
    """The rows of both were mixed, with NUL bytes between them, and one ended with status 0."""
    with pytest.raises(GenevaError, match=r"^rows\.csv: another run is writing this file"):
        GrowingFile(path, HEADER, KEY, resume)
    other_run.communicate("\n")
    assert other_run.returncode == 0
    assert read(path) == "a,b\n1,2\n"
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]


def test_it_does_not_go_on_for_another_request(path):
    begun(path, "1,2\n")
    with pytest.raises(GenevaError, match="has the rows of another run"):
        GrowingFile(path, HEADER, "another", True)
    assert read(path + ".geneva").endswith("\n1,2\n")


def whole(path, *lines):
    """A file made by a run that may be asked for again."""
    with closing(GrowingFile(path, HEADER, KEY, True)) as file:
        for line in lines:
            add(file, line)
        file.finish()


def test_of_a_whole_file_there_is_nothing_to_do(path):
    whole(path, "1,2\n")
    with closing(GrowingFile(path, HEADER, KEY, True)) as file:
        assert file.is_whole
        assert file.message == "--resume: rows.csv is whole already"
    assert read(path) == "a,b\n1,2\n"
    assert sorted(os.listdir(os.path.dirname(path))) == ["rows.csv", "rows.csv.geneva"]


def test_an_input_is_not_written_over(path):
    put(path, "")
    with pytest.raises(GenevaError, match="is an input"):
        GrowingFile(path, HEADER, KEY, False, [path])


@posix("/dev/null")
def test_no_device():
    with pytest.raises(GenevaError, match="not a file that can grow"):
        GrowingFile("/dev/null", HEADER, KEY, False)
