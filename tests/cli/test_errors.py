"""What a user can get wrong: exit code 2, one clear line with its place, never a traceback."""

import os
import shlex
import subprocess
from typing import NamedTuple, get_args

import pytest
from repo import GENEVA
from typer.main import get_command
from typer.testing import CliRunner

from geneva_cli.cli.app import COMMANDS, app

# commands that read none
WITHOUT_SPEC = {"table", "laws", "new", "synth", "explain", "keys", "help", "schema"}
WHEEL = "[wheel]\nz = 6\n"
SIDE = '[drive]\nkind = "side-crank"\n'
BEFORE = '[drive.before]\nkind = "side-crank"\nA = 0\n'
TABLE = '[motion]\nlaw = "table"\nfile = "law.csv"\n'


class Case(NamedTuple):
    """A wrong spec, the line that is wrong (0: none) and what the message must hold."""

    text: str | bytes
    line: int
    wants: tuple[str, ...]


def case(name, text, line, *wants):
    return pytest.param(Case(text, line, wants), id=name)


def key(name, text, line, *wants):
    """A wrong key below the shortest valid spec; its lines are counted from there."""
    return case(name, WHEEL + text, 2 + line, *wants)


def wheel(name, text, *wants):
    return case(name, f"[wheel]\n{text}\n", 2, *wants)


NOT_TOML = [
    case("not-toml", "[wheel]\nz = six\n", 2, "not TOML"),
    case("open-string", '[wheel]\nz = 6\ntitle = "six\n', 3, "a text between two marks"),
    case("no-value", "[wheel]\nz =\n", 2, "KEY = VALUE as in z = 6"),
    case("not-utf-8", b"[wheel]\nz = 6\n# gr\xfc\xdfe\n", 3, "not UTF-8", "save"),
    case("deep-lists", "a = " + "[" * 50_000, 0, "nested too deep"),
]

MISSING = [
    case("empty", "", 0, "[wheel]", "z = 6"),
    case("no-z", 'title = "x"\n[wheel]\ngearing = "internal"\n', 2, "needs z", "at least 3"),
    key("no-A", "\n" + SIDE, 2, "needs A", "above -1", "below 1"),
]

HEX = "0x" + "f" * 5000  # Python writes no decimal number of so many digits
LONG = "very " * 20_000
HUGE = [
    case("hex", f"[wheel]\nz = {HEX}\n", 2, "z = 0xff", "at most 1000000"),
    key("long-file", TABLE.replace("law.csv", LONG), 3, "cannot read", "too long"),
    key("nul-in-a-file", TABLE.replace("law.csv", r"a\u0000b"), 3, "cannot read", "null byte"),
]

UNKNOWN = [
    key("table", "[whel]\n", 1, "unknown table", "whel", '"wheel"'),
    case("key-at-the-top", "z = 6\n", 1, "z belongs to [wheel] (number of slots); write"),
    case("key", "[wheel]\nz = 6\nzz = 7\n", 3, "unknown key zz", '"z"'),
    key("gearing-as-a-key", "internal = true\n", 1, 'did you mean gearing = "internal"?'),
    key("half", "[size]\nwheel_diameter_mm = 9\n", 2, "[shaft]", "wheel_radius_mm", "half a diam"),
    key("pin", "[size]\npin_radius_mm = 5\n", 2, 'did you mean "roller_radius_mm"?'),
    key("inches", '[size]\ncenter_distance_mm = 8"\n', 2, 'write "8 in"'),
    key("law", '[motion]\nlaw = "cycloid"\n', 2, "law must be one of", 'did you mean "cycloidal"?'),
    key("key-of-another-kind", "[drive]\nA = 0.5\n", 2, "A belongs", '"side-crank"'),
    key("key-before", BEFORE + "foo = 1\n", 4, "foo in [drive.before]; known: kind, A, input_"),
]

TYPES = [
    wheel("float", "z = 6.5", "whole number", "6 or 7"),
    case("title", "title = 5\n" + WHEEL, 1, "title must be text"),
]

VALUES = [
    wheel("z-2", "z = 2", "z = 2", "at least 3"),
    key("A-1", SIDE + "A = 1\n", 3, "A = 1", "below 1"),
    key("rollers-3", "[drive]\nrollers = 3\n", 2, "rollers = 3", "at most 2"),
]

# The same mistakes where the line is hard to find.
PLACES = [
    case("dotted-key", "\nwheel.z = 2\n", 2, "at least 3"),
    case(
        "key-in-the-title",
        'title = """\n[wheel]\nz = 2\n"""\n[drive]\n[wheel]\nz = 2\n',
        7,
        "at least 3",
    ),
    case("byte-order-mark", "\ufeff[wheel]\nz = 2\n", 2, "at least 3"),
]

