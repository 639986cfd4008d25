"""Wheel and sdist tried out where nothing else is installed: `make dist`.

    python tests/stress/try_dist.py dist/*.whl dist/*.tar.gz

Each goes into an empty environment of every Python found here that pyproject allows, once with the
lowest and once with the highest releases of what it needs; there the commands are run. A Python
that is not here gets its releases chosen, from binaries alone, but nothing is run.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from repo import DESIGNS, ROOT

PYTHONS = ("3.11", "3.12", "3.13", "3.14")
RELEASES = ("lowest-direct", "highest")
COMMANDS = (
    "table --z 3..12 --format csv",
    "peaks side-crank-z6.toml --format json",
    "motion press-curved.toml --samples 9 --format csv",
    "loads turret.toml --format json",
    "vibration turret.toml --period-ratio 3 --format json",
    "tolerance tolerances.toml --format json",
    "check limits.toml turret.toml",
    "report press-straight.toml",
    "compare press-straight.toml press-curved.toml",
    "sweep side-crank-z6.toml --vary drive.A=0..0.6:0.1 --pick velocity.max",
    "synth --motion-deg 180 --z 6 --check 0",
    "plot press-straight.toml -o motion.svg",
    "profile press-curved.toml -o slot.csv",
    "profile press-straight.toml --part wheel -o wheel.dxf",
    "profile press-straight.toml --part assembly -o machine.svg",
    "profile press-straight.toml --part assembly -o machine.step",
    "new curved -o new.toml",
    "new --from-design table-law -o copy/spec.toml",
    "check copy/spec.toml",
    "help kinds",
    "keys drive.A",
    "laws",
)
# what the same Python computes to the same bytes whatever NumPy is there
SAME = COMMANDS[:2]


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, text=True, **options)


def quiet(*command, **options):
    return run(*command, capture_output=True, **options).stdout


def python_of(version):
    """The interpreter of a version on this machine, or None."""
    found = subprocess.run(
        ["uv", "python", "find", "--no-python-downloads", "--system", version],
        capture_output=True,
        text=True,
    )
    return found.stdout.strip() if found.returncode == 0 else None


def smoke(geneva, folder, expected):
    """Every command in a folder with the designs; raises for one that fails."""
    here = Path(folder, "designs")
    shutil.copytree(DESIGNS, here)
    (here / "copy").mkdir()
    alone = {"HOME": str(folder), "PATH": os.environ["PATH"]}
    for command in COMMANDS:
        said = quiet(geneva, *command.split(), cwd=here, env=alone)
        if command in expected and said != expected[command]:
            raise SystemExit(f"geneva {command}: other bytes than in the source tree")


def try_out(package, python, releases, expected):
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder, "venv")
        quiet("uv", "venv", "--python", python, place)
        inside = {**os.environ, "VIRTUAL_ENV": str(place)}
        quiet("uv", "pip", "install", "--resolution", releases, package, env=inside)
        smoke(place / "bin" / "geneva", folder, expected)


def choose(version, releases):
    """Releases with binaries for a Python that is not here; raises where there are none."""
    choice = ("uv", "pip", "compile", "--quiet", "--all-extras", "--only-binary", ":all:")
    options = ("--python-version", version, "--resolution", releases)
    return quiet(*choice, *options, ROOT / "pyproject.toml").count("==")


def main(packages):
    geneva = Path(sys.executable).with_name("geneva")
    expected = {command: quiet(geneva, *command.split(), cwd=DESIGNS) for command in SAME}
    for version in PYTHONS:
        python = python_of(version)
        for releases in RELEASES:
            if python is None:
                number = choose(version, releases)
                print(f"Python {version}, {releases}: {number} packages; not here, nothing run")
                continue
            for package in packages:
                try_out(Path(package).resolve(), python, releases, expected)
                name = Path(package).name
                print(f"Python {version}, {releases}: {name}, {len(COMMANDS)} commands")


if __name__ == "__main__":
    main(sys.argv[1:])
