"""Run time against error, subject by subject, as one table.

Times are ratios to a baseline in the same run: the median over rounds in which baseline and methods
take turns. A method is on the frontier unless another one of its task is faster and as accurate. A
tenth of the time counts as noise.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import cast

from bench.method import BenchRow, Subject, Task, with_frontier
from bench.timing_pairs import exponent, ratios
from geneva_cli.table import Table, rows_table

# The registry: a subject is a module of ``bench.subjects`` with a function ``subject(quick)``.
SUBJECTS = ("peaks", "many", "sweep", "motion", "synth", "start", "advice", "growth")


# Those of ``make bench``: kernels against rivals. The others are whole runs of the program, or have
# no rival.
SHORT = ("motion", "peaks", "many")


def measure(name: str, quick: bool, part: float = 1.0) -> tuple[Subject, list[BenchRow]]:
    """One subject with its rows.

    ``quick`` takes small sizes, for tests. ``part`` is the fraction of the time that each method is
    measured for.
    """
    module = importlib.import_module(f"bench.subjects.{name}")
    subject = cast(Subject, module.subject(quick))
    seconds = 0.01 if quick else part * subject.seconds
    rows = [row for task in subject.tasks for row in _rows(name, subject, task, seconds)]
    return subject, rows


def _rows(name: str, subject: Subject, task: Task, seconds: float) -> Iterator[BenchRow]:
    yield BenchRow(name, task.name, f"baseline: {task.baseline}", None, None, 1.0, None, False)
    runs = [m.run for m in task.methods]
    answers, times = ratios(task.baseline_run, runs, seconds, subject.clock)
    alone = not any(m.rival and not m.ours for m in task.methods)
    rows = [
        BenchRow(
            name,
            task.name,
            method.name,
            method.size,
            task.error(answer),
            time.ratio * method.times,
            method.memory() if method.memory else None,
            method.ours,
            rival="none but ourselves" if alone and method.ours else None,
            designs_per_s=task.designs and task.designs / (time.least_s * method.times),
        )
        for method, answer, time in zip(task.methods, answers, times, strict=True)
    ]
    rows = with_frontier(rows, subject.slack, subject.floor)
    yield from _with_exponents(rows) if subject.grows else rows


def _with_exponents(rows: list[BenchRow]) -> list[BenchRow]:
    """Rows of growing size, the largest with the exponents of time and memory."""
    *others, largest = rows
    sizes = [row.size or 0.0 for row in rows]
    time = exponent(sizes, [row.time_ratio for row in rows])
    memory = exponent(sizes, [row.memory_MB or 0.0 for row in rows])
    return [*others, largest._replace(time_exponent=time, memory_exponent=memory)]


def bench_table(rows: list[BenchRow]) -> Table:
    """Rows as a table of texts, without columns that are all empty.

    A table of numbers shows as 0 what is small compared with the column's largest; here the
    smallest errors count.
    """
    shown = rows_table(BenchRow._fields, [_spelled(row) for row in rows])
    kept = [i for i, c in enumerate(shown.columns) if any(v is not None for v in c)]
    return Table(tuple(shown.names[i] for i in kept), [list(shown.columns[i]) for i in kept])


def _spelled(row: BenchRow) -> tuple[object, ...]:
    """A row for people: three digits of what is measured, as more are noise."""
    spelled = {
        "size": _digits(row.size, 12),
        "error": "0" if row.error == 0.0 else row.error and f"{row.error:.1e}",
        "time_ratio": _digits(row.time_ratio, 3),
        "memory_MB": _digits(row.memory_MB, 3),
        "designs_per_s": row.designs_per_s and f"{float(f'{row.designs_per_s:.3g}'):,.0f}",
        "time_exponent": _digits(row.time_exponent, 2),
        "memory_exponent": _digits(row.memory_exponent, 2),
    }
    return tuple((row._asdict() | spelled).values())


def _digits(value: float | None, count: int) -> str | None:
    """Text of a number with some digits, without an exponent; None stays None."""
    return None if value is None else f"{float(f'{value:.{count}g}'):,.12g}"
