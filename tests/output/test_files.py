"""Files are replaced whole or not at all, and what they keep; what is never replaced; names."""

import errno
import ntpath
import os
import signal
import stat
import subprocess
import sys
import time

import pytest
import repo
from repo import GENEVA, get, posix, put

from geneva_cli.errors import GenevaError
from geneva_cli.output import files
from geneva_cli.output.files import refuse_name, write
from geneva_cli.output.folder import Row, filling_folder
from geneva_cli.output.growing import growing

OLD = "the old file, whole\n"
LONG = ["motion", "spec.toml", "--samples", "500000"]  # seconds of writing, some 40 MB
SHORT = ["peaks", "spec.toml"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", "[wheel]\nz = 6\n")
    return tmp_path


def geneva(*arguments, **settings):
    settings = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | settings
    return subprocess.run([GENEVA, *arguments], encoding="utf-8", timeout=60, **settings)


def clean_failure(found, *wants):
    assert found.returncode == 2, found.stderr
    assert len(found.stderr.splitlines()) == 1
    for want in wants:
        assert want in found.stderr


def leftovers():
    return [name for name in os.listdir() if name.endswith(".tmp")]


@posix("umask, and owners of files")
def test_permissions_and_owner():
    found = geneva(*SHORT, "-o", "peaks.json", umask=0o027)
    assert (found.returncode, found.stdout, leftovers()) == (0, "", [])
    assert stat.S_IMODE(os.stat("peaks.json").st_mode) == 0o640
    if os.geteuid() == 0:  # only root can give files away
        os.chown("peaks.json", 1234, 2345)
    before = os.stat("peaks.json")
    write("peaks.json", ["new"])
    now = os.stat("peaks.json")
    assert (now.st_uid, now.st_gid, now.st_mode) == (before.st_uid, before.st_gid, before.st_mode)


@posix("links without the rights of an administrator")
def test_a_link_stays_a_link():
    os.mkdir("store")
    put("store/real.csv", OLD)
    os.symlink("store/real.csv", "link.csv")
    write("link.csv", ["new"])
    assert os.readlink("link.csv") == "store/real.csv"
    assert (get("store/real.csv"), os.listdir("store")) == ("new", ["real.csv"])


def test_folders():
    os.mkdir("peaks.csv")
    clean_failure(geneva(*SHORT, "-o", "peaks.csv"), "peaks.csv", "give a file's name")
    clean_failure(geneva(*SHORT, "-o", "gone/peaks.csv"), "gone", "make the folder")


@posix("links without the rights of an administrator")
@pytest.mark.parametrize("name", ["./sub/../spec.toml", "link.toml", "hard.toml"])
def test_an_input_is_not_replaced(name):
    os.mkdir("sub")
    os.symlink("spec.toml", "link.toml")
    os.link("spec.toml", "hard.toml")
    with pytest.raises(GenevaError, match=r"is an input, .* another name"):
        write(name, ["new"], ["spec.toml"])
    with open("spec.toml", encoding="utf-8") as file:
        clean_failure(geneva("motion", "-", "-o", name, "--format", "csv", stdin=file), "an input")
    assert "z = 6" in get("spec.toml")


def test_read_only_is_refused():
    put("a.csv", OLD)
    os.chmod("a.csv", 0o444)
    with pytest.raises(GenevaError, match=r"a\.csv: this file is read-only; allow writing"):
        write("a.csv", ["new"])
    assert get("a.csv") == OLD


@pytest.mark.parametrize("name", ["a b+(1)@.csv", "größe.csv", "x" * 250 + ".csv"])
def test_what_a_killed_run_left_goes(name):
    put(f".{name[:200]}.geneva.tmp", "half a file that is longer than the new one")
    write(name, ["whole"])
    assert sorted(os.listdir()) == sorted([name, "spec.toml"]) and get(name) == "whole"


def test_two_writers_at_once():
    """The second is refused, in another thread of the run too."""

    def outer():
        yield "outer"
        with pytest.raises(GenevaError, match=r"a\.csv: another run is writing this"):
            write("a.csv", ["inner"])

    write("a.csv", outer())
    assert (get("a.csv"), leftovers()) == ("outer", [])


def test_a_file_that_another_program_holds(monkeypatch):
    """On Windows a table that is open in a spreadsheet cannot be replaced."""

    def refused(*paths):
        raise PermissionError(errno.EACCES, "Zugriff verweigert")  # in the system's language

    put("a.csv", OLD)
    monkeypatch.setattr(os, "replace", refused)
    monkeypatch.setattr(files, "POSIX", False)
    with pytest.raises(GenevaError, match="Permission denied; close the file in other programs"):
        write("a.csv", ["new"])
    assert (get("a.csv"), leftovers()) == (OLD, [])


# Runs that fail or are stopped


def small_files():
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))


