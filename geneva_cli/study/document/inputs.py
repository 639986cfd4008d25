"""The inputs of a design: the keys that its spec sets, and those at their defaults."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.names import described
from geneva_cli.output.document.blocks import Block, Fact, Facts, Grid, Heading, Prose, TextList
from geneva_cli.spec.schema import Field
from geneva_cli.specfile.writer import keys_in, values_of


def inputs(spec: Spec, with_units: Sequence[str]) -> Iterator[Block]:
    """The keys that are set, in the order of a file; ``with_units`` as in ``Design``."""
    rows = [
        (f"{name}.{key.key}", _shown(value), described(key.key)[1], key.meaning)
        for name, key, value in _known(spec)
        if value != key.default
    ]
    yield Heading("Inputs")
    caption = "Keys that are set; the appendix has those at their defaults"
    yield Grid(caption, ("Key", "Value", "Unit", "Meaning"), tuple(rows))
    if with_units:
        yield Prose("Written with a unit:")
        yield TextList(tuple(with_units))


def defaults(spec: Spec) -> Iterator[Block]:
    """The keys at their defaults, in the order of a file."""
    facts = (
        Fact(f"{name}.{key.key}", _shown(value), described(key.key)[1])
        for name, key, value in _known(spec)
        if value == key.default
    )
    yield Heading("Appendix: keys at their defaults")
    yield Facts("", tuple(facts))


def _known(spec: Spec) -> Iterator[tuple[str, Field, Any]]:
    """Table, key and value of each key that has a value, in the order of a file."""
    for table, keys in keys_in(spec).items():
        several = values_of(spec, table)
        for number, values in enumerate(several):
            name = table if len(several) < 2 else f"{table}.{number}"
            for key in keys:
                if values[key.key] is not None:
                    yield name, key, values[key.key]


def _shown(value: Any) -> Any:
    if isinstance(value, tuple):
        return ", ".join(f"{one:.6g}" for one in value)
    return value
