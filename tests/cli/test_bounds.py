"""Bounded in memory and time: what would take too much is refused at once, in clear words."""

import json
import os
import subprocess
import sys

import pytest
from repo import GENEVA, posix, put

WHEEL = "[wheel]\nz = 6\n"
CURVED = WHEEL + '[motion]\nlaw = "cycloidal"\n'
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

pytestmark = posix("limits of a process, and no measure of its memory (resource)")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", WHEEL)
    put("curved.toml", CURVED)


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
def test_too_much_is_refused_at_once(arguments):
    option = next(a for a in arguments if a.startswith("--"))
    refused(arguments, option)


def test_a_spec_of_a_gigabyte():
    with open("huge.toml", "wb") as file:
        file.truncate(1 << 30)  # sparse: it takes no room on the disk
    refused(["peaks", "huge.toml"], "huge.toml: ", "larger than")


# 36,000 rows of three numbers and a text are 9 MB as Python's objects; pyarrow reads and writes
# ahead in blocks of 4 MB, and keeps what it has had
@pytest.mark.long
@pytest.mark.parametrize(
    ("file", "how", "more"), [("a.csv", "--random", 6.0), ("a.parquet", "grid", 40.0)]
)
def test_a_sweep_holds_no_rows(file, how, more):
    """Its file grows block by block."""
    used = []
    for rows in (4_000, 40_000):
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
