"""Reader of spec files and of ``--set KEY=VALUE``; errors name the file and, if known, the line."""

import errno
import os
import re
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache
from typing import Any, NamedTuple

import tomli

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.specfile.tree import read_text, spec_of


@lru_cache  # of the many designs of a sweep
def line_of(text: str, path: tuple[str | int, ...]) -> int:
    """Line on which a key (or else its table) is set; 0 if it is not set.

    A number in the path counts the tables of a list, from 0.
    """
    lines, most = text.split("\n"), _depth(_parsed(text), path)
    # other lines go on with a value, or are empty
    begins = [i for i, line in enumerate(lines) if "=" in line or line.lstrip().startswith("[")]

    def has(k: int) -> bool:
        """True if the text up to the end of what begins on a line has the key."""
        for end in (*begins[k + 1 :], len(lines)):  # in a value there may be such lines, too
            with suppress(tomli.TOMLDecodeError):
                return _depth(tomli.loads("\n".join(lines[:end])), path) >= most
        return True

    return 1 + begins[bisect_left(range(len(begins)), True, key=has)] if most else 0


def _depth(node: Any, path: Sequence[str | int]) -> int:
    """Number of parts of a path that a tree has; in a list without a number, that any table has."""
    if isinstance(node, list) and path and isinstance(path[0], str):
        return max((_depth(one, path) for one in node), default=0)
    try:
        return 1 + _depth(node[path[0]], path[1:])
    except (LookupError, TypeError):
        return 0


class Setting(NamedTuple):
    """One key that an option sets: the option as typed, the key's path, and its value."""

    option: str
    path: tuple[str | int, ...]
    value: Any


def setting(text: str, option: str = "--set") -> Setting:
    """One ``table.key=value`` setting; a word's quotation marks are optional."""
    typed, key, value = parted(text, option, f"KEY=VALUE, as in {option} drive.n_rpm=90")
    path = tuple(int(p) if i and p.isdecimal() else p for i, p in enumerate(key.split(".")))
    return Setting(typed, path, read_value(value, typed))


def parted(text: str, option: str, form: str) -> tuple[str, str, str]:
    """Return an option as typed, the key in its text with its table, and the text of the value.

    A key needs no table if only one has it. Raises GenevaError for a text that has not this
    ``form``, and for a key that no table or several tables have.
    """
    key, sign, value = map(str.strip, text.partition("="))
    typed = f"{option} {cut(text.strip())}"
    if not sign or not value or not all(key.split(".")):
        raise GenevaError(f"{typed}: it must be {form}")
    if key == "title" or "." in key:
        return typed, key, value
    from geneva_cli.specfile.keys import all_keys, tables_with  # loads every kind

    names = [f"{table}.{key}" for table in tables_with(key)]
    if len(names) == 1:
        return typed, names[0], value
    if names:
        raise GenevaError(f"{typed}: several tables have this key; write {' or '.join(names)}")
    hint = nearest(key, sorted({k.key for k in all_keys() if k.table}))
    raise GenevaError(f"{typed}: no table has this key{hint}; `geneva keys` lists all")


def read_value(text: str, option: str) -> Any:
    """Return the value as TOML reads it, or a number such as .5; anything else is a word.

    Raises GenevaError, which begins with ``option``, if other keys follow the value.
    """
    try:
        tree = tomli.loads(f"x = {text.strip()}")
    except (tomli.TOMLDecodeError, RecursionError, ValueError):
        try:
            return float(text)
        except ValueError:
            return text.strip()
    if len(tree) > 1:
        raise GenevaError(f"{option}: it sets more than one key; use one option for each")
    return tree["x"]


class Text(NamedTuple):
    """A spec's text, the name of its file for messages, and settings from the command line."""

    name: str
    text: str
    set_keys: tuple[Setting, ...] = ()

    @contextmanager
    def located(self) -> Iterator[None]:
        """Context in which errors that name a key get the file and line on which it is set."""
        try:
            yield
        except GenevaError as error:
            if not error.key:
                raise
            # the option that set the key of an error, or a key in its table
            n = len(error.key)
            options = [one.option for one in self.set_keys if one.path[:n] == error.key]
            line = line_of(self.text, error.key)
            where = f"{self.name}:{line}" if line else self.name
            raise GenevaError(f"{options[-1] if options else where}: {error}") from None

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
            for one in self.set_keys:  # later ones over earlier ones
                tree = _with(tree, one.path, one)
            return spec_of(tree, self.name)


# A sweep reads one text many times with other settings; nothing changes a parsed tree.
_parsed = lru_cache(maxsize=8)(tomli.loads)


def _with(node: Any, path: tuple[str | int, ...], one: Setting) -> Any:
    if not path:
        return one.value
    head, *rest = path
    if isinstance(head, int):
        several = list(node) if isinstance(node, list) else []
        if not head < len(several):
            name = ".".join(map(str, one.path[: one.path.index(head)]))
            count = f"the spec has {len(several)} [[{name}]], counted from 0"
            raise GenevaError(f"{one.option}: {count}")
        several[head] = _with(several[head], tuple(rest), one)
        return several
    table = dict(node) if isinstance(node, dict) else {}
    return table | {head: _with(table.get(head), tuple(rest), one)}


def _reason(message: str, line: str) -> str:
    """What is wrong with a line that is not TOML, and what is right instead."""
    if re.search(r"overwrite|twice|Duplicate", message):
        return "this key or table is set above already; keep one of the two"
    reason, value = cut(message[:1].lower() + message[1:], 200), line.partition("=")[2].strip()
    if value[:1].isdigit():  # a number with a unit, or with a comma; a mark behind it is of inches
        value = re.sub(r"(\d),(\d)", r"\1.\2", value.partition("#")[0].strip())
        value = re.sub(r'["”″]$', " in", value)
        return f'{reason}; write "{cut(value)}" in quotation marks, or a number with a point'
    return f'{reason}; write [table], or KEY = VALUE as in z = 6, and a text between two marks "'


def read(path: str, set_keys: Iterable[str] = ()) -> Text:
    """Text of a spec file; ``-`` is standard input. ``set_keys`` are ``KEY=VALUE`` texts.

    Raises GenevaError, with the message ready to print, if it cannot be read.
    """
    try:
        text = read_text(path, 1 << 20, "too large for a spec")  # of a page
    except GenevaError as error:
        if not str(error).endswith(os.strerror(errno.ENOENT)):
            raise
        from geneva_cli.specfile.template import titles  # only for this message

        own = os.path.basename(path).removesuffix(".toml")
        words = f"--from-design {own} -o {own}" if own in titles() else "external -o spec"
        raise GenevaError(f"{error}; `geneva new {words}.toml` writes one") from None
    return Text("<stdin>" if path == "-" else path, text, tuple(map(setting, set_keys)))
