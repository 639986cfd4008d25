"""Locks that two runs cannot hold at once, on every system, and signals that end a run.

A file that is renamed or removed stays locked until then, except on Windows, which renames and
removes no open file.
"""

from __future__ import annotations

import errno
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import IO

from geneva_cli.errors import GenevaError

try:
    import fcntl
except ImportError:  # in a browser and on Windows
    fcntl = None  # type: ignore[assignment]
try:
    import msvcrt
except ImportError:  # elsewhere than on Windows
    msvcrt = None  # type: ignore[assignment]

POSIX = fcntl is not None
# The byte that is locked on Windows, where nobody else can read a locked one: past any file's end.
FAR = 1 << 40
# How a file is opened that somebody may have replaced by a link or a pipe. Windows lacks both.
CAREFUL = sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK"))
FOLDER_LOCK = ".geneva-export.lock"
# Windows has no SIGHUP, and only Windows has SIGBREAK: Ctrl-Break, and a closed console.
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS = [getattr(signal, name) for name in NAMES if hasattr(signal, name)]

_waiting: list[int] | None = None  # the signals that came while they are held


def lock(descriptor: int, alone: bool = False) -> None:
    """Lock a file for this process and its workers, or for this process alone.

    A worker may outlive a killed run for a moment, and would block the next run. Raises OSError if
    another process has the lock, and where there are no locks.
    """
    if fcntl is not None:
        (fcntl.lockf if alone else fcntl.flock)(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return
    if msvcrt is None:
        raise OSError(errno.ENOLCK, "no locks here")
    position = os.lseek(descriptor, 0, os.SEEK_CUR)
    os.lseek(descriptor, FAR, os.SEEK_SET)
    try:
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
    finally:
        os.lseek(descriptor, position, os.SEEK_SET)


def lock_or_refuse(descriptor: int, says: str, alone: bool = False) -> None:
    """Lock a file. Raises GenevaError with a message if another run has the lock."""
    try:
        lock(descriptor, alone)
    except OSError as error:  # any other: a file system without locks
        if error.errno in (errno.EAGAIN, errno.EACCES):
            raise GenevaError(says) from None


@contextmanager
def folder_locked(folder: str, says: str) -> Iterator[None]:
    """Hold a folder's lock within the block. Raises GenevaError with a message if another run has.

    Windows opens no folder: there the lock is that of a file in it.
    """
    path = folder if POSIX else os.path.join(folder, FOLDER_LOCK)
    descriptor = os.open(path, os.O_RDONLY if POSIX else os.O_RDWR | os.O_CREAT)
    try:
        lock_or_refuse(descriptor, says)
        yield
    finally:
        os.close(descriptor)
        if not POSIX:
            with suppress(OSError):  # another run has opened it, and will remove it
                os.unlink(path)


def remove(file: IO[bytes], path: str) -> None:
    """Remove an open, locked file."""
    if POSIX:
        os.unlink(path)
        return
    file.close()
    with suppress(PermissionError):  # another run has opened it since, and will remove it
        os.unlink(path)


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
