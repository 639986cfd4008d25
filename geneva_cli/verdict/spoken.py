"""Names and values in a sentence: ``crank_bore_wall_mm`` is a crank bore wall, 8.256 mm."""

from __future__ import annotations

from geneva_cli.output.document.values import shown
from geneva_cli.specfile.keys import UNITS

DIGITS = 4  # significant, in a sentence


def spoken(name: str) -> tuple[str, str]:
    """The words of a name, and its unit; no unit is an empty text.

    >>> spoken("crank_bore_wall_mm"), spoken("jerk_max")
    (('crank bore wall', 'mm'), ('jerk max', ''))
    """
    end = next((end for end in UNITS if name.endswith(end)), "")
    return name.removesuffix(end).replace("_", " "), UNITS.get(end, "")


def measured(value: float, unit: str = "", digits: int = DIGITS) -> str:
    """A value with its unit.

    >>> measured(8.25622, "mm"), measured(-58.2111, "deg")
    ('8.256 mm', '-58.21°')
    """
    return shown(value, "°" if unit == "deg" else unit, digits)
