"""Sweeps: the same rows in any number of processes, shares and runs; their files and refusals."""

import csv
import io
import json
import os
import subprocess
import sys
from contextlib import suppress

import numpy as np
import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.output.growing import growing
from geneva_cli.specfile.reader import read
from geneva_cli.study.sweep.request import request
from geneva_cli.study.sweep.run import plan, sweep
from geneva_cli.study.sweep.values import axis

SPEC = str(repo.DESIGNS / "side-crank-z6.toml")
GRID = ["drive.A=-0.4,0,0.6,1", "wheel.z=5,6"]


def geneva(*args):
    """A run of the program, in this process; where the process matters, tests start their own."""
    return CliRunner().invoke(app, args)


def rows(found, **options):
    return [row for block in found._replace(**options).blocks() for row in block]


def grid(*texts):
    return plan([axis(t) for t in texts], None, 0)


def test_the_same_rows_whatever_the_processes_and_shares():
    some = grid("drive.A=-0.9..0.9:0.05", "wheel.z=4,6")
    alone = rows(sweep(read(SPEC), some), jobs=1)
    assert rows(sweep(read(SPEC), some), jobs=2) == alone


def test_a_stopped_sweep_goes_on(tmp_path):
    """What a stopped run leaves is a beginning of the rows, maybe with half a block."""
    arguments = ["sweep", SPEC, "--vary", GRID[0], "--vary", GRID[1]]
    file = tmp_path / "rows.csv"
    assert geneva(*arguments, "-o", str(file)).exit_code == 0
    whole = file.read_text(encoding="utf-8")
    assert os.listdir(tmp_path) == ["rows.csv"]
    state = tmp_path / "rows.csv.geneva"
    plan = request(SPEC, GRID)
    rows = next(plan.blocks()).columns.values()
    with suppress(KeyboardInterrupt), growing(plan.names, plan.key, str(file)) as left:
        for start, stop in ((0, 2), (2, 3)):
            left.append([column[start:stop] for column in rows])
        raise KeyboardInterrupt
    half = state.read_bytes()[:-20]
    state.write_bytes(half)
    resumed = geneva(*arguments, "-o", str(file), "--resume")
    assert resumed.exit_code == 0 and "continues after row 2" in resumed.stderr
    assert file.read_text(encoding="utf-8") == whole
    state.write_bytes(half)
    other = geneva(*arguments, "--set", "drive.n_rpm=90", "-o", str(file), "--resume")
    assert other.exit_code == 2 and "has the rows of another run" in other.stderr
    assert file.read_text(encoding="utf-8") == whole


LAW = "".join(f"{i / 20},{(i / 20) ** 2 * (3 - i / 10)}\n" for i in range(21))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "arguments",
    [
        ["sweep", "spec.toml", "--vary", "drive.n_rpm=60,70", "--best", "min:k", "-o", "spec.toml"],
        ["sweep", "spec.toml", "--vary", "motion.file=a.csv,b.csv", "-o", "b.csv"],
        ["synth", "--from", "spec.toml", "--tau", "0.3", "--write", "1", "-o", "spec.toml"],
    ],
)
def test_no_input_is_written_over(tmp_path, monkeypatch, arguments):
    """Only the spec of a sweep's rows, and the points that it names, were held against the name."""
    monkeypatch.chdir(tmp_path)
    text = "[wheel]\nz = 6\n"
    if "motion" in str(arguments):
        text += '[motion]\nlaw = "table"\nfile = "a.csv"\n'
    files = {"spec.toml": text, "a.csv": LAW, "b.csv": LAW}
    for name, content in files.items():
        (tmp_path / name).write_text(content, encoding="utf-8")
    found = geneva(*arguments)
    assert found.exit_code == 2 and "this file is an input" in found.stderr
    assert {name: (tmp_path / name).read_text(encoding="utf-8") for name in os.listdir()} == files


def parquet(path):
    """The schema of a file, and its rows."""
    from pyarrow import parquet

    table = parquet.read_table(path)
    return dict(zip(table.schema.names, map(str, table.schema.types), strict=True)), (
        table.to_pylist()
    )


def test_parquet_holds_the_same(tmp_path):
    file = tmp_path / "rows.parquet"
    arguments = ["sweep", SPEC, "--vary", GRID[0], "--vary", "motion.law=cycloidal,3-4-5"]
    assert geneva(*arguments, "-o", str(file)).exit_code == 0
    types, found = parquet(file)
    assert {name for name, own in types.items() if own == "string"} == {"motion.law", "error"}
    assert set(types.values()) == {"string", "double"}
    printed = list(csv.DictReader(io.StringIO(geneva(*arguments).stdout)))
    assert len(found) == len(printed) == 8
    for row, text in zip(found, printed, strict=True):
        assert row["motion.law"] == text["motion.law"]
        assert (row["velocity.max"] is None) == (text["velocity.max"] == "")
        assert row["velocity.max"] is None or row["velocity.max"] == float(text["velocity.max"])
    assert os.listdir(tmp_path) == ["rows.parquet"]


