"""On a terminal of 60 columns or more nothing is wider than the window, and nothing is cut.

What the manual's commands print is looked at where test_manual.py runs them.
"""

import os
import random
import struct
import subprocess

import pytest
import repo
from repo import GENEVA
from typer.testing import CliRunner
from windows import COLUMNS, bare, look_at_page, look_at_table, require_width

from geneva_cli import output
from geneva_cli.cli.app import COMMANDS, app
from geneva_cli.cli.pages import page
from geneva_cli.manual import TOPICS
from geneva_cli.output.terminal.layout import Window
from geneva_cli.output.terminal.terminal_tables import chunks
from geneva_cli.table import Reading, record_table, rows_table

LOOKS = ({"TERM": "xterm-256color"}, {"TERM": "dumb"}, {"TERM": "xterm", "NO_COLOR": "1"})


def seen(monkeypatch, columns, *words):
    """What a run prints where its standard output is a terminal."""
    monkeypatch.setattr(output, "is_seen", lambda file: file == "-")
    monkeypatch.setenv("COLUMNS", str(columns))
    # where it is not told, help takes 80 columns in a test, and elsewhere two less than there are
    width = min(columns, 80) - 2
    result = CliRunner().invoke(app, words, prog_name="geneva", terminal_width=width)
    assert result.exit_code == 0, result.output
    return [bare(line) for line in result.stdout.splitlines()]


def on_a_terminal(columns, environment, *words):
    """The same in a process of its own, on a pseudo-terminal."""
    import fcntl
    import pty
    import termios

    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    kept = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR", "TERM")}
    with subprocess.Popen([GENEVA, *words], stdout=slave, stderr=slave, env=kept | environment):
        os.close(slave)
        return repo.read_terminal(master).decode().splitlines()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("columns", COLUMNS)
def test_help_fits(monkeypatch, columns):
    for name in COMMANDS:
        require_width(seen(monkeypatch, columns, name, "--help"), columns)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("topic", TOPICS)
def test_pages_fit(topic):
    look_at_page(page(topic))


@repo.posix("pseudo-terminals")
@pytest.mark.long
@pytest.mark.parametrize("environment", LOOKS, ids=str)
def test_a_terminal_itself_says_how_wide_it_is(environment):
    """And what it can show; messages on standard error are broken between words too."""
    design = str(repo.DESIGNS / "turret.toml")
    lines = on_a_terminal(72, environment, "loads", design)
    require_width(lines, 72)
    assert any("\x1b[" in line for line in lines) == (environment == LOOKS[0])
    assert max(map(len, map(bare, lines))) > 60


def paged(tmp_path, *words, pager="cat > seen", **environment):
    """The lines on a terminal of 24 lines, and what its pager got, None where none ran."""
    file, before = tmp_path / "seen", os.getcwd()
    file.unlink(missing_ok=True)
    os.chdir(tmp_path)
    try:
        lines = on_a_terminal(80, {"TERM": "xterm", "PAGER": pager} | environment, *words)
    finally:
        os.chdir(before)
    return lines, file.read_text(encoding="utf-8").splitlines() if file.exists() else None


def test_long_output_stops_in_the_pager(tmp_path):
    """And nowhere else: not what a screen holds, and not where nobody turns a page."""
    lines, seen = paged(tmp_path, "help", "symbols")
    assert lines == [] and len(seen) > 24 and "Symbols and conventions" in seen[0]
    assert paged(tmp_path, "help", "symbols", pager="no-such-pager")[0] == seen
    assert paged(tmp_path, "help", "symbols", "--no-pager") == (seen, None)
    lines, seen = paged(tmp_path, "help", "symbols", TERM="dumb")
    assert len(lines) > 24 and seen is None
    assert paged(tmp_path, "table")[1] is None


