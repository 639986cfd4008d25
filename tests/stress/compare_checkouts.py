"""Compare what two checkouts print and write: every command and format on every design.

Run ``python tests/stress/compare_checkouts.py OLD NEW [WORD ...] [--one-of K]``. OLD and NEW are
folders of checkouts. With WORDs only the command lines that contain all of them run; with K, only
each K-th of these. Nothing of the program is imported here: each command line is a process of its
own, ``python -m geneva_cli`` in a folder with the designs of OLD, with each checkout's package in
turn. Compared are its exit status, what it prints, and each file that it leaves. An output is
equal, equal to rounding (16 units in the last place of the greatest number in its column, or under
its key), or different. Exit status 1 where an output is different.
"""

import argparse
import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

ULPS = 16  # units in the last place
SECONDS = 600  # for one command line, on a slow machine
FORMATS = ("csv", "json", "md", "table")
DRAWN = ("wheel", "crank", "arm", "links", "first-wheel", "first-crank", "frame", "groove-plate")
TABLES = ("slot", "parts", "gears", "groove")
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
MOST_SHOWN = 400  # characters of a difference


def lines_of_design(design: str) -> list[str]:
    """The command lines for one design."""
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
    calls += [f"loads {spec} --samples 37 --format csv", f"plot {spec} -o plot.svg"]
    calls += [f"profile {spec} --part {p} --tolerance 0.05 --format csv" for p in TABLES]
    calls += [f"profile {spec} --part {p} --tolerance 0.05 -o part.dxf" for p in DRAWN]
    calls += [f"profile {spec} --part assembly --tolerance 0.05 -o m.{e}" for e in ("svg", "dxf")]
    calls += [f"profile {spec} --part assembly --tolerance 0.05 -o machine.step"]
    calls += [f"profile {spec} --part sheet --tolerance 0.05 -o sheet.{e}" for e in ("svg", "pdf")]
    calls += [f"report {spec} -o report.{e}" for e in ("html", "pdf")]
    calls += [f"animate {spec} -o page.html"]
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


def outputs(checkout: Path, designs: Path, call: str) -> dict[str, bytes]:
    """What one command line prints, its exit status, and the files that it writes, by name."""
    with tempfile.TemporaryDirectory() as place:
        shutil.copytree(designs, Path(place) / "designs")
        ran = subprocess.run(
            [sys.executable, "-m", "geneva_cli", *call.split()],
            cwd=place,
            env={**os.environ, "PYTHONPATH": str(checkout), "COLUMNS": "200"},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=SECONDS,
        )
        shutil.rmtree(Path(place) / "designs")
        files = {
            str(path.relative_to(place)): path.read_bytes()
            for path in sorted(Path(place).rglob("*"))
            if path.is_file()
        }
    printed = {
        "exit status": f"{ran.returncode}".encode(),
        "standard output": ran.stdout,
        "standard error": ran.stderr.replace(place.encode(), b"PLACE"),
    }
    return printed | files


class Difference(NamedTuple):
    """The distance of two outputs: units in the last place, and where."""

    ulps: float
    where: str


def numbers(lines: list[str]) -> dict[tuple[str, int], list[float]]:
    """The numbers of some lines by a line's words and the number's place: columns, keys."""
    found: dict[tuple[str, int], list[float]] = {}
    for line in lines:
        words = NUMBER.sub("#", line)
        for place, number in enumerate(NUMBER.findall(line)):
            found.setdefault((words, place), []).append(float(number))
    return found


def difference(old: bytes, new: bytes) -> Difference:
    """The distance of two outputs, infinite where more than numbers differ."""
    try:
        before, now = old.decode().splitlines(), new.decode().splitlines()
    except UnicodeDecodeError:
        return Difference(float("inf"), "bytes")
    for one, other in itertools.zip_longest(before, now, fillvalue=""):
        if NUMBER.sub("#", one) != NUMBER.sub("#", other):
            return Difference(float("inf"), f"{one!r} now {other!r}")
    worst, others = Difference(0.0, ""), numbers(now)
    for (words, place), values in numbers(before).items():
        pairs = [*zip(values, others[words, place], strict=True)]
        unit = 2.0**-52 * max(abs(x) for pair in pairs for x in pair if abs(x) < 1e300)
        for x, y in pairs:
            ulps = abs(x - y) / unit if x != y else 0.0
            if ulps > worst.ulps:
                worst = Difference(ulps, f"{x!r} now {y!r} (in {words[:40]!r})")
    return worst


def differences(old: dict[str, bytes], new: dict[str, bytes]) -> Iterator[tuple[str, Difference]]:
    """Each output of a command line, and how far apart it is in two checkouts."""
    for name in dict.fromkeys([*old, *new]):
        if name not in old or name not in new:
            yield name, Difference(float("inf"), "only before" if name in old else "only now")
        elif old[name] == new[name]:
            yield name, Difference(0.0, "")
        else:
            yield name, difference(old[name], new[name])


def main() -> int:
    """Run each command line in both checkouts, two lines at a time, and compare."""
    parser = argparse.ArgumentParser(description="Compare what two checkouts print and write.")
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--one-of", type=int, default=1, metavar="K")
    given = parser.parse_args()
    old, new = given.old.resolve(), given.new.resolve()
    designs = old / "designs"
    calls = [line for path in sorted(designs.glob("*.toml")) for line in lines_of_design(path.name)]
    calls = [c for c in calls + lines_of_no_design() if all(word in c for word in given.words)]
    calls = calls[:: given.one_of]
    counts = {"equal": 0, "equal to rounding": 0, "different": 0}

    def both(call: str) -> tuple[str, list[tuple[str, Difference]]]:
        before, now = (outputs(checkout, designs, call) for checkout in (old, new))
        return call, list(differences(before, now))

    with ThreadPoolExecutor(os.cpu_count()) as threads:
        for call, found in threads.map(both, calls):
            for name, (ulps, where) in found:
                kind = "different" if ulps > ULPS else "equal to rounding" if where else "equal"
                counts[kind] += 1
                if kind == "different":
                    far = "" if ulps == float("inf") else f"{ulps:.3g} units in the last place: "
                    print(f"geneva {call} [{name}]\n    {far}{where[:MOST_SHOWN]}", flush=True)
    print(", ".join(f"{count} {kind}" for kind, count in counts.items()))
    return min(counts["different"], 1)


if __name__ == "__main__":
    sys.exit(main())
