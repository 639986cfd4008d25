"""Every key of a spec: a list for users, and a JSON Schema for editors.

Both come from the reader's own definitions. The schema leaves some rules to `geneva check`: keys
that need others, whole numbers written 6.0, nan, and the kind and range of a value with a unit.
"""

from collections.abc import Iterable, Sequence
from functools import cache
from typing import Any, NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.motion.machine_spec import BEFORE, KindTable, kind_tables
from geneva_cli.names import unit_of
from geneva_cli.spec.rules import Csv, OneOf, Range
from geneva_cli.spec.schema import LIST, LIST_MAX, REQUIRED, TEXT_MAX, Field, fields
from geneva_cli.spec.tables import LISTS, PLAIN
from geneva_cli.spec.units import pattern, unit_key
from geneva_cli.specfile.writer import quoted

TYPES = {int: "whole number", float: "number", str: "word", bool: "true or false", LIST: "list"}


class Key(NamedTuple):
    """One key as listed for users; ``goes_with`` names the kinds that have it."""

    table: str
    key: str
    unit: str | None
    type: str
    range: str | None
    default: str | None  # None: it follows from other keys, or is required
    required: bool
    goes_with: str | None  # None: any machine
    meaning: str

    @property
    def whole_table(self) -> str:
        """The table without the brackets of a list."""
        return self.table.strip("[]")

    @property
    def name(self) -> str:
        """The key with its table, as ``drive.A``."""
        return f"{self.whole_table}.{self.key}" if self.table else self.key


@cache
def all_keys() -> tuple[Key, ...]:
    """All keys, by table, in the order of a file."""
    keys = [Key("", "title", None, "word", None, None, False, None, "free text")]
    for of in kind_tables():
        keys.append(_key(of.table, of.word))
        having: dict[Field, list[str]] = {}
        for name, own in of.keys.items():
            for field in own:
                having.setdefault(field, []).append(name)
        for field, names in having.items():  # a key that not all have names its kinds
            some = None if len(names) == len(of.names) else f"{of.word.key} = {', '.join(names)}"
            keys.append(_key(of.table, field, some))
        keys += [_key(of.table, field, f"with a {of.word.key}") for field in of.shared]
    keys += [_key(name, field) for name, table in PLAIN.items() for field in fields(table)]
    return tuple(keys)


def about(word: str) -> Sequence[Key]:
    """Keys of a table (``drive``), or with a name (``drive.A``, ``A``); all for an empty word.

    Raises GenevaError, with the nearest name, for an unknown word.
    """
    keys = all_keys()
    if not word:
        return keys
    some = [k for k in keys if word in (k.whole_table, k.whole_table.partition(".")[0])]
    some = some or [k for k in keys if word in (k.key, k.name)]
    if not some:
        known = sorted({text for k in keys for text in (k.whole_table, k.key, k.name)})
        fault = f"is no table or key of a spec{nearest(word, known)}; `geneva keys` lists all"
        raise GenevaError(f'"{cut(word)}" {fault}')
    return some


def tables_with(key: str) -> dict[str, str]:
    """The tables that have a key, each with the key's meaning in it."""
    return {k.whole_table: k.meaning for k in all_keys() if k.key == key and k.table}


def is_whole(name: str) -> bool:
    """Return True if a key, as ``table.key``, takes only whole numbers."""
    return {k.type for k in all_keys() if k.name == name} == {TYPES[int]}


def _key(table: str, field: Field, of: str | None = None) -> Key:
    types = " or ".join(TYPES[t] for t in field.types if t in TYPES)
    has_default = field.default not in (None, REQUIRED)
    return Key(
        f"[{table}]" if table in LISTS else table,
        field.key,
        unit_of(field.key),
        "a file" if isinstance(field.rule, Csv) else types,
        None if field.rule is None else str(field.rule),
        quoted(field.default) if has_default else None,
        field.default is REQUIRED,
        of,
        field.meaning,
    )


FILE = "geneva.schema.json"  # the file that the first line of a new spec names
Schema = dict[str, Any]
TEXT: Schema = {"type": "string", "maxLength": TEXT_MAX}
# by the brackets of a range
BOUNDS = {"[": "minimum", "(": "exclusiveMinimum", "]": "maximum", ")": "exclusiveMaximum"}


