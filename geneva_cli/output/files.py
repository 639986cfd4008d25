"""Writing a file as a whole or not at all, under a name that every system takes.

Locks, which two runs cannot hold at once, and signals that end a run, are on every system. A file
that is renamed or removed stays locked until then, except on Windows, which renames and removes no
open file.
"""

from __future__ import annotations

import errno
import hashlib
import ntpath
import os
import re
import signal
import stat
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import BinaryIO

from geneva_cli.errors import GenevaError, cut

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
# Windows has no SIGHUP, and only Windows has SIGBREAK: Ctrl-Break, and a closed console.
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS = [getattr(signal, name) for name in NAMES if hasattr(signal, name)]

# Left behind only by kill -9 or a power failure, until the next run that writes this file.
TEMPORARY = ".{name}.geneva-{number}.tmp"
FORBIDDEN = {*'"*:<>?|/\\', *map(chr, range(32))}  # of Windows; after a colon is a hidden stream
DEVICES = {"CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"}  # whatever the extension
DEVICES |= {port + number for port in ("COM", "LPT") for number in "123456789¹²³"}

_waiting: list[int] | None = None  # the signals that came while they are held


def write(path: str, chunks: Iterable[str] | Iterable[bytes], inputs: Iterable[str] = ()) -> None:
    """Write texts or bytes to ``path`` so that at every moment the old or new file is complete.

    They go to a temporary file in the same folder, which then replaces the old one and takes its
    owner and permissions. A device or a pipe is written to directly. Raises GenevaError if the file
    cannot be written, is read-only, or is one of ``inputs``.
    """
    with replacing(path, inputs) as file:
        file.writelines(one.encode() if isinstance(one, str) else one for one in chunks)


@contextmanager
def replacing(path: str, inputs: Iterable[str] = ()) -> Iterator[BinaryIO]:
    """Open a file that replaces ``path`` if the block ends without an error.

    It is a locked file beside ``path``, which takes its name at the end.
    """
    with write_errors(path), stopping_cleanly():
        real, old = place(path, inputs)
        if old is not None and not stat.S_ISREG(old.st_mode):
            with open(real, "wb") as file:
                yield file
            return
        folder, name = os.path.split(real)
        # The temporary name holds 200 bytes of it: a file system allows 255 in all.
        name = name.encode(errors="surrogateescape")[:200].decode(errors="replace")
        _remove_stale(folder, name)
        own, number = "", os.getpid()
        while not own or os.path.lexists(own):  # another run's file must not be touched
            own = os.path.join(folder, TEMPORARY.format(name=name, number=number))
            number += 1
        try:
            with open(own, "xb") as file:
                lock(file.fileno())
                if old is not None:
                    take_after(file.fileno(), old)
                yield file
                file.flush()
                os.fsync(file.fileno())
                if not POSIX:  # Windows renames no open file
                    file.close()
                os.replace(own, real)
        finally:
            with suppress(FileNotFoundError):
                os.unlink(own)


def _remove_stale(folder: str, name: str) -> None:
    """Remove temporary files of killed runs, of which nobody holds the lock."""
    left = re.compile(rf"\.{re.escape(name)}\.geneva-\d{{1,9}}\.tmp")
    with suppress(OSError):  # a folder that can be written but not listed
        for entry in filter(left.fullmatch, os.listdir(folder)):
            stale = os.path.join(folder, entry)
            with suppress(OSError), open(os.open(stale, os.O_RDONLY | CAREFUL), "rb") as file:
                if lock(file.fileno()) and stat.S_ISREG(os.lstat(stale).st_mode):
                    remove(file, stale)


@contextmanager
def write_errors(path: str) -> Iterator[None]:
    """Turn system errors about a file into GenevaError."""
    try:
        yield
    except OSError as error:
        advice = "; give a file's name" if error.errno == errno.EISDIR else ""
        if error.errno == errno.EACCES and not POSIX:
            advice = "; close the file in other programs, or give another name"
        if error.errno == errno.ENOENT:
            folder = os.path.dirname(os.path.realpath(path))
            advice = f"; make the folder {folder} first"
            if os.path.isdir(folder):  # one of the system may take no new files
                advice = f"; the folder {folder} takes no files"
        # Windows has texts of its own, in its language
        why = os.strerror(error.errno) if error.errno else error.strerror
        raise GenevaError(f"{cut(path, 300)}: cannot write: {why}{advice}") from None


