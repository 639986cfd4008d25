"""The bench: structure, errors of ours, frontier by error. Never a time: that is for people."""

import functools
import math
import subprocess
import sys
from importlib.util import find_spec

import pytest
from sampling import some
from scipy.integrate import dblquad

from bench.method import BenchRow, beats, with_frontier
from bench.run import SUBJECTS, bench_table, measure
from bench.subjects import export as bench_export
from bench.subjects import start as bench_start
from bench.subjects import tolerance as bench_tolerance
from bench.timing_pairs import exponent, median_ratio, ratios

# The greatest error that ours may show, in the subject's own measure; of the others none.
OURS = {
    "peaks": 4e-15,
    "sweep": 1e-12,  # sums of what quadrature leaves
    "many": 4e-15,  # two searches, each within the last places of the peak
    "motion": 8 * 2.0**-52,
    "tolerance": 1e-4,  # of 4,096 machines; of a million some 1e-7
}


@functools.cache
def measured(name):
    """A subject and its rows, small and once."""
    return measure(name, quick=True)


@pytest.mark.parametrize("one", some(list(SUBJECTS), ["peaks", "many"]))
def test_a_subject(one):
    """Each task has its baseline, others and usually ours; nothing is more accurate than ours.

    Of means over a few thousand machines luck decides: their errors are bounded alone.
    """
    subject, rows = measured(one)
    for task in subject.tasks:
        base, *others = [row for row in rows if row.task == task.name]
        assert base.method == f"baseline: {task.baseline}"
        assert (base.time_ratio, base.error, base.frontier) == (1.0, None, None)
        assert all(row.time_ratio > 0.0 and row.frontier in (True, False) for row in others)
        own = [row.error for row in others if row.ours]
        assert own or task.name == "python"
        assert max(own, default=0.0) <= OURS.get(one, 0.0)
        if one != "tolerance":
            assert max(own, default=0.0) <= max(min(r.error for r in others), 2 * subject.floor)
    assert bench_table(rows).names[:3] == ("subject", "task", "method")


def row(error, time):
    return BenchRow("s", "t", "m", None, error, time, None, False)


def test_frontier():
    fast, exact, both, tie = row(1e-3, 1.0), row(1e-16, 9.0), row(1e-3, 2.0), row(5e-16, 8.9)
    found = with_frontier([fast, exact, both, tie], 0.1, 1e-15)
    assert [r.frontier for r in found] == [True, True, False, True]
    assert beats(row(1e-3, 1.0), row(1e-3, 2.0), 0.1, 0.0)


def test_ratios_are_of_pairs():
    assert median_ratio([(1.0, 2.0), (10.0, 20.0), (1.0, 50.0)]) == 2.0
    calls = []
    answers, found = ratios(lambda: calls.append(0), [lambda: calls.append(1) or "one"], 1e-4)
    assert answers == ["one"]
    assert len(found) == 1
    assert min(found[0]) > 0.0
    assert set(calls) == {0, 1}


@pytest.mark.parametrize("name", [n for n in bench_export.LIBRARIES if find_spec(n)])
def test_libraries_write_the_same_numbers(name):
    """What they write reads back as it was; else a rival would be slandered."""
    (task,) = bench_export.subject(True).tasks
    (method,) = [m for m in task.methods if m.name == name]
    assert task.error(method.run()) == 0.0


def test_costs_have_the_exponent_of_their_growth():
    sizes = (10, 100, 1_000, 10_000)
    assert exponent(sizes, [1.2, 1.0, 2.0, 11.0]) == pytest.approx(1.0, abs=0.01)
    assert exponent(sizes, [1.0 + (n / 1e3) ** 2 for n in sizes]) == pytest.approx(2.0, abs=0.01)
    assert exponent(sizes, [1.0, 1.1, 0.9, 1.05]) == 0.0


def test_means_of_tolerances_are_those_of_an_adaptive_rule():
    """The jump begins as a square root at a length of the crank that depends on the distance."""
    exact = bench_tolerance.exact_means()
    rough = bench_tolerance.quasi_random(1 << 16)
    assert tuple(rough) == pytest.approx(tuple(exact), rel=1e-4)  # of 65,536 machines
    a, b = bench_tolerance.SIZES[:2]
    total, _ = dblquad(
        lambda R, away: bench_tolerance.jumps(away, R),
        *(bench_tolerance.L - a, bench_tolerance.L + a),
        lambda away: away * math.sin(math.pi / bench_tolerance.Z),
        bench_tolerance.arm() + b,
        epsabs=1e-12,
    )
    assert total / (4 * a * b) == pytest.approx(exact.jump, rel=1e-8)


def test_scripts_of_the_start_print_the_row():
    """The competitors do what they are there for."""
    for code in bench_start.SCRIPTS.values():
        run = subprocess.run(
            [sys.executable, "-c", code, "table", "--z", "6"], capture_output=True, text=True
        )
        assert run.returncode == 0, run.stderr
        numbers = [float(v) for v in run.stdout.split()]
        assert numbers == pytest.approx([6, 120, 240, 0.5, 1 / 3, 1.0], rel=1e-15)
