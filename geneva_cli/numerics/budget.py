"""A bound on the processor's time for what is only tried: asked in every loop that may be long."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_deadline: ContextVar[float] = ContextVar("deadline", default=math.inf)


class OutOfTime(Exception):
    """What is tried takes longer than it may. No fault of the spec's, so no GenevaError."""


@contextmanager
def until(deadline: float) -> Iterator[None]:
    """Within it ``ask`` raises OutOfTime past a deadline, in seconds of ``time.process_time``."""
    before = _deadline.set(deadline)
    try:
        yield
    finally:
        _deadline.reset(before)


def ask() -> None:
    """Raise OutOfTime where there is a deadline, and it is past."""
    deadline = _deadline.get()
    if deadline < math.inf and time.process_time() > deadline:
        raise OutOfTime
