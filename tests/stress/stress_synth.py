"""Rows of `geneva synth` for random requirements, written, checked and exported: `make stress`.

A row that says yes must pass every check and be cut; one that says no is counted by its reason.
"""

import random
import sys
import tempfile
from collections import Counter
from pathlib import Path

from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search
from geneva_cli.study.synth.synth_table import chosen

ROWS = 105  # as many as the trial in which an older synth's specs failed 27 times
REQUIREMENTS = (
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


def row(draw, folder):
    """Return how one row is marked, and its fault if check and export contradict that."""
    options = {**draw.choice(REQUIREMENTS), "z": str(draw.choice(SLOTS)), "law": draw.choice(LAWS)}
    target = read_target(**options)
    try:
        ranking = search(target)
    except GenevaError:
        return "out of reach", ""
    number = draw.randint(1, min(len(ranking.rows), 40))
    parts = ranking.rows[number - 1].cells["parts"]
    if parts is None:
        return "not drawn", ""
    machine, text = chosen(ranking, number, draw.random() < 0.5)
    file, wheel = folder / "spec.toml", folder / "wheel.dxf"
    file.write_text(text, encoding="utf-8")
    failing = [c.name for c in load(str(file)).checks if c.passes is False]
    if machine.trouble:
        return (
            f"no: {machine.trouble}",
            "" if failing or parts != "maybe" else f"{options} {number}",
        )
    cut = CliRunner().invoke(app, ["profile", str(file), "--part", "wheel", "-o", str(wheel)])
    wrong = failing or cut.exit_code
    return "yes", f"{options} {number}: {failing} {cut.stderr}" if wrong else ""


def main(rows=ROWS, seed=1):
    """Try so many rows; return 1 if one has a fault."""
    draw, marks, faults = random.Random(seed), Counter(), []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rows):
            what, fault = row(draw, Path(folder))
            marks[what] += 1
            if fault:
                faults.append(fault)
                print(fault, flush=True)
    for what, times in marks.most_common():
        print(f"{times:5}  {what}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
