"""From a TOML file to a spec; every complaint names the file and, where it can, the line."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any, NamedTuple

import tomli

from geneva_cli.errors import GenevaError, clean, cut, nearest
from geneva_cli.machine import registry
from geneva_cli.machine.spec import Motion, Spec, attribute
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.schema import REQUIRED, Points, Table, fields, require, shown, unknown
from geneva_cli.spec.tables import LISTS, PLAIN
from geneva_cli.specfile.lines import line_of
from geneva_cli.specfile.points import read_pairs
from geneva_cli.specfile.settings import Setting, applied, said_of, settings

BYTES_MAX = 1 << 20  # a spec is a page; a megabyte of it is a mistake
TABLES = ("wheel", "drive", "motion", *dict.fromkeys(t.partition(".")[0] for t in PLAIN))


class Text(NamedTuple):
    """A spec's text, the name that messages call its file by, and keys given beside it."""

    name: str
    text: str
    given: tuple[Setting, ...] = ()

    @contextmanager
    def located(self) -> Iterator[None]:
        """Errors that name a key come out with the file and the line where it is set."""
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
            return _spec(applied(tree, self.given), self.name)


# A sweep reads one text with other keys for each design; what is made of a tree changes none of it.
_parsed = lru_cache(maxsize=8)(tomli.loads)


def read(path: str, given: Iterable[str] = ()) -> Text:
    """The text of a spec file; ``-`` is standard input. ``given`` are ``KEY=VALUE`` beside it.

    Raises GenevaError, with the message ready to print, where it cannot be read.
    """
    name = "<stdin>" if path == "-" else path if path.strip() else repr(path)
    return Text(name, _read(path, name), settings(given))


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


class _Files:
    """The files that a spec names, read as it is read."""

    def __init__(self, spec: str) -> None:
        self.folder, self.read = os.path.dirname(spec), [spec]

    def points(self, name: Any, rule: Csv, place: tuple[str, str]) -> Points:
        """The pairs in the file that a key names, relative to the spec."""
        if not isinstance(name, str):
            raise GenevaError(f"{rule.key} must be text, not {shown(name)}", place)
        path = os.path.join(self.folder, name)
        self.read.append(path)
        return Points(tuple(read_pairs(path, rule, place)), name)


def _spec(tree: dict[str, Any], name: str) -> Spec:
    tree = dict(tree)
    title = tree.pop("title", "")
    if not isinstance(title, str):
        raise GenevaError(f"title must be text, not {shown(title)}", ("title",))
    for table, value in tree.items():
        if table not in TABLES:
            hint = nearest(table, (*TABLES, "title"))
            what = f"[{cut(table)}]" if isinstance(value, dict) else cut(table)
            raise GenevaError(
                f"unknown {'table' if isinstance(value, dict) else 'key'} {what}{hint}; "
                f"known: title, {', '.join(f'[{t}]' for t in TABLES)}",
                (table,),
            )
        if table in LISTS:
            _refuse_no_list(table, value)
        elif not isinstance(value, dict):
            raise GenevaError(f"{table} must be a table: write [{table}] above its keys", (table,))
    if "wheel" not in tree:
        raise GenevaError(
            f"{name}: no [wheel] table; the shortest spec is [wheel] and, below it, z = 6"
        )
    files = _Files(name)
    return Spec(
        wheel=_kind(
            tree["wheel"],
            "wheel",
            "gearing",
            "external",
            registry.GEARINGS,
            registry.gearing,
            files,
        ),
        drive=_kind(
            tree.get("drive", {}), "drive", "kind", "crank", registry.DRIVES, registry.drive, files
        ),
        motion=_motion(tree["motion"], files) if "motion" in tree else None,
        **_plain(tree, files),
        title=clean(title),
        path=name,
        files=tuple(files.read),
    )


def _refuse_no_list(table: str, value: Any) -> None:
    if not (isinstance(value, list) and all(isinstance(one, dict) for one in value)):
        raise GenevaError(
            f"{table} must be a list of tables: write [[{table}]] above the keys of each", (table,)
        )


def _plain(tree: dict[str, Any], files: _Files) -> dict[str, Any]:
    """The tables that do not depend on the machine, by their fields."""
    out: dict[str, Any] = {}
    for name, cls in PLAIN.items():
        table, _, part = name.partition(".")
        given = tree.get(table, {})
        if name in LISTS:
            out[name] = tuple(_one(cls, name, i, one, files) for i, one in enumerate(given or ()))
            continue
        if part:
            _refuse_part(table, given)
            given = given.get(part, {})
        out[attribute(name)] = cls(**_values(cls, given, files))
    return out


