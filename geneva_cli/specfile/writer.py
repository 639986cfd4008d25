"""A spec's tables and keys in the order of a file, and the text of a spec."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from geneva_cli.motion import registry
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.machine_spec import BEFORE, Spec, attribute
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.rules import OneOf
from geneva_cli.spec.schema import Field, Points, SpecTable, fields
from geneva_cli.spec.tables import LISTS, PLAIN

# words that name a kind, each in its table
GEARING = Field(
    "gearing", "", (str,), OneOf(registry.GEARINGS), "external", "type of wheel and crank"
)
KIND = Field("kind", "", (str,), None, "crank", "type of drive")
BEFORE_KIND = KIND._replace(default=None, meaning="drive that turns the input shaft of [drive]")
LAW = Field("law", "", (str,), None, None, "motion law of curved slots (`geneva laws`)")


class KindTable(NamedTuple):
    """A table whose keys depend on a word in it: the word's key, and the keys of each kind."""

    table: str
    word: Field
    keys: Mapping[str, Sequence[Field]]
    shared: Sequence[Field] = ()  # keys of all kinds, which the word alone allows


def kind_tables() -> list[KindTable]:
    """Every table whose keys depend on a word, in the order of a file; it imports all kinds."""
    gearings = {name: fields(registry.gearing(name)) for name in registry.GEARINGS}
    drives = {name: registry.drive(name) for name in registry.DRIVES}
    every = {name: fields(drive) for name, drive in drives.items()}
    before = {name: own_fields(drive) for name, drive in drives.items() if drive.IN_FRONT}
    laws = {name: fields(registry.law(name)) for name in registry.LAWS}
    return [
        KindTable("wheel", GEARING, gearings),
        KindTable("drive", KIND, every),
        KindTable(BEFORE, BEFORE_KIND, before),
        KindTable("motion", LAW, laws, fields(Motion)),
    ]


def keys_of(
    gearing: type[Gearing],
    drive: type[Drive],
    law_keys: Iterable[Field],
    before: type[Drive] | None = None,
) -> dict[str, list[Field]]:
    """Every key of a spec of these kinds, by table, in the order of a file."""
    slots, *wheel = fields(gearing)
    return {
        "wheel": [slots, GEARING, *wheel],
        "drive": [KIND, *fields(drive)],
        **({BEFORE: [BEFORE_KIND, *own_fields(before)]} if before else {}),
        "motion": [LAW, *law_keys, *fields(Motion)],
        **{name: [*fields(table)] for name, table in PLAIN.items()},
    }


def own_fields(drive: type[Drive]) -> list[Field]:
    """Keys of a kind of drive that others do not have, as in [drive.before]."""
    shared = fields(Drive)
    return [field for field in fields(drive) if field not in shared]


def keys_in(spec: Spec) -> dict[str, list[Field]]:
    """Every key of a spec's kinds, by table, in the order of a file."""
    law_keys = fields(type(spec.motion.law)) if spec.motion else ()
    before = type(spec.drive_before) if spec.drive_before else None
    return keys_of(type(spec.wheel), type(spec.drive), law_keys, before)


def spec_lines(spec: Spec) -> list[str]:
    """Lines of a spec's tables: keys that differ from their defaults, or are changed first."""
    first = {("wheel", "gearing"), (BEFORE, "kind")}
    first |= {("drive", key) for key in ("kind", "n_rpm", "rollers")}
    lines: list[str] = []
    for name, keys in keys_in(spec).items():
        head = f"[[{name}]]" if name in LISTS else f"[{name}]"
        for values in values_of(spec, name):
            block = [
                (f"{key.key} = {quoted(values[key.key])}", key.meaning)
                for key in keys
                if values[key.key] != key.default or (name, key.key) in first
            ]
            if block:
                width = max(len(setting) for setting, _ in block)
                lines += ["", head, *[f"{s.ljust(width)}  # {note}" for s, note in block]]
    return lines


def values_of(spec: Spec, table: str) -> list[dict[str, Any]]:
    """Values by key for each table of a name: one table, none, or those of a list."""
    if table == "motion":
        if spec.motion is None:  # straight slots
            return []
        law = spec.motion.law
        return [{"law": law.NAME, **_own(law), **_own(spec.motion)}]
    if table in LISTS:
        return [_own(one) for one in vars(spec)[table]]
    words = {"wheel": {"gearing": spec.wheel.NAME}, "drive": {"kind": spec.drive.NAME}}
    if spec.drive_before:
        words[BEFORE] = {"kind": spec.drive_before.NAME}
    return [{**words.get(table, {}), **_own(vars(spec)[attribute(table)])}]


def _own(table: SpecTable) -> dict[str, Any]:
    return {k: v.file if isinstance(v, Points) else v for k, v in table.as_dict().items()}


def quoted(value: Any) -> str:
    """A value in TOML; letters that a terminal does not show stand as their codes.

    >>> print(quoted("two" + chr(10) + "lines"))
    "two\\u000Alines"
    """
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(quoted(v) for v in value)}]"
    if isinstance(value, bool):
        return str(value).lower()
    if not isinstance(value, str):
        return repr(value)
    return f'"{"".join(map(_letter, value))}"'


def _letter(letter: str) -> str:
    if letter.isprintable():
        return f"\\{letter}" if letter in '"\\' else letter
    return f"\\U{ord(letter):08X}" if letter > "\uffff" else f"\\u{ord(letter):04X}"
