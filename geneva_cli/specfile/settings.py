"""``--set KEY=VALUE``: keys of a spec that the command line sets in addition to its file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import tomli

from geneva_cli.errors import GenevaError, cut, nearest


class Setting(NamedTuple):
    """One key that an option sets: the option as typed, the key's path, and its value."""

    option: str
    path: tuple[str | int, ...]
    value: Any


def setting(text: str, option: str = "--set") -> Setting:
    """One ``table.key=value`` setting; a word's quotation marks are optional.

    >>> setting("drive.A=0.6")
    Setting(option='--set drive.A=0.6', path=('drive', 'A'), value=0.6)
    """
    key, sign, value = text.partition("=")
    typed = f"{option} {cut(text.strip())}"
    if not sign or not value.strip() or not all(key.strip().split(".")):
        raise GenevaError(f"{typed}: it must be KEY=VALUE, as in {option} drive.n_rpm=90")
    parts = whole_key(key.strip(), typed).split(".")
    path = tuple(int(p) if i and p.isdecimal() else p for i, p in enumerate(parts))
    return Setting(typed, path, read_value(value, typed))


def whole_key(key: str, typed: str) -> str:
    """Return a key with its table; without one if it is the only table that has the key.

    Raises GenevaError, which begins with ``typed``, for a key that no table or several tables have.

    >>> whole_key("n_rpm", "--set n_rpm=90"), whole_key("drive.A", "--set drive.A=0.6")
    ('drive.n_rpm', 'drive.A')
    """
    if key == "title" or "." in key:
        return key
    from geneva_cli.specfile.keys import full_names, tables_with  # loads every kind

    names = [f"{table}.{key}" for table in tables_with(key)]
    if len(names) == 1:
        return names[0]
    if names:
        raise GenevaError(f"{typed}: several tables have this key; write {' or '.join(names)}")
    known = {name.rpartition(".")[2] for name in full_names()}
    hint = nearest(key, sorted(known))
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


def applied(tree: dict[str, Any], set_keys: Sequence[Setting]) -> dict[str, Any]:
    """A spec's tree with these keys set, later settings over earlier ones.

    Raises GenevaError for a missing table of a list.
    """
    for one in set_keys:
        tree = _with(tree, one.path, one)
    return tree


def _with(node: Any, path: tuple[str | int, ...], one: Setting) -> Any:
    if not path:
        return one.value
    head, *rest = path
    if isinstance(head, int):
        several = list(node) if isinstance(node, list) else []
        if not head < len(several):
            name = ".".join(map(str, one.path[: one.path.index(head)]))
            raise GenevaError(
                f"{one.option}: the spec has {len(several)} [[{name}]], counted from 0"
            )
        several[head] = _with(several[head], tuple(rest), one)
        return several
    table = dict(node) if isinstance(node, dict) else {}
    return table | {head: _with(table.get(head), tuple(rest), one)}
