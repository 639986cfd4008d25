"""Signals that end a run, which first removes what it has half written."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

# Windows has no SIGHUP, and only Windows has SIGBREAK: Ctrl-Break, and a closed console.
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS = [getattr(signal, name) for name in NAMES if hasattr(signal, name)]

_waiting: list[int] | None = None  # the signals that came while they are held


@contextmanager
def stopping_cleanly() -> Iterator[None]:
    """Make signals that end a run raise SystemExit, which cleans up; ignored ones stay so.

    A second signal does not interrupt the cleaning up.
    """
    handlers = {}
    for number in SIGNALS:
        # Only the main thread of a program may set signals.
        with suppress(ValueError):
            if signal.getsignal(number) not in (signal.SIG_IGN, _stop):
                handlers[number] = signal.signal(number, _stop)
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


@contextmanager
def holding_signals() -> Iterator[None]:
    """Let these signals wait for the end of a block that must not be left half done."""
    global _waiting
    _waiting = []
    try:
        yield
    finally:
        numbers, _waiting = _waiting, None
        if numbers:
            _stop(numbers[0], None)


def _stop(number: int, frame: FrameType | None) -> None:
    if _waiting is not None:
        _waiting.append(number)
        return
    for other in SIGNALS:
        if signal.getsignal(other) is _stop:
            signal.signal(other, signal.SIG_IGN)
    sys.exit(128 + number)
