"""Reader of spec files; errors name the file and, if known, the line.

The TOML reader itself determines the lines of keys.
"""

from __future__ import annotations

import codecs
import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from itertools import islice
from typing import Any, NamedTuple

import tomli

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.specfile.settings import Setting, applied, setting
from geneva_cli.specfile.tree import spec_of
from geneva_cli.table import in_digits


def line_of(text: str, path: tuple[str | int, ...]) -> int:
    """Line on which a key (or else its table) is set; 0 if it is not set.

    The key's line is the first after which the text so far parses and contains the key. Only lines
    that look like setting it are tried. A number in the path counts the tables of a list, from 0.
    """
    lines = text.split("\n")
    while path:
        before = sum(part for part in path if isinstance(part, int))  # tables that may set it too
        name = re.escape(next((p for p in reversed(path) if isinstance(p, str)), ""))
        sets = re.compile(rf"""(^|[\s.,{{\["']){name}["']?\s*[=.\]]""")
        likely = (
            i for i, x in enumerate(lines) if sets.search(x) and not x.lstrip().startswith("#")
        )
        for i in islice(likely, 10 + before):  # else its table is named
            if _holds(lines, i + 1, path):
                return i + 1
        path = path[:-1]
    return 0


def _holds(lines: list[str], end: int, path: tuple[str | int, ...]) -> bool:
    """True if the lines up to the end of the value that starts on line ``end`` set the key."""
    more = 0
    while True:
        try:
            node: Any = tomli.loads("\n".join(lines[: end + more]))
            break
        except (ValueError, RecursionError):
            if end + more >= len(lines):
                return False
            more = 2 * more + 1  # a value of many lines
    try:
        for part in path:
            node = node[part]
    except (LookupError, TypeError):
        return False
    return True


class Text(NamedTuple):
    """A spec's text, the name of its file for messages, and settings from the command line."""

    name: str
    text: str
    set_keys: tuple[Setting, ...] = ()

    @property
    def alone(self) -> Text:
        """The text without the settings."""
        return self._replace(set_keys=())

    @contextmanager
    def located(self) -> Iterator[None]:
        """Context in which errors that name a key get the file and line on which it is set."""
        try:
            yield
        except GenevaError as error:
            if not error.key:
                raise
            # the option that set the key of an error, or a key in its table
            options = (
                one.option
                for one in reversed(self.set_keys)
                if one.path[: len(error.key)] == error.key
            )
            where = next(options, "")
            if not where:
                line = line_of(self.text, error.key)
                where = f"{self.name}:{line}" if line else self.name
            raise GenevaError(f"{where}: {error}") from None

    def spec(self) -> Spec:
        """The spec. Raises GenevaError, ready to print, for anything wrong with it."""
        try:
            tree = _parsed(self.text)
        except tomli.TOMLDecodeError as error:
            reason = _reason(error.msg, self.text.split("\n")[error.lineno - 1])
            raise GenevaError(f"{self.name}:{error.lineno}: not TOML: {reason}") from None
        except RecursionError:
            raise GenevaError(f"{self.name}: not a spec: brackets are nested too deeply") from None
        except ValueError as error:  # a whole number of thousands of digits
            raise GenevaError(f"{self.name}: not a spec: {error}") from None
        with self.located():
            return spec_of(applied(tree, self.set_keys), self.name)

    def with_units(self, spec: Spec) -> list[str]:
        """Values that were written with a unit, each with the number that was read."""
        from geneva_cli.spec.units import unit_key

        return [
            f"{table}.{key} = {_shown(number)}, from {_typed(value)}"
            for table, key, value in _texts(applied(_parsed(self.text), self.set_keys))
            if unit_key(key) and (number := spec.table(table).get(key)) is not None
        ]


# A sweep reads one text many times with other settings; nothing changes a parsed tree.
_parsed = lru_cache(maxsize=8)(tomli.loads)


def _reason(message: str, line: str) -> str:
    """What is wrong with a line that is not TOML, and what is right instead."""
    if re.search(r"overwrite|twice|Duplicate", message):
        return "this key or table is set above already; keep one of the two"
    if message == r"Illegal character '\n'":
        return "a text ends without its quotation mark; write one behind its last letter"
    reason = cut(message[:1].lower() + message[1:], 200)
    if message == "Invalid statement" or message.startswith("Expected '=' after a key"):
        return f'{reason}; write [table], or KEY = VALUE as in z = 6, or a comment behind "#"'
    if message == "Invalid value" and not line.partition("=")[2].strip():
        return "the value is missing; write one behind the sign, as in z = 6"
    return reason + _hint(line)


