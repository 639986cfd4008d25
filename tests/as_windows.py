"""Run geneva without what Windows lacks, as far as another system can leave it out.

    python tests/as_windows.py WORDS...     one command line, as the installed command runs it
    python tests/as_windows.py < LINES      many in one process: a JSON list of words a line

The second prints a JSON list [status, standard output, standard error] for each line. On Windows
nothing is left out. Processes that a pool starts run this file too, so they lack the same.
"""

import errno
import importlib.abc
import io
import json
import multiprocessing
import os
import shutil
import signal
import subprocess  # noqa: F401  it takes msvcrt for a sign of Windows: before that is there
import sys
import types
from contextlib import redirect_stderr, redirect_stdout, suppress

MODULES = {"fcntl", "resource", "termios", "pty", "pwd", "grp", "tty", "curses", "readline"}
CALLS = (
    "fork forkpty openpty getuid geteuid getgid getegid fchmod fchown chown lchown mkfifo "
    "O_NOFOLLOW O_NONBLOCK O_DIRECTORY sched_getaffinity setsid killpg nice"
)
SIGNALS = (
    "SIGHUP SIGALRM SIGQUIT SIGUSR1 SIGUSR2 SIGPIPE alarm setitimer pthread_sigmask sigwait pause"
)


class Hidden(importlib.abc.MetaPathFinder):
    """Modules that cannot be imported."""

    def find_spec(self, name, path=None, target=None):
        if name in MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


def in_use(path):
    """Return True if this process has the file open: Windows neither renames nor removes it."""
    try:
        wanted = os.lstat(path)
    except OSError:
        return False
    for descriptor in range(256):
        with suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), wanted):
                return True
    return False


def guarded(call):
    """A call that fails for files in use, as its first two arguments may be."""

    def checked(*paths, **options):
        for path in paths[:2]:
            if in_use(path):
                raise PermissionError(errno.EACCES, "The file is in use by another process", path)
        return call(*paths, **options)

    return checked


def refusing_folders(usual):
    """``os.open``, which opens no folder on Windows."""

    def opened(path, flags, mode=0o777, **options):
        if os.path.isdir(path):
            raise PermissionError(errno.EACCES, "Permission denied", path)
        return usual(path, flags, mode, **options)

    return opened


def kill_nothing(process, number):
    """``os.kill(process, 0)`` is Ctrl-C on Windows: nobody may ask so whether a process lives."""
    raise AssertionError(f"os.kill({process}, {number}) stops the process on Windows")


def msvcrt_of(fcntl):
    """A stand-in for ``msvcrt.locking``: a lock of a descriptor, past the end of its file."""

    def locking(descriptor, mode, count):
        assert (mode, count) == (2, 1)
        end = os.fstat(descriptor).st_size
        assert os.lseek(descriptor, 0, os.SEEK_CUR) > end, "nobody can read a byte that is locked"
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise PermissionError(errno.EACCES, "Permission denied") from None

    module = types.ModuleType("msvcrt")
    module.locking, module.LK_NBLCK = locking, 2
    return module


def hide():
    """Leave out what Windows lacks, before the program is imported."""
    import fcntl

    sys.modules["msvcrt"] = msvcrt_of(fcntl)
    for name in MODULES:
        sys.modules.pop(name, None)
    sys.meta_path.insert(0, Hidden())
    for module, names in ((os, CALLS), (signal, SIGNALS)):
        for name in names.split():
            with suppress(AttributeError):  # macOS lacks some too
                delattr(module, name)
    for name in ("replace", "rename", "unlink", "remove"):
        setattr(os, name, guarded(getattr(os, name)))
    shutil._use_fd_functions = False  # with them it would open folders
    os.open, os.kill = refusing_folders(os.open), kill_nothing
    multiprocessing.get_all_start_methods = lambda: ["spawn"]
    multiprocessing.set_start_method("spawn", force=True)


def run_lines():
    """Run the lines of standard input in this process."""
    from geneva_cli.cli.app import app

    for line in sys.stdin:
        with (
            redirect_stdout(io.TextIOWrapper(io.BytesIO(), "utf-8")) as out,
            redirect_stderr(io.TextIOWrapper(io.BytesIO(), "utf-8")) as err,
        ):
            try:
                app(json.loads(line), prog_name="geneva")
                status = 0
            except SystemExit as end:
                status = end.code or 0
        texts = [stream.seek(0) or stream.read() for stream in (out, err)]
        print(json.dumps([status, *texts]), flush=True)


if os.name != "nt":
    hide()

if __name__ == "__main__":
    if len(sys.argv) > 1:
        from geneva_cli.__main__ import main

        main()
    else:
        run_lines()
