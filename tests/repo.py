"""Where the repository's files are, for tests in any folder."""

import os
import signal
import sys
from pathlib import Path

TESTS = Path(__file__).parent
ROOT = TESTS.parent
DESIGNS = ROOT / "designs"
# designs of wheels that rollers turn: a rack has no angle, and a counter's speed jumps, so that
# they have tests of their own
WHEELS = sorted(p for p in DESIGNS.glob("*.toml") if p.stem not in ("linear", "odometer"))
GENEVA = os.path.join(os.path.dirname(sys.executable), "geneva")  # the installed command


def heed_signals() -> None:
    """In a child: whoever runs the tests may ignore signals (nohup, a job behind &)."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def read_terminal(master: int) -> bytes:
    """All that is said to a pseudo-terminal whose other end only a child has open."""
    said = b""
    try:
        while piece := os.read(master, 65536):
            said += piece
    except OSError:  # Linux: the other end is closed
        pass
    os.close(master)
    return said
