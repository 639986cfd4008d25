"""The bench: structure, errors of ours, frontier by error. Never a time: that is for people."""

import functools
import json
import math
import re
import subprocess
import sys
from importlib.util import find_spec
from types import SimpleNamespace

import numpy as np
import pytest
from sampling import some
from scipy.integrate import dblquad
from typer.testing import CliRunner

from bench import __main__ as bench_main
from bench.__main__ import app
from bench.formulas import Proportions
from bench.kinds import KINDS, values_of
from bench.method import BenchRow, beats, missing, with_frontier
from bench.numeric import by_chebpy
from bench.plot import svg
from bench.run import SUBJECTS, measure
from bench.scalar_loop import looped, motion_loop
from bench.subjects import export as bench_export
from bench.subjects import start as bench_start
from bench.subjects import tolerance as bench_tolerance
from bench.subjects.cranks import CrankDesigns
from bench.subjects.many import PEAK_QUANTITIES
from bench.subjects.motion import blocks, stable, stable_texts
from bench.timing_pairs import exponent, median_ratio, ratios
from bench.truth import acceleration_peak, relative
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peak

# The greatest error that ours may show, in the subject's own measure.
OURS = {
    "loads": 4e-15,
    "peaks": 4e-15,
    "sweep": 1e-12,  # sums of what quadrature leaves
    "cranks": 4e-15,
    "many": 4e-15,  # two searches, each within the last places of the peak
    "motion": 8 * 2.0**-52,
    "slot": 1e-2 * 1.005,  # mm; 15 points a chord miss 1/256 of its error
    "tolerance": 1e-4,  # of 4,096 machines; of a million some 1e-7
    "vibration": 1e-13,
    "turn": 2e-6,  # how nearly curved walls are known
    "synth": 0.0,
    "start": 0.0,
    "export": 0.0,
    "growth": 0.0,
}


@functools.cache
def measured(name):
    """A subject and its rows, small and once."""
    return measure(name, quick=True)


@pytest.fixture(scope="module", params=some(list(SUBJECTS), list(SUBJECTS)[::4]))
def one(request):
    """The name of a subject, which the tests take one after the other."""
    return request.param


def test_every_task_has_a_baseline_others_and_usually_ours(one):
    subject, rows = measured(one)
    for task in subject.tasks:
        base, *others = [row for row in rows if row.task == task.name]
        assert base.method == f"baseline: {task.baseline}"
        assert (base.time_ratio, base.error, base.frontier) == (1.0, None, None)
        assert others
        assert any(row.ours for row in others) or task.name == "python"
        for row in others:
            assert row.subject == one
            assert row.time_ratio > 0.0
            assert row.error >= 0.0
            assert row.frontier in (True, False)


def test_errors_of_ours(one):
    own = [row.error for row in measured(one)[1] if row.ours]
    assert own
    assert max(own) <= OURS[one]


def test_nothing_is_more_accurate_than_ours(one):
    """But for what is below the errors that count as equal; a slot's pieces are counted below.

    Of means over a few thousand machines luck decides: their errors are bounded above.
    """
    subject, rows = measured(one)
    for row in rows:
        if row.ours and one not in ("slot", "tolerance"):
            rivals = [r.error for r in rows if r.task == row.task and r.error is not None]
            assert row.error <= max(min(rivals), 2 * subject.floor)


def test_no_even_or_halved_pieces_are_as_few():
    _, rows = measured("slot")
    for row in rows:
        if row.ours:
            rivals = [r for r in rows if r.task == row.task and not r.ours]
            same = [r.pieces for r in rivals if r.size == row.size]
            assert row.pieces < min(same)


def row(error, time, pieces=None):
    return BenchRow("s", "t", "m", None, pieces, error, time, None, False)


def test_frontier():
    fast, exact, both, tie = row(1e-3, 1.0), row(1e-16, 9.0), row(1e-3, 2.0), row(5e-16, 8.9)
    found = with_frontier([fast, exact, both, tie], 0.1, 1e-15)
    assert [r.frontier for r in found] == [True, True, False, True]
    assert not beats(row(1e-3, 1.0, 100), row(1e-3, 2.0, 50), 0.1, 0.0)
    assert beats(row(1e-3, 1.0, 50), row(1e-3, 2.0, 50), 0.1, 0.0)


