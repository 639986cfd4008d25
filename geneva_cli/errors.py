"""The one exception for errors that a user can correct, and helpers for messages."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Callable, Iterable, Iterator, Sized
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any


class GenevaError(Exception):
    """A wrong spec, file or value: shown as ``FILE:LINE: message``, with exit code 2.

    ``key`` names the place in the spec, as in ``("drive", "A")``; the reader of the spec
    turns it into a file and a line; a number in it counts a list's tables from 0.

    >>> SideCrank(A=2.0)
    Traceback (most recent call last):
    geneva_cli.errors.GenevaError: A = 2 must be above -1, below 1 (side-crank: base offset / ...)
    """

    def __init__(self, message: str, key: tuple[str | int, ...] = ()) -> None:
        super().__init__(message)
        self.key = key


class Notice(str):
    """A warning or a note about a design, with its name in ``geneva explain``.

    ``accepted`` is the reason for accepting it, which its text then begins with; else empty.
    ``plain`` is the text without that reason.

    >>> Notice("turns-back", "the wheel turns back").name
    'turns-back'
    """

    name: str
    plain: str
    accepted: str

    def __new__(cls, name: str, text: str, accepted: str = "") -> Notice:
        """The text, with its name."""
        notice = super().__new__(cls, f"accepted ({accepted}): {text}" if accepted else text)
        notice.name, notice.plain, notice.accepted = name, text, accepted
        return notice

    def __getnewargs__(self) -> tuple[str, str, str]:  # type: ignore[override]
        """The arguments for a copy in another process."""
        return self.name, self.plain, self.accepted


def open_warnings(texts: Iterable[str]) -> list[str]:
    """The warnings that are not accepted; notes on unknown values are none."""
    return [text for text in texts if not (isinstance(text, Notice) and text.accepted)]


def is_warning(text: str) -> bool:
    """Return True for a warning, and False for a note on an unknown value."""
    # A note of this name, on a value that needs a key, is not a warning.
    return isinstance(text, Notice) and text.name != "not-known"


_marks: ContextVar[list[Any] | None] = ContextVar("marks", default=None)


def refuse(where: Any, error: Callable[[], GenevaError]) -> None:
    """Raise an error where a condition holds; for an array of designs, mark those where it does.

    ``where`` is a truth value, or an array (n, 1) with one for each design. The error is created
    only when it is raised: an array does not report it, but a single design does.
    """
    if isinstance(where, bool):
        if where:
            raise error()
        return
    marks = _marks.get()
    if marks is None:
        raise GenevaError("an array of designs is built by geneva_cli.motion.many")
    marks.append(where)


def refuse_text(where: Any, key: tuple[str, str], text: str, /, **values: object) -> None:
    """``refuse`` with a text of a key, in which ``values`` are put when it is raised."""
    if where is not False:
        refuse(where, lambda: GenevaError(text.format(**values), key))


def refuse_size(
    wrong: Any, key: str, text: str, own: float | None = None, /, **values: object
) -> None:
    """``refuse_text`` of a key of ``[size]``, after its name and its ``own`` value."""
    told = text if own is None else f"{key} = {{own:g}}: {text}"
    where = wrong if isinstance(wrong, Sized) else bool(wrong)  # an array, or one design's
    refuse_text(where, ("size", key), told, own=own, **values)


@contextmanager
def marking() -> Iterator[list[Any]]:
    """Collect the masks of designs that ``refuse`` marks within the block."""
    marks: list[Any] = []
    token = _marks.set(marks)
    try:
        yield marks
    finally:
        _marks.reset(token)


def clean(text: str) -> str:
    """Text without control characters, which could carry terminal escapes."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else " " for c in text)


def cut(value: str | int, most: int = 60) -> str:
    """A value as a message quotes it, in ``most`` characters: beginning and end if longer.

    Whole numbers of more than some thousand digits are hexadecimal, as Python writes no others.
    """
    if isinstance(value, int) and value.bit_length() > 10_000:
        value = hex(value)
    text = str(value)
    if len(text) <= most:
        return text
    end = most // 4
    return f"{text[: most - end - 3]}...{text[len(text) - end :]}"


def below(folder: str, name: str) -> str:
    """A file of a folder, as it is opened and printed: with / on Windows, too.

    So what is printed is the same on every system, except what its user typed.
    """
    return name if os.path.isabs(name) else posixpath.join(folder, name)


def nearest(word: str, known: Iterable[str]) -> str:
    """A question `` (did you mean "..."?)`` with the known word most like ``word``, or nothing.

    Capitals make no difference; from three letters on, a beginning or a part is enough.
    """
    import difflib

    word, by_word = cut(word).casefold(), {k.casefold(): k for k in known}
    close = difflib.get_close_matches(word, by_word, n=1, cutoff=0.6)
    if not close and len(word) >= 3:
        parts = [k for k in by_word if word in k]
        close = sorted(parts, key=lambda k: not k.startswith(word))
    return f' (did you mean "{by_word[close[0]]}"?)' if close else ""


def few(word: Any, known: Iterable[str]) -> str:
    """The known words, for a message: at most five, those that are like ``word`` first."""
    import difflib

    words = list(known)
    more = len(words) - 5  # in a message: nobody reads more
    close = difflib.get_close_matches(cut(str(word)), words, n=5) if more > 0 else []
    words = [*dict.fromkeys([*close, *words])]
    return ", ".join(words[:5]) + (f" and {more} more" if more > 0 else "")
