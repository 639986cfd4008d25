"""Random cases before the program, for hours: `tests/stress/fuzz.py NAME --runs 20000 --jobs 2`.

NAME is one of ``FUZZERS``. A run is of numbered cases; each makes its own random numbers from its
number, so that any of them is made again by `--first N --runs 1`, in any order and by any process.
"""

import argparse
import contextlib
import multiprocessing
import os
import random
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
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
    batch: int  # cases of a process at once
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


def _batch(job):
    """Run cases one after another; return the number of each result, and the failures."""
    name, seed, start, count = job
    with contextlib.suppress(ImportError):  # on Windows there is no limit
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    ends, failed = Counter(), []
    with folder():
        for number in range(start, start + count):
            case = FUZZERS[name].make(numbers(seed, number))
            try:
                ends[FUZZERS[name].one(case)] += 1
            except Exception as error:
                ends["failed"] += 1
                place = traceback.extract_tb(error.__traceback__)[-1]
                where = f"{os.path.basename(place.filename)}:{place.lineno} {place.name}"
                # failures of one place are counted together; that of a time-out is random
                what = type(error).__name__
                what += "" if isinstance(error, TimeoutError) else f" in {where}"
                failed.append((what, f"case {number}: {what}: {str(error)[:400]}\n{case!r}\n"))
    return ends, failed


def main():
    """Run one fuzzer; the exit status is 1 if a case failed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("name", choices=FUZZERS)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    given = parser.parse_args()
    start, stop = time.perf_counter(), given.first + given.runs
    batch = FUZZERS[given.name].batch
    places = range(given.first, stop, batch)
    jobs = [(given.name, given.seed, at, min(batch, stop - at)) for at in places]
    every, failures = Counter(), Counter()
    with multiprocessing.get_context("spawn").Pool(given.jobs, maxtasksperchild=20) as pool:
        for ends, failed in pool.imap(_batch, jobs):
            every += ends
            for what, text in failed:
                if what not in failures:
                    print(text, flush=True)
                failures[what] += 1
    seconds = time.perf_counter() - start
    print(f"{given.name}: {given.runs} cases, {seconds:.0f} s; {dict(every)}")
    print(f"failures: {dict(failures)}", file=sys.stderr if failures else sys.stdout)
    return int(bool(failures))


if __name__ == "__main__":
    sys.exit(main())
