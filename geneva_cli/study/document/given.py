"""The inputs of a design: every key of its spec, given or by default."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.document import Block, Grid, Heading, Prose, Row
from geneva_cli.machine.spec import Spec
from geneva_cli.spec.schema import fields
from geneva_cli.specfile.writer import keys_of, values_of
from geneva_cli.study.document.named import unit_of

HEADS = ("Key", "Value", "Unit", "Given", "Meaning")


def inputs(spec: Spec) -> Iterator[Block]:
    """The keys in the order of a file, those that follow from the rest in a sentence after them."""
    rows: list[Row] = []
    absent: list[str] = []
    law_keys = fields(type(spec.motion.law)) if spec.motion else ()
    for table, keys in keys_of(type(spec.wheel), type(spec.drive), law_keys).items():
        several = values_of(spec, table)
        if not several:
            absent.append(table)
        for number, values in enumerate(several):
            name = table if len(several) < 2 else f"{table}.{number}"
            for key in keys:
                value = values[key.key]
                if value is None:
                    absent.append(f"{name}.{key.key}")
                    continue
                shown = ", ".join(map(_plain, value)) if isinstance(value, tuple) else value
                how = "default" if value == key.default else "yes"
                whole = f"{name}.{key.key}"
                rows.append((whole, shown, unit_of(key.key), how, key.meaning))
    yield Heading("Inputs")
    yield Grid("Keys of the spec", HEADS, tuple(rows))
    if absent:
        yield Prose(f"Not given, and following from the rest or not known: {', '.join(absent)}.")


def _plain(value: float) -> str:
    return f"{value:.6g}"
