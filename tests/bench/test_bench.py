"""The bench: structure, errors of ours, frontier by error. Never a time: that is for people."""

import functools
import subprocess
import sys

import numpy as np
import pytest
from sampling import some

from bench.__main__ import SUBJECTS, bench_table, measure
from bench.kinds import KINDS, values_of
from bench.method import BenchRow, with_frontier
from bench.timing_pairs import median_ratio, ratios
from bench.whole_runs import SCRIPTS
from geneva_cli.motion.mechanism import build

# The greatest error that ours may show, in the subject's own measure; of the others none.
OURS = {
    "peaks": 4e-15,
    "sweep": 1e-12,  # sums of what quadrature leaves
    "many": 4e-15,  # two searches, each within the last places of the peak
    "motion": 8 * 2.0**-52,
}


@functools.cache
def measured(name):
    """A subject and its rows, small and once."""
    return measure(name, quick=True)


@pytest.mark.parametrize("one", some(list(SUBJECTS), ["peaks", "many"]))
def test_a_subject(one):
    """Each task has its baseline, others and usually ours; nothing is more accurate than ours."""
    subject, rows = measured(one)
    for task in subject.tasks:
        base, *others = [row for row in rows if row.task == task.name]
        assert base.method == f"baseline: {task.baseline}"
        assert (base.time_ratio, base.error, base.frontier) == (1.0, None, None)
        assert all(row.time_ratio > 0.0 and row.frontier in (True, False) for row in others)
        own = [row.error for row in others if row.ours]
        assert own or task.name == "python"
        assert max(own, default=0.0) <= OURS.get(one, 0.0)
        assert max(own, default=0.0) <= max(min(r.error for r in others), 2 * subject.floor)
    assert bench_table(rows).names[:3] == ("subject", "task", "method")


def test_a_row_says_where_nobody_else_does_the_task():
    _, rows = measured("many")
    alone = {row.task: row.rival for row in rows if row.ours}
    (four_bar,) = [task for task in alone if "four-bar" in task]
    (plain,) = [task for task in alone if "plain crank" in task]
    assert (alone[four_bar], alone[plain]) == ("none but ourselves", None)


def test_closed_forms_are_the_motions():
    """Those of rivals, which are written without the program."""
    for kind in KINDS:
        if kind.formula:
            value = values_of(kind, 1)[0].item()
            engagement = build(kind.spec.with_(kind.key, value)).engagements[0]
            input_deg = np.linspace(engagement.entry_deg, engagement.exit_deg, 100)
            theirs = kind.formula(kind.argument(value, engagement), np.radians(input_deg))
            ours = engagement.motion.derivatives(input_deg, (1, 2))
            for own, other in zip(ours, theirs, strict=True):
                assert other == pytest.approx(own, abs=3e-14 * np.abs(own).max()), kind.name


def row(error, time):
    return BenchRow("s", "t", "m", None, error, time, False)


def test_frontier():
    fast, exact, both, tie = row(1e-3, 1.0), row(1e-16, 9.0), row(1e-3, 2.0), row(5e-16, 8.9)
    found = with_frontier([fast, exact, both, tie], 0.1, 1e-15)
    assert [r.frontier for r in found] == [True, True, False, True]


def test_ratios_are_of_pairs():
    assert median_ratio([(1.0, 2.0), (10.0, 20.0), (1.0, 50.0)]) == 2.0
    calls = []
    answers, found = ratios(lambda: calls.append(0), [lambda: calls.append(1) or "one"], 1e-4)
    assert answers == ["one"]
    assert len(found) == 1
    assert min(found[0]) > 0.0
    assert set(calls) == {0, 1}


def test_scripts_of_the_start_print_the_row():
    """The competitors do what they are there for."""
    for code in SCRIPTS.values():
        run = subprocess.run(
            [sys.executable, "-c", code, "table", "--z", "6"], capture_output=True, encoding="utf-8"
        )
        assert run.returncode == 0, run.stderr
        numbers = [float(v) for v in run.stdout.split()]
        assert numbers == pytest.approx([6, 120, 240, 0.5, 1 / 3, 1.0], rel=1e-15)
