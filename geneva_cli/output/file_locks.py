"""Locks of files between processes.

A browser and Windows have no such locks. There a file counts as one of a file system without locks.
"""

from __future__ import annotations

import errno

try:
    import fcntl
except ImportError:
    fcntl = None  # type: ignore[assignment]


def lock(descriptor: int) -> None:
    """Lock a file for this process and its workers. Raises OSError if that is not possible."""
    _require_locks()
    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def lock_alone(descriptor: int) -> None:
    """Lock a file for this process, not for its workers. Raises OSError if not possible.

    A worker may outlive a killed run for a moment, and would block the next run.
    """
    _require_locks()
    fcntl.lockf(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _require_locks() -> None:
    if fcntl is None:
        raise OSError(errno.ENOLCK, "no locks here")
