"""Reading a spec file; errors name the file and, where it is known, the line."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import NamedTuple

import tomli

from geneva_cli.errors import GenevaError, cut
from geneva_cli.machine.spec import Spec
from geneva_cli.specfile.lines import line_of
from geneva_cli.specfile.settings import Setting, applied, said_of, settings
from geneva_cli.specfile.tree import spec_of

BYTES_MAX = 1 << 20  # a spec is a page; a megabyte of it is a mistake


class Text(NamedTuple):
    """A spec's text, the name that messages call its file by, and keys given beside it."""

    name: str
    text: str
    given: tuple[Setting, ...] = ()

    @contextmanager
    def located(self) -> Iterator[None]:
        """A context in which errors that name a key get the file and line where that is set."""
        try:
            yield
        except GenevaError as error:
            if not error.key:
                raise
            where = said_of(self.given, error.key)
            if not where:
                line = line_of(self.text, error.key)
                where = f"{self.name}:{line}" if line else self.name
            raise GenevaError(f"{where}: {error}") from None

    def spec(self) -> Spec:
        """The spec. Raises GenevaError, ready to print, for anything wrong with it."""
        try:
            tree = _parsed(self.text)
        except tomli.TOMLDecodeError as error:
            said = error.msg[:1].lower() + error.msg[1:]
            raise GenevaError(f"{self.name}:{error.lineno}: not TOML: {cut(said, 200)}") from None
        except RecursionError:
            raise GenevaError(f"{self.name}: not a spec: brackets are nested too deeply") from None
        except ValueError as error:  # a whole number of thousands of digits
            raise GenevaError(f"{self.name}: not a spec: {error}") from None
        with self.located():
            return spec_of(applied(tree, self.given), self.name)


# A sweep reads one text many times with other keys; nothing changes a parsed tree.
_parsed = lru_cache(maxsize=8)(tomli.loads)


def read(path: str, given: Iterable[str] = ()) -> Text:
    """The text of a spec file; ``-`` is standard input. ``given`` are ``KEY=VALUE`` beside it.

    Raises GenevaError, with the message ready to print, where it cannot be read.
    """
    name = shown_name(path)
    return Text(name, _read(path, name), settings(given))


def shown_name(path: str) -> str:
    """What a spec file is called in messages."""
    return "<stdin>" if path == "-" else path if path.strip() else repr(path)


def _read(path: str, name: str) -> str:
    try:
        if path == "-":
            data = sys.stdin.buffer.read(BYTES_MAX + 1)
        else:
            with open(path, "rb") as file:
                data = file.read(BYTES_MAX + 1)
    except OSError as error:
        advice = "; `geneva new external -o spec.toml` writes one to start from"
        what = "this is a folder; give a file" if os.path.isdir(path) else str(error.strerror)
        missing = isinstance(error, FileNotFoundError)
        raise GenevaError(f"{name}: cannot read: {what}{advice if missing else ''}") from None
    except ValueError as error:  # a NUL in the name
        raise GenevaError(f"{name!r}: cannot read: {error}") from None
    if len(data) > BYTES_MAX:
        raise GenevaError(f"{name}: larger than {BYTES_MAX} bytes; a spec is a page of TOML")
    try:
        # A byte order mark, as some editors put it, is no part of the text.
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise GenevaError(f"{name}:{line}: not UTF-8 text; save the file as UTF-8") from None
