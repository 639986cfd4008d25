"""Where the repository's files are, for tests in any folder."""

import signal
from pathlib import Path

TESTS = Path(__file__).parent
ROOT = TESTS.parent
DESIGNS = ROOT / "designs"


def heed_signals() -> None:
    """In a child: whoever runs the tests may ignore signals (nohup, a job behind &)."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