def _hint(line: str) -> str:
    """What is right instead of a bare value such as ``12,5``, ``60 rpm`` or ``cycloidal``."""
    from geneva_cli.spec.units import NUMBER  # which a spec without errors or units needs not

    match = re.fullmatch(r"""\s*[\w.-]+\s*=\s*([^\s#"'\[{][^#"'\[{]*?)\s*(#.*)?""", line)
    value = match[1] if match else ""
    if comma := re.fullmatch(r"([+-]?\d+),(\d+)(.*)", value):
        quote = '"' if comma[3] else ""
        return f"; write {quote}{comma[1]}.{comma[2]}{comma[3]}{quote}, with a point"
    inches = re.fullmatch(rf"""\s*[\w.-]+\s*=\s*({NUMBER})\s*["”″]\s*(#.*)?""", line)
    if inches:
        return f'; write "{inches[1]} in"'
    if re.fullmatch(rf"{NUMBER}\s*[A-Za-zµ°].*", value):
        return f'; write "{cut(value)}" in quotation marks, or the number alone in the key\'s unit'
    return f'; write "{cut(value)}" in quotation marks' if value[:1].isalpha() else ""


def read(path: str, set_keys: Iterable[str] = ()) -> Text:
    """Text of a spec file; ``-`` is standard input. ``set_keys`` are ``KEY=VALUE`` texts.

    Raises GenevaError, with the message ready to print, if it cannot be read.
    """
    name = shown_name(path)
    return Text(name, _read(path, name), tuple(setting(text) for text in set_keys))


def shown_name(path: str) -> str:
    """Name of a spec file in messages."""
    return "<stdin>" if path == "-" else path if path.strip() else repr(path)


def _advice(path: str) -> str:
    """The command that writes a spec in place of one that is missing."""
    from geneva_cli.specfile.designs import names

    design = os.path.basename(path).removesuffix(".toml")
    if design in names():
        return f"; `geneva new --from-design {design} -o {design}.toml` writes one"
    return "; `geneva new external -o spec.toml` writes an example"


def _read(path: str, name: str) -> str:
    bytes_max = 1 << 20  # a spec is a page; a megabyte of it is a mistake
    try:
        if path == "-":
            data = sys.stdin.buffer.read(bytes_max + 1)
        else:
            with open(path, "rb") as file:
                data = file.read(bytes_max + 1)
    except OSError as error:
        what = "this is a folder, not a file" if os.path.isdir(path) else str(error.strerror)
        advice = _advice(path) if isinstance(error, FileNotFoundError) else ""
        raise GenevaError(f"{name}: cannot read: {what}{advice}") from None
    except ValueError as error:  # a NUL in the name
        raise GenevaError(f"{name!r}: cannot read: {error}") from None
    if len(data) > bytes_max:
        raise GenevaError(f"{name}: larger than {bytes_max} bytes, too large for a spec")
    try:
        # Some editors put a byte order mark before the text.
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        # Windows PowerShell 5 writes UTF-16 for >
        is_utf16 = data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
        what = "UTF-16 and not UTF-8 text" if is_utf16 else "not UTF-8 text"
        advice = ", or write it with -o FILE in place of > FILE" if is_utf16 else ""
        raise GenevaError(f"{name}:{line}: {what}; save the file as UTF-8{advice}") from None


def _texts(tree: dict[str, Any], table: str = "") -> Iterator[tuple[str, str, Any]]:
    """Table, key and value of each value that is a text or has texts in its list."""
    for key, value in tree.items():
        name = f"{table}.{key}" if table else key
        if isinstance(value, dict):
            yield from _texts(value, name)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for i, one in enumerate(value):
                yield from _texts(one, f"{name}.{i}")
        elif any(isinstance(one, str) for one in (value if isinstance(value, list) else [value])):
            yield table, key, value


def _shown(number: Any) -> str:
    if isinstance(number, tuple):
        return f"[{', '.join(map(_shown, number))}]"
    return in_digits(number, 7)


def _typed(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_typed, value))}]"
    return f'"{value}"' if isinstance(value, str) else str(value)
