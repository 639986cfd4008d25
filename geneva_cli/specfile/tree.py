"""Conversion of the tables of a parsed TOML file to a spec."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Mapping
from functools import partial
from typing import Any

from geneva_cli.errors import GenevaError, below, clean, cut, few, nearest
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import (
    BEFORE,
    DRIVES,
    LAWS,
    WHEELS,
    KindTable,
    Spec,
    drives_before,
    kind_tables,
)
from geneva_cli.names import unit_end
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.schema import (
    REQUIRED,
    Field,
    Points,
    SpecTable,
    fields,
    free_text,
    require,
    shown,
    unknown,
)
from geneva_cli.spec.tables import LISTS, PLAIN

TABLES = ["wheel", "drive", "motion"]
for _name in PLAIN:
    if _name.partition(".")[0] not in TABLES:
        TABLES.append(_name.partition(".")[0])

# Other names of a size: here the pin's radius is that of the roller on it.
ALSO_CALLED = {"pin_radius_mm": "roller_radius_mm", "crank_pin_radius_mm": "roller_radius_mm"}


def spec_of(tree: dict[str, Any], name: str) -> Spec:
    """The spec of a TOML file's tables; paths in it are relative to the file ``name``.

    Raises GenevaError, naming table and key, for anything invalid.
    """
    tree = dict(tree)
    title = tree.pop("title", "")
    if not isinstance(title, str):
        raise GenevaError(f"title must be text, not {shown(title)}", ("title",))
    for table, value in tree.items():
        if table not in TABLES or table in LISTS or not isinstance(value, dict):
            _refuse_table(table, value)
    if "wheel" not in tree:
        raise GenevaError(
            f"{name}: no [wheel] table; the shortest spec is [wheel] and, on the next line, z = 6"
        )
    files, plain = [name], dict[str, Any]()  # the tables that every kind of machine has
    for key, cls in PLAIN.items():
        table, _, part = key.partition(".")
        values = tree.get(table)
        if values is not None and part:
            _refuse_parts(table, values)
            values = values.get(part, {})
        if values is not None and key in LISTS:
            plain[key] = _several(key, cls, values, files)
        elif values is not None:
            plain[key.replace(".", "_")] = cls(**_values(cls, values, files))
    drawn = plain["outline"].files if "outline" in plain else ()
    files.extend(map(partial(below, os.path.dirname(name)), drawn))
    drive = dict(tree.get("drive", {}))
    before = drive.pop("before", None)
    return Spec(
        wheel=_kind(tree["wheel"], WHEELS, files),
        drive=_kind(drive, DRIVES, files),
        drive_before=None if before is None else _before(before, files),
        motion=_motion(tree["motion"], files) if "motion" in tree else None,
        **plain,
        title=clean(free_text("title", title, ("title",))),
        path=name,
        files=tuple(files),
    )


def _refuse_table(table: str, value: Any) -> None:
    """Raise GenevaError for what is no table of a spec, and no list of tables where one may be."""
    if table not in TABLES:
        named = f"table [{cut(table)}]" if isinstance(value, dict) else f"key {cut(table)}"
        where = "" if isinstance(value, dict) else _tables(_meanings(table))
        if where:
            text = f"{table} belongs to {where}; write it below that line"
            raise GenevaError(text, (table,))
        known = few(table, [f"[{t}]" for t in TABLES])
        hint = nearest(table, (*TABLES, "title"))
        raise GenevaError(f"unknown {named}{hint}; known: title, {known}", (table,))
    if table not in LISTS:
        raise GenevaError(f"{table} must be a table: write [{table}] above its keys", (table,))
    if not (isinstance(value, list) and all(isinstance(one, dict) for one in value)):
        several = f"a list of tables: write [[{table}]] above the keys of each"
        raise GenevaError(f"{table} must be {several}", (table,))


def _refuse_parts(table: str, values: dict[str, Any]) -> None:
    """Raise GenevaError for what is no table of a table, such as [material.wheel]."""
    known = [n.partition(".")[2] for n in PLAIN if n.startswith(f"{table}.")]
    for own, value in values.items():
        if own not in known:
            raise unknown(own, table, known)
        if not isinstance(value, dict):
            text = f"{own} must be a table: write [{table}.{own}] above its keys"
            raise GenevaError(text, (table, own))


def _several(
    name: str, cls: type[SpecTable], values: list[dict[str, Any]], files: list[str]
) -> tuple[SpecTable, ...]:
    """The tables of a list; an error says which one it is."""
    several = []
    for i, one in enumerate(values):
        try:
            several.append(cls(**_values(cls, one, files)))
        except GenevaError as error:
            where = f"[[{name}]] number {i + 1}"
            raise GenevaError(f"{where}: {error}", (name, i, *error.key[1:])) from None
    return tuple(several)


def _kind(values: dict[str, Any], kinds: KindTable, files: list[str]) -> Any:
    """The object of a table whose keys depend on a word in it, such as ``kind``."""
    values = dict(values)
    name = values.pop(kinds.word.key, kinds.word.default)
    cls, of = kinds.find(name), f'{kinds.word.key} = "{name}"'
    own: dict[str, Field] = {}
    for field in fields(cls):
        if field not in kinds.without:
            own[field.key] = field
    if not values.keys() <= own.keys():
        _refuse_foreign(values, own, kinds, of)
        strange = next(key for key in values if key not in own)
        shared = fields(Drive)  # they stand behind those of this kind
        order = sorted(own.items(), key=lambda item: item[1] in shared)
        raise _unknown(strange, kinds.table, dict(order))
    return cls(**_values(cls, values, files, f" for {of}"))


def _before(values: Any, files: list[str]) -> Any:
    """The drive before another one; an error names its table."""
    place = tuple(BEFORE.split("."))
    if not isinstance(values, dict):
        raise GenevaError(f"before must be a table: write [{BEFORE}] above its keys", place)
    if "kind" not in values:
        raise GenevaError(f"[{BEFORE}] needs kind: the drive that turns the shaft", place)
    try:
        return _kind(values, drives_before(), files)
    except GenevaError as error:
        if error.key[:2] == place:  # it names the table
            raise
        raise GenevaError(f"[{BEFORE}]: {error}", (*place, *error.key[1:])) from None


def _motion(values: dict[str, Any], files: list[str]) -> Motion | None:
    """The motion and its law, or None without a law, if the straight slots give the motion."""
    values = dict(values)
    name = values.pop("law", None)
    if name is None:
        known = {f.key: f for keys in (*LAWS.keys.values(), LAWS.shared) for f in keys}
        for key in values:
            if key not in known:
                raise _unknown(key, "motion", known)
            raise GenevaError(
                f'{key} needs a law, such as law = "cycloidal": straight slots fix the motion',
                ("motion", key),
            )
        return None
    cls, of = registry.law(name), f'law = "{name}"'
    own = {field.key for field in fields(cls)}
    params = {key: values.pop(key) for key in own & set(values)}
    _refuse_foreign(values, [field.key for field in LAWS.shared], LAWS, of)
    law = cls(**_values(cls, params, files, f" for {of}"))
    return Motion(law, **_values(Motion, values, files, also=fields(cls)))


def _unknown(key: str, table: str, known: Mapping[str, Field]) -> GenevaError:
    """Error for a key that a table does not have; it names the tables that have it.

    A single table is named with the key's meaning in it: a size in [tolerance] is a deviation.
    """
    meanings = _meanings(key)
    half = key.replace("_diameter_", "_radius_")
    twin = f"; {half} in [{table}] is half a diameter" if half != key and half in known else ""
    if tables := _tables(meanings):
        meaning = f" ({meanings.popitem()[1]})" if len(meanings) == 1 else ""
        where = (*table.split("."), key)
        return GenevaError(
            f"unknown key {key} in [{table}]; it belongs to {tables}{meaning}{twin}", where
        )
    of_table = [of for of in kind_tables() if of.table == table]
    kinds = [f'{of.word.key} = "{key}"' for of in of_table if key in of.names]
    other = ALSO_CALLED.get(key)
    meant = kinds[0] if kinds else f'"{other}"' if other in known else ""
    hint = f" (did you mean {meant}?)" if meant else twin
    known = {**{of.word.key: of.word for of in of_table}, **known}
    return unknown(key, table, tuple(known), hint or _hint(key, known.values()))


def _meanings(key: str) -> dict[str, str]:
    """The tables that have a key, each with the key's meaning in it."""
    from geneva_cli.specfile.keys import tables_with  # only for messages

    return tables_with(key)