def test_types_of_a_column_follow_from_all_blocks(tmp_path):
    """Numbers that one block has and words of another are words; whole numbers are numbers."""
    path = str(tmp_path / "rows.parquet")
    with growing(["a", "b", "c", "d"], "key", path) as rows:
        rows.append([np.array([4, 6]), [True, None], [None, None], np.array([1, 2])])
        rows.append([["x", None], [None, None], [1.0, None], np.array([0.5, np.inf])])
    assert parquet(path) == (
        {"a": "string", "b": "bool", "c": "double", "d": "double"},
        [
            {"a": "4", "b": True, "c": None, "d": 1.0},
            {"a": "6", "b": None, "c": None, "d": 2.0},
            {"a": "x", "b": None, "c": 1.0, "d": 0.5},
            {"a": None, "b": None, "c": None, "d": None},
        ],
    )


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--vary", "drive.A=0.1", "--pick", "acceleration.mx"], "did you mean"),
        (["--vary", "drive.A=0.1", "--pick", "peaks.jerk.max"], 'did you mean "jerk.max"'),
        (["--vary", "drive.A=0.1", "--pick", "loads.pin_for"], '"loads.pin_force_N.max"?'),
        (["--vary", "drive.A=0.1", "-o", "rows.xlsx"], "it must end in .csv or .parquet"),
        (["--vary", "drive.A=0.1", "--resume", "--format", "json"], "--resume continues all"),
        (["--vary", "drive.A=0.1", "--seed", "1"], "--seed 1: it needs --random"),
        (["--vary", "drive.A=0.1", "--pareto", "min:wheel.gearing"], "a word has no order"),
        (["--vary", "drive.A=0.1", "--best", "min:k", "-o", "all.csv"], "one of: toml"),
        (["--vary", "drive.A=2,3"], "no design can be built, of 2 tried: drive.A=2"),
    ],
)
def test_errors_come_at_once(arguments, said, tmp_path):
    found = geneva("sweep", SPEC, *arguments)
    assert (found.exit_code, found.stdout) == (2, "")
    assert said in found.stderr and len(found.stderr.splitlines()) == 1


def test_where_no_row_is_left_it_says_why():
    """Bounds that nothing keeps, and a load of a machine without one, as a line besides no rows."""
    some = ("sweep", SPEC, "--vary", "drive.A=0,0.5,2")
    few = geneva(*some, "--subject-to", "dwell_s >= 5", "--format", "json")
    assert (few.exit_code, json.loads(few.stdout)) == (0, {"rows": []})
    broken, none = few.stderr.splitlines()
    assert "1 of 3 designs cannot be built: the first: drive.A=2: A = 2 must be" in broken
    assert none.endswith(
        "none of 3 rows is left: timing.dwell_s >= 5 is kept by 0 (nearest 0.666667)"
    )
    unknown = geneva(*some, "--pareto", "min:loads.pin_force_N.max,max:dwell_s")
    assert len(unknown.stdout.splitlines()) == 1
    assert unknown.stderr.endswith("is left: no design has a value of loads.pin_force_N.max\n")


# What a person sees


def seen_on_a_terminal(*words):
    """What a person sees of a run that draws no bar, since it takes less than a second."""
    import pty

    master, slave = pty.openpty()
    program = [sys.executable, "-m", "geneva_cli", "sweep", *words]
    with subprocess.Popen(program, stdout=slave, stderr=subprocess.PIPE) as run:
        os.close(slave)
        seen = repo.read_terminal(master).decode()
        assert (run.stderr.read(), run.wait(timeout=60)) == (b"", 0)
    return seen


@repo.posix("pseudo-terminals")
def test_a_person_sees_the_first_rows_and_the_best():
    vary = ("--vary", "drive.A=0..0.9:0.01", "--pick", "dwell_s,jerk.max", "--jobs", "1")
    seen = seen_on_a_terminal(SPEC, *vary, "--pareto", "max:dwell_s,min:acceleration.max")
    assert "All 91 rows: -o FILE.csv" in seen
    assert "The 5 rows with the greatest timing.dwell_s" in seen
    rows = [line.split()[0] for line in seen.splitlines() if line.strip()[:1].isdigit()]
    assert rows == ["1", "2", "3", "4", "5"] * 2  # A = 0 rests longest, and is the first
