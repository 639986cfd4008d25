"""Conversion of the tables of a parsed TOML file to a spec."""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from geneva_cli.errors import GenevaError, below, clean, cut, few, nearest
from geneva_cli.motion import machine_spec
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import BEFORE, DRIVES, LAWS, WHEELS, KindTable, Spec
from geneva_cli.spec import schema
from geneva_cli.spec.rules import Csv
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
        raise GenevaError(f"title must be text, not {schema.shown(title)}", ("title",))
    for table, value in tree.items():
        if table not in TABLES:
            raise _no_table(table, value)
        if table not in LISTS and not isinstance(value, dict):
            raise _not_a_table(table)
    if "wheel" not in tree:
        raise GenevaError(f"{name}: no [wheel]; write it, and z = 6 on the next line")
    files, plain = [name], dict[str, Any]()  # the tables that every kind of machine has
    for key, cls in PLAIN.items():
        table, _, part = key.partition(".")
        values = tree.get(table)
        if values is not None and part:
            values = _part(table, part, values)
        if values is not None and key in LISTS:
            plain[key] = _several(key, cls, values, files)
        elif values is not None:
            plain[key.replace(".", "_")] = cls(**_arguments(cls, values, files))
    for drawing in plain["outline"].files if "outline" in plain else ():
        files.append(below(os.path.dirname(name), drawing))
    drive = dict(tree.get("drive", {}))
    before = drive.pop("before", None)
    return Spec(
        wheel=_kind(tree["wheel"], WHEELS, files),
        drive=_kind(drive, DRIVES, files),
        drive_before=None if before is None else _before(before, files),
        motion=_motion(tree["motion"], files) if "motion" in tree else None,
        **plain,
        title=clean(schema.free_text("title", title, ("title",))),
        path=name,
        files=tuple(files),
    )


def _no_table(name: str, value: Any) -> GenevaError:
    """The error for what is no table of a spec."""
    where = "" if isinstance(value, dict) else _having(name)[0]
    if where:
        return GenevaError(f"{name} belongs to {where}; write it below that line", (name,))
    named = f"table [{cut(name)}]" if isinstance(value, dict) else f"key {cut(name)}"
    hint, known = nearest(name, (*TABLES, "title")), few(name, [f"[{t}]" for t in TABLES])
    return GenevaError(f"unknown {named}{hint}; known: title, {known}", (name,))


def _not_a_table(table: str) -> GenevaError:
    """The error for a value in place of a table."""
    *_, key = place = tuple(table.split("."))
    return GenevaError(f"{key} must be a table: write [{table}] above its keys", place)


def _part(table: str, part: str, values: dict[str, Any]) -> Any:
    """A table of a table, such as [material.wheel]; None without it."""
    known = [name.partition(".")[2] for name in PLAIN if name.startswith(f"{table}.")]
    for own in values:
        if own not in known:
            raise schema.unknown(own, table, known)
    if not isinstance(values.get(part, {}), dict):
        raise _not_a_table(f"{table}.{part}")
    return values.get(part)


def _several(
    name: str, cls: type[schema.SpecTable], values: Any, files: list[str]
) -> list[schema.SpecTable]:
    """The tables of a list; an error says which one it is."""
    if not (isinstance(values, list) and all(isinstance(one, dict) for one in values)):
        text = f"{name} must be a list of tables: write [[{name}]] above the keys of each"
        raise GenevaError(text, (name,))
    several = []
    for i, one in enumerate(values):
        with _within(f"[[{name}]] number {i + 1}", (name, i)):
            several.append(cls(**_arguments(cls, one, files)))
    return several


@contextmanager
def _within(table: str, place: tuple[str | int, ...]) -> Iterator[None]:
    """Context in which errors of a table in a list or a table begin with its name."""
    try:
        yield
    except GenevaError as error:
        if error.key[: len(place)] == place:  # it names the table
            raise
        raise GenevaError(f"{table}: {error}", (*place, *error.key[1:])) from None


def _kind(values: dict[str, Any], kinds: KindTable, files: list[str]) -> Any:
    """The object of a table whose keys depend on a word in it, such as ``kind``."""
    values = dict(values)
    name = values.pop(kinds.word.key, kinds.word.default)
    cls = kinds.find(name)
    return cls(**_arguments(cls, values, files, kinds, name))


def _before(values: Any, files: list[str]) -> Any:
    """The drive before another one; an error names its table."""
    if not isinstance(values, dict):
        raise _not_a_table(BEFORE)
    place = ("drive", "before")
    if "kind" not in values:
        raise GenevaError(f"[{BEFORE}] needs kind: the drive that turns the shaft", place)
    with _within(f"[{BEFORE}]", place):
        return _kind(values, machine_spec.drives_before(), files)


