"""Writing a file whole or not at all."""

from __future__ import annotations

import errno
import os
import signal
import stat
import sys
from collections.abc import Iterable
from types import FrameType

from geneva_cli.errors import GenevaError

# Left behind only by kill -9 or a power cut; the name says whose it is.
TEMPORARY = ".{name}.geneva-{number}.tmp"
NAME_MAX = 200  # bytes of the file's own name in it: a folder takes 255


def write(path: str, chunks: Iterable[str], inputs: Iterable[str] = ()) -> None:
    """Write text to ``path`` so that at every moment the old file or the new one is whole.

    The text goes to a temporary file in the same folder, which then takes the old one's place and
    permissions. A device or a pipe is written to directly. Raises GenevaError where the file
    cannot be written, or is one of ``inputs``.
    """
    if not path or "\0" in path:
        raise GenevaError(f'-o "{path}": not a file\'s name')
    path = os.path.realpath(path)
    _refuse_input(path, inputs)
    try:
        old = os.stat(path)
    except OSError:
        old = None
    try:
        if old is not None and stat.S_ISDIR(old.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if old is not None and not stat.S_ISREG(old.st_mode):
            with open(path, "w", encoding="utf-8", newline="") as device:
                device.writelines(chunks)
            return
        _replace(path, chunks, old)
    except OSError as error:
        raise GenevaError(f"{path}: cannot write: {error.strerror}{_advice(error, path)}") from None


def _replace(path: str, chunks: Iterable[str], old: os.stat_result | None) -> None:
    folder, name = os.path.split(path)
    name = name.encode(errors="surrogateescape")[:NAME_MAX].decode(errors="replace")
    number = os.getpid()
    while os.path.lexists(temporary := _temporary(folder, name, number)):
        number += 1  # another run's, or one that was killed: not ours to touch

    def stop(number: int, frame: FrameType | None) -> None:
        sys.exit(128 + number)  # unwinds through the finally below

    handlers = {s: signal.signal(s, stop) for s in (signal.SIGTERM, signal.SIGHUP)}
    try:
        with open(temporary, "x", encoding="utf-8", newline="") as file:
            if old is not None:
                os.chmod(temporary, stat.S_IMODE(old.st_mode))
            file.writelines(chunks)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        if os.path.lexists(temporary):
            os.unlink(temporary)
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _temporary(folder: str, name: str, number: int) -> str:
    return os.path.join(folder, TEMPORARY.format(name=name, number=number))


def _refuse_input(path: str, inputs: Iterable[str]) -> None:
    for given in inputs:
        both = given != "-" and os.path.exists(given) and os.path.exists(path)
        if both and os.path.samefile(given, path):
            raise GenevaError(
                f"{given}: this file is an input, and would be overwritten; give -o another name"
            )


def _advice(error: OSError, path: str) -> str:
    if error.errno == errno.ENOENT:
        return f"; make the folder {os.path.dirname(path)} first"
    if error.errno == errno.EISDIR:
        return "; give a file's name"
    return ""
