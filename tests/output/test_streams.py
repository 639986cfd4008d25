"""Standard streams that fail, and Ctrl-C at any moment; what a title may not do to them."""

import csv
import json
import os
import subprocess
import sys

import pytest
from repo import GENEVA, posix, put
from typer.testing import CliRunner

from geneva_cli.cli.app import app

LONG = "motion spec.toml --samples 500000 --format"  # some 40 MB
full = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    folder = tmp_path / "Größe 六"  # letters and a space, as folders have them
    folder.mkdir()
    monkeypatch.chdir(folder)
    put("spec.toml", "[wheel]\nz = 6\n")
    # spherical: without parts that would be turned
    sphere = '[wheel]\nz = 6\ngearing = "spherical"\n'
    put("fails.toml", sphere + "[limits]\nvelocity_max = 0.1\n")
    put("warns.toml", "[wheel]\nz = 25\n")


@pytest.fixture(params=["", "1"], ids=["buffered", "unbuffered"])
def environment(request):
    return os.environ | {"PYTHONUNBUFFERED": request.param}  # an empty text counts as unset


def run(command, **settings):
    settings = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | settings
    return subprocess.run(command, encoding="utf-8", timeout=60, **settings)


@pytest.mark.sampled(3)
@full
@pytest.mark.parametrize("line", ["--help", "peaks spec.toml", "motion spec.toml --samples 20000"])
def test_full_disk(line, environment):
    with open("/dev/full", "w", encoding="utf-8") as out:
        found = run([GENEVA, *line.split()], env=environment, stdout=out)
    assert found.returncode == 2
    assert found.stderr.startswith("<stdout>: cannot write: No space left")
    assert found.stderr.count("\n") == 1


@pytest.mark.sampled(2)
@pytest.mark.parametrize("line", ["table", "--help", LONG + " csv", LONG + " json"])
def test_closed_pipe(line):
    """``geneva table | head -1``: the reader has what it wanted, and nobody is bothered."""
    process = subprocess.Popen(
        [GENEVA, *line.split()], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8"
    )
    process.stdout.readline()
    process.stdout.close()
    err = process.stderr.read()
    process.stderr.close()
    assert (err, process.wait(timeout=30) in (0, 141)) == ("", True)


STATUS = {"peaks warns.toml": 0, "check fails.toml": 1, "peaks gone.toml": 2, "tabel": 2}


@pytest.mark.sampled(4)
@full
@pytest.mark.parametrize("line", STATUS)
def test_messages_that_cannot_be_written(line, environment):
    """``2>/dev/full``: what is said changes nothing of what is."""
    plain = run([GENEVA, *line.split()], env=environment)
    with open("/dev/full", "w", encoding="utf-8") as err:
        found = run([GENEVA, *line.split()], env=environment, stderr=err)
    assert found.returncode == plain.returncode == STATUS[line]
    assert found.stdout == plain.stdout


CLOSED = [">&-", "2>&-", "<&- >&- 2>&-"]


@posix("shell that closes streams")
@pytest.mark.sampled(3)
@pytest.mark.parametrize("streams", CLOSED)
@pytest.mark.parametrize("spec", ["spec.toml", "warns.toml"])
def test_closed_streams(spec, streams):
    """What nobody can read is dropped: the exit status and the other stream are as ever."""
    plain = run([GENEVA, "peaks", spec])
    found = run(["sh", "-c", f'exec "$0" "$@" {streams}', GENEVA, "peaks", spec])
    assert found.returncode == plain.returncode == 0
    parts = streams.split()
    assert found.stdout == ("" if ">&-" in parts else plain.stdout)
    assert found.stderr == ("" if "2>&-" in parts else plain.stderr)


FILE = """
import sys
from geneva_cli.streams import open_streams
open_streams()
with open("rows.csv", "w") as file:
    print("data", file=file, flush=True)
    print("printed", flush=True)
    print("a message", file=sys.stderr, flush=True)
    sys.stdin.read()
"""


@posix("shell that closes streams")
@pytest.mark.sampled(1)
@pytest.mark.parametrize("streams", CLOSED)
def test_nothing_else_gets_into_a_file(streams):
    """The file took the descriptor of the closed stream, and with it what was said there."""
    command = ["sh", "-c", f'exec "$0" -c "$1" {streams}', sys.executable, FILE]
    run(command, stdin=subprocess.DEVNULL, check=True)
    with open("rows.csv", encoding="utf-8") as file:
        assert file.read() == "data\n"


