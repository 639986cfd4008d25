"""A progress bar on standard error, with the remaining time."""

import sys
import time
from datetime import timedelta

from geneva_cli.streams import columns

AFTER_S = 1.0  # shorter work shows no bar
EVERY_S = 0.1  # nobody reads faster updates
LONG = 30  # letters of the bar itself


class Bar:
    """A bar of one line, which is finally removed."""

    def __init__(self, what: str, total: int) -> None:
        self.what, self.total = what, total
        self.start = time.monotonic()
        self.next = self.start + AFTER_S
        self.shown = ""

    def update(self, done: int) -> None:
        """Draw the bar if it is time to."""
        now = time.monotonic()
        if now < self.next or not done:
            return
        self.next = now + EVERY_S
        left = timedelta(seconds=round((now - self.start) * (self.total - done) / done))
        full, empty = "━╌" if sys.stderr.encoding.startswith("utf") else "#-"
        drawn = (full * (LONG * done // self.total)).ljust(LONG, empty)
        self._draw(f"{drawn} {done}/{self.total} {self.what}, {left} left"[: columns() - 1])

    def close(self) -> None:
        """Remove the bar."""
        if self.shown:
            self._draw("")
            print(end="\r", file=sys.stderr, flush=True)

    def _draw(self, line: str) -> None:
        """Replace the line that is shown; no escapes, which some consoles of Windows lack."""
        print(end=f"\r{line.ljust(len(self.shown))}", file=sys.stderr, flush=True)
        self.shown = line
