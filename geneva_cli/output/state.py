"""The state file of a run that grows a file: its lock, its request, and all rows so far.

``FILE.geneva`` is in the folder of ``FILE``. Its first line names the program and the request. Each
block of rows follows a line with its numbers of rows and bytes and a digest. The digest covers the
first line and all blocks so far, so that a changed, lost or repeated block is noticed. Once the
file is whole, a line with the digest of that file replaces the blocks.
"""

from __future__ import annotations

import errno
import hashlib
import os
import re
import stat
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import BinaryIO

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.file_locks import lock_alone
from geneva_cli.output.files import refuse_input

SUFFIX = ".geneva"
TITLE = b"geneva sweep state 1 "
LINE_MAX = 1000  # bytes of a line of ours; a foreign file may have one of gigabytes


class StateFile:
    """An open state file, locked so that no second run writes it.

    ``request`` is that of an earlier run, None if there was none. Raises GenevaError if another
    file has this name, or if another run holds the lock.
    """

    def __init__(self, path: str, inputs: Iterable[str]) -> None:
        self.path = path
        self.file = _open_locked(path, inputs)
        try:
            self._read_title()
        except BaseException:
            self.file.close()
            raise

    def _read_title(self) -> None:
        first = self.file.readline(LINE_MAX)
        if first and not (first.startswith(TITLE) and first.endswith(b"\n")):
            raise _not_ours(self.path)
        self.request = first[len(TITLE) : -1].decode(errors="replace") if first else None
        self.start = self.end = len(first)
        self.digest = hashlib.sha256(first)

    def begin(self, request: str) -> None:
        """Discard the rows of an earlier run, and write the first line."""
        self.file.seek(0)
        self.file.truncate()
        first = TITLE + request.encode() + b"\n"
        self.file.write(first)
        self.file.flush()
        self.request, self.start, self.end = request, len(first), len(first)
        self.digest = hashlib.sha256(first)

    def blocks(self) -> Iterator[tuple[int, bytes]]:
        """Yield the number of rows and the bytes of each block, up to the first damaged one.

        What is appended next follows the last block that was read.
        """
        size = os.fstat(self.file.fileno()).st_size
        self.file.seek(0)
        self.digest = hashlib.sha256(self.file.read(self.start))
        self.end = self.start
        head = re.compile(rb"block (\d{1,18}) (\d{1,18}) ([0-9a-f]{64})\n")
        while line := head.fullmatch(self.file.readline(LINE_MAX)):
            rows, length = int(line[1]), int(line[2])
            if length > size - self.file.tell():
                return
            data = self.file.read(length)
            digest = self._digest_with(rows, data)
            if digest.hexdigest().encode() != line[3]:
                return
            self.digest, self.end = digest, self.file.tell()
            yield rows, data

    def append(self, rows: int, data: bytes) -> None:
        """Write a block after the last one, handed to the system before the next is computed."""
        self.digest = self._digest_with(rows, data)
        self.file.seek(self.end)
        self.file.truncate()
        self.file.write(b"block %d %d %b\n" % (rows, len(data), self.digest.hexdigest().encode()))
        self.file.write(data)
        self.file.flush()
        self.end = self.file.tell()

    def _digest_with(self, rows: int, data: bytes) -> hashlib._Hash:
        digest = self.digest.copy()
        digest.update(b"%d %d\n" % (rows, len(data)))
        digest.update(data)
        return digest

    @property
    def is_damaged(self) -> bool:
        """Return True if something other than a block follows the last block that was read."""
        return os.fstat(self.file.fileno()).st_size > self.end

    def whole_digest(self) -> str | None:
        """Return the digest of the whole file, None if its rows are not complete yet."""
        self.file.seek(self.start)
        line = re.fullmatch(rb"whole ([0-9a-f]{64})\n", self.file.readline(LINE_MAX))
        return line[1].decode() if line else None

    def mark_whole(self, digest: str) -> None:
        """Keep only the request and the digest of the finished file."""
        self.file.seek(self.start)
        self.file.truncate()
        self.file.write(f"whole {digest}\n".encode())
        self.file.flush()

    def remove(self) -> None:
        """Remove the file, if it is still the one that was opened."""
        if _has_name(self.file, self.path):
            os.unlink(self.path)

    def close(self) -> None:
        """Close the file, which ends the lock."""
        self.file.close()


def _open_locked(path: str, inputs: Iterable[str]) -> BinaryIO:
    """Open or create the file without following a link, and lock it."""
    inputs = tuple(inputs)
    while True:
        with suppress(FileNotFoundError):
            _refuse_other(path, os.lstat(path), inputs)
        # A link or a pipe that somebody puts there now is neither followed nor waited for.
        flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK
        file = os.fdopen(os.open(path, flags, 0o666), "r+b")
        try:
            _refuse_other(path, os.fstat(file.fileno()), inputs)
            _lock(file, path)
            if _has_name(file, path):
                return file
        except BaseException:
            file.close()
            raise
        file.close()  # the run with the lock has removed the file meanwhile


def _refuse_other(path: str, status: os.stat_result, inputs: Iterable[str]) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise _not_ours(path)
    refuse_input(path, status, inputs)


def _not_ours(path: str) -> GenevaError:
    name = cut(os.path.basename(path))
    return GenevaError(
        f"{name}: a sweep keeps its state under this name, but something else has it; "
        "rename it, or give -o another name"
    )


def _lock(file: BinaryIO, path: str) -> None:
    """Lock the file for this process alone. Raises GenevaError if another run has it."""
    try:
        lock_alone(file.fileno())
    except OSError as error:
        if error.errno in (errno.EAGAIN, errno.EACCES):
            name = cut(os.path.basename(path.removesuffix(SUFFIX)))
            raise GenevaError(
                f"{name}: another run is writing this file; wait until it ends, "
                "or give -o another name"
            ) from None
        # A file system without locks: the digests reveal mixed rows of two runs.


def _has_name(file: BinaryIO, path: str) -> bool:
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.lstat(path))
    except FileNotFoundError:
        return False
