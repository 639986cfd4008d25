"""A spec's tables and keys in the order of a file, and a spec written as one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from geneva_cli.machine import registry
from geneva_cli.machine.drives.drive import Drive
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.spec.rules import OneOf
from geneva_cli.spec.schema import Field, Points, Table, fields
from geneva_cli.spec.tables import Limits, Load, Size

# The words that name a kind, each in its table.
GEARING = Field(
    "gearing", "", (str,), OneOf(registry.GEARINGS), "external", "where the crank turns"
)
KIND = Field("kind", "", (str,), None, "crank", "what turns the crank")
LAW = Field("law", "", (str,), None, None, "motion law of curved slots (`geneva laws`)")

# Keys that a written spec shows also at their defaults: what one will change first.
SHOWN = {("wheel", "gearing"), ("drive", "kind"), ("drive", "n_rpm"), ("drive", "rollers")}


def keys_of(
    gearing: type[Gearing], drive: type[Drive], law_keys: Iterable[Field]
) -> dict[str, list[Field]]:
    """Every key of a spec of these kinds, table by table in the order of a file."""
    slots, *wheel = fields(gearing)
    return {
        "wheel": [slots, GEARING, *wheel],
        "drive": [KIND, *fields(drive)],
        "motion": [LAW, *law_keys, *fields(Motion)],
        "size": [*fields(Size)],
        "load": [*fields(Load)],
        "limits": [*fields(Limits)],
    }


def written(spec: Spec) -> list[str]:
    """The lines of a spec's tables: keys that are not at their defaults, and a few others."""
    law_keys = fields(type(spec.motion.law)) if spec.motion else ()
    lines: list[str] = []
    for name, keys in keys_of(type(spec.wheel), type(spec.drive), law_keys).items():
        values = _values(spec, name)
        if not values:  # no motion is given: straight slots
            continue
        block = [
            (f"{key.key} = {quoted(values[key.key])}", key.meaning)
            for key in keys
            if key.key in values and (values[key.key] != key.default or (name, key.key) in SHOWN)
        ]
        if block:
            width = max(len(setting) for setting, _ in block)
            lines += ["", f"[{name}]", *[f"{s.ljust(width)}  # {note}" for s, note in block]]
    return lines


def _values(spec: Spec, table: str) -> dict[str, Any]:
    """A table's values by their keys."""
    if table == "motion":
        if spec.motion is None:
            return {}
        law = spec.motion.law
        return {"law": law.NAME, **_own(law), **_own(spec.motion)}
    of: dict[str, tuple[dict[str, Any], Table]] = {
        "wheel": ({"gearing": spec.wheel.NAME}, spec.wheel),
        "drive": ({"kind": spec.drive.NAME}, spec.drive),
        "size": ({}, spec.size),
        "load": ({}, spec.load),
        "limits": ({}, spec.limits),
    }
    word, own = of[table]
    return {**word, **_own(own)}


def _own(table: Table) -> dict[str, Any]:
    return {k: v.file if isinstance(v, Points) else v for k, v in table.as_dict().items()}


def quoted(value: Any) -> str:
    """A value as TOML has it."""
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(quoted(v) for v in value)}]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
