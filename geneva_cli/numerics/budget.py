"""A limit on processor time for trials: every loop that may be long checks it."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_deadline: ContextVar[float] = ContextVar("deadline", default=math.inf)


class OutOfTime(Exception):
    """A trial takes longer than it may: not a fault of the spec, so not a GenevaError."""


@contextmanager
def time_limit(deadline: float) -> Iterator[None]:
    """A context in which ``check_time`` raises OutOfTime once ``time.process_time()`` is past
    ``deadline`` (seconds).
    """
    before = _deadline.set(deadline)
    try:
        yield
    finally:
        _deadline.reset(before)


def check_time() -> None:
    """Raise OutOfTime if the deadline of a surrounding ``time_limit`` is past."""
    deadline = _deadline.get()
    if deadline < math.inf and time.process_time() > deadline:
        raise OutOfTime
