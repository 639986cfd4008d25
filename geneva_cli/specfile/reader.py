"""From a TOML file to a mechanism; every complaint names the file and, where it can, the line."""

from __future__ import annotations

import math
import os
import re
import sys
from collections.abc import Callable
from itertools import islice
from types import UnionType
from typing import Any, NamedTuple, TypeVar, get_args, get_type_hints

import tomli

from geneva_cli.errors import GenevaError, clean, cut, nearest
from geneva_cli.machine import drives, kinds
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.spec import tables as keys

T = TypeVar("T")
EXACT = 2.0**53  # up to it, a float that is whole is that whole number
TRIES = 10  # lines that look like setting a key, before its table is named instead
BYTES_MAX = 1 << 20  # a spec is a page; a megabyte of it is a mistake
TABLES: dict[str, Any] = {
    "wheel": keys.Wheel,
    "drive": keys.Drive,
    "motion": keys.Motion,
    "size": keys.Size,
    "load": keys.Load,
    "limits": keys.Limits,
}
LIST = tuple[float, ...]
LIST_MAX = 1000
# words that stand for a number
WORDS = {"ratio": ("matched",), "planet_ratio": ("shockless",), "gear_ratio": ("shockless",)}
_NAMES: dict[Any, str] = {
    LIST: "a list of numbers",
    str: "text",
    int: "a whole number",
    float: "a number",
}


def load(path: str) -> Mechanism:
    """The mechanism that a spec file describes; ``-`` is standard input.

    Raises GenevaError, with the message ready to print, for anything wrong with the file.
    """
    return load_and(path, lambda mechanism: mechanism)


def load_and(path: str, make: Callable[[Mechanism], T]) -> T:
    """What is made of a spec's mechanism; what is wrong with it is said with the spec's line too.

    Raises GenevaError as ``load`` does.
    """
    name = "<stdin>" if path == "-" else path
    text = _read(path, name)
    try:
        tree = tomli.loads(text)
    except tomli.TOMLDecodeError as error:
        said = error.msg[:1].lower() + error.msg[1:]
        raise GenevaError(f"{name}:{error.lineno}: not TOML: {cut(said, 200)}") from None
    except RecursionError:
        raise GenevaError(f"{name}: not a spec: brackets are nested too deeply") from None
    except ValueError as error:  # a whole number of thousands of digits
        raise GenevaError(f"{name}: not a spec: {error}") from None
    try:
        return make(build(_spec(tree, name)))
    except GenevaError as error:
        if not error.key:
            raise
        line = line_of(text, error.key)
        raise GenevaError(f"{name}:{line}: {error}" if line else f"{name}: {error}") from None


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


def line_of(text: str, path: tuple[str, ...]) -> int:
    """The line where a key (or, failing that, its table) is set; 0 if it is nowhere.

    Asks the TOML reader itself: the key's line is the first after which the text so far parses
    and holds the key. Only lines that look like setting it are tried.
    """
    lines = text.split("\n")
    while path:
        name = re.escape(path[-1])
        sets = re.compile(rf"""(^|[\s.,{{\["']){name}["']?\s*[=.\]]""")
        likely = (
            i for i, x in enumerate(lines) if sets.search(x) and not x.lstrip().startswith("#")
        )
        for i in islice(likely, TRIES):
            if _holds(lines, i + 1, path):
                return i + 1
        path = path[:-1]
    return 0


def _holds(lines: list[str], end: int, path: tuple[str, ...]) -> bool:
    """Whether the first lines, up to the end of the value that line ``end`` begins, set the key."""
    more = 0
    while True:
        try:
            node: Any = tomli.loads("\n".join(lines[: end + more]))
            break
        except (ValueError, RecursionError):
            if end + more >= len(lines):
                return False
            more = 2 * more + 1  # a value of many lines
    for part in path:
        node = node.get(part) if isinstance(node, dict) else None
    return node is not None


class Field(NamedTuple):
    """One key: how its value is checked."""

    key: str
    types: tuple[Any, ...]
    rule: Any
    default: Any
    meaning: str


def fields(table: Any) -> list[Field]:
    """The keys of a table, from its class."""
    out = []
    for name, hint in get_type_hints(table, include_extras=True).items():
        annotated, rule, meaning = get_args(hint)
        # an alternative (a | b) by its parts, anything else as it is; tuple[...] stays whole
        types = get_args(annotated) if isinstance(annotated, UnionType) else (annotated,)
        default = table._field_defaults.get(name, ...)
        out.append(Field(name.rstrip("_"), types, rule, default, meaning))
    return out


def kind_keys(kind: str) -> Any:
    """The class of the keys that a kind of drive adds to ``[drive]``."""
    return kinds.module(kind).Keys