def _tables(names: Collection[str]) -> str:
    """Tables for a message; nothing for none and for more than three."""
    tables = [f"[[{name}]]" if name in LISTS else f"[{name}]" for name in names]
    return " or ".join(tables) if len(tables) <= 3 else ""


def _hint(typed: str, known: Iterable[Field]) -> str:
    """The known key that an unknown one means by a word of the meanings, or nothing.

    Nothing too where a known key is spelt like it: that one is named without this hint.
    """
    end = unit_end(typed)
    word = typed.removesuffix(end)
    keys = [field.key for field in known]
    for field in known if not nearest(typed, keys) else ():
        if end in ("", unit_end(field.key)) and word in re.findall(r"[\w-]+", field.meaning):
            return f' (did you mean "{field.key}", {field.meaning.partition(";")[0]}?)'
    return ""


def _refuse_foreign(
    values: dict[str, Any], own: Collection[str], kinds: KindTable, of: str
) -> None:
    """Raise GenevaError for a key of another kind; capitals make no difference to whose it is."""
    known = {key.casefold() for key in own}
    foreign = [key for key in values if key.casefold() not in known]
    if not foreign:  # the keys of all kinds are a dozen imports
        return
    theirs: dict[str, str] = {}  # the first kind that has a key
    for name, keys in kinds.keys.items():
        for field in keys:
            theirs.setdefault(field.key, name)
    by_small = {key.casefold(): key for key in theirs}
    for key in foreign:
        if meant := by_small.get(key.casefold()):
            fault = key
            if key not in theirs:
                hint = nearest(key, [meant])
                fault = f"unknown key {cut(key)} in [{kinds.table}]{hint}; {meant}"
            other = f'{kinds.word.key} = "{theirs[key if key in theirs else meant]}"'
            raise GenevaError(f"{fault} belongs to {other}, but this is {of}", (kinds.table, key))


def _values(
    cls: type[SpecTable],
    values: dict[str, Any],
    files: list[str],
    why: str = "",
    also: Iterable[Field] = (),
) -> dict[str, Any]:
    """Keys of a table as arguments of its class, which checks their values.

    ``files`` are the spec's and those read so far.
    The table has the keys ``also`` too; they are only for the message about an unknown key.
    """
    known: dict[str, Field] = {}
    is_whole = True
    for field in fields(cls):
        known[field.key] = field
        is_whole = is_whole and (field.default is not REQUIRED or field.key in values)
    out: dict[str, Any] = {}
    for key, value in values.items():
        if key not in known:
            known |= {field.key: field for field in also}
            raise _unknown(key, cls.TABLE, known)
        field, place = known[key], (cls.TABLE, key)
        if isinstance(field.rule, Csv):  # the name of a file, relative to the spec
            from geneva_cli.specfile.columns import read_pairs

            if not isinstance(value, str):
                raise GenevaError(f"file must be text, not {shown(value)}", place)
            files.append(below(os.path.dirname(files[0]), value))
            value = Points(tuple(read_pairs(files[-1], field.rule, place)), value)
        out[field.attribute] = value
    if not is_whole:
        require(cls, tuple(values), why)
    return out
