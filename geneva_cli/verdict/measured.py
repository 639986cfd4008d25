"""Values in a sentence, with their units."""

from __future__ import annotations

from geneva_cli.output.document.values import value_text


def measured(value: float, unit: str = "", digits: int = 4) -> str:
    """A value with its unit, and with the significant digits of a sentence.

    >>> measured(8.25622, "mm"), measured(-58.2111, "deg")
    ('8.256 mm', '-58.21°')
    """
    return value_text(value, "°" if unit == "deg" else unit, digits)
