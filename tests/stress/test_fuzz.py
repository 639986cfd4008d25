"""Property-based: random specs and random command lines, the same ones on every run.

`make fuzz` is the long version: a million specs, and 20,000 machines with parts.
"""

import importlib
import json
import math
import os
import random
import re

import fuzz_parts
import fuzz_sheets
import numpy as np
import pytest
from fuzz_machines import machine_text
from fuzz_spec import ODD, garbage, mutated, one, read, sound, spec_text
from fuzzing import LAW, folder, in_time, numbers
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from geneva_cli.analysis.motion import motion_table
from geneva_cli.analysis.peaks import worst
from geneva_cli.app import COMMANDS, app
from geneva_cli.machine.registry import DRIVES
from geneva_cli.output.formats import FORMATS
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Size
from geneva_cli.table import Table


# The same examples on every run, none kept on disk, and no limit of hypothesis' own: each example
# has one of seconds, which a busy machine does not exceed.
def fuzz(examples):
    return settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        print_blob=False,
    )


seeds = st.integers(0, 2**32)
WITHOUT_SPEC = {"table", "laws", "new", "schema", "bench", "keys", "help"}
SLOW = {"bench"}  # a run takes minutes: only that it refuses nonsense
SECONDS = 20


@pytest.fixture(autouse=True, scope="module")
def here():
    with folder():
        yield


@fuzz(400)
@given(st.text(max_size=200) | st.binary(max_size=200))
def test_any_text(text):
    one(text)


@fuzz(600)
@given(seeds)
def test_toml_words(seed):
    rng = random.Random(seed)
    one(garbage(rng))


@fuzz(1000)
@given(seeds)
def test_mutated_specs(seed):
    rng = random.Random(seed)
    one(mutated(rng, spec_text(rng, 0.1)))


@fuzz(100)
@given(seeds)
def test_specs_of_known_keys(seed):
    """A machine is consistent, and everything that is said of its motion is finite."""
    rng = random.Random(seed)
    text = spec_text(rng, 0.0) if rng.random() < 0.5 else machine_text(rng)
    if one(text) == "refused":
        return
    found = read(text.encode())
    table = motion_table(found, 97)
    wheel = table.columns[2]
    turned = sum(math.degrees(2.0 * s.half_step) for s in found.engagements)
    assert wheel[-1] - wheel[0] == pytest.approx(turned, rel=1e-9)
    assert table.columns[3][0] == pytest.approx(0.0, abs=1e-9 * worst(found).velocity.max)


# of the first some that take a second or less: with parts, without them, and refused
@pytest.mark.parametrize("case", [2, 5, 6, 9, 10, 11, 12, 13, 16, 21])
def test_machines_with_parts(case):
    """Cases of `fuzz_parts.py`: all that is made of them is finite, without a warning."""
    fuzz_parts.one(machine_text(numbers("make test", case)))


# of the first that have a sheet: gears by points, an internal wheel, two in series, a sphere
@pytest.mark.parametrize("case", [4, 14, 27, 33])
def test_sheets(case):
    """Cases of `fuzz_sheets.py`: texts stand free, sizes and list are the machine's."""
    assert fuzz_sheets.one(machine_text(numbers("sheets", case))) == "sheet"


def test_the_random_machines_are_of_every_kind_and_have_every_key():
    """What is never written is never tried; and most of it must be machines."""
    texts = [machine_text(numbers(1, case)) for case in range(300)]
    said = "\n".join(texts)
    for kind in DRIVES:
        assert f'kind = "{kind}"' in said, kind
    words = ["internal", "spherical", "offset_mm", "steps_deg", "roller_angles_deg"]
    words += [field.key for field in [*fields(Size), *fields(Limits)]]
    for word in words:
        assert word in said, word
    assert sum(not isinstance(read(t.encode()), str) for t in texts[:60]) > 30


def test_a_finding_is_a_finding():
    """The fuzzers' own test of numbers can fail."""
    for wrong in (math.nan, math.inf):
        with pytest.raises(AssertionError, match="velocity"):
            sound(Table(("input_deg", "velocity"), ([0.0, 1.0], np.array([1.0, wrong]))))
    sound(Table(("radius",), ([math.inf, None, 1],)), {"radius"})
    with pytest.raises(AssertionError):
        sound(Table(("radius",), ([math.nan],)), {"radius"})
    with pytest.raises(TimeoutError), in_time(0.05):
        while True:
            pass


# Command lines

NUMBERS = ["0", "1", "2", "3", "9", "97", "-1", "0.5", "0.001", "1e-300", "1e300", "nan", "inf",
           "1e12", "1000000000000", "9" * 400, "-0", "6", "3..5", "3,4", "12..3", "3..1000000000",
           "", " ", "six", "\u0661", "--", "-", "=1", "\x1b[31m", "slot"]  # fmt: skip
