"""Many specs judged side by side: one process for each of the computer's cores."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.table import Table, rows_table
from geneva_cli.verdict.checks import Check, all_pass

NAMES = ("spec", "check", "value", "at_deg", "must_be", "limit", "passes", "nearest")


class Verdict(NamedTuple):
    """What is to be said of one spec: its checks and cautions, or why it could not be read."""

    path: str
    files: tuple[str, ...] = ()  # that the design is read from
    checks: tuple[Check, ...] = ()
    cautions: tuple[str, ...] = ()
    error: str = ""

    @property
    def passes(self) -> bool:
        """Whether no check fails; what cannot be proved does not fail."""
        return not self.error and all_pass(self.checks)


def verdict(path: str, given: Sequence[str] = ()) -> Verdict:
    """Judge one spec, keys ``given`` set over its own; one that cannot be read is a verdict too."""
    try:
        design = load(path, given)
        told = (*design.warnings, *design.turn_warnings)
        return Verdict(design.spec.path, design.spec.files, tuple(design.checks), told)
    except GenevaError as error:
        return Verdict(path, error=str(error))


def verdicts(paths: list[str], given: Sequence[str] = ()) -> Iterator[Verdict]:
    """The verdicts on specs, in their order; standard input is read here, files anywhere."""
    judge = partial(verdict, given=given)
    files = [path for path in paths if path != "-"]
    workers = min(len(files), os.cpu_count() or 1)
    if workers < 2:
        yield from map(judge, paths)
        return
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    # A fork needs no second start of the program; where there is none, there is one.
    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("fork" if "fork" in methods else None)
    with ProcessPoolExecutor(workers, context, _attend) as pool:
        try:
            found = pool.map(judge, files)
            for path in paths:
                yield judge(path) if path == "-" else next(found)
        except BrokenProcessPool:
            raise GenevaError(
                "a process that checked some of the specs was ended from outside, or ran out of "
                "memory; check fewer at a time"
            ) from None


def _attend() -> None:
    """A worker ends with the program that started it, and by Ctrl-C, without a word of its own."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    threading.Thread(target=_leave, daemon=True).start()


def _leave() -> None:
    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)


def checks_table(found: list[Verdict]) -> Table:
    """One row a check, spec after spec."""
    rows = [
        (v.path, c.name, c.value, c.at_deg, c.must_be, c.limit, c.passes, c.nearest)
        for v in found
        for c in v.checks
    ]
    return rows_table(NAMES, rows)
