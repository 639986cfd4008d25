"""Start-up: whole runs as a user waits for them, with and without the lazy imports."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial

from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.bench.timing_pairs import process_seconds
from geneva_cli.bench.whole_runs import BASELINE, IMPORT, RUN, run_python
from geneva_cli.specfile.template import template

# A user's own script instead: a row of the table as in handbooks.
ROW = """
def row(z):
    import math
    a = math.pi / z
    l = math.sin(a)
    t = 0.5 - 1 / z
    print(z, 180 - 360 / z, 180 + 360 / z, t / (1 - t), t, l / (1 - l))
"""
SCRIPTS = {
    "a script with argparse, fewer columns": ROW + "import argparse\n"
    "parser = argparse.ArgumentParser()\n"
    "table = parser.add_subparsers().add_parser('table')\n"
    "table.add_argument('--z', type=int)\n"
    "row(parser.parse_args().z)\n",
    "a Typer app of lazy commands, fewer columns": ROW + "import typer\n"
    "app = typer.Typer()\n"
    "app.callback()(lambda: None)\n"
    "@app.command()\n"
    "def table(z: int = 6): row(z)\n"
    "app()\n",
}


def commands() -> list[str]:
    """Names of the commands, from a run of the program, since this module may not import it."""
    code = "from geneva_cli.app import COMMANDS; print(*COMMANDS)"
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()


def subject(quick: bool) -> Subject:
    """Bare Python, every command in both ways, and exports to cut; one task each."""
    spec = template("curved")  # the template that needs most
    eager = (
        "import importlib, numpy, scipy.optimize, scipy.interpolate, rich.table\n"
        "from geneva_cli.app import COMMANDS\n"
        "for name in COMMANDS: importlib.import_module('geneva_cli.commands.' + name)\n"
    )
    # arguments of commands, with a spec on standard input; other commands run with --help
    arguments: dict[str, tuple[str, ...]] = {
        "table": ("--z", "6"),
        "peaks": ("-",),
        "motion": ("-",),
        "profile": ("-",),
        "report": ("-",),
        "check": ("-",),
        "laws": (),
        "new": ("external",),
    }
    tasks = [_task("python", {"python -c pass": ("pass", ())}, None)]
    for name in ("table",) if quick else ("--help", *commands()):
        words = (name, *arguments.get(name, ("--help",) if name != "--help" else ()))
        runs = {
            "ours: lazy imports": (RUN, words),
            "everything imported first": (eager + RUN, words),
        }
        if name == "table":
            runs |= {script: (code, words) for script, code in SCRIPTS.items()}
        tasks.append(_task("geneva " + " ".join(words), runs, spec))
    # Wheels to cut: outlines computed, turned against the crank, and written. Templates and keys.
    wheels: dict[str, tuple[str, tuple[str, ...]]] = {
        "6 straight slots": ("external", ()),
        "6 curved slots": ("curved", ()),
        "24 straight slots": ("external", ("wheel.z=24", "size.roller_radius_mm=2")),
        "4 slots, 3 rollers": ("external", ("wheel.z=4", "drive.rollers=3")),
    }
    export = ("profile", "-", "--part", "wheel", "--format", "dxf")
    for name, (kind, keys) in () if quick else wheels.items():
        words = (*export, *(word for key in keys for word in ("--set", key)))
        runs = {"ours: lazy imports": (RUN, words)}
        tasks.append(_task(f"geneva profile as dxf: {name}", runs, template(kind)))
    return Subject("Start-up of whole runs", "none", tasks)


def _task(name: str, runs: dict[str, tuple[str, tuple[str, ...]]], spec: str | None) -> Task:
    methods = [
        Method(run, None, partial(_run, (sys.executable, "-c", code, *words), spec), "ours" in run)
        for run, (code, words) in runs.items()
    ]
    base = partial(run_python, IMPORT)
    return Task(name, BASELINE, base, lambda _: 0.0, methods)


def _run(command: tuple[str, ...], text: str | None) -> None:
    process_seconds(command, os.environ, text)
