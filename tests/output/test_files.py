"""Output files and streams: replaced whole or not at all, and quiet when nobody listens."""

import csv
import functools
import importlib
import json
import os
import re
import resource
import signal
import stat
import subprocess
import time

import pytest
import repo
from repo import GENEVA, get, put
from sampling import some
from typer.testing import CliRunner
from words import load

from geneva_cli.cli.app import COMMANDS, app
from geneva_cli.design import load as load_design
from geneva_cli.motion.motion_table import motion_table

OLD = "the old file, whole\n"
TEMPORARY = re.compile(r"\.motion\.csv\.geneva-\d+\.tmp")
LONG = ["motion", "spec.toml", "--samples", "500000"]  # seconds of writing, some 40 MB
SHORT = ["peaks", "spec.toml"]

full = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", "[wheel]\nz = 6\n")
    return tmp_path


def geneva(*arguments, **settings):
    settings = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | settings
    return subprocess.run([GENEVA, *arguments], text=True, timeout=60, **settings)


def clean_failure(found, *wants):
    assert found.returncode == 2, found.stderr
    assert "Traceback" not in found.stderr
    assert len(found.stderr.splitlines()) == 1
    for want in wants:
        assert want in found.stderr


def leftovers():
    return [name for name in os.listdir() if name.endswith(".tmp")]


# Where the file goes


def test_new_file_honours_the_umask():
    found = geneva(*SHORT, "-o", "peaks.json", umask=0o027)
    assert (found.returncode, found.stdout) == (0, "")
    assert stat.S_IMODE(os.stat("peaks.json").st_mode) == 0o640
    assert leftovers() == []


def test_symlink_stays_a_link():
    os.mkdir("store")
    put("store/real.csv", OLD)
    os.symlink("store/real.csv", "link.csv")
    assert geneva(*SHORT, "-o", "link.csv").returncode == 0
    assert os.readlink("link.csv") == "store/real.csv"
    assert get("store/real.csv").startswith("spec,title,velocity.max,")
    assert os.listdir("store") == ["real.csv"]


def test_same_text_on_a_stream_and_in_a_file():
    for extension, name in {"txt": "table", "csv": "csv", "json": "json", "md": "md"}.items():
        # the stream is a process's own; a file is a file
        assert CliRunner().invoke(app, [*SHORT, "-o", f"peaks.{extension}"]).exit_code == 0
        assert get(f"peaks.{extension}") == geneva(*SHORT, "--format", name, "-o", "-").stdout


def test_folder_missing():
    clean_failure(geneva(*SHORT, "-o", "gone/peaks.csv"), "gone", "No such file", "make the folder")
    clean_failure(geneva(*SHORT, "-o", "/proc/peaks.csv"), "the folder /proc takes no files")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["spec.toml", "./sub/../spec.toml", "link.toml", "hard.toml"])
def test_output_over_the_spec(name):
    os.mkdir("sub")
    os.symlink("spec.toml", "link.toml")
    os.link("spec.toml", "hard.toml")
    before = get("spec.toml")
    clean_failure(geneva(*SHORT, "-o", name, "--format", "csv"), "input", "another name")
    assert get("spec.toml") == before


# Runs that fail or are stopped


def small_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))


def test_failure_half_way_keeps_the_old_file():
    put("motion.csv", OLD)
    arguments = ["motion", "spec.toml", "--samples", "20000", "-o", "motion.csv"]
    clean_failure(geneva(*arguments, preexec_fn=small_files), "motion.csv", "cannot write")
    assert get("motion.csv") == OLD
    assert leftovers() == []