def schema() -> Schema:
    """JSON Schema, draft 7, of a spec."""
    properties: Schema = {"title": {**TEXT, "description": "free text"}}
    tables = {kinds.table: _cases(kinds) for kinds in kind_tables()}
    tables[BEFORE]["required"] = ["kind"]
    tables |= {name: _table(fields(table)) for name, table in PLAIN.items()}
    for name, one in tables.items():
        whole, _, part = name.partition(".")
        if part:
            properties.setdefault(whole, _closed({}))["properties"][part] = one
        else:
            properties[name] = {"type": "array", "items": one} if name in LISTS else one
    head = {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A Geneva mechanism: a spec of geneva",
    }
    with_unit = {"type": "string", "pattern": pattern(), "description": 'as "8 in" or "2 rad/s"'}
    return head | _closed(properties, required=["wheel"], definitions={"withUnit": with_unit})


def _closed(properties: Schema, **more: Any) -> Schema:
    return {"type": "object", "additionalProperties": False, "properties": properties, **more}


def _table(keys: tuple[Field, ...]) -> Schema:
    values = {key.key: {**_described(key), **_value(key)} for key in keys}
    return _closed(values, required=_required(keys))


def _required(keys: Iterable[Field]) -> list[str]:
    return [key.key for key in keys if key.default is REQUIRED]


def _cases(of: KindTable) -> Schema:
    """A table with the keys of each kind under the word that names it.

    Without the word the table has the keys of the default kind, or none.
    """
    word = of.word
    keys = {name: (*own, *of.shared) for name, own in of.keys.items()}
    every = {key.key: key for own in reversed([of.shared, *keys.values()]) for key in own}

    def case(own: tuple[Field, ...]) -> Schema:
        """Values of a kind's own keys; those of other kinds are refused."""
        values: Schema = dict.fromkeys(every, False) | {key.key: _value(key) for key in own}
        return {"properties": values, "required": _required(own)}

    without = {"not": {"required": [word.key]}}
    cases = [{"if": without, "then": case(keys[word.default] if word.default else ())}]
    for name, own in keys.items():
        named = {"properties": {word.key: {"const": name}}, "required": [word.key]}
        cases.append({"if": named, "then": case(own)})
    is_word = {**_described(word), "type": "string", "enum": list(keys)}
    properties = {word.key: is_word, **{name: _described(key) for name, key in every.items()}}
    return _closed(properties, allOf=cases)


def _described(key: Field) -> Schema:
    """Description and default of a key, for the editor."""
    if key.default in (None, REQUIRED):
        return {"description": key.meaning}
    plain = list(key.default) if isinstance(key.default, tuple) else key.default
    return {"description": key.meaning, "default": plain}


def _value(key: Field) -> Schema:
    """Allowed values of a key."""
    if isinstance(key.rule, Csv):
        return {"type": "string"}
    kinds: list[Schema] = [{"type": "boolean"}] if bool in key.types else []
    number = next((t for t in key.types if t in (int, float)), None)
    with_unit = [{"$ref": "#/definitions/withUnit"}] if unit_key(key.key) else []
    if number:
        kinds += [_number(key.rule, whole=number is int), *with_unit]
    if LIST in key.types:
        items = _any([_number(key.rule, whole=False), *with_unit])
        kinds.append({"type": "array", "items": items, "minItems": 1, "maxItems": LIST_MAX})
    if str in key.types and (key.words or not number):
        kinds.append({"type": "string", "enum": list(key.words)} if key.words else TEXT)
    return _any(kinds)


def _any(kinds: list[Schema]) -> Schema:
    return kinds[0] if len(kinds) == 1 else {"anyOf": kinds}


def _number(bounds: Range | OneOf, whole: bool) -> Schema:
    assert isinstance(bounds, Range)
    low, high = BOUNDS[bounds.ends[0]], BOUNDS[bounds.ends[1]]
    return {"type": "integer" if whole else "number", low: bounds.low, high: bounds.high}
