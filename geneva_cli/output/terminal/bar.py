"""A progress bar on standard error, with the remaining time."""

import sys
import time

from geneva_cli.streams import columns


class TextBar:
    """A bar of one line, which is overwritten and finally removed.

    It uses plain characters only, so it works on any terminal, whatever TERM says.
    """

    after_s = 1.0  # shorter work shows no bar
    every_s = 0.1  # nobody reads faster updates

    def __init__(self, what: str, total: int) -> None:
        self.what, self.total = what, total
        self.begun = time.monotonic()
        self.next = self.begun + self.after_s
        self.length = 0  # characters of the bar on the screen

    def update(self, done: int) -> None:
        """Draw the bar if it is time to."""
        now = time.monotonic()
        if now >= self.next:
            self.next = now + self.every_s
            self._write(self._line(done, now - self.begun))

    def close(self) -> None:
        """Remove the bar."""
        if self.length:
            self._write("")
            sys.stderr.write("\r")
            sys.stderr.flush()

    def _line(self, done: int, seconds: float) -> str:
        left = seconds * (self.total - done) / done if done else None
        text = f"{done:,} of {self.total:,} {self.what}"
        text += f", {_time(left)} left" if left is not None else ""
        width = min(30, columns() - len(text) - len(" []") - 1)  # columns of the bar itself
        if width < 8:  # a smaller bar shows nothing
            return text[: columns() - 1]
        full = width * done // self.total
        return f"[{'#' * full}{'-' * (width - full)}] {text}"

    def _write(self, line: str) -> None:
        sys.stderr.write(f"\r{line.ljust(self.length)}")
        sys.stderr.flush()
        self.length = len(line)


def _time(seconds: float) -> str:
    """Minutes and seconds, with hours if needed.

    >>> _time(75.2), _time(7384)
    ('1:15', '2:03:04')
    """
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
