"""The text of a spec: its tables in the order of a file, and keys written into a text."""

import re
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from geneva_cli.motion.drive import Drive
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import BEFORE, KINDS, Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.schema import Field, Points, fields
from geneva_cli.spec.tables import LISTS, PLAIN


def keys_of(
    gearing: type[Gearing],
    drive: type[Drive],
    law_keys: Iterable[Field],
    before: type[Drive] | None = None,
) -> dict[str, list[Field]]:
    """Every key of a spec of these kinds, by table, in the order of a file."""
    slots, *wheel = fields(gearing)
    front = KINDS[BEFORE]
    return {
        "wheel": [slots, KINDS["wheel"].word, *wheel],
        "drive": [KINDS["drive"].word, *fields(drive)],
        **({BEFORE: [front.word, *front.keys_of(before)]} if before else {}),
        "motion": [KINDS["motion"].word, *law_keys, *fields(Motion)],
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
            block = []
            for key in keys:
                value = values[key.key]
                if value != key.default or (name, key.key) in first:
                    note = notes.get(f"{name}.{key.key}", key.meaning)
                    block.append((f"{key.key} = {quoted(value)}", note))
            if block:
                lines += ["", head, *noted(block)]
    return lines


def noted(block: Sequence[tuple[str, str]]) -> list[str]:
    """Lines of settings, each with its note as a comment, if any; they begin in one column."""
    width = max((len(setting) for setting, note in block if note), default=0)
    return [f"{setting.ljust(width)}  # {note}" if note else setting for setting, note in block]


def values_of(spec: Spec, table: str) -> list[dict[str, Any]]:
    """Values by key for each table of a name: one table, none, or those of a list."""
    if table in LISTS:
        return [one.as_dict() for one in vars(spec)[table]]
    part = spec.part(table)
    if part is None:  # a motion that straight slots give
        return []
    named: Any = part.law if isinstance(part, Motion) else part
    own = {KINDS[table].word.key: named.NAME} if table in KINDS else {}
    own |= {k: v.file if isinstance(v, Points) else v for k, v in part.as_dict().items()}
    return [own]


def quoted(value: Any) -> str:
    """A value in TOML; letters that a terminal does not show stand as their codes."""
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


def inserted(text: str, table: str, keys: Mapping[str, tuple[Any, str]]) -> str | None:
    """Return a spec's text with these keys in one table, each with the comment behind it or "".

    A key that the table has gets the value, and keeps its line and its comment. Others stand behind
    the table's last key, or in a table at the end of the text. Returns None for a text in which the
    table has no line of its own, as in ``size = {pin_mm = 6}``, or a value takes several lines.

    >>> print(inserted("[size]\\nface_width_mm = 18", "size", {"pin_mm": (6.0, "rule")}))
    [size]
    face_width_mm = 18
    pin_mm = 6.0  # rule
    <BLANKLINE>
    """
    import tomli  # not to list keys

    lines, left = text.rstrip("\n").split("\n"), dict(keys)
    header = re.compile(rf"\s*\[\s*{re.escape(table)}\s*\]\s*(#.*)?")
    start = next((i for i, line in enumerate(lines) if header.fullmatch(line)), len(lines))
    if start == len(lines):
        lines += ["", f"[{table}]"]
        start += 1
    after = range(start + 1, len(lines))
    end = next((i for i in after if lines[i].lstrip().startswith("[")), len(lines))
    for i in range(start + 1, end):
        name = lines[i].partition("=")[0].strip()
        if name in left:
            lines[i] = _with_value(lines[i], left.pop(name)[0])
    last = max(i for i in range(start, end) if lines[i].strip()[:1] not in ("", "#"))
    more = [(f"{key} = {quoted(value)}", note) for key, (value, note) in left.items()]
    lines[last + 1 : last + 1] = noted(more)
    tree = node = tomli.loads(text)
    for name in table.split("."):
        node = node.setdefault(name, {})
    node.update({key: value for key, (value, _) in keys.items()})
    out = "\n".join(lines) + "\n"
    try:
        return out if tomli.loads(out) == tree else None
    except tomli.TOMLDecodeError:
        return None


def _with_value(line: str, value: Any) -> str:
    """Return a line ``key = value  # comment`` with another value."""
    parts = re.fullmatch(r"""([^=]*=\s*)("[^"]*"|'[^']*'|[^"'#]*?)(\s*#.*|\s*)""", line)
    return f"{parts[1]}{quoted(value)}{parts[3]}" if parts else line
