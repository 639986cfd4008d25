"""Inputs of a design and values of its report, as facts and grids with names in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.names import described
from geneva_cli.output.document.blocks import Block, Fact, Facts, Grid, Heading, Prose, TextList
from geneva_cli.spec.schema import Field
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.table import Table, in_digits


def capital(text: str) -> str:
    """A text that begins with a capital, unless it begins with a symbol.

    >>> capital("slot width"), capital("k, time of motion")
    ('Slot width', 'k, time of motion')
    """
    is_symbol = len(text.partition(",")[0].partition("_")[0]) < 2
    return text if is_symbol else text[:1].upper() + text[1:]


def fact(name: str, value: Any = None) -> Fact:
    """A value of a report by its name.

    >>> fact("loads.pin_force_N", 42.0)
    Fact(name='Loads, pin force', value=42.0, unit='N')
    >>> fact("speed_m_s.max", 1.5)
    Fact(name='Speed, greatest', value=1.5, unit='m/s')
    """
    parts = [described(part) for part in name.split(".")]
    unit = next((unit for _, unit in reversed(parts) if unit), "")
    return Fact(capital(", ".join(words for words, _ in parts)), value, unit)


def facts(caption: str, values: Mapping[str, Any]) -> list[Facts]:
    """The known values under a caption; empty without any."""
    known = tuple(fact(name, value) for name, value in values.items() if is_known(value))
    return [Facts(caption, known)] if known else []


def is_known(value: object) -> bool:
    """Return True if there is a value to show."""
    return value is not None and value not in ("", ())


class RemainingValues:
    """The values that have not been shown yet."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.values = values

    def one(self, name: str) -> Any:
        """A single value, which then counts as shown."""
        return self.values.pop(name, None)

    def take(self, group: str) -> dict[str, Any]:
        """The values of a group by the rest of their names, which then count as shown."""
        begin = f"{group}."
        names = [name for name in self.values if name.startswith(begin)]
        return {name.removeprefix(begin): self.values.pop(name) for name in names}

    def rest(self) -> Iterator[Block]:
        """All values that no section has taken, such as those of a new section."""
        for group in dict.fromkeys(name.rpartition(".")[0] for name in self.values):
            own = {n: v for n, v in self.values.items() if n.rpartition(".")[0] == group}
            by_name = {n.rpartition(".")[2]: v for n, v in own.items()}
            for name in [n for n, v in by_name.items() if isinstance(v, Table)]:
                yield grid(capital(name), by_name.pop(name))
            yield from facts(capital(group.replace(".", ", ")), by_name)


def grid(caption: str, table: Table) -> Grid:
    """A table with units in its headings, without columns that have no value."""
    rows = list(table.rows())
    shown = [i for i in range(len(table.names)) if any(is_known(row[i]) for row in rows)]
    named = [fact(table.names[i]) for i in shown]
    heads = tuple(f"{head.name}, {head.unit}" if head.unit else head.name for head in named)
    return Grid(caption, heads, tuple(tuple(row[i] for i in shown) for row in rows))


def grids(caption: str, table: Table | None) -> list[Grid]:
    """The grid of a table, if there is one."""
    return [] if table is None else [grid(caption, table)]


def section(heading: str, blocks: Sequence[Block]) -> Iterator[Block]:
    """Blocks under a heading; nothing without any."""
    if blocks:
        yield Heading(heading)
        yield from blocks


def inputs(spec: Spec, with_units: Sequence[str]) -> Iterator[Block]:
    """The keys that are set, in the order of a file; ``with_units`` as in ``Design``."""
    rows = [
        # as it was set, with all its digits
        (
            name,
            in_digits(value, 10) if isinstance(value, float) else value,
            described(key.key)[1],
            key.meaning,
        )
        for name, key, value, is_default in _known(spec)
        if not is_default
    ]
    yield Heading("Inputs")
    caption = "Keys that are set; the appendix has those at their defaults"
    yield Grid(caption, ("Key", "Value", "Unit", "Meaning"), tuple(rows))
    if with_units:
        yield Prose("Written with a unit:")
        yield TextList(tuple(with_units))


def defaults(spec: Spec) -> Iterator[Block]:
    """The keys at their defaults, in the order of a file."""
    facts = [
        Fact(name, value, described(key.key)[1])
        for name, key, value, is_default in _known(spec)
        if is_default
    ]
    yield Heading("Appendix: keys at their defaults")
    yield Facts("", tuple(facts))


def _known(spec: Spec) -> Iterator[tuple[str, Field, Any, bool]]:
    """Name, key, value and whether it is the default, of each key that has a value."""
    for table, keys in keys_in(spec).items():
        several = values_of(spec, table)
        for number, values in enumerate(several):
            name = table if len(several) < 2 else f"{table}.{number}"
            for key in keys:
                value = values[key.key]
                shown = value
                if isinstance(value, tuple):
                    shown = ", ".join(f"{one:.6g}" for one in value)
                if value is not None:
                    yield f"{name}.{key.key}", key, shown, value == key.default
