"""Writing a file as a whole or not at all."""

from __future__ import annotations

import errno
import hashlib
import os
import re
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import BinaryIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.locks import CAREFUL, POSIX, lock, remove, rename
from geneva_cli.output.reserved import require_possible
from geneva_cli.output.stopping import stopping_cleanly

# Left behind only by kill -9 or a power failure, until the next run that writes this file.
TEMPORARY = ".{name}.geneva-{number}.tmp"


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
    """Open a file that replaces ``path`` if the block ends without an error."""
    with write_errors(path):
        real, old = place(path, inputs)
        is_file = old is None or stat.S_ISREG(old.st_mode)
        with _temporary_for(real, old) if is_file else open(real, "wb") as file:
            yield file


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
            made = os.path.isdir(folder)  # a folder of the system may take no new files
            says = (
                f"the folder {folder} takes no files" if made else f"make the folder {folder} first"
            )
            advice = f"; {says}"
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


@contextmanager
def _temporary_for(path: str, old: os.stat_result | None) -> Iterator[BinaryIO]:
    """Open a locked file beside ``path`` that takes its name at the end."""
    folder, name = os.path.split(path)
    # The temporary name holds 200 bytes of it: a file system allows 255 in all.
    name = name.encode(errors="surrogateescape")[:200].decode(errors="replace")
    _remove_stale(folder, name)
    number = os.getpid()
    while os.path.lexists(temporary := os.path.join(folder, _temporary(name, number))):
        number += 1  # another run's file, which must not be touched
    with stopping_cleanly():
        try:
            with open(temporary, "xb") as file:
                with suppress(OSError):  # a file system without locks
                    lock(file.fileno())
                if old is not None:
                    take_after(file.fileno(), old)
                yield file
                file.flush()
                os.fsync(file.fileno())
                rename(file, temporary, path)
        finally:
            with suppress(FileNotFoundError):
                os.unlink(temporary)


def _temporary(name: str, number: int | str) -> str:
    return TEMPORARY.format(name=name, number=number)


def _remove_stale(folder: str, name: str) -> None:
    """Remove temporary files of this file that killed runs have left: nobody holds their lock."""
    left = re.compile(re.escape(_temporary(name, "0")).replace(r"\-0\.", r"\-\d{1,9}\."))
    with suppress(OSError):  # a folder that can be written but not listed
        for entry in filter(left.fullmatch, os.listdir(folder)):
            _remove_unlocked(os.path.join(folder, entry))


def _remove_unlocked(path: str) -> None:
    with suppress(OSError), open(os.open(path, os.O_RDONLY | CAREFUL), "rb") as file:
        lock(file.fileno())
        if stat.S_ISREG(os.lstat(path).st_mode):
            remove(file, path)


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