def place(path: str, inputs: Iterable[str] = ()) -> tuple[str, os.stat_result | None]:
    """The real path of a file to write, and the status of the existing file.

    Raises GenevaError, or OSError, if it must not or cannot be written.
    """
    real = real_path(path)
    try:
        old = os.stat(real)
    except FileNotFoundError:
        return real, None
    refuse_input(path, old, inputs)
    if stat.S_ISDIR(old.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not old.st_mode & stat.S_IWUSR or not os.access(real, os.W_OK):
        raise GenevaError(f"{path}: this file is read-only; allow writing, or give -o another name")
    return real, old


def real_path(path: str, what: str = "a file") -> str:
    """The path without links. Raises GenevaError if it is no name of ``what``."""
    if not path or "\0" in path:
        raise GenevaError(f'-o "{path}": not {what}\'s name')
    require_possible(path)
    try:
        return os.path.realpath(path)
    except FileNotFoundError:
        raise GenevaError(f'-o "{path}": the current folder is gone; change to another') from None


def require_possible(path: str, platform: str = sys.platform) -> None:
    """Raise GenevaError for a path with a name that this platform does not give to a file."""
    if platform == "win32":
        for name in ntpath.splitdrive(path)[1].replace("/", "\\").split("\\"):
            if why := fault(name):
                raise GenevaError(f'"{cut(path, 300)}": {why}; give another name')


def fault(name: str) -> str:
    """Why Windows takes no file or folder of this name; empty if it does.

    >>> fault("nul.csv"), fault("null.csv")
    ('Windows reserves the name "nul" for a device', '')
    """
    if name in ("", ".", ".."):
        return ""
    if signs := sorted(FORBIDDEN & {*name}):
        return f"Windows takes no {signs[0]!r} in a name"
    if name[-1] in ". ":
        return "Windows drops a dot or a space at the end of a name"
    stem = name.partition(".")[0].rstrip(" ")
    return f'Windows reserves the name "{stem}" for a device' if stem.upper() in DEVICES else ""


def refuse_input(path: str, old: os.stat_result, inputs: Iterable[str]) -> None:
    """Refuse to replace a regular file that the run has read.

    Terminals and devices may be both read and written.
    """
    stdin = "<stdin>"  # among the inputs, if the spec was read from standard input
    for source in inputs if stat.S_ISREG(old.st_mode) else ():
        try:
            read = os.fstat(0) if source == stdin else os.stat(source)
        except (OSError, ValueError):  # ValueError: a word with a NUL, which is not a file
            continue
        if os.path.samestat(read, old):
            name = f"{path} (standard input)" if source == stdin else source
            raise GenevaError(
                f"{name}: this file is an input, and would be overwritten; give -o another name"
            )


def take_after(descriptor: int, old: os.stat_result) -> None:
    """Copy owner and permissions of the old file; a user without that right keeps the file.

    Windows has one permission, to write, and a file without it was refused.
    """
    if not POSIX:
        return
    new = os.fstat(descriptor)
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
        with suppress(PermissionError):
            os.fchown(descriptor, old.st_uid, old.st_gid)
    os.fchmod(descriptor, stat.S_IMODE(old.st_mode))


def digest_of(path: str) -> str:
    """The checksum of a file; empty for what is no file."""
    if not os.path.isfile(path):
        return ""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def lock(descriptor: int, busy: str = "", alone: bool = False) -> bool:
    """Lock a file for this process and its workers, or for this process alone; True if it is.

    A worker may outlive a killed run for a moment, and would block the next run. It is not locked
    where there are no locks, or if another process has the lock; with a text ``busy`` that raises
    GenevaError.
    """
    try:
        if fcntl is not None:
            (fcntl.lockf if alone else fcntl.flock)(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        elif msvcrt is not None:
            position = os.lseek(descriptor, 0, os.SEEK_CUR)
            os.lseek(descriptor, FAR, os.SEEK_SET)
            try:
                msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
            finally:
                os.lseek(descriptor, position, os.SEEK_SET)
    except OSError as error:  # any other: a file system without locks
        if busy and error.errno in (errno.EAGAIN, errno.EACCES):
            raise GenevaError(busy) from None
        return False
    return fcntl is not None or msvcrt is not None


def remove(file: BinaryIO, path: str) -> None:
    """Remove an open, locked file."""
    if POSIX:
        os.unlink(path)
        return
    file.close()  # Windows removes no open file
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
