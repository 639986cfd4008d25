"""Compare what two checkouts print and write: every command and format on every design.

Run ``python tests/stress/compare_checkouts.py OLD NEW [WORD ...]``; OLD and NEW are folders of
checkouts, and with WORDs only the command lines that contain all of them run. Both sides run on the
designs of OLD, each side in its own process with its own ``geneva_cli``. An output is equal, equal
to rounding (16 units in the last place of the greatest number in its column, or in its object), or
different. Exit status 1 where an output is different.
"""

import contextlib
import csv
import io
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ULPS = 16  # units in the last place
FORMATS = ("csv", "json", "md", "table")
DRAWN = ("wheel", "crank", "arm", "links", "first-wheel", "first-crank", "frame", "groove-plate")
TABLES = ("slot", "parts", "gears", "groove")
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
MOST_SHOWN = 400  # characters of a difference


def lines_of_design(design: str) -> list[str]:
    """The command lines for one design; OUT stands for a file's name without its extension."""
    spec = f"designs/{design}"
    calls = [
        f"{command} {spec} --format {format}"
        for command in (
            "peaks",
            "motion --samples 73",
            "loads",
            "check",
            "report",
            "vibration --period-ratio 4.2 --samples 9",
            "tolerance --samples 256",
        )
        for format in FORMATS
    ]
    calls += [f"loads {spec} --samples 37 --format csv", f"plot {spec} -o OUT.svg"]
    calls += [f"profile {spec} --part {p} --tolerance 0.05 --format csv" for p in TABLES]
    calls += [f"profile {spec} --part {p} --tolerance 0.05 -o OUT.dxf" for p in DRAWN]
    calls += [f"profile {spec} --part assembly --tolerance 0.05 -o OUT.{e}" for e in ("svg", "dxf")]
    calls += [f"profile {spec} --part assembly --tolerance 0.05 -o OUT.step"]
    calls += [f"profile {spec} --part sheet --tolerance 0.05 -o OUT.{e}" for e in ("svg", "pdf")]
    calls += [f"report {spec} -o OUT.{e}" for e in ("html", "pdf")]
    calls += [f"animate {spec} -o OUT.html"]
    calls += [
        f"sweep {spec} --vary size.center_distance_mm=95,100,107 --check",
        f"sweep {spec} --vary drive.n_rpm=30,60 --pick loads.pin_force_N.max,sizing.power_W",
        f"compare {spec} --vary drive.n_rpm=30,60 --format csv",
    ]
    return calls


def lines_of_no_design() -> list[str]:
    """The command lines that take no design, or choose one."""
    kinds = ("", " --internal", " --spherical", " --A 0.6", " --rollers 2")
    calls = [f"table --z 3..12{kind} --format {f}" for f in FORMATS for kind in kinds]
    calls += [f"{word} --format {f}" for word in ("laws", "keys", "explain") for f in FORMATS]
    calls += ["schema", "new curved", "new turret", "new --list", "--help"]
    turret = "sweep designs/turret.toml --vary wheel.z=5..9"
    several = "designs/turret.toml designs/press-curved.toml designs/four-bar-z4.toml"
    front = "--pareto min:acceleration.max,max:dwell_s"
    best = "--best min:loads.pin_force_N.max"
    calls += [
        "synth --motion-deg 180 --z 6 --format json",
        "synth --motion-deg 100..200 --z 6,8 --check 0 --format json",
        "synth --dwell-s 0.8 --cycle 1.5 --z 8 --motion-deg ..180 --format json",
        f"{turret} --vary drive.n_rpm=20..60:10 {front}",
        f"{turret} --vary size.center_distance_mm=200..300 {best}",
        f"compare {several} --format csv",
        "compare designs/press-straight.toml designs/press-345.toml --ratio --format json",
    ]
    return calls


def run_all(folder: str, words: list[str]) -> None:
    """Run every command line with the package that Python finds, and keep what comes out."""
    from typer.testing import CliRunner

    from geneva_cli.cli.app import app

    designs = sorted(name for name in os.listdir("designs") if name.endswith(".toml"))
    calls = [line for name in designs for line in lines_of_design(name)] + lines_of_no_design()
    for number, call in enumerate(calls):
        if not all(word in call for word in words):
            continue
        place = Path(folder) / f"{number:05d}"
        result = CliRunner().invoke(app, call.replace("OUT", str(place)).split())
        stop = result.exception
        error = "" if stop is None or isinstance(stop, SystemExit) else repr(stop)
        said = result.stderr.replace(str(place), "OUT")
        text = f"$ geneva {call}\nexit {result.exit_code} {error}\n{said}----\n{result.stdout}"
        Path(f"{place}.txt").write_text(text, encoding="utf-8")


