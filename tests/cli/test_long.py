"""Long tables, and numbers that are none: bounded memory, a clear refusal, no NaN in a file."""

import contextlib
import csv
import io
import json
import math
import os
import pty
import resource
import signal
import subprocess
import sys
import time
import warnings

import numpy as np
import pytest
import repo
from repo import GENEVA, put
from words import load

from geneva_cli import Cycloidal, Design, External, Motion, progress
from geneva_cli.errors import GenevaError
from geneva_cli.motion.motion_table import SAMPLES_MAX, motion_table
from geneva_cli.motion.peaks import peaks
from geneva_cli.output import show
from geneva_cli.output.terminal.bar import TextBar
from geneva_cli.parts.slots.slot_sampling import profile_table
from geneva_cli.study.survey import survey
from geneva_cli.table import WHOLE_ROWS, Table, record_table, rows_table


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", "[wheel]\nz = 6\n")


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
    "rows",
    [
        lambda design, samples: design.slot(samples=samples),
        lambda design, samples: design.spectrum(samples, 5.0, 0.1),
        lambda design, samples: design.spectrum(samples, 5.0),
    ],
    ids=["slot", "damped", "undamped"],
)
def test_long_tables_of_other_numbers_are_the_same(rows, monkeypatch):
    """Slot and spectrum, in pieces and whole; the last digits depend on where a piece ends."""
    samples = 2300
    design = Design(External(6), motion=Motion(Cycloidal()))
    whole = rows(design, samples)
    monkeypatch.setattr("geneva_cli.table.WHOLE_ROWS", 1000)
    monkeypatch.setattr("geneva_cli.table.PIECE", 512)  # no divisor of them
    for name, column in rows(design, samples).to_dict().items():
        expected = np.array(whole[name], dtype=float)
        assert len(column) == samples
        assert np.allclose(np.array(column, dtype=float), expected, rtol=1e-12, equal_nan=True)


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
def test_memory_does_not_grow(command, text):
    """Half a million rows are 24 to 40 MB as numbers, and several times that in the making."""
    put("spec.toml", text)

    def small():
        most = 150 << 20 if command.startswith("vibration") else 120 << 20
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))

    name, *options = command.split()
    arguments = [name, "spec.toml", *options, "--samples", str(SAMPLES_MAX // 2), "-o", "out.csv"]
    found = subprocess.run([GENEVA, *arguments], capture_output=True, text=True, preexec_fn=small)
    assert (found.returncode, found.stderr) == (0, "")
    with open("out.csv") as file:
        assert sum(1 for _ in file) == SAMPLES_MAX // 2 + 1


def test_progress_on_a_terminal():
    master, slave = pty.openpty()
    # at once, where it is after a second of work that a bar is shown
    now = "from geneva_cli.output.terminal.bar import TextBar as T; T.after_s = T.every_s = 0.0"
    main = "from geneva_cli.__main__ import main; main()"
    arguments = ["motion", "spec.toml", "--samples", "200000", "-o", "out.csv"]
    command = [sys.executable, "-c", f"{now}; {main}", *arguments]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=slave)
    os.close(slave)
    said = repo.read_terminal(master)
    process.stdout.close()
    assert process.wait(timeout=60) == 0
    assert b" of 200,000 rows, 0:" in said
    assert said.endswith(b" \r")  # and nothing is left of it


def test_a_bar_shows_what_is_left_and_goes(capsys, monkeypatch):
    """After a second, at most ten times a second, in one line that is overwritten."""
    clock = iter([0.0, 0.5, 2.0, 2.05, 3.0])
    monkeypatch.setattr("geneva_cli.output.terminal.bar.time.monotonic", lambda: next(clock))
    monkeypatch.setattr("geneva_cli.output.terminal.bar.columns", lambda: 60)
    progress.show_with(TextBar)
    try:
        # what is inside of other work shows nothing of its own
        outer = (len([*progress.tracked("ab", "inner", 2)]) for _ in range(4))
        assert [*progress.tracked(outer, "outer", 4)] == [2] * 4
    finally:
        progress.show_with(None)
    _, first, second, *end = capsys.readouterr().err.split("\r")
    assert first == f"[{'#' * 15}{'-' * 15}] 2 of 4 outer, 0:02 left"
    assert second == f"[{'#' * 30}] 4 of 4 outer, 0:00 left"
    assert all(not part.strip() for part in end)


def test_one_item_shows_the_progress_within_it(capsys, monkeypatch):
    """A bar of one item would stand still until the end."""
    clock = iter([0.0, 2.0, 3.0])
    monkeypatch.setattr("geneva_cli.output.terminal.bar.time.monotonic", lambda: next(clock))
    monkeypatch.setattr("geneva_cli.output.terminal.bar.columns", lambda: 60)
    progress.show_with(TextBar)
    try:
        outer = (len([*progress.tracked("ab", "steps", 2)]) for _ in range(1))
        assert [*progress.tracked(outer, "specs", 1)] == [2]
    finally:
        progress.show_with(None)
    shown = capsys.readouterr().err
    assert "1 of 2 steps, 0:02 left" in shown and "specs" not in shown


@pytest.mark.parametrize("gearing", ["spherical", "external"])
def test_too_many_rows_that_are_solved(gearing):
    with pytest.raises(GenevaError, match=r"--z 3\.\.10002: that is more than 1000 rows"):
        survey("3..10002", gearing, 60.0, 1, 0.0 if gearing == "spherical" else 0.3)


def test_the_closest_points_that_are_read():
    """Their rounding moves the jerk by no more than law_table.py says, in a second or two."""
    n = 10_000
    rows = [(k / n, k / n - math.sin(math.tau * k / n) / math.tau) for k in range(n)] + [(1.0, 1.0)]
    put("law.csv", "".join(f"{u!r},{s!r}\n" for u, s in rows))
    put("table.toml", '[wheel]\nz = 6\n[motion]\nlaw = "table"\nfile = "law.csv"\n')
    put("named.toml", '[wheel]\nz = 6\n[motion]\nlaw = "cycloidal"\n')
    found, wanted = (peaks(load(name).engagements[0]) for name in ("table.toml", "named.toml"))
    assert found.jerk.max == pytest.approx(wanted.jerk.max, rel=3e-4)
    assert found.acceleration.max == pytest.approx(wanted.acceleration.max, rel=1e-6)


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


def ratios(points):
    """i = 1 + 0.2 cos(input): mirrored, so that half-way of the samples is mid-motion."""
    rows = []
    for k in range(points):
        x = 360.0 * k / (points - 1)
        i = 1.0 + 0.2 * math.cos(math.radians(x))
        rows.append(f"{x!r},{i if k < points - 1 else 1.2!r}\n")
    return "input_deg,ratio\n" + "".join(rows)


@pytest.mark.parametrize("points", [25, 73])
def test_a_sample_beside_the_middle(points):
    """Mid-motion falls at 2e-14 deg and not at 0: the pin's direction was rounding or NaN."""
    put("ratio.csv", ratios(points))
    middles = 0
    for z in range(3, 47):
        text = f'[wheel]\nz = {z}\n[drive]\nkind = "noncircular-gears"\nratio_file = "ratio.csv"\n'
        put("spec.toml", text)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mechanism = load("spec.toml")
            table = profile_table(mechanism, 0.001, 51)
        columns = dict(zip(table.names, table.columns, strict=True))
        for name, column in columns.items():
            assert name == "curvature_radius_mm" or np.isfinite(column).all(), (z, name)
        # the flanks stay where they are beside: straight, at a roller's radius from the x axis
        for side, sign in (("left", 1.0), ("right", -1.0)):
            off = columns[f"{side}_y_mm"] * sign
            assert np.ptp(off) < 1e-9 and abs(abs(off[0]) - 5.0) < 1e-9, (z, side)
        middles += int((np.abs(columns["input_deg"]) < 1e-9).any())
    assert middles > 10, "the case is no longer met"


def test_a_point_that_rests():
    """The rod's end runs on a straight line and stops at both ends: there it has no direction."""
    put(
        "spec.toml",
        '[wheel]\nz = 6\n[drive]\nkind = "slider-crank"\ncrank_mm = 25\nrod_mm = 100\n'
        "point_mm = 100\npoint_deg = 0\n",
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(GenevaError, match="no wheel of z = 6 slots fits this path"):
            load("spec.toml")


@pytest.mark.skipif(os.name != "posix", reason="signals")
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
