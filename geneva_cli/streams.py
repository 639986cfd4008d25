"""The standard streams of a run, and its reaction if they cannot be written.

Write errors are handled in the streams themselves, whoever writes and whenever a buffer is flushed.
"""

import errno
import io
import os
import sys
from collections.abc import Callable
from typing import Any, NoReturn

from geneva_cli.errors import cut

NARROWEST = 60  # characters of a line that is never broken
LACKING = "backslashreplace"  # for letters that the encoding lacks, such as those of a title


def open_streams() -> None:
    """Replace the interpreter's standard streams by those of this file."""
    _fill_closed()
    sys.stdin = sys.stdin or open(0, closefd=False, encoding="utf-8")
    sys.stderr = _opened(_Messages, sys.stderr, 2, lambda _: None, True)
    sys.stdout = _opened(io.TextIOWrapper, sys.stdout, 1, _end, os.isatty(1))


def _opened(
    kind: Any, own: Any, number: int, fails: Callable[[OSError], None], by_line: bool
) -> Any:
    """A stream over the interpreter's ``own`` one of bytes, which a console of Windows needs."""
    raw = own.buffer if own else io.FileIO(number, "w", closefd=False)  # none if it was closed
    if isinstance(raw, io.BufferedWriter):  # an unbuffered one is raw itself
        raw = raw.raw
    return kind(
        io.BufferedWriter(_Standard(raw, fails)),
        encoding=own.encoding if own else "utf-8",
        errors=LACKING,
        newline="\n",  # on Windows too, as in files
        line_buffering=by_line,
    )


def use_utf8() -> None:
    """Print UTF-8 from here on, whatever the console has: a program reads it, as it reads a file.

    Tables for people keep the console's encoding.
    """
    if isinstance(sys.stdout, io.TextIOWrapper):  # not a stream of a notebook
        sys.stdout.reconfigure(encoding="utf-8", errors=LACKING)


def _fill_closed() -> None:
    """Open the null device for each closed stream, such as a daemon's, and keep it open.

    An open takes the lowest free descriptor, so an output file with number 2 would get the
    messages.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def leave(status: int) -> NoReturn:
    """End the process at once; cleaning up the interpreter would take a sixth of the run."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


class _Standard(io.RawIOBase):
    """A standard stream, over that of the interpreter; ``fails`` handles its write errors."""

    def __init__(self, raw: Any, fails: Callable[[OSError], None]) -> None:
        self.raw, self.fails = raw, fails

    def writable(self) -> bool:
        return True

    def fileno(self) -> int:
        return self.raw.fileno()

    def isatty(self) -> bool:
        return self.raw.isatty()

    def write(self, data: Any, /) -> int:
        try:
            return self.raw.write(data)
        except OSError as error:
            self.fails(error)
            return len(data)


def _end(error: OSError) -> None:
    """End a run whose output cannot be written: as by SIGPIPE if its reader has left."""
    if error.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: a closed pipe of Windows
        os._exit(128 + 13)  # 13 is SIGPIPE's number
    print(f"<stdout>: cannot write: {error.strerror}; try -o FILE", file=sys.stderr)
    os._exit(2)


class _Messages(io.TextIOWrapper):
    """Text with a limited line length, since a quoted megabyte would hide the message.

    On a terminal lines are broken between words, except for those of a bar, which moves the cursor.
    """

    def write(self, text: str, /) -> int:
        lines = [cut(line, 4000) for line in text.split("\n")]
        # A carriage return or an escape begins a movement of the cursor.
        if max(map(len, lines)) > NARROWEST and self.isatty() and not {"\r", "\x1b"} & set(text):
            import shutil  # only where somebody looks at a long message
            from textwrap import TextWrapper

            width = max(shutil.get_terminal_size().columns, NARROWEST)
            wrapper = TextWrapper(width, subsequent_indent="  ", break_on_hyphens=False)
            wrapper.break_long_words = False
            lines = [part for line in lines for part in wrapper.wrap(line) or [line]]
        super().write("\n".join(lines))
        return len(text)
