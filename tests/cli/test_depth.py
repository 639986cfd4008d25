"""How many functions of the program a run calls, in how many files, and how deep.

A reader of a number follows these. The bounds are a little above today's counts: who exceeds one
finds a shorter way, or names the reason where he raises it.
"""

import subprocess
import sys

import pytest
import repo

# Counts each function, class body and comprehension of the program once, and the frames of the
# deepest stack. A generator's frame is left and entered again with each value.
PROBE = """
import sys
from geneva_cli.cli.app import app
functions, depth, deepest = set(), 0, 0
def count(frame, event, _):
    global depth, deepest
    code = frame.f_code
    if "geneva_cli" not in code.co_filename:
        return
    if event == "call":
        depth += 1
        deepest = max(deepest, depth)
        if not code.co_name.startswith("<module"):
            functions.add((code.co_filename, code.co_qualname))
    elif event == "return":
        depth -= 1
sys.setprofile(count)
try:
    app(prog_name="geneva")
except SystemExit:
    pass
sys.setprofile(None)
print(len(functions), len({file for file, _ in functions}), deepest, file=sys.stderr)
"""
BOUNDS = {  # functions, files, frames
    "peaks": (206, 35, 14),
    "check": (768, 89, 24),
}


@pytest.mark.parametrize("command", BOUNDS)
def test_a_run_calls_few_functions_and_not_deep(command):
    run = subprocess.run(
        [sys.executable, "-c", PROBE, command, str(repo.DESIGNS / "turret.toml")],
        capture_output=True,
        encoding="utf-8",
    )
    counts = tuple(map(int, run.stderr.split()))
    assert all(one <= most for one, most in zip(counts, BOUNDS[command], strict=True)), counts
