"""Rows of `geneva synth` over wishes and wheels, written, checked and exported: `make stress`.

A row that says yes must pass every check and be cut; one that says no is counted by its reason.
"""

import random
import sys
import tempfile
from collections import Counter
from pathlib import Path

from typer.testing import CliRunner

from geneva_cli.app import app
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.synthesis.reading import read_target
from geneva_cli.synthesis.search import search
from geneva_cli.synthesis.written import chosen

ROWS = 105  # as many as the trial in which an older synth's specs failed 27 times
WISHES = (
    {"tau": "1/3"},
    {"tau": "0.6"},
    {"tau": "1/5"},
    {"motion_deg": "100"},
    {"motion_deg": "180"},
    {"motion_deg": "240"},
    {"subject_to": ["acceleration.max <= 0.5"]},
    {"subject_to": ["acceleration.max <= 1.5"]},
    {"dwell_s": "0.8..", "cycle": "1.5", "motion_deg": "..180"},
    {"tau": "0.2..0.4", "subject_to": ["jerk.max <= 20"]},
)
SLOTS = (3, 4, 5, 6, 8, 10, 12, 16, 20)
LAWS = ("modified-sine", "cycloidal", "modified-trapezoid", "3-4-5")


def row(some, folder):
    """What became of one row: how it was said, and whether check and export agree."""
    options = {**some.choice(WISHES), "z": str(some.choice(SLOTS)), "law": some.choice(LAWS)}
    target = read_target(**options)
    try:
        found = search(target)
    except GenevaError:
        return "out of reach", ""
    number = some.randint(1, min(len(found.rows), 40))
    said = found.rows[number - 1].candidate.parts
    if said is None:
        return "not drawn", ""
    made, text = chosen(found, number, some.random() < 0.5)
    file, wheel = folder / "spec.toml", folder / "wheel.dxf"
    file.write_text(text, encoding="utf-8")
    failing = [c.name for c in load(str(file)).checks if c.passes is False]
    if made.trouble:
        return f"no: {made.trouble}", "" if failing or said != "maybe" else f"{options} {number}"
    cut = CliRunner().invoke(app, ["profile", str(file), "--part", "wheel", "-o", str(wheel)])
    wrong = failing or cut.exit_code
    return "yes", f"{options} {number}: {failing} {cut.stderr}" if wrong else ""


def main(rows=ROWS, seed=1):
    """So many rows; exit 1 where one is not what it says."""
    some, told, faults = random.Random(seed), Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rows):
            what, fault = row(some, Path(folder))
            told[what] += 1
            if fault:
                faults.append(fault)
                print(fault, flush=True)
    for what, times in told.most_common():
        print(f"{times:5}  {what}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
