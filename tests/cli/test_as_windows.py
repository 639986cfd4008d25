"""The whole program without what Windows lacks (``as_windows.py``): each command, format and lock.

On Windows itself the same runs take place with nothing left out.
"""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
import repo
from repo import get, put
from typer.testing import CliRunner

from geneva_cli.cli.app import COMMANDS, app
from geneva_cli.output import DOCUMENTS, DRAWN, FORMATS, PLOTTED, SHEETS

# as in as_windows.py, whose import hides them
MODULES = "fcntl", "resource", "termios", "pty", "pwd", "grp", "tty", "curses", "readline"
LAUNCHER = [sys.executable, str(repo.TESTS / "as_windows.py")]
LINES = """
table --z 6 -o table.txt
table --z 6 --internal -o table.csv
peaks spec.toml -o peaks.json
motion spec.toml --samples 9 -o motion.md
motion spec.toml --format cam -o axis.txt
loads spec.toml --set load.inertia_kgm2=0.05 -o loads.csv
vibration spec.toml --period-ratio 5 -o vibration.json
tolerance spec.toml --samples 9 --set tolerance.slot_angle_deg=0.05 -o peaks.json
laws -o laws.csv
check spec.toml -o check.json
report spec.toml -o report.html
report spec.toml -o report.pdf
synth --tau 1/3 --z 6 --write 1 -o new.toml
compare spec.toml --vary drive.n_rpm=60,90 -o compare.csv
sweep spec.toml --vary drive.n_rpm=1,30 --jobs 1 -o sweep.csv
profile spec.toml -o slot.csv
profile spec.toml --part wheel -o wheel.dxf
size spec.toml -o sized.toml
check spec.toml --wheel wheel.dxf -o drawn.json
profile spec.toml --part wheel -o wheel.svg
profile spec.toml --part wheel -o wheel.step
profile spec.toml --part wheel -o wheel.stl
profile spec.toml --part wheel -o wheel.3mf
profile spec.toml --part sheet -o sheet.pdf
plot spec.toml -o plot.svg
plot spec.toml -o plot.png
export spec.toml --for print -o shop
export spec.toml --for print -o shop
animate spec.toml -o page.html
animate spec.toml --open
help symbols
new external -o own.toml
new --from-design table-law -o law.toml
explain horn_mm -o explain.md
keys -o keys.csv
schema -o schema.json
""".strip().splitlines()


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    put("spec.toml", 'title = "Größe 六"\n[wheel]\nz = 4\n')
    return tmp_path


@pytest.fixture(autouse=True)
def environment(folder, monkeypatch):
    """No browser is opened, and temporary files are in the folder."""
    for name in ("TMP", "TEMP", "TMPDIR"):
        monkeypatch.setenv(name, str(folder))
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("BROWSER", "none")


def results(lines):
    """Status, output and messages of each line, all run in one process."""
    text = "".join(json.dumps(line.split()) + "\n" for line in lines)
    run = subprocess.run(LAUNCHER, input=text, capture_output=True, encoding="utf-8", timeout=300)
    assert run.returncode == 0, run.stderr
    return [json.loads(line) for line in run.stdout.splitlines()]


def unfinished():
    return [name for name in os.listdir() if name.endswith((".tmp", ".geneva"))]


def test_no_test_imports_what_windows_lacks():
    """At its top: a function of a test that is marked for it may."""
    top = re.compile(rf"^(?:import|from) (?:{'|'.join(MODULES)})\b", re.MULTILINE)
    files = [*repo.TESTS.rglob("*.py")]
    assert len(files) > 100
    wrong = [file for file in files if top.search(file.read_text(encoding="utf-8"))]
    assert wrong == []


def test_every_command_and_format():
    assert {line.split()[0] for line in LINES} == {*COMMANDS}
    for line, (status, _, said) in zip(LINES, results(LINES), strict=True):
        assert status == 0, (line, said)
    files = {word for line in LINES for word in line.split() if "." in word} - {"symbols"}
    formats = {"txt" if name == "table" else name for name in FORMATS}
    formats |= {*DRAWN, *SHEETS, *PLOTTED, *DOCUMENTS}
    assert formats <= {name.rpartition(".")[2] for name in files}
    assert all(os.path.getsize(line.split()[-1]) for line in LINES if " -o " in line)
    assert unfinished() == []
    assert all(name[0] != "." for name in os.listdir("shop"))
    assert "Größe 六" in get("page.html")


# four blocks of four rows
VARIED = ["sweep", "spec.toml", "--vary", "drive.n_rpm=1..16", "--check", "-o", "rows.csv"]


def stop(words, begun):
    """Run some words, and stop them as Ctrl-C or Ctrl-Break does once ``begun()`` is true."""
    group = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP} if os.name == "nt" else {}
    process = subprocess.Popen(
        [*LAUNCHER, *words], stderr=subprocess.PIPE, encoding="utf-8", **group
    )
    deadline = time.monotonic() + 60
    while not begun() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    assert process.poll() is None, "it ended before it could be stopped"
    process.send_signal(signal.CTRL_BREAK_EVENT if os.name == "nt" else signal.SIGINT)
    assert "Traceback" not in process.communicate(timeout=30)[1]
    return process.returncode


def has_rows():
    """Return True if a sweep has kept a block of rows."""
    return os.path.exists("rows.csv.geneva") and get("rows.csv.geneva").count("\nblock ") > 1


def test_a_stopped_sweep_of_two_processes_goes_on():
    """The processes are started anew, as there is no fork; the rows are those of one process."""
    status = stop([*VARIED, "--jobs", "2"], has_rows)
    assert status == 130 or os.name == "nt"
    assert not os.path.exists("rows.csv")
    ((status, _, said),) = results([" ".join([*VARIED, "--jobs", "2", "--resume"])])
    assert status == 0 and "continues after row" in said
    alone = [*VARIED[:-1], "alone.csv", "--jobs", "1"]
    assert CliRunner().invoke(app, alone).exit_code == 0
    assert get("rows.csv") == get("alone.csv")


def test_a_file_stopped_in_the_middle_stays_the_old_one():
    put("motion.csv", "old")
    stop(["motion", "spec.toml", "--samples", "100000", "-o", "motion.csv"], unfinished)
    assert get("motion.csv") == "old"
    assert unfinished() == []


HOLD = """
import sys
import as_windows  # it leaves out what Windows lacks
from geneva_cli.output.folder import Row, filling_folder
from geneva_cli.output.growing import growing
with growing(["a", "b"], "request", "rows.csv") as rows:
    with filling_folder("shop", [Row("a.txt", "a text")]) as (new, _):
        rows.append([[1], [2]])
        print("held", flush=True)
        sys.stdin.readline()
        open(new + "/a.txt", "w").close()
"""


def test_two_writers(monkeypatch):
    """The second is refused before it computes, and the first ends as if it were alone."""
    monkeypatch.setenv("PYTHONPATH", str(repo.TESTS))
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "encoding": "utf-8"}
    with subprocess.Popen([sys.executable, "-c", HOLD], **pipes) as process:
        assert process.stdout.readline() == "held\n"
        rows, folder = results([" ".join(VARIED), "export spec.toml --for print -o shop"])
        process.communicate("\n")
    assert process.returncode == 0
    assert (rows[0], folder[0]) == (2, 2)
    assert all("another run is writing this" in said for _, _, said in (rows, folder))
    assert get("rows.csv") == "a,b\n1,2\n"
    assert sorted(os.listdir("shop")) == ["a.txt", "contents.csv"]
    assert unfinished() == []
