"""Growth of run time and memory with z, rows, designs, rollers and tolerance: whole runs.

The exponent is that of a power of the size: 1 is linear, and n log n is 1.1 to 1.2.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.bench.whole_runs import BASELINE, IMPORT, RUN, run_python
from geneva_cli.specfile.template import template

SIZES = "--set size.roller_radius_mm=0.1 --set size.center_distance_mm"
ROWS = (10, 100, 1_000, 10_000, 100_000)
# Runs a command and prints its largest memory. The bench's own process is too large for that: a
# child starts with the memory of its parent.
LARGEST = (
    "import resource, subprocess, sys; subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL);"
    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
)


class Grown(NamedTuple):
    """A run whose size grows: words with {n} for the size, or {1/n} for its inverse."""

    words: str
    sizes: Sequence[int]
    kind: str = "external"  # template of the spec


def wheel(command: str, sizes: Sequence[int] = (6, 12, 24, 48, 96, 192, 360)) -> Grown:
    """Run of a command whose wheel has more slots; its size grows with them.

    Parts are drawn for up to 360 slots.
    """
    return Grown(f"{command} {SIZES}={{20n}} --set wheel.z={{n}}", sizes)


RUNS = (
    Grown("table --z 3..{n} --format csv", (10, 100, 1_000, 10_000)),
    wheel("peaks -", (6, 60, 600, 6_000)),
    wheel("loads -", (6, 60, 600, 6_000)),
    wheel("vibration - --period-ratio 5", (6, 60, 600, 6_000)),
    wheel("tolerance - --set tolerance.crank_radius_mm=0.01", (6, 60, 600, 6_000)),
    wheel("check -"),
    wheel("report - --format md"),
    wheel("profile - --part wheel --format svg"),
    wheel("profile - --part wheel --format dxf"),
    wheel("profile - --part wheel --format step"),
    wheel("profile - --part sheet --format svg"),
    wheel("animate -"),
    wheel("plot - --format svg"),
    Grown("motion - --samples {n} --format csv", (*ROWS, 1_000_000)),
    Grown("motion - --samples {n} --format json", ROWS),
    Grown("motion - --samples {n}", ROWS),
    Grown("loads - --set load.inertia_kgm2=1 --samples {n} --format csv", ROWS),
    Grown("profile - --samples {n} --format csv", ROWS, "curved"),
    Grown("vibration - --period-ratio 5 --samples {n} --format csv", ROWS),
    Grown(
        "tolerance - --set tolerance.crank_radius_mm=0.01 --samples {n}",
        (100, 1_000, 10_000, 100_000, 1_000_000),
    ),
    Grown("profile - --tolerance {1/n} --format csv", (*ROWS, 1_000_000), "curved"),
    Grown("profile - --part wheel --tolerance {1/n} --format svg", ROWS, "curved"),
    Grown("peaks - --set motion.alpha0_deg=110 --set drive.rollers={n}", (1, 4, 16, 32), "curved"),
    Grown(f"check - {SIZES}=100 --set wheel.z=3 --set drive.rollers={{n}}", (1, 2, 3, 4, 5)),
    Grown("compare - --vary drive.n_rpm={1..n}", (2, 10, 100)),
    *(
        Grown(
            f"sweep - {SIZES}=100 --set drive.kind=side-crank --vary drive.A=-0.3..0.5 "
            f"--random {{n}} --jobs 1 {words}",
            sizes,
        )
        for words, sizes in (
            ("--pick acceleration.max --format csv", ROWS),
            ("--pick pin_force_N.max --set load.inertia_kgm2=1 --format csv", ROWS[:-1]),
            ("--pick horn_mm --format csv", ROWS[:-2]),
            ("--check --format csv", (10, 100)),
            ("--pareto min:acceleration.max,max:dwell_s --format csv", ROWS),
            ("--best min:acceleration.max", ROWS),
        )
    ),
    Grown("synth --motion-deg 100..179 --z 3..{n} --check 0", (4, 10, 24, 100)),
)


def subject(quick: bool) -> Subject:
    """One task for each command and size."""
    runs = (RUNS[0], wheel("peaks -", (6, 60))) if quick else RUNS
    return Subject(
        "Growth of whole runs: time and memory with the size",
        "none",
        [_task(run, 2 if quick else None) for run in runs],
        seconds=0.5,
        grows=True,
    )


def words_of(run: Grown, n: int) -> tuple[str, ...]:
    """Return the arguments of a run of one size."""
    values = {"{n}": f"{n}", "{1/n}": f"{1.0 / n!r}", "{20n}": f"{20 * n}"}
    values["{1..n}"] = ",".join(f"{60 + i}" for i in range(n)) if "{1..n}" in run.words else ""
    text = run.words
    for mark, value in values.items():
        text = text.replace(mark, value)
    return tuple(text.split())


def _task(run: Grown, most: int | None) -> Task:
    text = template(run.kind)
    methods = [
        Method(
            "ours",
            n,
            partial(_run, words_of(run, n), text),
            ours=True,
            memory=partial(_memory, words_of(run, n), text),
        )
        for n in run.sizes[:most]
    ]
    base = partial(run_python, IMPORT)
    return Task(f"geneva {run.words}", BASELINE, base, lambda _: 0.0, methods)


def _command(words: Sequence[str]) -> list[str]:
    return [sys.executable, "-c", RUN, *words]


def _run(words: Sequence[str], text: str) -> None:
    done = subprocess.run(_command(words), capture_output=True, input=text, text=True)
    # 1: a check fails, which is a result
    if done.returncode not in (0, 1):
        raise subprocess.CalledProcessError(done.returncode, done.args, stderr=done.stderr)


def _memory(words: Sequence[str], text: str) -> float:
    """Return the greatest memory of a run, MB."""
    command = [sys.executable, "-c", LARGEST, *_command(words)]
    done = subprocess.run(command, capture_output=True, input=text, text=True, check=True)
    return float(done.stdout) / (1e6 if sys.platform == "darwin" else 1e3)  # bytes or kilobytes
