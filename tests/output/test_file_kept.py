"""What a file that is written to keeps, what is never replaced, and what killed runs leave."""

import errno
import os
import stat
import subprocess

import pytest
from repo import GENEVA, get, posix, put

from geneva_cli.errors import GenevaError
from geneva_cli.output import files
from geneva_cli.output.files import write

ROOT_ALONE = hasattr(os, "geteuid") and os.geteuid() != 0
GONE = 2**22 + 1  # above the greatest number that Linux gives to a process


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def geneva(*arguments, **settings):
    return subprocess.run(
        [GENEVA, *arguments], capture_output=True, encoding="utf-8", timeout=60, **settings
    )


def temporary(name, number):
    return f".{name}.geneva-{number}.tmp"


LONG = pytest.param("x" * 250 + ".csv", marks=posix("paths of 300 letters"))


@pytest.mark.parametrize("name", ["a.csv", "a b+(1)@.csv", "größe.csv", LONG])
def test_stale_ones_go(name):
    put(temporary(name.encode()[:200].decode(), GONE), "half a fi")
    write(name, ["whole"])
    assert os.listdir() == [name]


@posix("fcntl, by which another process holds the file")
def test_others_stay():
    """another file's, one that is held open elsewhere, and no file at all."""
    import fcntl

    names = [temporary("b.csv", GONE), temporary("a.csv", "x")]
    for name in names:
        put(name)
    os.mkdir(temporary("a.csv", GONE))
    put("target")
    os.symlink("target", temporary("a.csv", GONE + 1))
    held = temporary("a.csv", GONE + 2)
    with open(held, "w", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        before = set(os.listdir())
        write("a.csv", ["whole"])
    assert set(os.listdir()) == before | {"a.csv"}


def test_two_writers_at_once():
    """The text may itself write the same file: as two threads, or two runs, would."""

    def outer():
        yield "outer "
        write("a.csv", ["inner"])
        assert get("a.csv") == "inner"
        yield "whole"

    write("a.csv", outer())
    assert get("a.csv") == "outer whole"
    assert os.listdir() == ["a.csv"]


def test_a_file_that_another_program_holds(monkeypatch):
    """On Windows a table that is open in a spreadsheet cannot be replaced."""

    def refused(*paths):
        raise PermissionError(errno.EACCES, "Zugriff verweigert")  # in the system's language

    put("a.csv", "kept")
    monkeypatch.setattr(os, "replace", refused)
    monkeypatch.setattr(files, "POSIX", False)
    with pytest.raises(GenevaError) as error:
        write("a.csv", ["new"])
    assert str(error.value) == (
        "a.csv: cannot write: Permission denied; close the file in other programs, or give "
        "another name"
    )
    assert get("a.csv") == "kept" and os.listdir() == ["a.csv"]


def test_read_only_is_refused():
    put("a.csv", "kept")
    os.chmod("a.csv", 0o444)
    with pytest.raises(GenevaError, match=r"a\.csv: this file is read-only; allow writing"):
        write("a.csv", ["new"])
    assert get("a.csv") == "kept"


@posix("owners of files")
@pytest.mark.skipif(ROOT_ALONE, reason="only root can give files away")
def test_owner_is_kept():
    put("a.csv")
    os.chown("a.csv", 1234, 2345)
    os.chmod("a.csv", 0o640)
    write("a.csv", ["new"])
    now = os.stat("a.csv")
    assert (now.st_uid, now.st_gid, stat.S_IMODE(now.st_mode)) == (1234, 2345, 0o640)


@posix("/dev/stdin")
@pytest.mark.long
@pytest.mark.parametrize("spec", ["-", "/dev/stdin"])
def test_standard_input_is_not_replaced(spec):
    text = "[wheel]\nz = 6\n"
    put("spec.toml", text)
    arguments = ["motion", spec, "-o", "spec.toml", "--format", "csv"]
    with open("spec.toml", encoding="utf-8") as file:
        found = geneva(*arguments, stdin=file)
    assert found.returncode == 2
    assert "is an input" in found.stderr
    assert get("spec.toml") == text
    assert geneva(*arguments, input=text).returncode == 0  # a pipe is no file