SPECS = [*NOT_TOML, *HUGE, *MISSING, *UNKNOWN, *TYPES, *VALUES, *PLACES]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(*arguments, text=None):
    return CliRunner().invoke(app, list(arguments), input=text)


def write(name, text):
    data = text if isinstance(text, bytes) else text.encode()
    with open(name, "wb") as file:
        file.write(data)


def refused(result, *wants, place=""):
    """The run ended as an error should; returns what it said."""
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception  # what a user would see as a traceback
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    said = result.stderr
    assert "Traceback" not in said
    assert said.startswith(place), said
    for want in wants:
        assert want in said
    assert all(c.isprintable() or c == "\n" for c in said), "control characters in a message"
    return said


@pytest.mark.parametrize("wrong", SPECS)
def test_wrong_spec(wrong):
    write("spec.toml", wrong.text)
    place = f"spec.toml:{wrong.line}: " if wrong.line else "spec.toml:"
    said = refused(run("peaks", "spec.toml"), *wrong.wants, place=place)
    assert len(said) < 1000


@pytest.mark.parametrize("name", [n for n in COMMANDS if n not in WITHOUT_SPEC])
def test_every_command_says_the_same(name):
    write("spec.toml", "[wheel]\nz = 2\n")
    said = refused(run(name, "spec.toml"))
    assert said.splitlines()[0] == run("peaks", "spec.toml").stderr.rstrip()


def test_from_stdin():
    refused(run("peaks", "-", text="[wheel]\nz = 2\n"), "at least 3", place="<stdin>:2: ")
    refused(run("peaks", "-", text=""), "[wheel]", place="<stdin>:")
    assert run("peaks", "-", text=WHEEL).exit_code == 0


@pytest.mark.parametrize(
    "text",
    ["\ufeff" + WHEEL, WHEEL.replace("\n", "\r\n"), "\ufeff\r\n" + WHEEL, "wheel = {z = 6}"],
    ids=["byte-order-mark", "windows-lines", "both", "one-line"],
)
def test_unusual_but_right(text):
    write("spec.toml", WHEEL)
    plain = run("peaks", "spec.toml").stdout
    write("spec.toml", text)
    found = run("peaks", "spec.toml")
    assert (found.exit_code, found.stdout) == (0, plain)


def test_python_without_docstrings_is_refused():
    environment = {**os.environ, "PYTHONOPTIMIZE": "2"}
    run = subprocess.run([GENEVA, "table"], env=environment, capture_output=True, encoding="utf-8")
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
    assert "PYTHONOPTIMIZE" in run.stderr


def test_no_file():
    refused(run("peaks", "gone.toml"), "No such file", "geneva new", place="gone.toml: ")
    refused(run("peaks", ""), "No such file", place="'': ")


ESCAPE = r"\u001b]0;x\u0007\u009b31m"


@pytest.mark.parametrize("text", ['[drive]\n"{}" = 1\n', '["{}"]\n', '[motion]\nlaw = "{}"\n'])
def test_messages_carry_no_terminal_escapes(text):
    write("spec.toml", "wheel.z = 6\n" + text.format(ESCAPE))
    refused(run("peaks", "spec.toml"), place="spec.toml:")


# The law's points: they have their own file, and their own lines.
ROWS = "u,s\n0,0\n0.2,0.1\n0.4,0.3\n0.6,0.7\n0.8,0.9\n1,1\n"
POINTS = [
    ("text", ROWS.replace("0.4,0.3", "0.4,much"), 4, "two numbers u,s"),
    ("nan", ROWS.replace("0.4,0.3", "0.4,nan"), 4, "finite"),
    ("backwards", ROWS.replace("0.4,0.3", "0.1,0.3"), 4, "exceed the one before"),
    ("from-elsewhere", ROWS.replace("0,0\n", "0,0.1\n", 1), 0, "from 0,0 to 1,1"),
    ("not-utf-8", ROWS.encode() + b"\xff\n", 8, "not UTF-8"),
]


@pytest.mark.parametrize(
    ("text", "line", "wants"), [pytest.param(t, n, w, id=name) for name, t, n, *w in POINTS]
)
def test_wrong_law_points(text, line, wants):
    os.mkdir("sub")
    write("sub/spec.toml", WHEEL + TABLE)
    write("sub/law.csv", text)  # relative to the spec
    place = f"sub/law.csv:{line}: " if line else "sub/law.csv:"
    if "from 0,0 to 1,1" in wants:  # a law's own rule, whoever gives it its points
        place = "sub/spec.toml:5: law.csv: "
    refused(run("peaks", "sub/spec.toml"), *wants, place=place)


