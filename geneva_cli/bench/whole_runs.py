"""Whole runs of the program as tasks of the bench, compared with a Python that imports Typer."""

from __future__ import annotations

import subprocess
import sys

from geneva_cli.bench.method import Method, Task

RUN = "import sys; sys.argv[0] = 'geneva'; from geneva_cli.__main__ import main; main()"
IMPORT = "import typer"
BASELINE = f"python -c '{IMPORT}'"


def run_python(code: str, words: tuple[str, ...] = ()) -> None:
    """Run a program in a new Python process; raises CalledProcessError if it fails."""
    command = [sys.executable, "-c", code, *words]
    subprocess.run(command, capture_output=True, stdin=subprocess.DEVNULL, check=True)


def task(name: str, runs: dict[str, tuple[str, ...]]) -> Task:
    """Task of ``geneva`` runs with some arguments, by name; it has no error."""
    methods = [
        Method(run, None, lambda words=words: run_python(RUN, words), ours=True)  # type: ignore[misc]
        for run, words in runs.items()
    ]
    return Task(name, BASELINE, lambda: run_python(IMPORT), lambda _: 0.0, methods)
