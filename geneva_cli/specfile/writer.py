"""A spec's tables and keys in the order of a file, and the text of a spec."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import BEFORE, DRIVES, LAWS, WHEELS, Spec, drives_before
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.schema import Field, Points, SpecTable, fields
from geneva_cli.spec.tables import LISTS, PLAIN


def keys_of(
    gearing: type[Gearing],
    drive: type[Drive],
    law_keys: Iterable[Field],
    before: type[Drive] | None = None,
) -> dict[str, list[Field]]:
    """Every key of a spec of these kinds, by table, in the order of a file."""
    slots, *wheel = fields(gearing)
    front = drives_before()
    return {
        "wheel": [slots, WHEELS.word, *wheel],
        "drive": [DRIVES.word, *fields(drive)],
        **({BEFORE: [front.word, *front.keys_of(before)]} if before else {}),
        "motion": [LAWS.word, *law_keys, *fields(Motion)],
        **{name: [*fields(table)] for name, table in PLAIN.items()},
    }


def keys_in(spec: Spec) -> dict[str, list[Field]]:
    """Every key of a spec's kinds, by table, in the order of a file."""
    law_keys = fields(type(spec.motion.law)) if spec.motion else ()
    before = type(spec.drive_before) if spec.drive_before else None
    return keys_of(type(spec.wheel), type(spec.drive), law_keys, before)


def spec_lines(spec: Spec, notes: Mapping[str, str] = MappingProxyType({})) -> list[str]:
    """Lines of a spec's tables: keys that differ from their defaults, or are changed first.

    Behind each key stands its meaning, or else the note of ``table.key`` in ``notes``.
    """
    first = {("wheel", "gearing"), (BEFORE, "kind")}
    first |= {("drive", key) for key in ("kind", "n_rpm", "rollers")}
    lines: list[str] = []
    for name, keys in keys_in(spec).items():
        head = f"[[{name}]]" if name in LISTS else f"[{name}]"
        for values in values_of(spec, name):
            block = [
                (
                    f"{key.key} = {quoted(values[key.key])}",
                    notes.get(f"{name}.{key.key}", key.meaning),
                )
                for key in keys
                if values[key.key] != key.default or (name, key.key) in first
            ]
            if block:
                lines += ["", head, *noted(block)]
    return lines


def noted(block: Sequence[tuple[str, str]]) -> list[str]:
    """Lines of settings, each with its note as a comment, if any; they begin in one column.

    >>> noted([("z = 6", "slots"), ("gearing = 2", "type")])
    ['z = 6        # slots', 'gearing = 2  # type']
    """
    width = max((len(setting) for setting, note in block if note), default=0)
    return [f"{setting.ljust(width)}  # {note}" if note else setting for setting, note in block]


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
    return [{**words.get(table, {}), **_own(vars(spec)[table.replace(".", "_")])}]


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
