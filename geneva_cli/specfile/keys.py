"""Every key of a spec: its unit, type, range, default, and the kinds that have it."""

from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.motion.machine_spec import kind_tables
from geneva_cli.names import unit_of
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.schema import LIST, REQUIRED, Field, fields
from geneva_cli.spec.tables import LISTS, PLAIN
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


def all_keys() -> list[Key]:
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
    return keys + [_key(name, field) for name, table in PLAIN.items() for field in fields(table)]


def about(word: str) -> list[Key]:
    """Keys of a table (``drive``), or with a name (``drive.A``, ``A``); all for an empty word.

    Raises GenevaError, with the nearest name, for an unknown word.

    >>> [(k.table, k.key, k.range) for k in about("drive.A")]
    [('drive', 'A', 'above -1, below 1'), ('drive', 'A', 'above -1, below 1')]
    """
    keys = all_keys()
    if not word:
        return keys
    some = [k for k in keys if word in (k.whole_table, k.whole_table.partition(".")[0])]
    some = some or [k for k in keys if word in (k.key, k.name)]
    if not some:
        known = sorted({text for k in keys for text in (k.whole_table, k.key, k.name)})
        raise GenevaError(
            f'"{cut(word)}" is not a table or key of a spec{nearest(word, known)}; '
            "`geneva keys` lists all"
        )
    return some


def full_names() -> dict[str, str]:
    """Every key as ``table.key``, with its meaning."""
    return {k.name: k.meaning for k in all_keys() if k.table}


def tables_with(key: str) -> dict[str, str]:
    """The tables that have a key, each with the key's meaning in it.

    >>> list(tables_with("friction"))
    ['load', 'support', 'product']
    """
    return {k.whole_table: k.meaning for k in all_keys() if k.key == key and k.table}


def is_whole(name: str) -> bool:
    """Return True if a key, as ``table.key``, takes only whole numbers.

    >>> is_whole("wheel.z"), is_whole("drive.A")
    (True, False)
    """
    types = {k.type for k in all_keys() if k.name == name}
    return types == {TYPES[int]}


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
