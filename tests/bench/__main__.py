"""``python -m bench [SUBJECT ...]`` in the tests' folder: run time against error, as one table.

Without a subject it measures the kernels against their rivals, in five minutes; with ``--full`` all
subjects, each for longer, in an hour. Times are ratios to a baseline in the same run: the median
over rounds in which baseline and methods take turns. A method is on the frontier unless another one
of its task is faster and as accurate. A tenth of the time counts as noise.
"""

import argparse
import os

from bench import batches, motion, peaks, plots, whole_runs
from bench.method import BenchRow, with_frontier
from bench.timing_pairs import ratios
from geneva_cli.output import show
from geneva_cli.table import Table, rows_table

SUBJECTS = {
    "peaks": peaks.peaks,
    "many": batches.peaks,
    "sweep": batches.loads,
    "motion": motion.motion,
    "synth": whole_runs.synth,
    "start": whole_runs.start,
    "advice": whole_runs.advice,
}
# Those of ``make bench``: kernels against rivals. The others are whole runs of the program, or have
# no rival.
SHORT = ("motion", "peaks", "many")


def measure(name, quick, part=1.0):
    """One subject with its rows.

    ``quick`` takes small sizes, for tests. ``part`` is the fraction of the time that each method is
    measured for.
    """
    subject = SUBJECTS[name](quick)
    seconds = 0.01 if quick else part * subject.seconds
    return subject, [row for task in subject.tasks for row in _rows(name, subject, task, seconds)]


def _rows(name, subject, task, seconds):
    yield BenchRow(name, task.name, f"baseline: {task.baseline}", None, None, 1.0, False)
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
            method.ours,
            rival="none but ourselves" if alone and method.ours else None,
            designs_per_s=task.designs and task.designs / (time.least_s * method.times),
        )
        for method, answer, time in zip(task.methods, answers, times, strict=True)
    ]
    yield from with_frontier(rows, subject.slack, subject.floor)


def bench_table(rows):
    """Rows as a table of texts, without columns that are all empty.

    A table of numbers shows as 0 what is small compared with the column's largest; here the
    smallest errors count.
    """
    shown = rows_table(BenchRow._fields, [_spelled(row) for row in rows])
    kept = [i for i, c in enumerate(shown.columns) if any(v is not None for v in c)]
    return Table(tuple(shown.names[i] for i in kept), [list(shown.columns[i]) for i in kept])


def _spelled(row):
    """A row for people: three digits of what is measured, as more are noise."""
    digits = {"size": 12, "time_ratio": 3, "designs_per_s": 3}
    spelled = {"error": "0" if row.error == 0.0 else row.error and f"{row.error:.1e}"}
    for name, count in digits.items():
        value = getattr(row, name)
        spelled[name] = value and f"{float(f'{value:.{count}g}'):,.12g}"
    return tuple((row._asdict() | spelled).values())


def main():
    """Measure some subjects, and print one table; with -o also a plot of each beside it."""
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("subjects", nargs="*", choices=(*SUBJECTS, []), metavar="SUBJECT")
    parser.add_argument("--quick", action="store_true", help="small sizes, seconds in all")
    parser.add_argument("--full", action="store_true", help="all subjects, an hour")
    parser.add_argument("-o", "--output", default="-")
    given = parser.parse_args()
    rows = []
    for name in given.subjects or (SUBJECTS if given.full else SHORT):
        subject, own = measure(name, given.quick, 1.0 if given.full else 0.2)
        rows += own
        if given.output != "-":
            plots.write(subject, own, os.path.join(os.path.dirname(given.output), f"{name}.svg"))
    show(bench_table(rows), given.output)


if __name__ == "__main__":
    main()
