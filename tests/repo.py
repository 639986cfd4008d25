"""Where the repository's files are, for tests in any folder."""

import functools
import os
import signal
import sysconfig
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ROOT = TESTS.parent
DESIGNS = ROOT / "designs"
# The installed command: Windows calls the folder Scripts, and adds .exe.
GENEVA = os.path.join(sysconfig.get_path("scripts"), "geneva")


def posix(reason: str) -> pytest.MarkDecorator:
    """A mark of tests that Windows leaves out, with what it lacks."""
    return pytest.mark.skipif(not hasattr(os, "fork"), reason=f"Windows has no {reason}")


@functools.cache
def wheels() -> list[Path]:
    """The designs whose output turns: what has no angle has tests of its own."""
    from geneva_cli import load

    return sorted(p for p in DESIGNS.glob("*.toml") if load(str(p)).spec.output.turns)


def put(name: str, text: str = "") -> None:
    """Write a file as it stands, in the current folder."""
    with open(name, "w", encoding="utf-8", newline="") as file:
        file.write(text)


def get(name: str) -> str:
    """The text of a file as it stands."""
    with open(name, encoding="utf-8", newline="") as file:
        return file.read()


def heed_signals() -> None:
    """Restore the default signals in a child: nohup and jobs behind & ignore them."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def read_terminal(master: int) -> bytes:
    """Return the output on a pseudo-terminal whose other end only a child has open."""
    output = b""
    try:
        while piece := os.read(master, 65536):
            output += piece
    except OSError:  # Linux: the other end is closed
        pass
    os.close(master)
    return output
