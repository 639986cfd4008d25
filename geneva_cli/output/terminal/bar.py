"""A progress bar on standard error, by Rich, with the remaining time."""

import time
from typing import Any

AFTER_S = 1.0  # shorter work shows no bar, and does without Rich
EVERY_S = 0.1  # nobody reads faster updates


class Bar:
    """A bar of one line, which is finally removed."""

    def __init__(self, what: str, total: int) -> None:
        self.what, self.total = what, total
        self.next = time.monotonic() + AFTER_S
        self.shown: Any = None

    def update(self, done: int) -> None:
        """Draw the bar if it is time to."""
        if time.monotonic() < self.next:
            return
        if self.shown is None:
            self.shown = _started(self.what, self.total)
        self.shown.update(self.shown.task_ids[0], completed=done, refresh=True)
        self.next = time.monotonic() + EVERY_S

    def close(self) -> None:
        """Remove the bar."""
        if self.shown:
            self.shown.stop()


def _started(what: str, total: int) -> Any:
    from rich import progress
    from rich.console import Console

    class Screen(Console):
        """The terminal, whose cursor stays: a run that is killed could not give it back."""

        def show_cursor(self, show: bool = True) -> bool:
            return False

    shown = progress.Progress(
        progress.BarColumn(30),
        progress.MofNCompleteColumn(),
        progress.TextColumn(f"{what},"),
        progress.TimeRemainingColumn(),
        progress.TextColumn("left"),
        console=Screen(stderr=True),
        transient=True,
        auto_refresh=False,  # no thread, as processes are forked meanwhile
        redirect_stdout=False,
        redirect_stderr=False,
    )
    shown.add_task(what, total=total)
    shown.start()
    return shown
