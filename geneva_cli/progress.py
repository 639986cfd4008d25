"""Progress of long work, reported here by the work and shown by the command line.

Nothing is shown by default: only the command line sets ``maker``.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

T = TypeVar("T")


# Makes a bar, such as ``Bar``, from the word for the items and their number; None if nobody
# watches.
maker: Callable[[str, int], Any] | None = None
_shown: list[Any] = []  # at most one bar: work within other work is not shown


def close() -> None:
    """Remove the bar that is shown."""
    while _shown:
        _shown.pop().close()


class Meter:
    """The progress of one piece of work over ``total`` items; ``what`` is the word for them.

    Within other work that is shown it shows nothing.
    """

    def __init__(self, what: str, total: int) -> None:
        self.total = total
        # a bar of one item shows no progress, and would hide those of the work within
        self.bar = maker(what, total) if maker and not _shown and total > 1 else None
        if self.bar:
            _shown.append(self.bar)

    def report(self, done: int) -> None:
        """Report that ``done`` items are done; the last one ends the bar."""
        if self.bar:
            self.bar.update(done)
            if done >= self.total:
                self.close()

    def close(self) -> None:
        """Remove its bar."""
        if self.bar:
            close()
            self.bar = None


def tracked(
    items: Iterable[T], what: str, total: int, size: Callable[[T], int] | None = None
) -> Iterator[T]:
    """Yield the items and report how many of ``total`` are done; ``size`` of an item is 1."""
    meter, done = Meter(what, total), 0
    try:
        for item in items:
            yield item
            done += size(item) if size else 1
            meter.report(done)
    finally:
        meter.close()
