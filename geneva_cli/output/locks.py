"""Locks that two runs cannot hold at once, on every system.

A file that is renamed or removed stays locked until then, except on Windows, which renames and
removes no open file.
"""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from typing import IO, Any

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


def lock(descriptor: int, alone: bool = False) -> None:
    """Lock a file for this process and its workers, or for this process alone.

    A worker may outlive a killed run for a moment, and would block the next run. Raises OSError if
    another process has the lock, and where there are no locks.
    """
    if fcntl is not None:
        (fcntl.lockf if alone else fcntl.flock)(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    elif msvcrt is not None:
        _lock_far(descriptor, msvcrt)
    else:
        raise OSError(errno.ENOLCK, "no locks here")


def _lock_far(descriptor: int, windows: Any) -> None:
    position = os.lseek(descriptor, 0, os.SEEK_CUR)
    os.lseek(descriptor, FAR, os.SEEK_SET)
    try:
        windows.locking(descriptor, windows.LK_NBLCK, 1)
    finally:
        os.lseek(descriptor, position, os.SEEK_SET)


def lock_or_refuse(descriptor: int, says: str, alone: bool = False) -> None:
    """Lock a file. Raises GenevaError with a message if another run has the lock."""
    try:
        lock(descriptor, alone)
    except OSError as error:  # any other: a file system without locks
        if error.errno in (errno.EAGAIN, errno.EACCES):
            raise GenevaError(says) from None


def open_to_lock(folder: str) -> int:
    """A descriptor whose lock is that of a folder."""
    if POSIX:
        return os.open(folder, os.O_RDONLY)
    return os.open(os.path.join(folder, FOLDER_LOCK), os.O_RDWR | os.O_CREAT)


def close_folder(descriptor: int, folder: str) -> None:
    """End the lock of a folder."""
    os.close(descriptor)
    if not POSIX:
        with suppress(OSError):  # another run has opened it, and will remove it
            os.unlink(os.path.join(folder, FOLDER_LOCK))


def rename(file: IO[bytes], path: str, target: str) -> None:
    """Rename an open, locked file, which replaces the target."""
    if not POSIX:
        file.close()
    os.replace(path, target)


def remove(file: IO[Any], path: str) -> None:
    """Remove an open, locked file."""
    if POSIX:
        os.unlink(path)
        return
    file.close()
    with suppress(PermissionError):  # another run has opened it since, and will remove it
        os.unlink(path)
