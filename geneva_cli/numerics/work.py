"""A count of the work that a search does, so that its limit is the same on every machine."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar


class Work:
    """Evaluations of functions of an angle at arrays of angles."""

    def __init__(self) -> None:
        self.evaluations = 0


_counted: ContextVar[Work | None] = ContextVar("counted", default=None)


@contextmanager
def counted() -> Iterator[Work]:
    """Count the evaluations within the block; those of a block inside it count there only."""
    work = Work()
    token = _counted.set(work)
    try:
        yield work
    finally:
        _counted.reset(token)


def count() -> None:
    """Count one evaluation, if anybody counts."""
    work = _counted.get()
    if work is not None:
        work.evaluations += 1
