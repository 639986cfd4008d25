"""Long tables and too much work: bounded memory, a clear refusal at once; no NaN in a file."""

import contextlib
import csv
import io
import json
import math
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import repo
from repo import GENEVA, posix, put
from words import load

from geneva_cli import progress
from geneva_cli.motion.motion_table import SAMPLES_MAX, motion_table
from geneva_cli.output import show
from geneva_cli.output.terminal import bar
from geneva_cli.table import WHOLE_ROWS, Table, record_table, rows_table


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", "[wheel]\nz = 6\n")
    put("curved.toml", CURVED)


CURVED = '[wheel]\nz = 6\n[motion]\nlaw = "cycloidal"\n'
ROLLERS = "[wheel]\nz = 5\n[drive]\nroller_angles_deg = [0, 150]\n"


@pytest.mark.parametrize("text", ["[wheel]\nz = 6\n", ROLLERS], ids=["one", "two-rollers"])
def test_a_long_table_is_the_same_as_a_held_one(text, monkeypatch):
    put("spec.toml", text)
    samples = WHOLE_ROWS + 12_345  # no multiple of a piece
    found = motion_table(load("spec.toml"), samples)
    monkeypatch.setattr("geneva_cli.table.WHOLE_ROWS", SAMPLES_MAX)
    held = motion_table(load("spec.toml"), samples)
    rows = np.array(list(found.rows()))
    assert len(rows) == len(found) == samples
    # A whole cycle is mirrored, and a piece is not: the last digits of its place may differ.
    assert np.allclose(rows, np.column_stack(held.columns), rtol=1e-11, atol=1e-12)
    assert rows[-1, 1] == held.columns[1][-1]


@pytest.mark.parametrize(
    ("command", "text"),
    [
        ("motion", "[wheel]\nz = 6\n"),
        pytest.param("motion", CURVED, marks=pytest.mark.long),
        pytest.param("profile", CURVED, marks=pytest.mark.long),
        pytest.param("vibration --period-ratio 5", "[wheel]\nz = 6\n", marks=pytest.mark.long),
    ],
    ids=["straight", "curved", "slot", "spectrum"],
)
@posix("limits of a process (resource)")
@pytest.mark.long
def test_memory_does_not_grow(command, text):
    """Half a million rows are 24 to 40 MB as numbers, and several times that in the making."""
    put("spec.toml", text)

    import resource

    def small():
        most = 150 << 20 if command.startswith("vibration") else 120 << 20
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))

    name, *options = command.split()
    arguments = [name, "spec.toml", *options, "--samples", str(SAMPLES_MAX // 2), "-o", "out.csv"]
    found = subprocess.run(
        [GENEVA, *arguments], capture_output=True, encoding="utf-8", preexec_fn=small
    )
    assert (found.returncode, found.stderr) == (0, "")
    with open("out.csv", encoding="utf-8") as file:
        assert sum(1 for _ in file) == SAMPLES_MAX // 2 + 1


def test_a_bar_shows_what_is_left_and_goes(capsys, monkeypatch):
    """Work of a second shows none; longer work has one line, which is overwritten and removed."""
    for name, value in {"FORCE_COLOR": "1", "TERM": "xterm", "COLUMNS": "60"}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(progress, "maker", bar.Bar)
    seen = []
    for seconds in (1e9, 0.0):
        monkeypatch.setattr(bar, "AFTER_S", seconds)
        monkeypatch.setattr(bar, "EVERY_S", seconds)
        # what is inside of other work shows nothing of its own
        outer = (len([*progress.tracked("ab", "inner", 2)]) for _ in range(4))
        assert [*progress.tracked(outer, "outer", 4)] == [2] * 4
        seen.append(re.sub(r"\x1b\[[?\d;]*\w", "", capsys.readouterr().err).split("\r"))
    none, lines = seen
    assert none == [""]
    assert [f"{done}/4 outer, " in lines[done] for done in range(5)] == [True] * 5
    assert all(len(line.strip()) <= 60 and "inner" not in line for line in lines)
    assert lines[-1] == ""


# Numbers that are none


def nonsense(value):
    yield rows_table(("a", "b"), [(1.0, "x"), (value, "y")])
    yield record_table({"a.b": 1.0, "a.c": value})
    yield record_table({"a": 1.0, "b": rows_table(("c",), [(value,)])})
    yield record_table({"a": (1.0, value)})
    yield Table(("a", "b"), [np.zeros(5), np.array([0.0, 1.0, value, 2.0, 3.0])])


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("format", ["table", "csv", "json", "md"])
def test_nothing_else_than_numbers_is_written(value, format, capsys):
    for table in nonsense(value):
        with pytest.raises(ArithmeticError, match="not a number"):
            show(table, format=format)
        assert capsys.readouterr().out == ""
    for table in nonsense(1.5):
        show(table, format=format)
        assert "1.5" in capsys.readouterr().out


def test_infinity_where_it_is_an_answer(capsys):
    table = Table(("x_mm", "curvature_radius_mm"), [np.zeros(2), np.array([1.0, np.inf])])
    show(table, format="csv")
    assert list(csv.reader(io.StringIO(capsys.readouterr().out)))[2] == ["0.0", "inf"]
    show(table, format="json")
    assert json.loads(capsys.readouterr().out)["rows"][1]["curvature_radius_mm"] is None


@posix("signals that one process sends another")
def test_no_worker_outlives_the_check_that_started_it() -> None:
    """Standard output stays open for as long as one of them lives."""
    designs = sorted(str(p) for p in (repo.DESIGNS).glob("*.toml"))
    command = [sys.executable, "-m", "geneva_cli", "check", *designs]
    run = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=repo.heed_signals,
    )
    try:
        time.sleep(1.0)
        run.send_signal(signal.SIGINT)
        assert run.communicate(timeout=5.0) == (b"", b"")
        assert run.returncode == 130
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.communicate()


# What would take too much is refused at once, in clear words

MEGABYTE = 1 << 20
# "At once": a run takes 0.1 s; the rest is a guard for a busy machine, not a promise.
AT_ONCE = 30.0
# CPU time is what the program takes itself, however busy the machine is.
CPU = 2.0
LONGEST = 20  # CPU seconds after which a run is ended
# The measuring child: the limit on address space catches what an endless run would take.
CHILD = """
import json, resource, subprocess, sys
out = open(sys.argv[1], "w")
run = subprocess.run(sys.argv[2:], stdout=out, stderr=subprocess.PIPE, encoding="utf-8")
used = resource.getrusage(resource.RUSAGE_CHILDREN)
seconds = used.ru_utime + used.ru_stime
print(json.dumps([run.returncode, run.stderr, used.ru_maxrss / 1024, seconds]))
"""

MEASURED = posix("limits of a process, and no measure of its memory (resource)")


def limited():
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (4096 * MEGABYTE, 4096 * MEGABYTE))
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))  # nothing runs on after a test


