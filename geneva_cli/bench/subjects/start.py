"""Start-up: whole runs as a user waits for them, with and without the lazy imports."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial

from geneva_cli.bench.method import Method, Subject, Task
from geneva_cli.bench.timing_pairs import process_seconds
from geneva_cli.bench.whole_runs import BASELINE, IMPORT, RUN, finished
from geneva_cli.specfile.template import template

# Arguments of commands, with a spec on standard input. Other commands run with --help.
ARGUMENTS = {
    "table": ("--z", "6"),
    "peaks": ("-",),
    "motion": ("-",),
    "profile": ("-",),
    "report": ("-",),
    "check": ("-",),
    "laws": (),
    "new": ("external",),
}
SPEC = "curved"  # the template that needs most
QUICK = ("table",)
# A wheel to cut: its outline computed, turned against the crank, and written. Templates and keys.
EXPORT = ("profile", "-", "--part", "wheel", "--format", "dxf")
CUT = {
    "6 straight slots": ("external", ()),
    "6 curved slots": ("curved", ()),
    "24 straight slots": ("external", ("wheel.z=24", "size.roller_radius_mm=2")),
    "4 slots, 3 rollers": ("external", ("wheel.z=4", "drive.rollers=3")),
}
EAGER = (
    "import importlib, numpy, scipy.optimize, scipy.interpolate, rich.table\n"
    "from geneva_cli.app import COMMANDS\n"
    "for name in COMMANDS: importlib.import_module('geneva_cli.commands.' + name)\n"
)
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
    spec = template(SPEC)
    tasks = [_task("python", {"python -c pass": ("pass", ())}, None)]
    for name in QUICK if quick else ("--help", *commands()):
        words = (name, *ARGUMENTS.get(name, ("--help",) if name != "--help" else ()))
        runs = {
            "ours: lazy imports": (RUN, words),
            "everything imported first": (EAGER + RUN, words),
        }
        if name == "table":
            runs |= {way: (code, words) for way, code in SCRIPTS.items()}
        tasks.append(_task("geneva " + " ".join(words), runs, spec))
    for name, (kind, keys) in () if quick else CUT.items():
        words = (*EXPORT, *(word for key in keys for word in ("--set", key)))
        runs = {"ours: lazy imports": (RUN, words)}
        tasks.append(_task(f"geneva profile as dxf: {name}", runs, template(kind)))
    return Subject("Start-up of whole runs", "none", tasks)


def _task(name: str, runs: dict[str, tuple[str, tuple[str, ...]]], spec: str | None) -> Task:
    methods = [
        Method(way, None, partial(_run, (sys.executable, "-c", code, *words), spec), "ours" in way)
        for way, (code, words) in runs.items()
    ]
    base = partial(finished, IMPORT)
    return Task(name, BASELINE, base, lambda _: 0.0, methods)


def _run(command: tuple[str, ...], text: str | None) -> None:
    process_seconds(command, os.environ, text)
