"""Every command that takes a spec takes ``--set``, and means the same by it."""

import importlib
import inspect
import json
import subprocess
import sys

from geneva_cli.cli.app import COMMANDS
from geneva_cli.cli.options import Settings

TAKE_A_SPEC = {"spec", "specs"}


def parameters(name):
    run = importlib.import_module(f"geneva_cli.cli.commands.{name}").run
    return inspect.signature(run, eval_str=True).parameters


def test_every_command_with_a_spec_takes_set():
    every = map(parameters, COMMANDS)
    taking = [options for options in every if TAKE_A_SPEC & {*options}]
    assert len(taking) >= 5
    assert all(options["settings"].annotation == Settings for options in taking)


def geneva(*args):
    run = [sys.executable, "-m", "geneva_cli", *args]
    return subprocess.run(run, capture_output=True, text=True, timeout=60, check=False)


def test_set_reaches_every_spec_of_check():
    """Two designs judged in two processes, each with the key over its own."""
    specs = ["designs/internal-z6.toml", "designs/three-slots.toml"]
    found = geneva("check", *specs, "--set", "limits.velocity_max=1000", "--format", "json")
    rows = json.loads(found.stdout)["rows"]
    limits = {row["spec"]: row["limit"] for row in rows if row["check"] == "velocity_max"}
    assert limits == dict.fromkeys(specs, 1000.0)
    assert found.returncode == 0


def test_an_error_names_the_option_and_nothing_is_printed():
    found = geneva("peaks", "designs/internal-z6.toml", "--set", "wheel.z=2")
    assert (found.returncode, found.stdout) == (2, "")
    assert found.stderr.startswith("--set wheel.z=2: z = 2 must be at least 3")
