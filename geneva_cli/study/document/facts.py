"""Values of a report as facts: their names in words, and their units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from geneva_cli.document import Fact, Facts
from geneva_cli.names import described


def capital(text: str) -> str:
    """A text that begins with a capital, unless it begins with a symbol.

    >>> capital("slot width"), capital("k, time of motion")
    ('Slot width', 'k, time of motion')
    """
    is_symbol = len(text.partition(",")[0].partition("_")[0]) < 2
    return text if is_symbol else text[:1].upper() + text[1:]


def fact(name: str, value: Any) -> Fact:
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