def test_ratios_are_of_pairs():
    assert median_ratio([(1.0, 2.0), (10.0, 20.0), (1.0, 50.0)]) == 2.0
    calls = []
    answers, found = ratios(lambda: calls.append(0), [lambda: calls.append(1) or "one"], 1e-4)
    assert answers == ["one"]
    assert len(found) == 1
    assert min(found[0]) > 0.0
    assert set(calls) == {0, 1}


def test_where_the_clock_of_the_processor_stands_still_the_wall_counts(monkeypatch):
    """Some systems' clock ticks every sixteen milliseconds."""
    monkeypatch.setattr("bench.timing_pairs.process_time", lambda: 1.0)
    _, (found,) = ratios(lambda: 0, [lambda: sum(range(1000))], 1e-4)
    assert 0.0 < found.least_s < 1.0


def invoke(*words):
    return CliRunner().invoke(app, words)


@pytest.fixture
def measured_once(monkeypatch):
    """A command shows the rows that another test has measured."""
    monkeypatch.setattr(bench_main, "measure", lambda name, quick: measured(name))


@pytest.mark.usefixtures("measured_once")
def test_command_and_plot(tmp_path):
    folder = tmp_path / "plots"
    folder.mkdir()
    words = ("peaks", "--quick", "--format", "json", "--plots", str(folder))
    first = invoke(*words)
    assert first.exit_code == 0, first.output
    rows = json.loads(first.stdout)["rows"]
    assert {"subject", "method", "error", "time_ratio", "ours", "frontier"} <= set(rows[0])
    text = (folder / "peaks.svg").read_text(encoding="utf-8")
    assert text.startswith("<?xml")
    assert not re.search(r"20\d\d-\d\d-\d\d", text), "a date in an output file"
    assert "relative error" in text
    assert text == svg(*measured("peaks")), "the same rows give the same plot"


@pytest.mark.usefixtures("measured_once")
def test_people_see_small_errors():
    """The table for people shows as 0 what is small beside its column; here that would hide all."""
    found = invoke("peaks", "--quick")
    assert found.exit_code == 0, found.output
    assert re.search(r"\d\.\de-1[5-8]", found.stdout)


def test_export_names_the_libraries_that_are_missing(monkeypatch):
    real = bench_export.importlib.util.find_spec
    monkeypatch.setattr(
        bench_export.importlib.util,
        "find_spec",
        lambda name: None if name == "polars" else real(name),
    )
    found = invoke("export", "--quick", "--format", "json")
    assert found.exit_code == 0, found.output
    assert "polars" in found.stderr
    assert "--group bench" in found.stderr
    methods = {row["method"] for row in json.loads(found.stdout)["rows"]}
    assert "polars" not in methods
    assert "orjson" in methods  # of the tests' own needs


@pytest.mark.parametrize("name", [n for n in bench_export.LIBRARIES if find_spec(n)])
def test_libraries_write_the_same_numbers(name):
    """What they write reads back as it was; else a rival would be slandered."""
    subject = bench_export.subject(True)
    (task,) = subject.tasks
    (method,) = [m for m in task.methods if m.name == name]
    assert task.error(method.run()) == 0.0


def test_exports_of_more_rows_than_are_held_are_compared_too(monkeypatch):
    """A longer table makes its rows while it is written: the other writers want whole arrays."""
    monkeypatch.setattr("geneva_cli.table.WHOLE_ROWS", 1000)
    monkeypatch.setattr(bench_export, "COUNTS", (3000,))
    (task,) = bench_export.subject(False).tasks
    assert task.name == "3000 rows x 6"
    task.baseline_run()
    assert {method.name: task.error(method.run()) for method in task.methods} == dict.fromkeys(
        [method.name for method in task.methods], 0.0
    )


@pytest.mark.parametrize(
    ("name", "library", "method"),
    [
        ("peaks", "chebfun", "chebpy, roots of the slope"),
        ("motion", "numexpr", "stable formula, numexpr"),
        ("motion", "numba", "stable formula, numba"),
        *some([("cranks", "numba", "numba, loop over designs")], []),
    ],
)
def test_a_library_takes_part_or_is_said_to_be_missing(name, library, method):
    subject, rows = measured(name)
    is_here = not missing(library)
    assert (library in subject.absent) != is_here
    assert (method in {row.method for row in rows}) == is_here


def test_the_loop_for_numba_finds_the_peaks():
    """Run as it is written, not compiled; against 50 digits."""
    designs = CrankDesigns(300)
    sign, l, A, _ = designs.arrays
    found = np.zeros(300)
    looped(lambda function: function)(sign, l, A, found)
    assert designs.error(found) < 4e-15


