"""Machines under test, built as a spec would build them."""

import functools
import gc
import importlib
import os
import pkgutil

# Before NumPy is imported: there is a worker for each core, so threads of its linear algebra only
# take turns with them, and wait for each other in loops. That is a tenth of a run's processor time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# What a child prints, and what pytest reads, is UTF-8 on Windows too.
os.environ.setdefault("PYTHONUTF8", "1")

import pytest
from hypothesis import settings
from sampling import left_out, some
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli import extras, kinds, load, study
from geneva_cli.motion.mechanism import build
from geneva_cli.parts import flat_parts
from geneva_cli.parts.outlines import curved_walls, cut_outlines, path_walls
from geneva_cli.parts.turn import full_turn
from geneva_cli.verdict import advice, motion_warnings
from geneva_cli.verdict.checks import motion_checks

SHARING = {"made_once", "read_once"}  # fixtures of what costs seconds
LONGEST = "test_without"  # by the middle of a run, much that it copies is compiled


def pytest_configure(config):
    """Collect tests without garbage collection; every run has the same random cases."""
    gc.disable()
    config.addinivalue_line("markers", "sampled(k): run one of k cases, all in `make stress`")
    config.addinivalue_line("markers", "long: run in `make stress` alone")
    settings.register_profile(
        "same", deadline=None, derandomize=True, database=None, max_examples=some(100, 25)
    )
    settings.load_profile("same")
    if hasattr(config, "workerinput"):
        config.pluginmanager.register(Worker(config.workerinput["workerid"]))


class Worker:
    """One of several processes that share the compilation of a new checkout's tests."""

    def __init__(self, name):
        self.backwards = int(name.removeprefix("gw")) % 2

    @pytest.hookimpl(wrapper=True)
    def pytest_make_collect_report(self, collector):
        """Every second worker begins at the last file: each compiles half of a new checkout."""
        report = yield
        if self.backwards and isinstance(collector, pytest.Directory):
            report.result.reverse()
        return report


def pytest_collection_modifyitems(config, items):
    """Leave out tests that are not sampled; those that share designs come first, in one worker.

    The order is the same in all workers, whichever file each of them collects first.
    """
    if out := left_out(items):
        config.hook.pytest_deselected(items=list(out))
        items[:] = [item for item in items if item not in out]
    items.sort(
        key=lambda item: (
            not SHARING & {*item.fixturenames},
            str(item.path.parent / "kinds" if item.path.stem == LONGEST else item.path),
        )
    )


def pytest_collection_finish():
    """Exclude the collected tests, which stay to the end, from garbage collection.

    It runs ten times less often than usual, which saves 2 % of the time.
    """
    gc.freeze()
    gc.set_threshold(7_000)
    gc.enable()


@pytest.fixture(scope="session")
def machine():
    """Return a function that builds a mechanism; A = 0 is a plain crank.

    Its other keywords are keys of ``[motion]``.
    """

    def make(z, gearing="external", A=0.0, rollers=1, path="", **motion):
        kind, keys = ("side-crank", Keys("side-crank", A)) if A else ("crank", None)
        drive = Drive(kind, 60.0, rollers)
        return build(Spec(Wheel(z, gearing), drive, keys, motion=Motion(**motion), path=path))

    return make


@pytest.fixture(scope="session")
def engagement(machine):
    """Return a function that builds a mechanism and returns its first engagement."""
    return lambda *args, **keys: machine(*args, **keys).engagements[0]


KEPT = 256  # latest results: the designs of the folder, with some tolerances


def kept(function, key):
    """The function, computed once a key; it keeps its arguments, so that their ids stay valid."""
    known = {}

    def once(*arguments):
        k = key(*arguments)
        if k not in known:
            known[k] = function(*arguments), arguments
            if len(known) > KEPT:
                del known[next(iter(known))]
        return known[k][0]

    return once


def of_outlines(parts, *refined):
    # shells have no tolerance
    return parts.assembly.full.spec, getattr(parts, "fine", 0.0), *refined


def of_certificate(parts, gap_mm, to_mm):
    return *of_outlines(parts), gap_mm, to_mm


def of_sizes(assembly, sizes, tolerance=0.0):
    return assembly.full.spec, sizes, tolerance


def of_slot(assembly, sizes, of):
    return id(assembly), sizes, id(of)


OUTLINES = kept(cut_outlines.drawn, of_sizes)
TURNED = kept(full_turn.full_turn, of_outlines)
PROVED = kept(motion_checks.certificate, of_certificate)
WALLS = kept(path_walls.walls, of_slot)
CHAIN = kept(curved_walls.chain, of_slot)  # whose walls are kept too
MOTION_WARNINGS = kept(motion_warnings.motion_warnings, lambda mechanism: mechanism.spec)


@pytest.fixture(scope="module")
def made_once():
    """Compute walls, outlines, turn, proof and warnings of a spec once a test file; saves seconds.

    Not for tests of their computation, or of its time.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cut_outlines, "drawn", OUTLINES)
        patch.setattr(flat_parts, "drawn", OUTLINES)
        patch.setattr(full_turn, "full_turn", TURNED)
        patch.setattr(motion_checks, "certificate", PROVED)
        patch.setattr(curved_walls, "walls", WALLS)
        patch.setattr(curved_walls, "chain", CHAIN)
        patch.setattr(motion_warnings, "motion_warnings", MOTION_WARNINGS)
        yield


@pytest.fixture
def no_advice(monkeypatch):
    """Omit the search for advice on failing checks, which takes seconds."""
    monkeypatch.setattr(advice, "TRIALS", 0)


@pytest.fixture(scope="module")
def few_four_bars():
    """Search four-bars at an eighth of the places, for tests that are not about four-bars.

    The search still returns four-bars, though not the best; test_synth_four_bar.py tests those.
    """
    with pytest.MonkeyPatch.context() as patch:
        if "linkages" in kinds.FOLDERS:
            search = "geneva_cli.kinds.linkages.four_bar_search"
            patch.setattr(f"{search}.SAMPLES", (128, 256))
            patch.setattr(f"{search}.SAMPLINGS", (7, 8))
        yield


READ = functools.cache(load)


def read(path, settings=(), reverse=False):
    """The design of a file with settings, read once."""
    return READ(path, tuple(settings), reverse)


@pytest.fixture(scope="module")
def read_once():
    """Read each design once, so that tests share its computed values.

    These tests name files by paths that do not change. Modules that import ``load`` must be
    imported before: otherwise they would keep this one after the tests.
    """
    for module in pkgutil.iter_modules(study.__path__, "geneva_cli.study."):
        importlib.import_module(module.name)
    if "servo" in extras.FOLDERS:
        importlib.import_module("geneva_cli.extras.servo.against")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geneva_cli.design.load", read)
        yield