@posix("limits of a process (resource)")
def test_failure_half_way_keeps_the_old_file():
    put("motion.csv", OLD)
    arguments = ["motion", "spec.toml", "--samples", "20000", "-o", "motion.csv"]
    clean_failure(geneva(*arguments, preexec_fn=small_files), "motion.csv", "cannot write")
    assert (get("motion.csv"), leftovers()) == (OLD, [])


@posix("signals that one process sends another; test_as_windows.py has Ctrl-Break")
@pytest.mark.sampled(3)
@pytest.mark.parametrize(("name", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_stopped_by_a_signal(name, status):
    """A long export, stopped once its temporary file has appeared."""
    put("motion.csv", OLD)
    process = subprocess.Popen(
        [GENEVA, *LONG, "-o", "motion.csv"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        preexec_fn=repo.heed_signals,
    )
    deadline = time.monotonic() + 30
    while not leftovers() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    assert process.poll() is None, "the export ended before it could be stopped"
    process.send_signal(getattr(signal, name))
    assert (*process.communicate(timeout=30), process.returncode) == ("", "", status)
    assert (get("motion.csv"), leftovers()) == (OLD, [])


# Names that Windows does not give to a file, as Microsoft lists them ("Naming Files, Paths, and
# Namespaces"), tried on any system

RESERVED = "nul nul.csv AUX.txt con prn.tar.gz Com1 LPT9.dxf com¹.csv CONIN$ ab:c.csv a. ... a* a?"
RESERVED = [*RESERVED.split(), "nul .csv", "bad:name", "a ", 'a"b', "a|b", "a\tb"]
TAKEN = "null.csv console aux-1.csv com0 com10.csv lpt.dxf .nul a.nul größe.csv .. . -1 wheel-1x-8"


def test_names():
    for name in RESERVED:
        with pytest.raises(GenevaError, match=r"Windows .*; give another name"):
            refuse_name(name)
    for name in TAKEN.split():
        refuse_name(name)
    if hasattr(ntpath, "isreserved"):  # Python 3.13's own answer
        for name in (*RESERVED, *TAKEN.split()):
            assert (name in RESERVED) == ntpath.isreserved(name)


def test_every_file_and_folder_is_asked_for(monkeypatch):
    """A file, one that grows, and a folder of an export; elsewhere a folder for others alone."""
    device = 'Windows reserves the name "aux" for a device'
    if os.name != "nt":
        assert files.real_path("aux.csv") == os.path.realpath("aux.csv")
    with pytest.raises(GenevaError, match=device), filling_folder("b", [Row("aux.csv", "")]):
        pass
    monkeypatch.setattr(sys, "platform", "win32")
    with pytest.raises(GenevaError, match=device):
        write(r"C:\shop\aux\a.csv", ["a text"])
    with pytest.raises(GenevaError, match=device), growing(["a"], "request", "shop/aux.csv"):
        pass
    with pytest.raises(GenevaError, match=device), filling_folder("aux", []):
        pass
    for path in (r"C:\shop\a.csv", "../a.csv", r"\\server\share\a.csv", "C:a.csv"):
        files.real_path(path)
    assert os.listdir() == ["spec.toml"]
