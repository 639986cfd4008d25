"""Whole runs of the program, compared with a Python that imports Typer; none has an error."""

import os
import subprocess
import sys
from typing import NamedTuple

from bench.method import Method, Subject, Task
from bench.timing_pairs import wall_s
from geneva_cli.specfile.template import template

# What the installed ``geneva`` does.
GENEVA = "import sys; sys.argv[0] = 'geneva'; from geneva_cli.__main__ import main; main()"


class WholeRun(NamedTuple):
    """A Python process: its code, its arguments, and the text on its standard input."""

    code: str
    words: tuple[str, ...] = ()
    text: str = ""

    def run(self):
        """Run it, and return what it prints. Raises CalledProcessError if it fails."""
        command = (sys.executable, "-c", self.code, *self.words)
        # an installed program is compiled once
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
        done = subprocess.run(
            command, capture_output=True, input=self.text, encoding="utf-8", env=environment
        )
        # 1: a check fails, which is a result where it is printed
        if done.returncode > 1 or (done.returncode and not done.stdout):
            raise subprocess.CalledProcessError(done.returncode, command, stderr=done.stderr)
        return done.stdout


def geneva(words, text=""):
    """A run of the program with some arguments, and a spec on standard input."""
    return WholeRun(GENEVA, tuple(words.split()), text)


def task(name, methods):
    typer = WholeRun("import typer").run
    return Task(name, "python -c 'import typer'", typer, lambda _: 0.0, methods)


def ours(words, text=""):
    """The task of one run of the program."""
    return task(f"geneva {words}", [Method("ours", None, geneva(words, text).run, True)])


# Start-up

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
EAGER = (
    "import importlib, numpy, scipy.optimize, scipy.interpolate, rich.table\n"
    "from geneva_cli.cli.app import COMMANDS\n"
    "for name in COMMANDS: importlib.import_module('geneva_cli.cli.commands.' + name)\n"
)
COMPLETE = (
    "import os; os.environ.update(_GENEVA_COMPLETE='complete_bash', "
    "COMP_WORDS='geneva ta', COMP_CWORD='1')\n"
)
WITHOUT_A_SPEC = """--help
table --help
table --format csv
table --A 0.3 --z 6
explain horn_mm
explain acceleration.max
keys
keys load
laws
schema
new external
help
help units
synth --motion-deg 180 --z 6 --external --rollers 1 --check 0"""
WITH_A_SPEC = """peaks -
motion -
loads - --set load.inertia_kgm2=0.05
vibration - --period-ratio 5
tolerance - --set tolerance.crank_radius_mm=0.01
check -
report -
compare - --vary drive.n_rpm=60,90
sweep - --vary drive.n_rpm=60,90 --jobs 1
profile - --format csv
profile - --part wheel --format svg
profile - --part wheel --format dxf
profile - --part sheet --format svg
plot - --format svg
animate -"""


def start(quick):
    """Bare Python, what runs cannot do without, and a row of the table; then each command."""
    methods = [Method(f"python -c '{c}'", None, WholeRun(c).run) for c in ("pass", "import numpy")]
    tasks = [task("python", [*methods, _limit("typer"), _limit("typer", "numpy")])]
    words = ("table", "--z", "6")
    methods = [
        Method("ours: lazy imports", None, WholeRun(GENEVA, words).run, True),
        Method("ours: completion of geneva ta", None, WholeRun(COMPLETE + GENEVA).run, True),
        Method("everything imported first", None, WholeRun(EAGER + GENEVA, words).run),
        *(Method(name, None, WholeRun(code, words).run) for name, code in SCRIPTS.items()),
    ]
    tasks.append(task("geneva table --z 6", methods))
    if not quick:
        tasks += [ours(words) for words in WITHOUT_A_SPEC.splitlines()]
        tasks += [_design(words) for words in WITH_A_SPEC.splitlines()]
    return Subject("Start-up of whole runs", "none", tasks, seconds=2.0)


def _limit(*libraries):
    """A run that imports what it cannot do without, as the program imports it, and no more."""
    # the program searches rarely for garbage, and ends without Python's cleaning up
    alone = "import gc, os; gc.set_threshold(250_000); os.environ['OPENBLAS_NUM_THREADS'] = '1'"
    modules = [name.replace("ezdxf", "geneva_cli.output.ezdxf_alone") for name in libraries]
    code = f"{alone}; import {', '.join(modules)}; os._exit(0)"
    return Method(f"the limit: import {', '.join(libraries)}", None, WholeRun(code).run)


def _design(words):
    """A command on the templates of two wheels, and the libraries that no run does without."""
    kinds = {"external": "straight slots", "curved": "curved slots"}
    methods = [
        Method(f"ours, {slots}", None, geneva(words, template(kind)).run, True)
        for kind, slots in kinds.items()
    ]
    # the peaks of straight slots are closed forms of floats
    libraries = ["typer"] if words.startswith("peaks") else ["typer", "numpy"]
    libraries += ["ezdxf"] if words.endswith("dxf") else []
    return task(f"geneva {words}", [*methods, _limit(*libraries)])


# Requirements, and checks that fail

TARGETS = """--motion-deg 180 --z 6
--motion-deg 100..200
--motion-deg 100..200 --internal
--motion-deg 100..170 --rollers 2
--motion-deg 150..200 --spherical
--motion-deg 100..200 --law all
--motion-deg 120.. --sort min:jerk.max
--dwell-s 0.8.. --cycle 1.5 --motion-deg ..180
--cycle 1.5 --subject-to dwell_s>=0.8
--subject-to timing.tau<=0.3 --subject-to velocity.max<=2
--subject-to acceleration.max<=0.5
--motion-deg 120..150 --z 6 --subject-to parts.horn_mm>=5
--motion-deg 120..150 --z 6,8 --sort max:checks.horn_mm"""
DESIGNS = (
    *("turret", "press-straight", "press-curved", "sine-group", "internal-z6", "side-crank-z6"),
    *("four-bar-z4", "spherical-z6", "three-rollers-z4", "linear", "behind-gears"),
)
CHANGES = (
    "size.roller_radius_mm=2",
    "size.lock_clearance_mm=3",
    "size.wheel_bore_mm=60",
    "limits.acceleration_max=0.3",
)


def synth(quick):
    """From requirements to machines, with the first twenty turned and without, on all cores."""
    targets, counts = TARGETS.splitlines(), (0, 20)  # rows whose parts are turned
    if quick:
        targets, counts = ["--motion-deg 180 --z 6 --external --rollers 1"], (0,)
    tasks = []
    for target in targets:
        runs = {count: geneva(f"synth {target} --check {count}") for count in counts}
        methods = [Method(f"{n} turned", None, run.run, True) for n, run in runs.items()]
        tasks.append(task(f"geneva synth {target}", methods))
    # several processes search at once: a user waits for the wall clock
    return Subject("From requirements to machines: whole runs", "none", tasks, clock=wall_s)


def advice(quick):
    """Checks that fail: four changes of eleven designs, judged with their advice."""
    few = slice(1 if quick else None)
    tasks = [
        ours(f"check designs/{design}.toml --set {change}")
        for design in DESIGNS[few]
        for change in CHANGES[few]
    ]
    return Subject("Advice on checks that fail", "none", tasks)