def _spec(tree: dict[str, Any], name: str) -> keys.Spec:
    tree = dict(tree)
    title = tree.pop("title", "")
    if not isinstance(title, str):
        raise GenevaError(f"title must be text, not {_shown(title)}", ("title",))
    for table, value in tree.items():
        if table not in TABLES:
            hint = nearest(table, (*TABLES, "title"))
            what = f"[{cut(table)}]" if isinstance(value, dict) else cut(table)
            raise GenevaError(
                f"unknown {'table' if isinstance(value, dict) else 'key'} {what}{hint}; "
                f"known: title, {', '.join(f'[{t}]' for t in TABLES)}",
                (table,),
            )
        if not isinstance(value, dict):
            raise GenevaError(f"{table} must be a table: write [{table}] above its keys", (table,))
    if "wheel" not in tree:
        raise GenevaError(
            f"{name}: no [wheel] table; the shortest spec is [wheel] and, below it, z = 6"
        )
    drive, kind = _drive(dict(tree.pop("drive", {})))
    tables = {table: _table(TABLES[table], table, value) for table, value in tree.items()}
    return keys.Spec(drive=drive, kind=kind, title=clean(title), path=name, **tables)


def _drive(given: dict[str, Any]) -> tuple[keys.Drive, Any]:
    """The common keys, and those of the kind."""
    kind = given.get("kind", "crank")
    if not isinstance(kind, str) or kind not in drives.KINDS:
        hint = nearest(kind, drives.KINDS) if isinstance(kind, str) else ""
        known = ", ".join(f'"{k}"' for k in drives.KINDS)
        raise GenevaError(
            f"kind must be one of {known}, not {_shown(kind)}{hint}", ("drive", "kind")
        )
    own_class = kind_keys(kind)
    own = {k: given.pop(k) for k in [f.key for f in fields(own_class)] if k in given}
    common = {f.key for f in fields(keys.Drive)}
    strange = set(given) - common
    for other in drives.KINDS if strange else ():
        for key in {f.key for f in fields(kind_keys(other))} & strange:
            raise GenevaError(
                f'{key} belongs to kind = "{other}", and this drive is "{kind}"', ("drive", key)
            )
    return (
        _table(keys.Drive, "drive", given, tuple(own_class._fields)),
        _table(own_class, "drive", own, why=f' for kind = "{kind}"'),
    )


def _table(
    table: Any, name: str, given: dict[str, Any], also: tuple[str, ...] = (), why: str = ""
) -> Any:
    """The table's values, checked one by one."""
    known = {f.key: f for f in fields(table)}
    values = {}
    for key, value in given.items():
        if key not in known:
            raise GenevaError(
                f"unknown key {cut(key)} in [{name}]{nearest(key, (*known, *also))}; "
                f"known: {', '.join((*known, *also))}",
                (name, key),
            )
        field = f"{key}_" if f"{key}_" in table._fields else key
        values[field] = _value(known[key], value, name)
    for key, field_ in known.items():
        if field_.default is ... and key not in given:
            raise GenevaError(
                f"[{name}] needs {key}{why}: {field_.meaning}, {field_.rule}", (name,)
            )
    return table(**values)


def _value(field: Field, value: Any, table: str) -> Any:
    """One value of the right type, in its range."""
    place = (table, field.key)
    numeric = [t for t in field.types if t in (int, float)]
    if isinstance(value, (int, float)) and not isinstance(value, bool) and numeric:
        if numeric[0] is int and not isinstance(value, int):
            raise GenevaError(
                f"{field.key} = {value!r} must be a whole number{_whole(value)} ({field.meaning})",
                place,
            )
        if value not in field.rule:
            raise GenevaError(
                f"{field.key} = {_shown(value)} must be {field.rule} ({field.meaning})", place
            )
        try:
            return value if numeric[0] is int else float(value)
        except OverflowError:
            raise GenevaError(
                f"{field.key} = {_shown(value)} is too large a number ({field.meaning})", place
            ) from None
    if isinstance(value, list) and LIST in field.types:
        if not value or len(value) > LIST_MAX:
            raise GenevaError(f"{field.key} must be a list of 1 to {LIST_MAX} numbers", place)
        return tuple(_value(field._replace(types=(float,)), v, table) for v in value)
    if isinstance(value, str) and str in field.types:
        if isinstance(field.rule, tuple) and not numeric and value not in field.rule:
            raise GenevaError(
                f"{field.key} = {_shown(value)} must be {field.rule}{nearest(value, field.rule)}",
                place,
            )
        if numeric and value not in WORDS[field.key]:
            words = " or ".join(f'"{w}"' for w in WORDS[field.key])
            raise GenevaError(
                f"{field.key} must be a number or {words}, not {_shown(value)}", place
            )
        return value
    wanted = " or ".join(_NAMES[t] for t in field.types if t in _NAMES)
    raise GenevaError(f"{field.key} must be {wanted}, not {_shown(value)}", place)


def _shown(value: Any) -> str:
    """A wrong value, short enough for a message."""
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return "a list"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{cut(value)}"'
    return f"{value:.12g}" if isinstance(value, float) else cut(value)


def _whole(value: float) -> str:
    """The whole numbers beside one that is not, as it must be written."""
    if not abs(value) < EXACT:
        return ""
    if value == math.floor(value):
        return f": write {value:.0f}"
    return f", {math.floor(value)} or {math.ceil(value)}"