def run(*arguments, timeout=AT_ONCE):
    """Exit status, standard error, peak memory in MB, CPU seconds; output goes to out.txt."""
    found = subprocess.run(
        [sys.executable, "-c", CHILD, "out.txt", GENEVA, *arguments],
        capture_output=True,
        encoding="utf-8",
        timeout=timeout,
        preexec_fn=limited,
    )
    return json.loads(found.stdout)


def refused(arguments, *wants):
    status, said, megabytes, seconds = run(*arguments)
    assert status == 2, said
    assert os.path.getsize("out.txt") == 0
    assert len(said.splitlines()) == 1, said
    for want in wants:
        assert want in said
    assert megabytes < 200.0
    assert seconds < CPU
    return said


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    "arguments",
    [
        ["motion", "spec.toml", "--samples", "1000000000000"],
        ["motion", "curved.toml", "--samples", "10000001"],
        ["profile", "spec.toml", "--samples", "1000000000000"],
        ["profile", "curved.toml", "--samples", "1000001"],
        ["profile", "curved.toml", "--tolerance", "5e-324"],
        ["profile", "curved.toml", "--tolerance", "1e-30"],
        ["table", "--z", "3..1000000"],
        ["table", "--z", "3..9999," * 1000 + "6"],
        ["table", "--z", "9" * 4000],
    ],
    ids=lambda words: " ".join(words)[:50],
)
@MEASURED
def test_too_much_is_refused_at_once(arguments):
    option = next(a for a in arguments if a.startswith("--"))
    refused(arguments, option)


@MEASURED
def test_a_spec_of_a_gigabyte():
    with open("huge.toml", "wb") as file:
        file.truncate(1 << 30)  # sparse: it takes no room on the disk
    refused(["peaks", "huge.toml"], "huge.toml: ", "larger than")


# 40,000 rows of three numbers and a text are 10 MB as Python's objects; a batch of 16,384 rows is
# 12 MB in any run; pyarrow reads and writes ahead in blocks of 4 MB, and keeps what it has had
@pytest.mark.long
@pytest.mark.parametrize(
    ("file", "how", "more"), [("a.csv", "--random", 6.0), ("a.parquet", "grid", 9.0)]
)
@MEASURED
def test_a_sweep_holds_no_rows(file, how, more):
    """Its file grows block by block."""
    used = []
    for rows in (20_000, 60_000):
        points = f"drive.A=0..0.9:{0.9 / (rows - 1)!r}" if how == "grid" else "drive.A=0..0.9"
        vary = ["--vary", points, *(() if how == "grid" else ("--random", str(rows)))]
        picked = ["--pick", "velocity.max,acceleration.max", "--jobs", "1", "-o", file]
        status, said, megabytes, _ = run(
            "sweep", "spec.toml", "--set", "drive.kind=side-crank", *vary, *picked, timeout=120
        )
        assert status == 0, said
        used.append(megabytes)
        os.remove(file)
    assert used[1] < used[0] + more
