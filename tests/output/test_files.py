"""Output files and streams: replaced whole or not at all, and quiet when nobody listens."""

import csv
import json
import os
import re
import signal
import stat
import subprocess
import time

import pytest
import repo
from repo import GENEVA, get, posix, put
from typer.testing import CliRunner
from words import load

from geneva_cli.cli.app import app
from geneva_cli.motion.motion_table import motion_table

OLD = "the old file, whole\n"
TEMPORARY = re.compile(r"\.motion\.csv\.geneva-\d+\.tmp")
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
    assert "Traceback" not in found.stderr
    assert len(found.stderr.splitlines()) == 1
    for want in wants:
        assert want in found.stderr


def leftovers():
    return [name for name in os.listdir() if name.endswith(".tmp")]


# Where the file goes


@posix("umask")
def test_new_file_honours_the_umask():
    found = geneva(*SHORT, "-o", "peaks.json", umask=0o027)
    assert (found.returncode, found.stdout) == (0, "")
    assert stat.S_IMODE(os.stat("peaks.json").st_mode) == 0o640
    assert leftovers() == []


@posix("links without the rights of an administrator")
def test_symlink_stays_a_link():
    os.mkdir("store")
    put("store/real.csv", OLD)
    os.symlink("store/real.csv", "link.csv")
    assert geneva(*SHORT, "-o", "link.csv").returncode == 0
    assert os.readlink("link.csv") == "store/real.csv"
    assert get("store/real.csv").startswith("spec,title,velocity.max,")
    assert os.listdir("store") == ["real.csv"]


def test_folder_missing():
    clean_failure(geneva(*SHORT, "-o", "gone/peaks.csv"), "gone", "No such file", "make the folder")
    clean_failure(geneva(*SHORT, "-o", "/proc/peaks.csv"), "the folder /proc takes no files")


@posix("links without the rights of an administrator")
@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["spec.toml", "./sub/../spec.toml", "link.toml", "hard.toml"])
def test_output_over_the_spec(name):
    os.mkdir("sub")
    os.symlink("spec.toml", "link.toml")
    os.link("spec.toml", "hard.toml")
    before = get("spec.toml")
    clean_failure(geneva(*SHORT, "-o", name, "--format", "csv"), "input", "another name")
    assert get("spec.toml") == before


# Runs that fail or are stopped


def small_files():
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))


@posix("limits of a process (resource)")
def test_failure_half_way_keeps_the_old_file():
    put("motion.csv", OLD)
    arguments = ["motion", "spec.toml", "--samples", "20000", "-o", "motion.csv"]
    clean_failure(geneva(*arguments, preexec_fn=small_files), "motion.csv", "cannot write")
    assert get("motion.csv") == OLD
    assert leftovers() == []


def stopped(number):
    """A long export, stopped by a signal once its temporary file has appeared."""
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
    assert TEMPORARY.fullmatch(leftovers()[0])
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert (out, err) == ("", "")
    assert get("motion.csv") == OLD
    return process.returncode


@posix("signals that one process sends another; test_as_windows.py has Ctrl-Break")
@pytest.mark.sampled(3)
@pytest.mark.parametrize(("name", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_stopped_by_a_signal(name, status):
    assert stopped(getattr(signal, name)) == status
    assert leftovers() == []


# Standard output that does not take what we write


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "arguments",
    [["table"], ["--help"], [*LONG, "--format", "csv"], [*LONG, "--format", "json"], SHORT],
    ids=" ".join,
)
def test_closed_pipe(arguments):
    """``geneva table | head -1``: the reader has what it wanted, and nobody is bothered."""
    process = subprocess.Popen(
        [GENEVA, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8"
    )
    process.stdout.readline()
    process.stdout.close()
    err = process.stderr.read()
    process.stderr.close()
    assert (err, process.wait(timeout=30) in (0, 141)) == ("", True)


@pytest.mark.long
def test_a_pipe_of_ascii():
    """A title in any script, on a system that knows only ASCII, is no reason to fail."""
    put("spec.toml", 'title = "Größe 六"\n' + ANSWERED)
    ascii_only = os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    for line in ("peaks spec.toml", "check spec.toml"):
        run = subprocess.run(
            [GENEVA, *line.split()], env=ascii_only, capture_output=True, encoding="utf-8"
        )
        assert run.returncode in (0, 1), run.stderr
        assert "Traceback" not in run.stderr
        assert len(run.stdout) > 200


# What is written


def strict(text):
    def refuse(constant):
        raise AssertionError(f"{constant} in json")

    return json.loads(text, parse_constant=refuse)


@pytest.mark.parametrize("samples", [2, 361, 8193])
def test_csv_reads_back_equal(samples):
    put("spec.toml", '[wheel]\nz = 7\n[drive]\nkind = "side-crank"\nA = 0.3\nn_rpm = 47\n')
    words = ["motion", "spec.toml", "--samples", str(samples), "--format", "csv"]
    lines = CliRunner().invoke(app, words).stdout.splitlines()
    table = motion_table(load("spec.toml"), samples)
    rows = list(csv.reader(lines))
    assert tuple(rows[0]) == table.names
    assert [[float(x) for x in row] for row in rows[1:]] == [list(row) for row in table.rows()]
    assert not any(x in ("-0.0", "nan", "inf", "-inf") for row in rows for x in row)


# What a title may not do

HOSTILE = ["=HYPERLINK(1)", r"\u001b]0;x\u0007\u001b[31mred", r"one\r\ntwo", r"\u202ea|b`c<script>"]
ANSWERED = "[wheel]\nz = 400\n"  # without parts that would be turned for each title


@pytest.mark.sampled(3)
@pytest.mark.parametrize("command", ["peaks", "check", "motion"])
def test_hostile_title(command):
    """In every format a title adds no line, no formula, no mark-up and no control character."""
    plain = {}
    for title in ["plain", *HOSTILE]:
        put("spec.toml", f'title = "{title}"\n{ANSWERED}')
        for format in ("table", "csv", "json", "md"):
            found = CliRunner().invoke(app, [command, "spec.toml", "--format", format])
            assert found.exit_code in (0, 1), (title, found.output, found.exception)
            text = found.stdout
            clean_title(text, format, title)
            assert text.count("\n") == plain.setdefault(format, text).count("\n"), (title, format)


def clean_title(text, format, title):
    assert all(c.isprintable() or c == "\n" for c in text), (title, format)
    if format == "csv":
        for cell in (c for row in csv.reader(text.splitlines()) for c in row):
            assert not cell.startswith(("=", "@", "+", "-")) or float(cell) <= 0, title
    if format == "json":
        strict(text)
    if format == "md":
        assert "<script>" not in text, title


def test_output_is_a_folder():
    os.mkdir("peaks.csv")
    clean_failure(geneva(*SHORT, "-o", "peaks.csv"), "peaks.csv", "directory")
    assert os.listdir("peaks.csv") == []
