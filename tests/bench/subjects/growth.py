"""Growth of run time and memory with z, rows, designs, rollers and tolerance: whole runs.

The exponent is that of a power of the size: 1 is linear, and n log n is 1.1 to 1.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from bench.method import Method, Subject, Task
from bench.whole_runs import geneva, task
from geneva_cli.specfile.template import template

SWEEP = "sweep - --set drive.kind=side-crank --vary drive.A=-0.3..0.5 --jobs 1 --random {n}"
ROWS = (10, 100, 1_000, 10_000, 100_000)


class Grown(NamedTuple):
    """A run whose size grows: words with {n} for the size, or {1/n} for its inverse."""

    words: str
    sizes: Sequence[int]
    kind: str = "external"  # template of the spec


def wheel(command: str, sizes: Sequence[int] = (6, 12, 24, 48, 96, 192, 360)) -> Grown:
    """Run of a command whose wheel has more slots.

    Parts are drawn for up to 360 slots.
    """
    return Grown(f"{command} --set wheel.z={{n}}", sizes)


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
    Grown("check - --set wheel.z=3 --set drive.rollers={n}", (1, 2, 3, 4, 5)),
    Grown("compare - --vary drive.n_rpm={1..n}", (2, 10, 100)),
    *(
        Grown(f"{SWEEP} {words}", sizes)
        for words, sizes in (
            ("--pick acceleration.max --format csv", ROWS),
            ("--pick pin_force_N.max --set load.inertia_kgm2=1 --format csv", ROWS[:-1]),
            ("--pick horn_mm --format csv", ROWS[:-2]),
            ("--check --format csv", (4, 16, 64)),
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
    values = {"{n}": f"{n}", "{1/n}": f"{1.0 / n!r}"}
    values["{1..n}"] = ",".join(f"{60 + i}" for i in range(n)) if "{1..n}" in run.words else ""
    text = run.words
    for mark, value in values.items():
        text = text.replace(mark, value)
    return tuple(text.split())


def spec_of(run: Grown, n: int) -> str:
    """Return the spec of a run of one size. With the slots grows L, so that each has its room."""
    L = 20 * n if "wheel.z={n}" in run.words else 100
    sizes = f"center_distance_mm = {L}\nroller_radius_mm = 5\nwall_min_mm = 0.5\n"
    return template(run.kind).replace("[size]\n", f"[size]\n{sizes}", 1)


def _task(run: Grown, most: int | None) -> Task:
    runs = {n: geneva(*words_of(run, n), text=spec_of(run, n)) for n in run.sizes[:most]}
    methods = [Method("ours", n, run.run, True, memory=run.memory_MB) for n, run in runs.items()]
    return task(f"geneva {run.words}", methods)