def test_a_pager_that_is_left_early_does_not_change_the_exit_status(tmp_path):
    """The reader saw enough; a design that fails still fails."""
    import pty

    spec = tmp_path / "z6.toml"
    spec.write_text("[wheel]\nz = 6\n[limits]\nvelocity_max = 0.9\n", encoding="utf-8")
    environment = os.environ | {"TERM": "xterm", "PAGER": "head -n 1", "LINES": "5"}
    master, slave = pty.openpty()
    command = [GENEVA, "check", "-v", str(spec)]
    with subprocess.Popen(command, stdout=slave, stderr=slave, env=environment) as run:
        os.close(slave)
        shown = repo.read_terminal(master).decode()
    assert run.returncode == 1 and shown.count("\n") == 1 and "z6.toml:" in shown


def test_a_wrong_column_is_refused_with_the_nearest():
    result = CliRunner().invoke(app, ["table", "--columns", "acceleration"])
    assert result.exit_code == 2
    said = result.stderr.rpartition("there are ")[2].split(", ")
    assert len(said) <= 5 and "acceleration_max" in said


def test_columns_where_no_table_is_printed_are_refused(tmp_path):
    design, file = str(repo.DESIGNS / "turret.toml"), tmp_path / "wheel.dxf"
    words = ["profile", design, "--part", "wheel", "-o", str(file), "--columns", "x_mm"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 2 and "--columns is for tables" in result.stderr
    assert not file.exists()


def test_a_column_that_decides_is_never_left_out():
    """Whether parts can be built, and which of two kinds has a key."""
    names = ("no", "machine", "peak_a", "peak_b", "peak_c", "peak_d", "parts")
    peaks = [[-1.2345e-9 * i * j for j in (3, 4, 5, 6)] for i in (1, 2)]
    rows = [(i, f"four-bar {i} 52.4 154", *peaks[i - 1], f"no: island {i}") for i in (1, 2)]
    for decide in ((), ("parts",)):
        reading = Reading(names, decide=decide)
        text = "\n".join(lines_of(rows_table(names, rows).replaced(reading=reading), 60))
        assert ("no: island" in text) == bool(decide)


def lines_of(table, columns):
    return "".join(chunks(table, Window(columns))).splitlines()


def test_what_is_alike_in_every_row_is_said_once():
    table = rows_table(("z", "drive", "cycle_s"), [(3, "crank", 1.0), (4, "crank", 1.0)])
    assert lines_of(table, 80) == [
        "In every row: drive crank; cycle 1 s.",
        "",
        "slots",
        "    3",
        "    4",
    ]


def any_value(rng, kind):
    words = ["a", "wheel's", "slot_width_mm", "12.5", "x" * 20, "輪の", "greatest"]
    values = {
        "number": lambda: rng.choice((1, -1)) * 10 ** rng.uniform(-12, 12),
        "count": lambda: rng.randrange(10 ** rng.randrange(1, 9)),
        "truth": lambda: rng.random() < 0.5,
        "prose": lambda: " ".join(rng.choices(words, k=rng.randrange(15))),
        "same": lambda: 1.5,
    }
    return None if rng.random() < 0.15 else values[kind]()


@pytest.mark.sampled(9)
@pytest.mark.parametrize("seed", range(30))
def test_any_table_fits(seed):
    """Of up to 24 columns of all kinds, with values that are not there and with wide letters."""
    rng = random.Random(seed)
    kinds = rng.choices(("number", "number", "count", "truth", "prose", "same"), k=1 + seed % 24)
    names = [f"{rng.choice(('motion', 'k_r', 'loads.pin_N'))}_{i}_mm" for i in range(len(kinds))]
    rows = [[any_value(rng, kind) for kind in kinds] for _ in range(seed % 6)]
    table = rows_table(names, rows, mixed=seed % 3 == 0)
    look_at_table(table)
    look_at_table(record_table({"x": 1.0, "t": table, "g.y_mm": 2.0}, "Title " * 20, "Prose " * 50))


def test_a_page_is_not_for_a_terminal(monkeypatch):
    """It would fill the screen with half a megabyte of HTML."""
    monkeypatch.setattr(output, "is_seen", lambda file: True)
    result = CliRunner().invoke(app, ["animate", str(repo.DESIGNS / "turret.toml")])
    assert result.exit_code == 2 and "a page is not for a terminal: give -o FILE" in result.stderr
