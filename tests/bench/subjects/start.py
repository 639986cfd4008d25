"""Start-up: short runs of every command, compared with a Python that imports Typer."""

from __future__ import annotations

from bench.method import Method, Subject, Task
from bench.whole_runs import GENEVA, WholeRun, geneva, task
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
MODULES = {"ezdxf": "geneva_cli.output.ezdxf_alone"}


def subject(quick: bool) -> Subject:
    """Bare Python, what runs cannot do without, and a row of the table; then each command."""
    methods = [Method(f"python -c '{c}'", None, WholeRun(c).run) for c in ("pass", "import numpy")]
    tasks = [task("python", [*methods, _limit("typer"), _limit("typer", "numpy")])]
    tasks.append(_table())
    if not quick:
        tasks += [_command(words) for words in _without_a_spec()]
        tasks += [_design(words) for words in _with_a_spec()]
    return Subject("Start-up of whole runs", "none", tasks, seconds=2.0)


def _limit(*libraries: str) -> Method:
    """A run that imports what it cannot do without, as the program imports it, and no more."""
    # the program searches rarely for garbage, and ends without Python's cleaning up
    alone = "import gc, os; gc.set_threshold(250_000); os.environ['OPENBLAS_NUM_THREADS'] = '1'"
    modules = [MODULES.get(name, name) for name in libraries]
    code = f"{alone}; import {', '.join(modules)}; os._exit(0)"
    return Method(f"the limit: import {', '.join(libraries)}", None, WholeRun(code).run)


def _without_a_spec() -> tuple[str, ...]:
    return (
        "--help",
        "table --help",
        "table --format csv",
        "table --A 0.3 --z 6",
        "explain horn_mm",
        "explain acceleration.max",
        "keys",
        "keys load",
        "laws",
        "schema",
        "new external",
        "help",
        "help units",
        "synth --motion-deg 180 --z 6 --external --rollers 1 --check 0",
    )


def _with_a_spec() -> tuple[str, ...]:
    return (
        "peaks -",
        "motion -",
        "loads - --set load.inertia_kgm2=0.05",
        "vibration - --period-ratio 5",
        "tolerance - --set tolerance.crank_radius_mm=0.01",
        "check -",
        "report -",
        "compare - --vary drive.n_rpm=60,90",
        "sweep - --vary drive.n_rpm=60,90 --jobs 1",
        "profile - --format csv",
        "profile - --part wheel --format svg",
        "profile - --part wheel --format dxf",
        "profile - --part sheet --format svg",
        "plot - --format svg",
        "animate -",
    )


def _table() -> Task:
    """One row of the table, as the program, an eager program and scripts print it."""
    words = ("table", "--z", "6")
    eager = (
        "import importlib, numpy, scipy.optimize, scipy.interpolate, rich.table\n"
        "from geneva_cli.cli.app import COMMANDS\n"
        "for name in COMMANDS: importlib.import_module('geneva_cli.cli.commands.' + name)\n"
    )
    complete = (
        "import os; os.environ.update(_GENEVA_COMPLETE='complete_bash', "
        "COMP_WORDS='geneva ta', COMP_CWORD='1')\n"
    )
    methods = [
        Method("ours: lazy imports", None, geneva(*words).run, True),
        Method("ours: completion of geneva ta", None, WholeRun(complete + GENEVA).run, True),
        Method("everything imported first", None, WholeRun(eager + GENEVA, words).run),
        *(Method(name, None, WholeRun(code, words).run) for name, code in SCRIPTS.items()),
    ]
    return task("geneva table --z 6", methods)


def _command(words: str) -> Task:
    return task(f"geneva {words}", [Method("ours", None, geneva(*words.split()).run, True)])


def _design(words: str) -> Task:
    """A command on the templates of two wheels, and the libraries that no run does without."""
    kinds = {"external": "straight slots", "curved": "curved slots"}
    methods = [
        Method(f"ours, {slots}", None, geneva(*words.split(), text=template(kind)).run, True)
        for kind, slots in kinds.items()
    ]
    # the peaks of straight slots are closed forms of floats
    libraries = ["typer"] if words.startswith("peaks") else ["typer", "numpy"]
    libraries += ["ezdxf"] if words.endswith("dxf") else []
    methods.append(_limit(*libraries))
    return task(f"geneva {words}", methods)
