"""The standard streams of a run, and its reaction if they cannot be written.

Write errors are handled in the streams themselves, whoever writes and whenever a buffer is flushed.
"""

from __future__ import annotations

import io
import os
import sys
from typing import Any, NoReturn, TextIO

from geneva_cli.errors import cut

NARROWEST = 60  # characters of a line that is never broken


def open_streams() -> None:
    """Replace the interpreter's standard streams by those of this file."""
    _fill_closed()
    sys.stdin = sys.stdin or open(0, closefd=False)
    sys.stderr = _Messages(
        io.BufferedWriter(_ErrorOutput(2, "w", closefd=False)),
        encoding=_encoding(sys.stderr),
        errors="backslashreplace",
        line_buffering=True,
    )
    sys.stdout = io.TextIOWrapper(
        io.BufferedWriter(_Output(1, "w", closefd=False)),
        encoding=_encoding(sys.stdout),
        errors="backslashreplace",  # for a title in a script that the terminal lacks
        line_buffering=os.isatty(1),
    )


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


def _encoding(stream: TextIO | None) -> str:
    return stream.encoding if stream else "utf-8"


def leave(status: int) -> NoReturn:
    """End the process at once; cleaning up the interpreter would take a sixth of the run."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


class _Output(io.FileIO):
    """Standard output, for which a write error ends the run.

    If the reader has left, the run ends as by SIGPIPE; otherwise with a message and status 2.
    """

    def write(self, data: Any, /) -> int:
        try:
            return super().write(data)
        except BrokenPipeError:
            os._exit(128 + 13)  # 13 is SIGPIPE's number
        except OSError as error:
            print(f"<stdout>: cannot write: {error.strerror}; try -o FILE", file=sys.stderr)
            os._exit(2)


class _ErrorOutput(io.FileIO):
    """Standard error, which ignores write errors and leaves the exit status unchanged."""

    def write(self, data: Any, /) -> int:
        try:
            return super().write(data)
        except OSError:
            return len(data)


class _Messages(io.TextIOWrapper):
    """Text with a limited line length, since a quoted megabyte would hide the message.

    On a terminal lines are broken between words, except for those of a bar, which moves the cursor.
    """

    def write(self, text: str, /) -> int:
        lines = [cut(line, 4000) for line in text.split("\n")]
        # A carriage return or an escape begins a movement of the cursor.
        if max(map(len, lines)) > NARROWEST and self.isatty() and not {"\r", "\x1b"} & set(text):
            lines = [part for line in lines for part in _broken(line, columns())]
        super().write("\n".join(lines))
        return len(text)


def columns() -> int:
    """The width of the terminal that shows messages, in letters."""
    try:
        width = int(os.environ.get("COLUMNS", ""))
    except ValueError:  # unset, or no number
        width = 0
    return width if width > 0 else os.get_terminal_size(2).columns or 80


def _broken(line: str, width: int) -> list[str]:
    from textwrap import wrap  # only where somebody looks at a long message

    width = max(width, NARROWEST)
    return wrap(
        line, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    ) or [line]