def _motion(values: dict[str, Any], files: list[str]) -> Motion | None:
    """The motion and its law, or None without a law, if the straight slots give the motion."""
    values = dict(values)
    name = values.pop("law", None)
    if name is None:
        every = [field for keys in (*LAWS.keys.values(), LAWS.shared) for field in keys]
        for key in values:
            if key not in [field.key for field in every]:
                raise _unknown(key, "motion", every)
            text = f'{key} needs a law, such as law = "cycloidal": straight slots fix the motion'
            raise GenevaError(text, ("motion", key))
        return None
    cls = LAWS.find(name)
    own = {field.key: values.pop(field.key) for field in schema.fields(cls) if field.key in values}
    law: Any = cls(**_arguments(cls, own, files, LAWS, name))
    return Motion(law, **_arguments(Motion, values, files, LAWS, name))


def _unknown(
    key: str, table: str, own: Iterable[schema.Field], kinds: KindTable | None = None, of: str = ""
) -> GenevaError:
    """Error for a key that a table does not have; it names what has it.

    ``of`` is the kind of a table whose keys depend on its kind. A single other table is named with
    the key's meaning in it: a size in [tolerance] is a deviation.
    """
    keys, place = [field.key for field in own], (*table.split("."), key)
    if kinds:
        for name, others in kinds.keys.items():
            if key in [field.key for field in others]:
                word = kinds.word.key
                text = f'{key} belongs to {word} = "{name}", but this is {word} = "{of}"'
                return GenevaError(text, place)
    half = key.replace("_diameter_", "_radius_")
    twin = f"; {half} in [{table}] is half a diameter" if half != key and half in keys else ""
    where, meaning = _having(key)
    if where:
        text = f"unknown key {key} in [{table}]; it belongs to {where}{meaning}{twin}"
        return GenevaError(text, place)
    hint = twin
    if ALSO_CALLED.get(key) in keys:
        hint = f' (did you mean "{ALSO_CALLED[key]}"?)'
    for one in machine_spec.kind_tables():
        if one.table == table:
            keys.insert(0, one.word.key)
            if key in one.names:
                hint = f' (did you mean {one.word.key} = "{key}"?)'
    return schema.unknown(key, table, keys, hint)


def _having(key: str) -> tuple[str, str]:
    """The tables that have a key, and its meaning if it is one; nothing for more than three."""
    from geneva_cli.specfile.keys import tables_with  # only for messages

    meanings = tables_with(key)
    tables = [f"[[{name}]]" if name in LISTS else f"[{name}]" for name in meanings]
    if len(tables) > 3:
        return "", ""
    meaning = f" ({meanings.popitem()[1]})" if len(meanings) == 1 else ""
    return " or ".join(tables), meaning


def _arguments(
    cls: type[schema.SpecTable],
    values: dict[str, Any],
    files: list[str],
    kinds: KindTable | None = None,
    of: str = "",
) -> dict[str, Any]:
    """Keys of a table as arguments of its class, which checks their values.

    ``files`` are the spec's and those read so far; ``of`` is the kind of a table of ``kinds``.
    """
    out: dict[str, Any] = {}
    is_whole = True
    for field in schema.fields(cls):
        if field.key not in values:
            is_whole = is_whole and field.default is not schema.REQUIRED
            continue
        value = values[field.key]
        if isinstance(field.rule, Csv):  # the name of a file, relative to the spec
            from geneva_cli.specfile.columns import read_pairs

            place = (cls.TABLE, field.key)
            if not isinstance(value, str):
                raise GenevaError(f"file must be text, not {schema.shown(value)}", place)
            files.append(below(os.path.dirname(files[0]), value))
            value = schema.Points(tuple(read_pairs(files[-1], field.rule, place)), value)
        out[field.attribute] = value
    if len(out) < len(values):
        own = schema.fields(cls)
        if kinds:  # keys of the kind come first
            shared = (*kinds.shared, *schema.fields(Drive))
            own = (*(f for f in schema.fields(kinds.find(of)) if f not in shared), *own)
        known = {field.key: field for field in own}
        key = next(key for key in values if key not in known)
        raise _unknown(key, kinds.table if kinds else cls.TABLE, known.values(), kinds, of)
    if not is_whole:
        schema.require(cls, tuple(values), f' for {kinds.word.key} = "{of}"' if kinds else "")
    return out