@pytest.mark.parametrize("name", ["gone.csv", ".", ""])
def test_no_law_points(name):
    write("spec.toml", WHEEL + TABLE.replace("law.csv", name))
    refused(run("peaks", "spec.toml"), place="spec.toml:5: ")


# Options: the message names the one that is wrong, the first of its line.
ZEROS = "1" + "0" * 400
OPTIONS = [
    (f"table -o {ZEROS}", "100"),
    (f"profile --curves {ZEROS} spec.toml", "100"),
    (f"synth --tau {ZEROS}", "100"),
    (f"synth --rollers -{ZEROS} --tau 1/3", "at least 1"),
    ("table --z 2", "at least 3"),
    ("table --z 12..3", "the lesser first"),
    ("table --z " + "9" * 5000, "whole numbers"),
    ("table --n", "requires an argument"),
    ("table --rollers 0", "at least 1"),
    ("table --z 6 --internal --rollers 2", "rollers = 2", "at most 1"),
    ("table --zz 6", "--z"),
    ("profile --tolerance 0 spec.toml", "above 0"),
]


@pytest.mark.long
@pytest.mark.parametrize(("line", "wants"), [pytest.param(x, w, id=x[:40]) for x, *w in OPTIONS])
def test_wrong_option(line, wants):
    write("spec.toml", WHEEL)
    words = shlex.split(line)
    said = refused(run(*words), words[1], *wants)
    assert len(said) <= 1001


@pytest.mark.parametrize(
    ("arguments", "wants"),
    [
        (["tabel"], ["'tabel'", "'table'"]),
        (["--nix"], ["geneva: no such option: --nix; see geneva -h"]),
        (["table", "--rpm", "60"], ["--rpm (did you mean --n?)"]),
        (["peaks", "spec.toml", "--rpm", "60"], ["(did you mean --set drive.n_rpm=RPM?)"]),
        (["peaks"], ["SPEC"]),
        (["new"], ["KIND"]),
        (["new", "externel"], ["KIND", "externel", '"external"']),
        (["new", "external", "-o", "gone/spec.toml"], ["gone"]),
        (["peaks", "spec.toml", "other.toml"], ["other.toml"]),
        (["peaks", "spec.toml", "-o", "peaks.xyz"], ["peaks.xyz", "table, csv, json, md"]),
        (["peaks", "spec.toml", "-o", "peaks"], ["peaks", "csv", "--format"]),
        (["peaks", "spec.toml", "-o", ""], ["-o"]),
        (["profile", "--part", "wheel", "spec.toml"], ["-o FILE", "dxf, svg, step, stl, 3mf"]),
    ],
    ids=lambda words: " ".join(words),
)
def test_wrong_usage(arguments, wants):
    write("spec.toml", WHEEL)
    assert refused(run(*arguments), *wants).count("\n") == 1


def texts():
    """Every option of every command whose value may be any text."""
    group = get_command(app)
    context = group.make_context("geneva", ["table"])
    for name in COMMANDS:
        _, command, _ = group.resolve_command(context, [name])
        spec = ["spec.toml"] if name not in WITHOUT_SPEC else []
        for option in command.params:
            kind = command.kinds.get(option.name)
            numeric = {int, float} & {kind, *get_args(kind)}
            if option.param_type_name == "option" and not (option.is_flag or numeric):
                for said in option.opts:
                    yield [name, *spec, said, ""], option.opts[0]


@pytest.mark.long
def test_an_option_that_is_empty_is_not_one_that_is_not_given():
    """A script has it of a variable without a value; what it is to ask for would be passed over."""
    write("spec.toml", WHEEL)
    for arguments, option in texts():
        refused(run(*arguments), "give it a value", place=f'{option} "": ')


@pytest.mark.parametrize(
    ("arguments", "option"),
    [
        ("synth --tau ..0.1 --tau 0.2.. --z 6", "--tau"),
        ("synth --tau=0.3 --rollers 2 --rollers=1", "--rollers"),
        ("peaks spec.toml --format csv -o a.csv --output b.csv", "-o"),
        ("table --z 6 --A 0.1 --A 0.1", "--A"),
    ],
)
def test_an_option_of_one_value_is_given_once(arguments, option):
    write("spec.toml", WHEEL)
    refused(run(*arguments.split()), "only one of both would count", place=f"{option}: given twice")
    assert os.listdir() == ["spec.toml"]
