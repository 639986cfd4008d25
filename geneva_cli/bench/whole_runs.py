"""Whole runs of the program as tasks of the bench, beside a Python that imports Typer alone."""

from __future__ import annotations

import subprocess
import sys

from geneva_cli.bench.method import Method, Task

RUN = "import sys; sys.argv[0] = 'geneva'; from geneva_cli.app import main; main()"
IMPORT = "import typer"
BASELINE = f"python -c '{IMPORT}'"


def finished(code: str, words: tuple[str, ...] = ()) -> None:
    """Run a program in a Python of its own; raises CalledProcessError where it fails."""
    command = [sys.executable, "-c", code, *words]
    subprocess.run(command, capture_output=True, stdin=subprocess.DEVNULL, check=True)


def task(name: str, runs: dict[str, tuple[str, ...]]) -> Task:
    """What ``geneva`` takes with some words, each by its name; there is no error to it."""
    methods = [
        Method(way, None, lambda words=words: finished(RUN, words), ours=True)  # type: ignore[misc]
        for way, words in runs.items()
    ]
    return Task(name, BASELINE, lambda: finished(IMPORT), lambda _: 0.0, methods)