OUTPUTS = ["-", "out.csv", "out.json", "out.md", "out.txt", "out.xyz", "gone/out.csv", "", ".",
           "spec.toml", "law.csv", "x" * 300 + ".csv", "a\0b.csv", "out"]  # fmt: skip
FILES = [
    "spec.toml",
    "spec.toml",
    "spec.toml",
    "other.toml",
    "gone.toml",
    ".",
    "-",
    "law.csv",
    "a\0b",
]
# a file, an option, an argument's name or its text, or the usage of the whole
FILE = r"(spec|other|gone)\.toml|law\.csv|x+\.*x*\.csv|\.:|/|<std\w+>|'a\\x00b'"
TEXT = r'".*" is no '
PLACES = re.compile(
    rf"Usage: |(unknown )?KIND|--?[\w-]+|SPEC|{FILE}|{TEXT}|[^:]+: cannot (read|write)"
)


def parameters(name):
    """The options of a command, as its own signature has them."""
    import typer
    from typer.main import get_command

    one = typer.Typer(add_completion=False)
    one.command(name)(importlib.import_module(f"geneva_cli.commands.{name}").run)
    return [p.opts for p in get_command(one).params if p.opts[0].startswith("-")]


def command_line(rng, name):
    words = [name]
    if name not in WITHOUT_SPEC and rng.random() < 0.97:
        words += [rng.choice(FILES) for _ in range(1 if rng.random() < 0.9 else 2)]
    if name == "new":
        words.append(rng.choice(["external", "internal", "curved", "wheel", ""]))
    if name == "keys" and rng.random() < 0.8:
        words.append(rng.choice(["drive", "drive.A", "z", "mass", *NUMBERS]))
    for opts in parameters(name):
        if rng.random() < 0.35:
            option = rng.choice(opts)
            if option == "--help" and rng.random() < 0.9:
                continue
            words.append(option)
            if option in ("--internal", "--spherical", "--help"):
                continue
            if option in ("-o", "--output"):
                words.append(rng.choice(OUTPUTS))
            elif option == "--format":
                words.append(rng.choice([*FORMATS, *FORMATS, *FORMATS, "xml", ""]))
            else:
                words.append(rng.choice(NUMBERS))
    if rng.random() < 0.05:
        words.insert(rng.randint(1, len(words)), rng.choice([*NUMBERS, *ODD[:9], "--zz", "-x"]))
    return words


def no_constant(name):
    raise AssertionError(f"json holds {name}")


def contents():
    out = {}
    for name in ("spec.toml", "other.toml", "law.csv"):
        with open(name, "rb") as file:
            out[name] = file.read()
    return out


def outputs(words):
    return {b for a, b in zip(words, words[1:], strict=False) if a in ("-o", "--output")}


def inputs(words, before):
    """The specs that a command line names, and the points that they name."""
    if words[0] in WITHOUT_SPEC:
        return set()
    specs = {w for a, w in zip(words, words[1:], strict=False) if a not in ("-o", "--output")}
    named = any(b'"law.csv"' in before[s] for s in specs & {"spec.toml", "other.toml"})
    return specs | ({"law.csv"} if named else set())


@pytest.mark.parametrize("name", COMMANDS)
def test_command_lines(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with open("law.csv", "w") as file:
        file.write(LAW)

    @fuzz(60)
    @given(seeds)
    def check(seed):
        rng = random.Random(seed)
        for spec in ("spec.toml", "other.toml"):
            with open(spec, "w", encoding="utf-8", errors="replace") as file:
                file.write(spec_text(rng, rng.choice([0.0, 0.02])))
        before = contents()
        words = command_line(rng, name)
        if rng.random() < 0.3:
            words += ["--format", "json"]  # the last one counts
        if name in SLOW:
            words.append("--no-such-option")
        with in_time(SECONDS):
            found = CliRunner().invoke(app, words, input=spec_text(rng))
        if found.exception and not isinstance(found.exception, SystemExit):
            raise AssertionError(f"{words} on {before['spec.toml']}") from found.exception
        assert found.exit_code in (0, 1, 2)
        assert found.exit_code != 1 or name == "check"
        after = contents()
        changed = {n for n in before if before[n] != after[n]}
        assert changed <= outputs(words) - inputs(words, before), f"{words} changed {changed}"
        assert not [n for n in os.listdir() if n.endswith(".tmp")]
        assert all(c.isprintable() or c in "\n\t" for c in found.stderr)
        if found.exit_code == 2:
            assert found.stdout == ""
            assert PLACES.match(found.stderr), found.stderr
        elif words[-2:] == ["--format", "json"] and found.stdout:
            json.loads(found.stdout, parse_constant=no_constant)

    check()