FAULTY = """
import sys
from geneva_cli.cli.commands import peaks

def run(spec: str) -> None:
    "Fail."
    {}["no\\nkey"]

peaks.run = run
from geneva_cli.__main__ import main
main()
"""


@pytest.mark.parametrize("debug", ["", "1"])
def test_a_fault_of_the_program(debug):
    """One line that names the command, and a status that no design has; a traceback on request."""
    environment = os.environ | {"GENEVA_DEBUG": debug}
    found = run([sys.executable, "-c", FAULTY, "peaks", "spec.toml"], env=environment)
    assert (found.returncode, found.stdout) == (70, "")
    *traceback, line = found.stderr.splitlines()
    assert line.startswith("geneva peaks spec.toml: a fault of geneva ")
    assert "KeyError" in line and "please report it in the issues of geneva-cli" in line
    assert traceback[:1] == (["Traceback (most recent call last):"] if debug else [])


INTERRUPTED = """
import importlib.abc, os, signal, sys

class Interrupt(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name == wanted:
            os.kill(os.getpid(), signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupt())
wanted, sys.argv[1:] = sys.argv[1], ["motion", "spec.toml", "--format", "csv"]
from geneva_cli.__main__ import main
main()
"""


@posix("signals that a process sends to itself")
@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "module",
    ["geneva_cli.cli.app", "typer", "geneva_cli.cli.commands.motion", "numpy", "numpy.linalg"],
)
def test_ctrl_c_while_importing(module):
    """At once, and without the traceback of whatever was being imported."""
    found = run([sys.executable, "-c", INTERRUPTED, module])
    assert (found.returncode, found.stdout, found.stderr) == (130, "", "")


LINES = ["plot spec.toml --format svg", "peaks spec.toml --format csv", "help symbols", "schema"]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("line", [*LINES, "peaks spec.toml"])
@pytest.mark.parametrize("encoding", ["cp1252", "ascii"])
def test_files_on_standard_output_are_utf8(line, encoding):
    """An .svg in the console's encoding was not valid XML. Tables for people follow the console."""
    put("spec.toml", 'title = "Größe 六"\n[wheel]\nz = 6\n')
    found, utf8 = (
        subprocess.run(
            [GENEVA, *line.split()],
            capture_output=True,
            env=os.environ | {"PYTHONIOENCODING": own, "PYTHONUTF8": "0"},
        )
        for own in (encoding, "utf-8")
    )
    assert found.returncode == 0 and b"\r" not in found.stdout
    assert (line in LINES) == (found.stdout == utf8.stdout)
    if line not in LINES:
        said = utf8.stdout.decode().encode(encoding, "backslashreplace")
        assert found.stdout == said


CLOSED_PIPE = """
import errno, sys
from geneva_cli import streams
class Closed:
    def write(self, data):
        raise OSError(errno.EINVAL, "Invalid argument")
streams.open_streams()
sys.stdout.buffer.raw.raw = Closed()
print("a row", flush=True)
"""


def test_a_closed_pipe_of_windows():
    """It is an invalid argument there: the reader has what it wanted, and nobody is bothered."""
    found = run([sys.executable, "-c", CLOSED_PIPE])
    assert (found.returncode, found.stderr) == (141, "")


HOSTILE = ["=HYPERLINK(1)", r"\u001b]0;x\u0007\u001b[31mred", r"one\r\ntwo", r"\u202ea|b`c<script>"]


@pytest.mark.parametrize("format", ["table", "csv", "json", "md"])
def test_hostile_title(format):
    """A title adds no line, no formula, no mark-up and no control character."""
    lines = set()
    for title in ["plain", *HOSTILE]:
        put("spec.toml", f'title = "{title}"\n[wheel]\nz = 400\n')
        found = CliRunner().invoke(app, ["peaks", "spec.toml", "--format", format])
        assert found.exit_code == 0, (title, found.output, found.exception)
        text = found.stdout
        assert all(c.isprintable() or c == "\n" for c in text), title
        lines.add(text.count("\n"))
        for cell in csv.reader(text.splitlines()) if format == "csv" else ():
            assert not any(c.startswith(("=", "@", "+")) for c in cell), title
        if format == "json":
            json.loads(text)
        assert format != "md" or "<script>" not in text
    assert len(lines) == 1
