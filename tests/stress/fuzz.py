"""Random cases before the program, for hours: `tests/stress/fuzz.py NAME --runs 20000 --jobs 2`.

NAME is one of ``FUZZERS``. A run is of numbered cases; each makes its own random numbers from its
number, so that any of them is made again by `--first N --runs 1`, in any order and by any process.
A run with `--state` can be stopped and resumed.
"""

import argparse
import contextlib
import json
import multiprocessing
import os
import random
import signal
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from typing import NamedTuple

import fuzz_checks
import fuzz_studies
from fuzz_machines import machine_text
from fuzz_texts import text_of

LAW = "".join(f"{i / 10},{(i / 10) ** 2 * (3 - i / 5)}\n" for i in range(11))
FILES = {"law.csv": LAW}  # which a spec may name
MEMORY = 2**30  # bytes of data that a process of a long run may hold


class Fuzzer(NamedTuple):
    """Random cases and what must be true of each."""

    make: Callable  # a case from random numbers
    check: Callable  # returns how a case ended, in a word; raises for a fault
    seconds: float  # of one case, at most
    batch: int  # cases of a process between two lines of the state
    strict: bool = True  # warnings are errors

    def one(self, case):
        """Try a case in time."""
        with in_time(self.seconds), warnings.catch_warnings():
            if self.strict:
                warnings.simplefilter("error")
            return self.check(case)


FUZZERS = {
    "specs": Fuzzer(text_of, fuzz_checks.motion, 10, 500),
    "parts": Fuzzer(machine_text, fuzz_checks.parts, 30, 20),
    "sheets": Fuzzer(machine_text, fuzz_checks.sheet, 60, 20),
    "stops": Fuzzer(fuzz_studies.stop_case, fuzz_studies.stops, 30, 20, strict=False),
    "schema": Fuzzer(fuzz_studies.schema_case, fuzz_studies.schema, 10, 500, strict=False),
    "synth": Fuzzer(fuzz_studies.synth_case, fuzz_studies.synth, 120, 10, strict=False),
    "certificates": Fuzzer(
        fuzz_checks.machine_of_each_kind, fuzz_checks.certified, 60, 50, strict=False
    ),
}


@contextlib.contextmanager
def in_time(seconds):
    """Raise TimeoutError after ``seconds`` of processor time; other processes do not count.

    Windows has no such timer: there a run may take for ever.
    """
    if not hasattr(signal, "setitimer"):
        yield
        return

    def stop(number, frame):
        raise TimeoutError(f"more than {seconds} s")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@contextlib.contextmanager
def folder():
    """A temporary working folder with files of points, which nothing may harm."""
    with tempfile.TemporaryDirectory() as path, contextlib.chdir(path):
        for name, text in FILES.items():
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        yield
        for name, text in FILES.items():
            with open(name, encoding="utf-8") as file:
                assert file.read() == text, f"{name} was changed"
        assert sorted(os.listdir()) == sorted(FILES)


def numbers(seed, case):
    """The random numbers of a case."""
    return random.Random(f"{seed}-{case}")


def _place(error):
    """The function that raised an error: failures of one place are counted together."""
    last = error.__traceback__
    while last.tb_next:
        last = last.tb_next
    code = last.tb_frame.f_code
    return f"{os.path.basename(code.co_filename)}:{last.tb_lineno} {code.co_name}"


def _batch(job):
    """Run cases one after another; return the number of each result, and the first failures."""
    name, seed, start, count = job
    with contextlib.suppress(ImportError):  # on Windows there is no limit
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    ends, failed = {}, {}
    with folder():
        for number in range(start, start + count):
            case = FUZZERS[name].make(numbers(seed, number))
            try:
                end = FUZZERS[name].one(case)
            except Exception as error:
                # the place of a time-out is random
                slow = isinstance(error, TimeoutError)
                what = "TimeoutError" if slow else f"{type(error).__name__} in {_place(error)}"
                first = failed.setdefault(what, [0, number, str(error)[:400], repr(case)])
                first[0] += 1
                end = "failed"
            ends[end] = ends.get(end, 0) + 1
    return ends, failed


def main():
    """Run one fuzzer; the exit status is 1 if a case failed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("name", choices=FUZZERS)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--state", help="file to take the run up from, and to keep it in")
    options = parser.parse_args()
    state = {"seed": options.seed, "next": options.first, "ends": {}, "failed": {}}
    if options.state and os.path.exists(options.state):
        with open(options.state) as file:
            state = json.load(file)
    start, stop = time.perf_counter(), options.first + options.runs
    batch = FUZZERS[options.name].batch
    places = range(state["next"], stop, batch)
    jobs = [(options.name, state["seed"], at, min(batch, stop - at)) for at in places]
    with multiprocessing.get_context("spawn").Pool(options.jobs, maxtasksperchild=20) as pool:
        for at, (ends, failed) in zip(places, pool.imap(_batch, jobs), strict=True):
            state["next"] = min(at + batch, stop)
            for end, count in ends.items():
                state["ends"][end] = state["ends"].get(end, 0) + count
            for what, first in failed.items():
                if what not in state["failed"]:
                    print(f"case {first[1]}: {what}: {first[2]}\n{first[3]}\n", flush=True)
                    state["failed"][what] = first
                else:
                    state["failed"][what][0] += first[0]
            if options.state:
                with open(options.state + ".new", "w") as file:
                    json.dump(state, file, indent=1)
                os.replace(options.state + ".new", options.state)
    seconds = time.perf_counter() - start
    print(f"{options.name}: {stop - options.first} cases, {seconds:.0f} s; {state['ends']}")
    counts = {what: first[0] for what, first in state["failed"].items()}
    print(f"failures: {counts}", file=sys.stderr if counts else sys.stdout)
    return int(bool(counts))


if __name__ == "__main__":
    sys.exit(main())