def _one(cls: type[Table], name: str, i: int, given: dict[str, Any], files: _Files) -> Table:
    """The i-th table of a list; its errors say which."""
    try:
        return cls(**_values(cls, given, files))
    except GenevaError as error:
        raise GenevaError(
            f"[[{name}]] number {i + 1}: {error}", (name, i, *error.key[1:])
        ) from None


def _refuse_part(table: str, given: dict[str, Any]) -> None:
    """Of a table of tables, such as [material]: each must be known and be a table."""
    known = [n.partition(".")[2] for n in PLAIN if n.startswith(f"{table}.")]
    for part, value in given.items():
        if part not in known:
            raise unknown(part, table, known)
        if not isinstance(value, dict):
            raise GenevaError(
                f"{part} must be a table: write [{table}.{part}] above its keys", (table, part)
            )


def _kind(
    given: dict[str, Any],
    table: str,
    word: str,
    default: str,
    kinds: dict[str, str],
    find: Callable[[str], type[Any]],
    files: _Files,
) -> Any:
    """A table whose keys depend on a word in it: the object of that kind."""
    given = dict(given)
    name = given.pop(word, default)
    cls = find(name)
    of = f'{word} = "{name}"'
    _refuse_foreign(given, cls, table, of, lambda: ((f'{word} = "{k}"', find(k)) for k in kinds))
    return cls(**_values(cls, given, files, f" for {of}", (word,)))


def _motion(given: dict[str, Any], files: _Files) -> Motion | None:
    """The motion and its law; without a law the straight slots give the motion."""
    given = dict(given)
    name = given.pop("law", None)
    if name is None:
        _refuse_lawless(given)
        return None
    cls = registry.law(name)
    own = {field.key for field in fields(cls)}
    params = {key: given.pop(key) for key in own & set(given)}
    _refuse_foreign(given, Motion, "motion", f'law = "{name}"', _laws)
    law = cls(**_values(cls, params, files, f' for law = "{name}"'))
    return Motion(law, **_values(Motion, given, files, also=("law", *own)))


def _laws() -> Iterator[tuple[str, type[Table]]]:
    return ((f'law = "{name}"', registry.law(name)) for name in registry.LAWS)


def _refuse_lawless(given: dict[str, Any]) -> None:
    """Without a law nothing of the motion is free; what is at its default does no harm."""
    known = {f.key: f.default for _, law in _laws() for f in fields(law)}
    known |= {f.key: f.default for f in fields(Motion)}
    for key, value in given.items():
        if key in known and value != known[key]:
            raise GenevaError(
                f'{key} needs a law (law = "cycloidal", say): straight slots leave it no freedom',
                ("motion", key),
            )
        if key not in known:
            raise unknown(key, "motion", ("law", *known))


def _refuse_foreign(
    given: dict[str, Any],
    cls: type[Table],
    table: str,
    of: str,
    kinds: Callable[[], Iterator[tuple[str, type[Table]]]],
) -> None:
    """Take out keys of other kinds at their defaults; raise GenevaError for others of theirs."""
    own = {field.key for field in fields(cls)}
    for key in [k for k in given if k not in own]:
        for other, theirs in kinds():
            field = next((f for f in fields(theirs) if f.key == key), None)
            if field and field.default is not REQUIRED and given[key] == field.default:
                del given[key]
                break
            if field:
                raise GenevaError(f"{key} belongs to {other}, and this is {of}", (table, key))


def _values(
    cls: type[Table],
    given: dict[str, Any],
    files: _Files,
    why: str = "",
    also: tuple[str, ...] = (),
) -> dict[str, Any]:
    """The keys of a table as its class takes them; the class checks their values."""
    known = {field.key: field for field in fields(cls)}
    out = {}
    for key, value in given.items():
        if key not in known:
            raise unknown(key, cls.TABLE, (*also, *known))
        field = known[key]
        rule = field.rule
        named = isinstance(rule, Csv)
        out[field.attribute] = files.points(value, rule, (cls.TABLE, key)) if named else value
    require(cls, tuple(given), why)
    return out