def test_the_loop_over_angles_is_the_stable_formula():
    l, x, out = math.sin(math.pi / 3.0), np.linspace(-0.5, 0.5, 101), np.zeros((2, 101))
    motion_loop(lambda function: function)(l, x, *out)
    for values, exact in zip(out, stable(l, x, (1, 2)), strict=True):
        assert np.abs(values - exact).max() < 4e-15 * np.abs(exact).max()  # a few roundings


def test_the_expressions_for_numexpr_are_the_stable_formula():
    l, x = math.sin(math.pi / 3.0), np.linspace(-0.5, 0.5, 101)
    for text, exact in zip(stable_texts(), stable(l, x, range(4)), strict=True):
        found = eval(text, {**vars(np), "l": l, "x": x})
        assert np.abs(found - exact).max() < 4e-15 * np.abs(exact).max()


def test_scripts_for_batches_find_the_peaks():
    """The narrowest peaks are 0.3 % higher than a grid of 101 angles shows."""
    for kind in (k for k in KINDS if k.script):
        values = values_of(kind, 50)
        alone = [
            build(kind.spec.with_(kind.key, value)).engagements[0] for value in values.tolist()
        ]
        exact = [[peak(e.motion, name).max for name in PEAK_QUANTITIES] for e in alone]
        assert kind.script(values) == pytest.approx(np.array(exact), rel=5e-3), kind.name


def test_costs_have_the_exponent_of_their_growth():
    sizes = (10, 100, 1_000, 10_000)
    assert exponent(sizes, [1.2, 1.0, 2.0, 11.0]) == pytest.approx(
        1.0, abs=0.01
    )  # the first is noise
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


def test_blocks_are_the_whole():
    x = np.linspace(-0.5, 0.5, 101)
    whole, parts = stable(0.5, x, (1, 3)), blocks(0.5, x, (1, 3), size=7)
    assert np.array_equal(whole, parts)


class Series(np.polynomial.Chebyshev):
    """What of a chebfun is asked for."""

    diff = np.polynomial.Chebyshev.deriv

    def roots(self):
        found = super().roots()
        real = found.real[np.abs(found.imag) < 1e-9]
        return real[(real > self.domain[0]) & (real < self.domain[1])]


def test_the_call_of_chebpy_finds_the_peak(monkeypatch):
    stand_in = SimpleNamespace(chebfun=lambda f, ends: Series.interpolate(f, 60, ends))
    monkeypatch.setitem(sys.modules, "chebpy", stand_in)
    for z, A in ((3, 0.0), (6, 0.6)):
        found = by_chebpy(Proportions.of(1.0, z, A))
        assert relative(found, acceleration_peak(z, "external", A)) < 1e-14


def test_scripts_of_the_start_print_the_row():
    """The competitors do what they are there for."""
    for code in bench_start.SCRIPTS.values():
        run = subprocess.run(
            [sys.executable, "-c", code, "table", "--z", "6"], capture_output=True, text=True
        )
        assert run.returncode == 0, run.stderr
        numbers = [float(v) for v in run.stdout.split()]
        assert numbers == pytest.approx([6, 120, 240, 0.5, 1 / 3, 1.0], rel=1e-15)


def test_a_start_stands_beside_the_libraries_that_it_needs():
    """Below the time of their import no run can be."""
    limits = {task.name: task.methods[-1] for task in bench_start.subject(False).tasks}
    assert limits["geneva peaks -"].name == "the limit: import typer"
    assert limits["geneva check -"].name == "the limit: import typer, numpy"
    dxf = limits["geneva profile - --part wheel --format dxf"]
    assert dxf.name == "the limit: import typer, numpy, ezdxf"
    dxf.run()  # it raises an error if the run fails


def test_unknown_subject():
    found = invoke("peak")
    assert found.exit_code == 2
    assert 'did you mean "peaks"' in found.output


def test_plots_without_matplotlib(monkeypatch, tmp_path):
    for name in ("matplotlib", "matplotlib.figure"):
        monkeypatch.setitem(sys.modules, name, None)
    found = invoke("start", "--quick", "--plots", str(tmp_path))
    assert found.exit_code == 2
    assert "--group bench" in found.output
    assert not list(tmp_path.iterdir())


def test_plots_into_no_folder():
    found = invoke("peaks", "--quick", "--plots", "/no/such/folder")
    assert found.exit_code == 2
    assert "/no/such/folder" in found.output
