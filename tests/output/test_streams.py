"""Standard streams that fail, and Ctrl-C at any moment: the exit status says what happened."""

import os
import subprocess
import sys

import pytest
from repo import GENEVA, posix, put

SOME = [["--help"], ["peaks", "spec.toml"], ["motion", "spec.toml", "--samples", "20000"]]

some = pytest.mark.parametrize("arguments", SOME, ids=" ".join)
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


def run(arguments, environment=None, **settings):
    settings = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | settings
    return subprocess.run(
        [GENEVA, *arguments],
        encoding="utf-8",
        timeout=60,
        env=environment or os.environ,
        **settings,
    )


@pytest.mark.sampled(6)
@full
@some
def test_full_disk(arguments, environment):
    with open("/dev/full", "w", encoding="utf-8") as out:
        found = run(arguments, environment, stdout=out)
    assert found.returncode == 2
    assert found.stderr.startswith("<stdout>: cannot write: No space left")
    assert found.stderr.count("\n") == 1


STATUS = {"peaks warns.toml": 0, "check fails.toml": 1, "peaks gone.toml": 2, "tabel": 2}


SAID = {}  # by a command line, with streams that can be written: the same in any folder


@pytest.mark.sampled(16)
@pytest.mark.parametrize("arguments", STATUS)
@pytest.mark.parametrize("kind", [pytest.param("full", marks=full), "pipe"])
def test_messages_that_cannot_be_written(arguments, kind, environment):
    """``2>/dev/full``: what is said changes nothing of what is."""
    key = arguments, environment["PYTHONUNBUFFERED"]
    plain = SAID[key] = SAID.get(key) or run(arguments.split(), environment)
    if kind == "full":
        with open("/dev/full", "w", encoding="utf-8") as err:
            found = run(arguments.split(), environment, stderr=err)
    else:
        read, write = os.pipe()
        os.close(read)
        with open(write, "w", encoding="utf-8") as err:
            found = run(arguments.split(), environment, stderr=err)
    assert found.returncode == plain.returncode == STATUS[arguments]
    assert found.stdout == plain.stdout


CLOSED = [">&-", "2>&-", "<&- >&- 2>&-"]


def closed(arguments, streams):
    """A run that a shell starts without some of its streams."""
    script = f'exec "$0" "$@" {streams}'
    return subprocess.run(
        ["sh", "-c", script, GENEVA, *arguments], capture_output=True, encoding="utf-8", timeout=60
    )


@posix("shell that closes streams")
@pytest.mark.sampled(6)
@pytest.mark.parametrize("streams", CLOSED)
@pytest.mark.parametrize("spec", ["spec.toml", "warns.toml"])
def test_closed_streams(spec, streams):
    """What nobody can read is dropped: the exit status and the other stream are as ever.

    Without standard output the run ended with status 2 and "Bad file descriptor".
    """
    plain, found = run(["peaks", spec]), closed(["peaks", spec], streams)
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
@pytest.mark.sampled(2)
@pytest.mark.parametrize("streams", CLOSED)
def test_nothing_else_gets_into_a_file(streams):
    """The file took the descriptor of the closed stream, and with it what was said there."""
    script = f'exec "$0" -c "$1" {streams}'
    command = ["sh", "-c", script, sys.executable, FILE]
    subprocess.run(command, stdin=subprocess.DEVNULL, check=True, timeout=60)
    with open("rows.csv", encoding="utf-8") as file:
        assert file.read() == "data\n"


FAULTY = """
import sys
from geneva_cli.cli.commands import peaks

def run(spec: str) -> None:
    {}["no\\nkey"]

peaks.run = run
from geneva_cli.__main__ import main
main()
"""


@pytest.mark.parametrize("debug", ["", "1"])
def test_a_fault_of_the_program(debug):
    """One line that names the command, and a status that no design has; a traceback on request."""
    command = [sys.executable, "-c", FAULTY, "peaks", "spec.toml"]
    environment = os.environ | {"GENEVA_DEBUG": debug}
    found = subprocess.run(
        command, capture_output=True, encoding="utf-8", timeout=60, env=environment
    )
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

signal.signal(signal.SIGINT, signal.default_int_handler if sys.argv[2] == "on" else signal.SIG_IGN)
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
    command = [sys.executable, "-c", INTERRUPTED, module]
    found = subprocess.run([*command, "on"], capture_output=True, encoding="utf-8", timeout=60)
    assert (found.returncode, found.stdout, found.stderr) == (130, "", "")


LINES = {
    "plot spec.toml --format svg": True,
    "report spec.toml --format html": True,
    "peaks spec.toml --format md": True,
    "peaks spec.toml --format csv": True,
    "help symbols": True,
    "schema": True,
    "new external": True,
    "peaks spec.toml": False,
}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("line", LINES)
@pytest.mark.parametrize("encoding", ["cp1252", "ascii"])
def test_files_on_standard_output_are_utf8(line, encoding):
    """An .svg in the console's encoding was not valid XML. Tables for people follow the console."""
    put("spec.toml", 'title = "Größe 六"\n[wheel]\nz = 6\n')
    command = [GENEVA, *line.split()]
    environment = os.environ | {"PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"}
    found = subprocess.run(command, capture_output=True, timeout=60, env=environment)
    utf8 = subprocess.run(
        command, capture_output=True, timeout=60, env=environment | {"PYTHONIOENCODING": "utf-8"}
    )
    assert found.returncode == 0 and b"\r" not in found.stdout
    assert LINES[line] == (found.stdout == utf8.stdout)
    if not LINES[line]:
        text = utf8.stdout.decode()
        assert found.stdout.decode(encoding) == text.encode(encoding, "backslashreplace").decode(
            encoding
        )


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
    found = subprocess.run([sys.executable, "-c", CLOSED_PIPE], capture_output=True, timeout=60)
    assert (found.returncode, found.stderr) == (141, b"")