class Difference(NamedTuple):
    """How far two outputs are apart: units in the last place, and where."""

    ulps: float
    where: str


def groups(text: str) -> list[list[str]]:
    """The text in groups of like things: a csv's columns, a json's objects, or all of it."""
    with contextlib.suppress(ValueError):
        value = json.loads(text)
        found: list[list[str]] = []

        def walk(node: object) -> None:
            children = node.values() if isinstance(node, dict) else node
            if not isinstance(node, dict | list):
                return
            keys = [json.dumps([*node])] if isinstance(node, dict) else []
            found.append(keys + [json.dumps(c) for c in children if not isinstance(c, dict | list)])
            for child in children:
                walk(child)

        walk(value)
        return found
    rows = list(csv.reader(io.StringIO(text)))
    if len(rows) > 1 and len(rows[0]) > 1 and len({len(row) for row in rows}) == 1:
        return [list(column) for column in zip(*rows, strict=True)]
    return [line.split() for line in text.splitlines()]


def scale(group: list[str]) -> float:
    """The greatest finite number of a group."""
    sizes = [abs(float(x)) for cell in group for x in NUMBER.findall(cell)]
    return max((x for x in sizes if x < 1e300), default=0.0)


def difference(old: str, new: str) -> Difference | None:
    """How two texts differ; None where only rounding tells them apart or nothing does."""
    ones, others = groups(old), groups(new)
    if len(ones) != len(others):
        return Difference(float("inf"), f"{len(ones)} groups, {len(others)} now")
    worst = Difference(0.0, "")
    for one, other in zip(ones, others, strict=True):
        if one == other:
            continue
        unit = 2.0**-52 * max(scale(one), scale(other))
        for a, b in itertools.zip_longest(one, other, fillvalue=""):
            if a == b:
                continue
            if NUMBER.sub("#", a) != NUMBER.sub("#", b):
                return Difference(float("inf"), f"{a!r} now {b!r}")
            for x, y in zip(NUMBER.findall(a), NUMBER.findall(b), strict=True):
                ulps = abs(float(x) - float(y)) / unit if unit else 0.0
                if ulps > worst.ulps:
                    worst = Difference(ulps, f"{x} now {y} (in {a[:40]!r})")
    return worst


def compare(old: Path, new: Path) -> int:
    """Compare two folders of outputs, print the differences; return how many there are."""
    different = rounded = equal = 0
    for name in sorted({p.name for p in [*old.iterdir(), *new.iterdir()]}):
        title = old / f"{name.partition('.')[0]}.txt"
        call = title.read_text(encoding="utf-8").splitlines()[0] if title.exists() else name
        if not (old / name).exists() or not (new / name).exists():
            print(f"{call}: {name} only {'before' if (old / name).exists() else 'now'}")
            different += 1
            continue
        a, b = (old / name).read_bytes(), (new / name).read_bytes()
        if a == b:
            equal += 1
            continue
        try:
            one, other = (x.decode().partition("----\n") for x in (a, b))
            parts = [difference(x, y) for x, y in zip(one, other, strict=True)]
            worst = max((p for p in parts if p), key=lambda p: p.ulps)
        except UnicodeDecodeError:
            worst = Difference(float("inf"), "bytes")
        if worst.ulps <= ULPS:
            rounded += 1
        else:
            different += 1
            kind = "text" if worst.ulps == float("inf") else f"{worst.ulps:.3g} ulps"
            print(f"{call} [{name}]\n    {kind}: {worst.where[:MOST_SHOWN]}")
    print(f"{equal} equal, {rounded} equal to rounding, {different} different")
    return different


def main() -> int:
    """Run both checkouts side by side and compare them."""
    if sys.argv[1] == "--run":
        run_all(sys.argv[2], sys.argv[3:])
        return 0
    old, new, *words = sys.argv[1:]
    with tempfile.TemporaryDirectory() as scratch:
        sides = [Path(scratch) / "before", Path(scratch) / "now"]
        runs = []
        for checkout, side in zip((old, new), sides, strict=True):
            side.mkdir()
            environment = {**os.environ, "PYTHONPATH": os.path.abspath(checkout), "COLUMNS": "200"}
            command = [sys.executable, "-P", os.path.abspath(__file__), "--run", str(side), *words]
            runs.append(subprocess.Popen(command, cwd=old, env=environment))
        if sum(run.wait() for run in runs):
            return 2
        return min(compare(*sides), 1)


if __name__ == "__main__":
    sys.exit(main())
