"""Writing a file as a whole or not at all, under a name that every system takes.

Two runs cannot hold one lock. Windows renames and removes no open file.
"""

import errno
import ntpath
import os
import re
import signal
import stat
import sys
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from importlib import import_module
from types import FrameType
from typing import Any, BinaryIO

from geneva_cli.errors import GenevaError, cut

try:
    import fcntl
except ImportError:  # in a browser and on Windows
    fcntl = None  # type: ignore[assignment]

POSIX = fcntl is not None
# The byte that is locked on Windows, where nobody else can read a locked one: past any file's end.
FAR = 1 << 40
# Windows has no SIGHUP, and only Windows has SIGBREAK: Ctrl-Break, and a closed console.
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS = [one for one in signal.Signals if one.name in ENDING]
# What Windows refuses in a name, and why; a hidden stream follows a colon, and the names of devices
# are reserved whatever the extension.
DEVICES = r"con|prn|aux|nul|conin\$|conout\$|(?:com|lpt)[1-9¹²³]"
REFUSED = {
    "takes no {!r} in a name": r'(["*:<>?|/\\\x00-\x1f])',
    "drops a dot or a space at the end of a name": r"([. ])\Z",
    'reserves the name "{}" for a device': rf"\A({DEVICES}) *(?:\.|\Z)",
}


def write(path: str, chunks: Iterable[str] | Iterable[bytes], inputs: Iterable[str] = ()) -> None:
    """Write texts or bytes to ``path``, which is the complete old or new file at every moment.

    Raises GenevaError if it cannot be written, is read-only, or is one of ``inputs``.
    """
    with replacing(path, inputs) as file:
        file.writelines(one.encode() if isinstance(one, str) else one for one in chunks)


def _stop(number: int, frame: FrameType | None) -> None:
    """Raise SystemExit, which cleans up; a second signal does not interrupt that."""
    for other in SIGNALS:
        signal.signal(other, signal.SIG_IGN)
    sys.exit(128 + number)


@contextmanager
def answering(handler: Any = _stop) -> Iterator[None]:
    """Answer the signals that end a run by ``handler`` in the block; ignored ones stay so."""
    with ExitStack() as before:
        for number in SIGNALS:
            with suppress(ValueError):  # only the main thread of a program may set signals
                if signal.getsignal(number) not in (signal.SIG_IGN, handler):
                    before.callback(signal.signal, number, signal.signal(number, handler))
        yield


@contextmanager
def replacing(path: str, inputs: Iterable[str] = ()) -> Iterator[BinaryIO]:
    """Open a file that replaces ``path``, with its owner, if the block ends without an error.

    It is a locked file beside ``path``, which takes its name at the end; one that a killed run has
    left is used again. A device or a pipe is written to directly.
    """
    with write_errors(path), answering(), ExitStack() as at_error:
        real, old = place(path, inputs)
        if old is not None and not stat.S_ISREG(old.st_mode):
            yield at_error.enter_context(open(real, "wb"))
            return
        folder, name = os.path.split(real)
        # The temporary name holds 200 bytes of it: a file system allows 255 in all.
        name = name.encode(errors="surrogateescape")[:200].decode(errors="replace")
        own, late = os.path.join(folder, f".{name}.geneva.tmp"), list[Any]()
        with answering(lambda *got: late.append(got)):  # the file is ours, or not there
            file = open_locked(own, path)
            at_error.callback(remove, file, own)
        if late:
            _stop(*late[0])
        file.truncate()
        take_after(file.fileno(), old)
        yield file
        file.flush()
        os.fsync(file.fileno())
        if not POSIX:
            file.close()
        os.replace(own, real)
        at_error.pop_all()
        file.close()


def open_locked(path: str, shown: str) -> BinaryIO:
    """Open a file that this run alone writes. Raises GenevaError if another run has it."""
    if os.path.lexists(path) and not stat.S_ISREG(os.lstat(path).st_mode):
        raise GenevaError(f"{cut(path, 300)}: not a file; rename it, or give -o another name")
    file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
    with suppress(FileNotFoundError):  # just removed or renamed
        if _lock(file) and os.path.samestat(os.lstat(path), os.fstat(file.fileno())):
            return file
    file.close()
    raise GenevaError(f"{cut(shown, 300)}: another run is writing this; wait until it ends")


def _lock(file: BinaryIO) -> bool:
    """Lock a file for this run; False if another run has it."""
    try:
        if POSIX:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            windows: Any = import_module("msvcrt")
            file.seek(FAR)
            windows.locking(file.fileno(), windows.LK_NBLCK, 1)
            file.seek(0)
    except ImportError:  # a browser has one run
        return True
    except OSError as error:  # any other: a file system without locks
        return error.errno not in (errno.EAGAIN, errno.EACCES)
    return True


def remove(file: BinaryIO, path: str) -> None:
    """Remove an open, locked file, and close it."""
    if not POSIX:
        file.close()
    with suppress(FileNotFoundError, PermissionError):  # another run has opened it since
        os.unlink(path)
    file.close()


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
            advice = f"; make the folder {os.path.dirname(os.path.realpath(path))} first"
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
    for source in inputs if stat.S_ISREG(old.st_mode) else ():  # devices may be read and written
        with suppress(OSError, ValueError):  # ValueError: a word with a NUL, which is not a file
            if os.path.samestat(os.stat(0 if source == "<stdin>" else source), old):
                raise GenevaError(
                    f"{path}: this file is an input, and would be overwritten; give -o another name"
                )
    if stat.S_ISDIR(old.st_mode):
        raise IsADirectoryError(errno.EISDIR, "")
    if not old.st_mode & stat.S_IWUSR or not os.access(real, os.W_OK):
        raise GenevaError(f"{path}: this file is read-only; allow writing, or give -o another name")
    return real, old


def real_path(path: str) -> str:
    """The path without links. Raises GenevaError if no file or folder can have it."""
    if not path or "\0" in path:
        raise GenevaError(f'-o "{path}": not the name of a file or folder')
    if sys.platform == "win32":
        for name in ntpath.splitdrive(path)[1].replace("/", "\\").split("\\"):
            refuse_name(name)
    try:
        return os.path.realpath(path)
    except FileNotFoundError:
        raise GenevaError(f'-o "{path}": the current folder is gone; change to another') from None


def refuse_name(name: str) -> None:
    """Raise GenevaError if Windows takes no file or folder of this name."""
    for why, pattern in REFUSED.items():
        bad = re.search(pattern, name, re.IGNORECASE)
        if bad and name not in (".", ".."):
            why = why.format(bad[1])
            raise GenevaError(f'"{cut(name, 300)}": Windows {why}; give another name')


def take_after(place: str | int, old: os.stat_result | None) -> None:
    """Give a path or an open file owner and permissions of the old file, as far as a user may.

    Windows has one permission, to write, and a file without it was refused.
    """
    if POSIX and old:
        with suppress(PermissionError):
            os.chown(place, old.st_uid, old.st_gid)
        os.chmod(place, stat.S_IMODE(old.st_mode))
