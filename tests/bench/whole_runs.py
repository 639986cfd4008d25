"""Whole runs of the program as tasks of the bench, compared with a Python that imports Typer."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from typing import NamedTuple

from bench.method import Method, Task

# What the installed ``geneva`` does.
GENEVA = "import sys; sys.argv[0] = 'geneva'; from geneva_cli.__main__ import main; main()"
# Runs a command and prints its largest memory. The bench's own process is too large for that: a
# child starts with the memory of its parent.
LARGEST = (
    "import resource, subprocess, sys; subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL);"
    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
)


class WholeRun(NamedTuple):
    """A Python process: its code, its arguments, and the text on its standard input."""

    code: str
    words: tuple[str, ...] = ()
    text: str = ""

    def run(self) -> None:
        """Run it. Raises CalledProcessError if it fails."""
        self._output(())

    def memory_MB(self) -> float | None:
        """Greatest memory of a run, MB; None on Windows, which does not tell it."""
        if os.name == "nt":
            return None
        largest = float(self._output((sys.executable, "-c", LARGEST)))
        return largest / (1e6 if sys.platform == "darwin" else 1e3)  # bytes or kilobytes

    def _output(self, outer: tuple[str, ...]) -> str:
        command = (*outer, sys.executable, "-c", self.code, *self.words)
        # an installed program is compiled once
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
        done = subprocess.run(
            command, capture_output=True, input=self.text, encoding="utf-8", env=environment
        )
        # 1: a check fails, which is a result where it is printed
        if done.returncode > 1 or (done.returncode and not done.stdout):
            raise subprocess.CalledProcessError(done.returncode, command, stderr=done.stderr)
        return done.stdout


def geneva(*words: str, text: str = "") -> WholeRun:
    """A run of the program with some arguments, and a spec on standard input."""
    return WholeRun(GENEVA, words, text)


def task(name: str, methods: Sequence[Method]) -> Task:
    """Task of whole runs; it has no error."""
    return Task(
        name, "python -c 'import typer'", WholeRun("import typer").run, lambda _: 0.0, methods
    )
