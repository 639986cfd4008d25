"""Values in a sentence, with their units."""

from __future__ import annotations

from geneva_cli.output import shown
from geneva_cli.output.document.values import value_text


def measured(value: float, unit: str = "", digits: int = 4) -> str:
    """A value with its unit, and with the significant digits of a sentence.

    >>> measured(8.25622, "mm"), measured(-58.2111, "deg")
    ('8.256 mm', '-58.21°')
    """
    value, unit = shown(value, unit)
    return value_text(value, "°" if unit == "deg" else unit, digits)


def bare(value: float, unit: str, digits: int = 4) -> str:
    """A value without its unit, which stands at another value of the sentence.

    >>> bare(8.25622, "mm")
    '8.256'
    """
    return value_text(shown(value, unit)[0], "", digits)