def stopped(number):
    """A long export, stopped by a signal once its temporary file has appeared."""
    put("motion.csv", OLD)
    process = subprocess.Popen(
        [GENEVA, *LONG, "-o", "motion.csv"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=repo.heed_signals,
    )
    deadline = time.monotonic() + 30
    while not leftovers() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    assert process.poll() is None, "the export ended before it could be stopped"
    assert TEMPORARY.fullmatch(leftovers()[0])
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert (out, err) == ("", "")
    assert get("motion.csv") == OLD
    return process.returncode


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_stopped_by_a_signal(number, status):
    assert stopped(number) == status
    assert leftovers() == []


def test_killed():
    assert stopped(signal.SIGKILL) == -signal.SIGKILL
    (left,) = leftovers()
    assert TEMPORARY.fullmatch(left)
    # another file's run leaves it alone; the next run of the same file removes it
    assert geneva("motion", "spec.toml", "-o", "motion.csv.csv").returncode == 0
    assert leftovers() == [left]
    assert geneva("motion", "spec.toml", "-o", "motion.csv").returncode == 0
    assert leftovers() == []


# Standard output that does not take what we write


@pytest.mark.sampled(2)
@full
@pytest.mark.parametrize("arguments", [["table"], SHORT, LONG], ids=" ".join)
def test_full_disk_on_a_file(arguments):
    found = geneva(*arguments, "-o", "/dev/full", "--format", "csv")
    clean_failure(found, "/dev/full", "No space left")
    assert found.stdout == ""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "arguments",
    [["table"], ["--help"], [*LONG, "--format", "csv"], [*LONG, "--format", "json"], SHORT],
    ids=" ".join,
)
def test_closed_pipe(arguments):
    """``geneva table | head -1``: the reader has what it wanted, and nobody is bothered."""
    process = subprocess.Popen(
        [GENEVA, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    process.stdout.readline()
    process.stdout.close()
    err = process.stderr.read()
    process.stderr.close()
    assert (err, process.wait(timeout=30) in (0, 141)) == ("", True)


def test_a_pipe_of_ascii():
    """A title in any script, on a system that knows only ASCII, is no reason to fail."""
    put("spec.toml", 'title = "Größe 六"\n' + ANSWERED)
    ascii_only = os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    for line in ("peaks spec.toml", "check spec.toml"):
        run = subprocess.run(
            [GENEVA, *line.split()], env=ascii_only, capture_output=True, text=True
        )
        assert run.returncode in (0, 1), run.stderr
        assert "Traceback" not in run.stderr
        assert len(run.stdout) > 200


# What is written


def numbers(tree):
    if isinstance(tree, dict):
        return [x for value in tree.values() for x in numbers(value)]
    if isinstance(tree, list):
        return [x for value in tree for x in numbers(value)]
    return [tree]


def strict(text):
    def refuse(constant):
        raise AssertionError(f"{constant} in json")

    return json.loads(text, parse_constant=refuse)


def get_lines(*arguments):
    found = CliRunner().invoke(app, list(arguments))
    assert found.exit_code == 0, found.output
    return found.stdout.splitlines()


@pytest.mark.parametrize("samples", [2, 361, 8193])
def test_csv_reads_back_equal(samples):
    put("spec.toml", '[wheel]\nz = 7\n[drive]\nkind = "side-crank"\nA = 0.3\nn_rpm = 47\n')
    lines = get_lines("motion", "spec.toml", "--samples", str(samples), "--format", "csv")
    table = motion_table(load("spec.toml"), samples)
    rows = list(csv.reader(lines))
    assert tuple(rows[0]) == table.names
    assert [[float(x) for x in row] for row in rows[1:]] == [list(row) for row in table.rows()]
    assert not any(x in ("-0.0", "nan", "inf", "-inf") for row in rows for x in row)


@pytest.mark.parametrize("arguments", [["motion", "spec.toml"], SHORT, ["table"]], ids=" ".join)
def test_json_and_csv_hold_the_same(arguments):
    tree = strict("\n".join(get_lines(*arguments, "--format", "json")))
    rows = list(csv.DictReader(get_lines(*arguments, "--format", "csv")))
    if "rows" in tree:
        assert [{k: str(v) for k, v in row.items()} for row in tree["rows"]] == rows
    else:
        assert ["" if x is None else str(x) for x in numbers(tree)] == list(rows[0].values())


# What a title may not do

HOSTILE = [
    "=HYPERLINK(1)",
    "@SUM(1)",
    "+1+1",
    "-1+1",
    r"\u001b]0;x\u0007\u001b[31mred",
    r"\u009b31mred",
    r"one\r\ntwo",
    r"\ttab",
    r"\u202eback",
    r"a|b`c<script>",
    r"\u2028=1",
]


def titled():
    """The commands that read a spec and print something; export writes a folder."""
    runs = {c: importlib.import_module(f"geneva_cli.cli.commands.{c}").run for c in COMMANDS}
    reads = [name for name, run in runs.items() if {"spec", "specs"} & set(run.__annotations__)]
    return [name for name in reads if name != "export"]


def more(command):
    """What a command must be told besides the spec."""
    few = {"sweep": ("--vary", "drive.n_rpm=60,70"), "tolerance": ("--samples", "64")}
    return few.get(command, ())


# without parts that would be turned for each title; and what each command asks for
ANSWERED = """[wheel]
z = 400
[load]
inertia_kgm2 = 0.1
[shaft]
stiffness_Nm_rad = 1e4
damping_ratio = 0.1
[tolerance]
crank_radius_mm = 0.01
"""


# in every format; the rows of a sweep are csv, whoever reads them
PRINTED = dict.fromkeys(titled(), ("table", "csv", "json", "md")) | {"sweep": ("",)}
# what is made of a title there is in tests of the page
del PRINTED["animate"]


def once(read):
    """Of what is given beside a file, a list, none can be looked up."""
    return lambda path, given=(), reverse=False: read(path, tuple(given), reverse)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("command", PRINTED)
def test_hostile_title(command, monkeypatch):
    plain = {}
    for title in ["plain", *(HOSTILE if command == "peaks" else some(HOSTILE, HOSTILE[::4]))]:
        put("spec.toml", f'title = "{title}"\n{ANSWERED}')
        # what a design has worked out for one format it has for all
        monkeypatch.setattr("geneva_cli.design.load", once(functools.cache(load_design)))
        for format in PRINTED[command]:
            words = [command, "spec.toml", *more(command)]
            found = CliRunner().invoke(app, words + (["--format", format] if format else []))
            assert found.exit_code in (0, 1), (title, found.output, found.exception)
            text = found.stdout
            clean_title(text, format or "csv", title)
            assert text.count("\n") == plain.setdefault(format, text).count("\n"), (title, format)


def clean_title(text, format, title):
    assert all(c.isprintable() or c == "\n" for c in text), (title, format)
    if format == "csv":
        for cell in (c for row in csv.reader(text.splitlines()) for c in row):
            assert not cell.startswith(("=", "@", "+", "-")) or float(cell) <= 0, title
    if format == "json":
        strict(text)
    if format == "md":
        assert "<script>" not in text, title


def test_output_is_a_folder():
    os.mkdir("peaks.csv")
    clean_failure(geneva(*SHORT, "-o", "peaks.csv"), "peaks.csv", "directory")
    assert os.listdir("peaks.csv") == []
